/// \file   gyro_free.c
/// \brief  Error filter of a strapdown whose rates are integrals of accelerometer readings. Frames: b -> n (NED). SI, rad.
/// SPDX-License-Identifier: MIT
#include "ins/gyro_free.h"
#include "ins/earth.h"
#include "ins/ins_math.h"
#include "ins/quat.h"
#include "ins/vec.h"
#include "strapdown_internal.h"

#define GF_N   INS_GYRO_FREE_N
#define GF_PHI INS_GYRO_FREE_PHI
#define GF_V   INS_GYRO_FREE_V
#define GF_P   INS_GYRO_FREE_P
#define GF_W   INS_GYRO_FREE_W
#define GF_BD  INS_GYRO_FREE_BD
#define GF_BF  INS_GYRO_FREE_BF

static int is_deviation(ins_real x)
{
    return x >= 0 && x <= INS_REAL_MAX;
}

/// The pseudo-inverse times its transpose, and the map back.
static void set_geometry(ins_gyro_free_t* self, const ins_accel_t* accels)
{
    const ins_sixacc_t* s = &self->sixacc;
    for (unsigned j = 0; j < s->count; j++)
    {
        ins_vec_cross(accels[j].r, accels[j].axis, self->forward[j]);
        ins_vec_copy(accels[j].axis, self->forward[j] + 3);
    }
    for (int i = 0; i < 6; i++)
    {
        for (int k = 0; k < 6; k++)
        {
            for (unsigned j = 0; j < s->count; j++)
            {
                self->noise[i][k] += s->inverse[i][j] * s->inverse[k][j];
            }
        }
    }
}

ins_status_t ins_gyro_free_init(ins_gyro_free_t* self, const ins_gyro_free_config_t* cfg, unsigned count,
                                const ins_accel_t* accels, ins_real period_s, const ins_real q_nb[4],
                                const ins_real v_n[3], const ins_position_t* position)
{
    static const ins_gyro_free_t zero;
    ins_sixacc_t sixacc;
    ins_strapdown_t strapdown;
    ins_real start[GF_N * GF_N] = {0};
    ins_real work[GF_N * GF_N];
    int good = cfg->noise > 0 && is_deviation(cfg->noise) && is_deviation(cfg->bias) && is_deviation(cfg->bias_walk) &&
               is_deviation(cfg->velocity) && is_deviation(cfg->position) && is_deviation(cfg->rate) &&
               is_deviation(cfg->gate);
    for (int i = 0; i < 3; i++)
    {
        good = good && is_deviation(cfg->attitude[i]);
    }
    if (!good || ins_sixacc_init(&sixacc, count, accels, period_s) != INS_OK ||
        ins_strapdown_init(&strapdown, INS_CONING_HIST2_OPT, period_s, q_nb, v_n, position) != INS_OK)
    {
        return INS_E_RANGE;
    }
    *self = zero;
    self->cfg = *cfg;
    self->sixacc = sixacc;
    self->strapdown = strapdown;
    set_geometry(self, accels);
    for (int i = 0; i < 3; i++)
    {
        start[(GF_N + 1) * (GF_PHI + i)] = cfg->attitude[i] * cfg->attitude[i];
        start[(GF_N + 1) * (GF_V + i)] = cfg->velocity * cfg->velocity;
        start[(GF_N + 1) * (GF_P + i)] = cfg->position * cfg->position;
        start[(GF_N + 1) * (GF_W + i)] = cfg->rate * cfg->rate;
    }
    for (int i = 0; i < 6; i++)
    {
        for (int k = 0; k < 6; k++)
        {
            start[GF_N * (GF_BD + i) + GF_BD + k] = cfg->bias * cfg->bias * self->noise[i][k];
        }
    }
    return ins_ud_factor(GF_N, start, self->UD, work);
}

/// Derivative of the centripetal terms: rows wd, f; columns w.
static void centripetal(const ins_sixacc_t* s, ins_real J[6][3])
{
    const ins_real* w = s->w_ib_b;
    for (int i = 0; i < 6; i++)
    {
        const ins_real* p = s->product[i];
        J[i][0] = 2 * p[0] * w[0] + p[3] * w[1] + p[4] * w[2];
        J[i][1] = 2 * p[1] * w[1] + p[3] * w[0] + p[5] * w[2];
        J[i][2] = 2 * p[2] * w[2] + p[4] * w[0] + p[5] * w[1];
    }
}

/// Phi = I + F T + (F T)^2 / 2, of the second order what leads from one kind of error to another.
/// \param[in] C  [9] T C_nb. \param[in] v_b  [3] of the increment: f T.
static void transition(const ins_gyro_free_t* self, const ins_real C[9], const ins_real v_b[3],
                       ins_real Phi[GF_N * GF_N])
{
    const ins_real T = self->sixacc.period_s;
    const ins_real half = INS_C(0.5) * T;
    ins_real J[6][3];
    ins_real u[3];
    centripetal(&self->sixacc, J);
    ins_quat_rotate(self->strapdown.sculling.q_nb, v_b, u);
    for (int i = 0; i < GF_N; i++)
    {
        Phi[(GF_N + 1) * i] = 1;
    }
    for (int i = 0; i < 3; i++)
    {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        Phi[GF_N * (GF_V + i) + GF_PHI + j] = u[k]; // phi x f T
        Phi[GF_N * (GF_V + i) + GF_PHI + k] = -u[j];
        Phi[GF_N * (GF_P + i) + GF_PHI + j] = half * u[k];
        Phi[GF_N * (GF_P + i) + GF_PHI + k] = -half * u[j];
        Phi[GF_N * (GF_P + i) + GF_V + i] = T;
        Phi[GF_N * (GF_W + i) + GF_BD + i] = -T;
        for (int m = 0; m < 3; m++)
        {
            const ins_real c = C[3 * i + m];
            Phi[GF_N * (GF_PHI + i) + GF_W + m] = c;
            Phi[GF_N * (GF_PHI + i) + GF_BD + m] = -half * c;
            Phi[GF_N * (GF_V + i) + GF_BF + m] = -c;
            Phi[GF_N * (GF_P + i) + GF_BF + m] = -half * c;
            Phi[GF_N * (GF_W + i) + GF_W + m] += T * J[i][m];
            Phi[GF_N * (GF_V + i) + GF_W + m] = INS_C(0.5) * (C[3 * j + m] * u[k] - C[3 * k + m] * u[j]);
            for (int n = 0; n < 3; n++)
            {
                Phi[GF_N * (GF_V + i) + GF_W + m] += C[3 * i + n] * J[3 + n][m];
            }
        }
    }
}

/// White noise of the readings, held over the step: into rate and velocity, and half a step of it into attitude and position; walk of
/// the biases. \param[in] C  [9] T C_nb.
static void noise_of(const ins_gyro_free_t* self, const ins_real C[9], ins_real Q[GF_N * GF_N])
{
    const ins_real T = self->sixacc.period_s;
    const ins_real half = INS_C(0.5) * T;
    const ins_real white = self->cfg.noise * self->cfg.noise;
    const ins_real walk = self->cfg.bias_walk * self->cfg.bias_walk * T;
    ins_real G[GF_BD][6] = {{0}};
    for (int i = 0; i < 3; i++)
    {
        G[GF_W + i][i] = T;
        for (int m = 0; m < 3; m++)
        {
            G[GF_PHI + i][m] = half * C[3 * i + m];
            G[GF_V + i][3 + m] = C[3 * i + m];
            G[GF_P + i][3 + m] = half * C[3 * i + m];
        }
    }
    for (int i = 0; i < GF_BD; i++)
    {
        ins_real row[6] = {0};
        for (int a = 0; a < 6; a++)
        {
            for (int b = 0; b < 6; b++)
            {
                row[b] += white * G[i][a] * self->noise[a][b];
            }
        }
        for (int k = 0; k < GF_BD; k++)
        {
            for (int b = 0; b < 6; b++)
            {
                Q[GF_N * i + k] += row[b] * G[k][b];
            }
        }
    }
    for (int i = 0; i < 6; i++)
    {
        for (int k = 0; k < 6; k++)
        {
            Q[GF_N * (GF_BD + i) + GF_BD + k] = walk * self->noise[i][k];
        }
    }
}

ins_status_t ins_gyro_free_step(ins_gyro_free_t* self, const ins_real* readings)
{
    ins_increment_t increment;
    ins_real C[9];
    ins_real Phi[GF_N * GF_N] = {0};
    ins_real Q[GF_N * GF_N] = {0};
    ins_real Q_ud[INS_UD_SIZE(GF_N)];
    ins_real work[INS_UD_WORK(GF_N)];
    ins_sixacc_t before;
    before = self->sixacc;
    const ins_status_t status = ins_sixacc_step(&self->sixacc, readings, &increment);
    if (status != INS_OK)
    {
        return status;
    }
    if (ins_strapdown_step(&self->strapdown, &increment) < 0)
    {
        self->sixacc = before;
        return INS_E_RANGE;
    }
    ins_quat_to_dcm(self->strapdown.sculling.q_nb, C);
    for (int i = 0; i < 9; i++)
    {
        C[i] *= self->sixacc.period_s;
    }
    transition(self, C, increment.v_b, Phi);
    noise_of(self, C, Q);
    (void)ins_ud_factor(GF_N, Q, Q_ud, work); // a sum of squares
    ins_ud_predict(GF_N, 0, self->UD, Phi, Q_ud, work);
    return INS_OK;
}

/// The errors' axes are the body's, seen in n, and turn with the attitude's estimate.
static void turn_errors(ins_gyro_free_t* self, const ins_real phi[3])
{
    ins_real q[4];
    ins_real C[9];
    ins_real Phi[GF_N * GF_N] = {0};
    ins_real none[INS_UD_SIZE(GF_N)] = {0};
    ins_real work[INS_UD_WORK(GF_N)];
    if (ins_quat_from_rotvec(phi, q) != INS_OK)
    {
        return;
    }
    ins_quat_to_dcm(q, C);
    for (int i = 0; i < GF_N; i++)
    {
        Phi[(GF_N + 1) * i] = 1;
    }
    for (int i = 0; i < GF_W; i++)
    {
        for (int k = 0; k < 3; k++)
        {
            Phi[GF_N * i + i - i % 3 + k] = C[3 * (i % 3) + k];
        }
    }
    ins_ud_predict(GF_N, 0, self->UD, Phi, none, work);
}

static void correct_by(ins_gyro_free_t* self, const ins_real x[GF_N])
{
    ins_sixacc_t* s = &self->sixacc;
    ins_real moved[GF_W]; // v^ + dv + phi x dv / 2
    ins_vec_copy(x + GF_PHI, moved);
    for (int i = GF_V; i < GF_W; i += 3)
    {
        ins_vec_cross(x + GF_PHI, x + i, moved + i);
        for (int k = i; k < i + 3; k++)
        {
            moved[k] = x[k] + INS_C(0.5) * moved[k];
        }
    }
    ins_strapdown_correct(&self->strapdown, moved);
    turn_errors(self, x + GF_PHI);
    ins_vec_add_scaled(s->w_ib_b, 1, x + GF_W);
    ins_vec_add_scaled(s->wd_ib_b, -1, x + GF_BD);
    for (int i = 0; i < 6; i++)
    {
        s->linear[i] -= x[GF_BD + i];
        for (unsigned j = 0; j < s->count; j++)
        {
            s->bias[j] += self->forward[j][i] * x[GF_BD + i];
        }
    }
}

/// Three scalars v = H x + noise, one after the other, and the correction. \param[in] H  [3][N].
static ins_status_t measure(ins_gyro_free_t* self, ins_real H[3][GF_N], const ins_real v[3], const ins_real sigma[3])
{
    ins_real x[GF_N] = {0};
    ins_real work[3 * GF_N];
    ins_status_t all = INS_OK;
    for (int i = 0; i < 3; i++)
    {
        if (!(sigma[i] > 0 && sigma[i] <= INS_REAL_MAX) || !(ins_fabs(v[i]) <= INS_REAL_MAX))
        {
            return INS_E_RANGE;
        }
    }
    for (int i = 0; i < 3; i++)
    {
        ins_innovation_t z = {v[i], sigma[i] * sigma[i], self->cfg.gate, 0};
        for (int k = 0; k < GF_N; k++)
        {
            z.v -= H[i][k] * x[k];
        }
        const ins_status_t status = ins_ud_update(GF_N, x, self->UD, H[i], &z, work);
        if (status != INS_OK)
        {
            self->refused++;
            all = status;
        }
    }
    correct_by(self, x);
    return all;
}

ins_status_t ins_gyro_free_position(ins_gyro_free_t* self, const ins_position_t* fix, const ins_real sigma[3],
                                    const ins_real l_b[3])
{
    ins_position_t antenna;
    ins_real l_n[3];
    ins_real unused[3];
    ins_real v[3];
    ins_real H[3][GF_N] = {{0}};
    ins_quat_rotate(self->strapdown.sculling.q_nb, l_b, l_n);
    ins_strapdown_point(&self->strapdown, l_b, self->sixacc.w_ib_b, unused, &antenna);
    ins_position_difference(&antenna, fix, v);
    for (int i = 0; i < 3; i++)
    {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        H[i][GF_P + i] = 1;
        H[i][GF_PHI + j] = l_n[k]; // phi x l
        H[i][GF_PHI + k] = -l_n[j];
    }
    return measure(self, H, v, sigma);
}

ins_status_t ins_gyro_free_velocity(ins_gyro_free_t* self, const ins_real v_n[3], const ins_real sigma[3])
{
    ins_real v[3];
    ins_real H[3][GF_N] = {{0}};
    for (int i = 0; i < 3; i++)
    {
        v[i] = v_n[i] - self->strapdown.v_n[i];
        H[i][GF_V + i] = 1;
    }
    return measure(self, H, v, sigma);
}

ins_status_t ins_gyro_free_still(ins_gyro_free_t* self, ins_real sigma_v, ins_real sigma_w)
{
    static const ins_real zero[3];
    const ins_strapdown_t* s = &self->strapdown;
    const ins_real each_v[3] = {sigma_v, sigma_v, sigma_v};
    const ins_real each_w[3] = {sigma_w, sigma_w, sigma_w};
    ins_real v[3];
    ins_real q_bn[4];
    ins_real w_ie_n[3];
    ins_real H[3][GF_N] = {{0}};
    ins_earth_rate(s->sin_lat, s->cos_lat, w_ie_n);
    ins_quat_conj(s->sculling.q_nb, q_bn);
    ins_quat_rotate(q_bn, w_ie_n, v);
    for (int i = 0; i < 3; i++)
    {
        v[i] -= self->sixacc.w_ib_b[i];
        H[i][GF_W + i] = 1;
    }
    const ins_status_t status = measure(self, H, v, each_w);
    return status == INS_OK ? ins_gyro_free_velocity(self, zero, each_v) : status;
}

void ins_gyro_free_sigma(const ins_gyro_free_t* self, ins_real sigma[GF_N])
{
    ins_real full[GF_N * GF_N];
    ins_ud_covariance(GF_N, self->UD, full);
    for (int i = 0; i < GF_N; i++)
    {
        sigma[i] = ins_sqrt(full[(GF_N + 1) * i]);
    }
}
