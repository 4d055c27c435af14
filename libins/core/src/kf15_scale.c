/// \file   kf15_scale.c
/// \brief  Covariance of scale factors beside the 15 errors of a strapdown. Frames: b -> n (NED). SI, rad.
///
/// With D and G of s' = D s, x' = Phi x + G s, B = [B1 (15); B2 (6)] and M = Phi B1 + G B2 / 2:
///     P = Phi P Phi' + Q + M G' + G M'        B1 = (M + G B2 / 2) D        B2 = D B2 D + q
/// SPDX-License-Identifier: MIT
#include "ins/kf15_scale.h"
#include "ins/ins_math.h"
#include "ins/vec.h"
#include "kalman_internal.h"
#include "kf15_internal.h"

#define SCALE_N    INS_KF15_SCALE_N
#define SCALE_MOST INS_KF15_P ///< states that scale factors drive: attitude and velocity

static int is_sigma(ins_real sigma, ins_real tau)
{
    return sigma >= 0 && sigma <= INS_KF15_SCALE_MAX && tau >= INS_STRAPDOWN_PERIOD_MAX && tau <= INS_REAL_MAX;
}

ins_status_t ins_kf15_scale_init(ins_kf15_scale_t* self, const ins_kf15_scale_sensors_t* sensors)
{
    if (!is_sigma(sensors->gyro_sigma, sensors->gyro_tau) || !is_sigma(sensors->accel_sigma, sensors->accel_tau))
    {
        return INS_E_RANGE;
    }
    for (unsigned i = 0; i < (INS_KF15_N + SCALE_N) * SCALE_N; i++)
    {
        self->B[i] = 0;
    }
    for (unsigned i = 0; i < SCALE_N; i++)
    {
        const ins_real sigma = i < 3 ? sensors->gyro_sigma : sensors->accel_sigma;
        self->B[(INS_KF15_N + i) * SCALE_N + i] = sigma * sigma;
        self->K[i] = 0;
    }
    self->sensors = *sensors;
    return INS_OK;
}

/// Rows of G: of attitude by the gyros' scale factors, of velocity by the accelerometers'; -C diag(x) dt.
static void drive(const ins_kf15_model_t* m, const ins_real theta_b[3], const ins_real v_b[3], ins_real G[18])
{
    const ins_real per_dt = 1 / m->dt;
    for (unsigned k = 0; k < 3; k++)
    {
        const ins_real w = -per_dt * theta_b[k];
        const ins_real f = -per_dt * v_b[k];
        for (unsigned i = 0; i < 9; i += 3)
        {
            G[i + k] = w * m->C[i + k];
            G[9 + i + k] = f * m->C[i + k];
        }
    }
}

/// M = Phi B1. \param[in] m  as kf15_turn() is told; there are six columns here.
static void turn_crossed(const ins_kf15_model_t* m, const ins_real* restrict B, ins_real* restrict M)
{
    for (unsigned i = 0; i < 3; i++)
    {
        for (unsigned j = 0; j < SCALE_N; j++)
        {
            M[(INS_KF15_PHI + i) * SCALE_N + j] = kf15_attitude(m, i, B + j, SCALE_N);
            M[(INS_KF15_V + i) * SCALE_N + j] = kf15_velocity(m, i, B + j, SCALE_N);
            M[(INS_KF15_P + i) * SCALE_N + j] = kf15_position(m, i, B + j, SCALE_N);
            M[(INS_KF15_BG + i) * SCALE_N + j] = m->bg.phi * B[(INS_KF15_BG + i) * SCALE_N + j];
            M[(INS_KF15_BA + i) * SCALE_N + j] = m->ba.phi * B[(INS_KF15_BA + i) * SCALE_N + j];
        }
    }
}

/// Which of two sets of three columns drives state i < SCALE_MOST.
static unsigned columns_of(unsigned i)
{
    return i < INS_KF15_V ? 0 : 3;
}

/// G B2 / 2: the first SCALE_MOST rows, the others are 0.
static void half_driven(const ins_real G[18], const ins_real* restrict B2, ins_real* restrict half)
{
    for (unsigned i = 0; i < SCALE_MOST; i++)
    {
        const ins_real* const b = B2 + columns_of(i) * SCALE_N;
        const ins_real g0 = INS_C(0.5) * G[3 * i];
        const ins_real g1 = INS_C(0.5) * G[3 * i + 1];
        const ins_real g2 = INS_C(0.5) * G[3 * i + 2];
        for (unsigned j = 0; j < SCALE_N; j++)
        {
            half[i * SCALE_N + j] = g0 * b[j] + g1 * b[SCALE_N + j] + g2 * b[2 * SCALE_N + j];
        }
    }
}

/// P + M G' + G M'
static void scale_spread(const ins_real G[18], const ins_real* M, ins_real* P)
{
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        for (unsigned j = 0; j < SCALE_MOST && j <= i; j++)
        {
            ins_real p = P[i * INS_KF15_ROW + j] + ins_vec_dot(M + i * SCALE_N + columns_of(j), G + 3 * j);
            if (i < SCALE_MOST)
            {
                p += ins_vec_dot(M + j * SCALE_N + columns_of(i), G + 3 * i);
            }
            P[i * INS_KF15_ROW + j] = p;
            P[j * INS_KF15_ROW + i] = p;
        }
    }
}

void ins_kf15_scale_propagate(ins_kf15_scale_t* self, ins_kf15_t* kf, const ins_kf15_model_t* model,
                              const ins_real theta_b[3], const ins_real v_b[3])
{
    ins_real G[18];
    ins_real M[INS_KF15_N * SCALE_N];
    ins_real half[SCALE_MOST * SCALE_N];
    ins_real keep[SCALE_N];
    ins_real q[SCALE_N];
    ins_real* const B2 = self->B + INS_KF15_N * SCALE_N;
    for (unsigned j = 0; j < SCALE_N; j++)
    {
        const ins_real sigma = j < 3 ? self->sensors.gyro_sigma : self->sensors.accel_sigma;
        const ins_real fall = model->dt / (j < 3 ? self->sensors.gyro_tau : self->sensors.accel_tau);
        keep[j] = 1 - fall;
        q[j] = sigma * sigma * fall * (2 - fall); // the variance of its own stays
    }
    drive(model, theta_b, v_b, G);
    half_driven(G, B2, half);
    turn_crossed(model, self->B, M);
    for (unsigned i = 0; i < SCALE_MOST * SCALE_N; i++)
    {
        M[i] += half[i];
    }
    ins_kf15_propagate(kf, model);
    scale_spread(G, M, kf->P);
    for (unsigned i = 0; i < SCALE_MOST * SCALE_N; i++)
    {
        M[i] += half[i];
    }
    for (unsigned i = 0; i < INS_KF15_N * SCALE_N; i += SCALE_N)
    {
        for (unsigned j = 0; j < SCALE_N; j++)
        {
            self->B[i + j] = keep[j] * M[i + j];
        }
    }
    for (unsigned i = 0; i < SCALE_N; i++)
    {
        for (unsigned j = 0; j < SCALE_N; j++)
        {
            B2[i * SCALE_N + j] *= keep[i] * keep[j];
        }
        B2[i * SCALE_N + i] += q[i];
    }
}

/// y += k x, elements of x `step` apart.
static inline void add_scaled(unsigned n, ins_real* restrict y, ins_real k, const ins_real* restrict x, unsigned step)
{
    for (unsigned j = 0; j < n; j++)
    {
        y[j] += k * x[j * step];
    }
}

/// g = P h' + B1 h_s', g_s = B1' h' + B2 h_s'.
static void times_all(const ins_kf15_scale_t* self, const ins_kf15_t* kf, const ins_real* h, const ins_real* h_s,
                      ins_real* g, ins_real* g_s)
{
    for (unsigned j = 0; j < INS_KF15_ROW; j++)
    {
        g[j] = 0;
    }
    for (unsigned j = 0; j < SCALE_N; j++)
    {
        g_s[j] = 0;
    }
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        if (h[i] != 0)
        {
            add_scaled(KF15_COLUMNS, g, h[i], kf->P + i * INS_KF15_ROW, 1);
            add_scaled(SCALE_N, g_s, h[i], self->B + i * SCALE_N, 1);
        }
    }
    for (unsigned k = 0; k < SCALE_N; k++)
    {
        if (h_s[k] != 0)
        {
            add_scaled(INS_KF15_N, g, h_s[k], self->B + k, SCALE_N);
            add_scaled(SCALE_N, g_s, h_s[k], self->B + (INS_KF15_N + k) * SCALE_N, 1);
        }
    }
}

/// h g + h_s g_s
static ins_real inner_all(const ins_real* h, const ins_real* h_s, const ins_real* g, const ins_real* g_s)
{
    ins_real sum = 0;
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        sum += h[i] * g[i];
    }
    for (unsigned k = 0; k < SCALE_N; k++)
    {
        sum += h_s[k] * g_s[k];
    }
    return sum;
}

/// As in kf15.c: what rounding leaves of P h' - r K goes into the row and the column that had the most to lose.
static void restore_all(ins_kf15_scale_t* self, ins_kf15_t* kf, const ins_real* h, const ins_real* h_s, unsigned pivot,
                        ins_real r)
{
    ins_real x[INS_KF15_ROW];
    ins_real x_s[SCALE_N];
    const ins_real per_h = 1 / h[pivot];
    times_all(self, kf, h, h_s, x, x_s);
    for (unsigned j = 0; j < INS_KF15_N; j++)
    {
        x[j] = per_h * (r * kf->K[j] - x[j]);
    }
    for (unsigned k = 0; k < SCALE_N; k++)
    {
        x_s[k] = per_h * (r * self->K[k] - x_s[k]);
        self->B[pivot * SCALE_N + k] += x_s[k];
    }
    x[pivot] += x[pivot] - per_h * inner_all(h, h_s, x, x_s);
    for (unsigned j = 0; j < INS_KF15_N; j++)
    {
        const ins_real p = kf->P[pivot * INS_KF15_ROW + j] + x[j];
        kf->P[pivot * INS_KF15_ROW + j] = p;
        kf->P[j * INS_KF15_ROW + pivot] = p;
    }
}

ins_status_t ins_kf15_scale_update(ins_kf15_scale_t* self, ins_kf15_t* kf, const ins_real h[INS_KF15_N],
                                   const ins_real h_s[INS_KF15_SCALE_N], ins_innovation_t* z)
{
    ins_real g[INS_KF15_ROW];
    ins_real g_s[SCALE_N];
    ins_real w_s[SCALE_N];
    ins_real most = 0;
    unsigned pivot = 0;
    times_all(self, kf, h, h_s, g, g_s);
    const ins_real hph = inner_all(h, h_s, g, g_s);
    const ins_status_t status = kalman_judge(z, hph);
    if (status != INS_OK)
    {
        return status;
    }
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        const ins_real own = h[i] * h[i] * kf->P[i * (INS_KF15_ROW + 1)];
        pivot = own > most ? i : pivot;
        most = own > most ? own : most;
    }
    const ins_real per_s = 1 / (hph + z->r);
    const ins_real root = ins_sqrt(per_s);
    ins_kf15_downdate(kf, g, hph + z->r);
    for (unsigned k = 0; k < SCALE_N; k++)
    {
        self->K[k] = per_s * g_s[k];
        w_s[k] = root * g_s[k];
    }
    for (unsigned i = 0; i < INS_KF15_N + SCALE_N; i++)
    {
        const ins_real w_i = i < INS_KF15_N ? root * g[i] : w_s[i - INS_KF15_N];
        for (unsigned k = 0; k < SCALE_N; k++)
        {
            self->B[i * SCALE_N + k] -= w_i * w_s[k];
        }
    }
    if (most > 0 && hph > KF15_FALL * z->r)
    {
        restore_all(self, kf, h, h_s, pivot, z->r);
    }
    return INS_OK;
}
