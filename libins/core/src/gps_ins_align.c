/// \file   gps_ins_align.c
/// \brief  Start of a GPS/INS filter: attitude from what was felt and what it must have been. Frames: b, n (NED). SI, rad.
///
/// M = sum w n b'; the attitude C has the largest trace of C' M. With N = M C', a turn phi of C adds phi.g - phi'H phi / 2 to it,
/// g = (N21 - N12, N02 - N20, N10 - N01), H = tr N - (N + N') / 2: Newton's step is H^-1 g.
/// SPDX-License-Identifier: MIT
#include "ins/gps_ins_align.h"
#include "earth_internal.h"
#include "elementary_internal.h"
#include "ins/align.h"
#include "ins/ins_math.h"
#include "ins/quat.h"
#include "ins/vec.h"

#define GRAVITY    INS_C(9.8)  ///< where only its size matters [m/s^2]
#define INTERVAL   INS_C(0.95) ///< between two fixes whose difference is used [s]
#define LATE_MAX   INS_C(0.1)  ///< [s]
#define FULL_TURN  INS_C(6.28318530717958648)
#define REST_GATE  16 ///< largest square of a velocity at rest over its variance, 99.9 %
#define NEWTON     4  ///< steps; it doubles its digits from a guess of some degrees
#define TO_S       INS_C(1e-9)
#define ACCEL_LATE INS_C(2.) ///< of the vehicle while a fix is late: counted as error [m/s^2]

static const ins_real nose[3] = {1, 0, 0};

void ins_gps_ins_align_config(ins_gps_ins_align_config_t* how)
{
    static const ins_gps_ins_align_config_t vehicle = {INS_C(0.2), 20, 3, INS_C(0.05)};
    *how = vehicle;
}

ins_status_t ins_gps_ins_align_init(ins_gps_ins_align_t* self, const ins_gps_ins_config_t* cfg,
                                    const ins_gps_ins_align_config_t* how)
{
    static const ins_gps_ins_align_t zero; // all 0
    static const ins_real level[4] = {1, 0, 0, 0};
    ins_still_t still;
    if (!(how->heading_max > 0 && how->heading_max <= INS_GPS_INS_TILT_MAX) || !(how->memory > 0) ||
        !(how->course_speed >= 0) || !(how->course_sigma > 0) || ins_still_init(&still, &cfg->still) != INS_OK)
    {
        return INS_E_RANGE;
    }
    *self = zero;
    self->sensors = cfg->sensors;
    self->how = *how;
    self->still = still;
    self->bg_sigma = cfg->sensors.bg_sigma;
    ins_vec_copy(cfg->antenna_b, self->antenna_b);
    return ins_sculling_init(&self->turned, INS_CONING_HIST2_OPT, level);
}

/// From the body of the last fix to that of now.
static void turn_to_now(ins_gps_ins_align_t* self)
{
    ins_real C[9];
    ins_real back[4];
    ins_quat_to_dcm(self->turned.q_nb, C);
    for (unsigned i = 0; i < 3; i++)
    {
        const ins_real row[3] = {self->M[3 * i], self->M[3 * i + 1], self->M[3 * i + 2]};
        for (unsigned j = 0; j < 3; j++)
        {
            self->M[3 * i + j] = row[0] * C[j] + row[1] * C[3 + j] + row[2] * C[6 + j];
        }
    }
    ins_quat_conj(self->turned.q_nb, back);
    ins_quat_rotate(back, self->felt, self->felt);
    ins_quat_rotate(back, self->sum_b, self->sum_b);
    ins_quat_rotate(back, self->nose_b, self->nose_b);
    self->turned.q_nb[0] = 1;
    self->turned.q_nb[1] = 0;
    self->turned.q_nb[2] = 0;
    self->turned.q_nb[3] = 0;
}

/// b was felt over T, in the body of now; it must have been n.
/// \param[in] sigma2  variance to weigh it by. \param[in] noise2  variance of each component of n.
static void learn(ins_gps_ins_align_t* self, const ins_real b[3], const ins_real n[3], ins_real T, ins_real sigma2,
                  ins_real noise2)
{
    const ins_real keep = 1 / (1 + T / self->how.memory);
    const ins_real w = 1 / sigma2;
    const ins_real lean = self->sensors.ba_sigma * T;
    const ins_real turn = INS_C(0.5) * self->bg_sigma * self->how.memory * GRAVITY * T;
    for (unsigned i = 0; i < 9; i++)
    {
        self->M[i] = keep * self->M[i] + w * n[i / 3] * b[i % 3];
        self->S[i] = keep * self->S[i] + w * (n[i / 3] * n[i % 3] - (i % 4 == 0 ? noise2 : 0));
    }
    for (unsigned i = 0; i < 3; i++)
    {
        self->sum_b[i] = keep * self->sum_b[i] + b[i];
        self->sum_n[i] = keep * self->sum_n[i] + n[i];
    }
    self->bent = keep * self->bent + w * (lean * lean + turn * turn);
}

ins_status_t ins_gps_ins_align_step(ins_gps_ins_align_t* self, int64_t t_ns, ins_real dt,
                                    const ins_increment_t* increment)
{
    ins_increment_t x;
    ins_real dv[3];
    const ins_sculling_t* s = &self->turned;
    const ins_real before[4] = {s->q_nb[0], s->q_nb[1], s->q_nb[2], s->q_nb[3]};
    if (!(dt > 0 && dt <= INS_STRAPDOWN_PERIOD_MAX) || t_ns > INS_GNSS_TIME_MAX_NS || t_ns < -INS_GNSS_TIME_MAX_NS ||
        (self->dt > 0 && t_ns <= self->t_ns))
    {
        return INS_E_RANGE;
    }
    x = *increment;
    ins_vec_add_scaled(x.theta_b, -dt, self->gyro_bias);
    if (ins_sculling_step(&self->turned, &x, dv) < INS_OK)
    {
        return INS_E_RANGE;
    }
    if (self->dt > 0 && (ins_real)(t_ns - self->t_ns) * TO_S > INS_C(1.5) * dt)
    {
        self->has_fix = 0; // a gap
        ins_still_restart(&self->still);
    }
    ins_quat_rotate(before, dv, dv);
    ins_vec_add_scaled(self->felt, 1, dv);
    self->felt_s += dt;
    self->t_ns = t_ns;
    self->dt = dt;
    if (ins_still_add(&self->still, dt, &x) && self->rests)
    {
        const ins_real T = dt * self->still.cfg.samples;
        const ins_real up[3] = {0, 0, -GRAVITY * T};
        const ins_real b[3] = {T * self->still.force[0], T * self->still.force[1], T * self->still.force[2]};
        ins_vec_add_scaled(self->gyro_bias, 1, self->still.rate);
        self->bg_sigma = INS_EARTH_RATE + self->sensors.arw / ins_sqrt(T);
        turn_to_now(self);
        learn(self, b, up, T,
              (self->sensors.vrw * self->sensors.vrw + self->sensors.ba_sigma * self->sensors.ba_sigma * T) * T, 0);
    }
    return INS_OK;
}

ins_status_t ins_gps_ins_align_heading(ins_gps_ins_align_t* self, ins_real heading, ins_real sigma)
{
    if (!(ins_fabs(heading) <= FULL_TURN) || !(sigma > 0 && sigma <= FULL_TURN))
    {
        return INS_E_RANGE;
    }
    turn_to_now(self);
    ins_elementary_turn(heading, &self->nose_n[1], &self->nose_n[0]);
    self->nose_n[2] = 0;
    ins_vec_copy(nose, self->nose_b);
    self->nose_sigma = sigma;
    return INS_OK;
}

/// N = M C'
static void product_of(const ins_real M[9], const ins_real q[4], ins_real N[9])
{
    ins_real C[9];
    ins_quat_to_dcm(q, C);
    for (unsigned i = 0; i < 9; i++)
    {
        N[i] = ins_vec_dot(M + 3 * (i / 3), C + 3 * (i % 3));
    }
}

/// H x = g for a symmetric H, by Cramer's rule. \return 0 if H is singular.
static int solve_step(const ins_real H[9], const ins_real g[3], ins_real x[3])
{
    ins_real c[3];
    ins_real d[3];
    ins_real e[3];
    ins_vec_cross(H + 3, H + 6, c);
    ins_vec_cross(H + 6, H, d);
    ins_vec_cross(H, H + 3, e);
    const ins_real det = ins_vec_dot(H, c);
    for (unsigned i = 0; i < 3; i++)
    {
        x[i] = (g[0] * c[i] + g[1] * d[i] + g[2] * e[i]) / det;
    }
    return ins_vec_is_finite(x);
}

/// Of the best rotation: P = H^-1, H = tr S - S; biases bend it by at most sqrt(P bent) (Cauchy and Schwarz).
static void deviations(const ins_gps_ins_align_t* self, ins_real* level, ins_real* heading)
{
    ins_real H[9] = {0};
    ins_real P[3] = {0, 0, 0};
    const ins_real trace = self->S[0] + self->S[4] + self->S[8];
    for (unsigned i = 0; i < 9; i++)
    {
        H[i] = (i % 4 == 0 ? trace : 0) - self->S[i];
    }
    for (unsigned i = 0; i < 3; i++)
    {
        ins_real axis[3] = {0, 0, 0};
        ins_real column[3] = {0, 0, 0};
        axis[i] = 1;
        P[i] = solve_step(H, axis, column) && column[i] > 0 ? column[i] : INS_REAL_MAX;
    }
    const ins_real tilt = INS_C(0.5) * (P[0] + P[1]);
    *level = ins_sqrt(tilt * (1 + self->bent));
    *heading = ins_sqrt(P[2] * (1 + self->bent));
}

/// Attitude from everything that was felt. \return 0 if there is none.
static int attitude(const ins_gps_ins_align_t* self, ins_real q[4])
{
    ins_real N[9];
    ins_real dq[4];
    if (ins_align_level(self->sum_b, 0, q) != INS_OK)
    {
        return 0;
    }
    // Heading: the turn about the vertical that brings the horizontal parts together, by its half angle.
    product_of(self->M, q, N);
    const ins_real c = N[0] + N[4];
    const ins_real s = N[3] - N[1];
    const ins_real r = ins_sqrt(c * c + s * s);
    if (!(r > 0))
    {
        return 0;
    }
    const ins_real half_s = ins_sqrt(INS_C(0.5) * (c < r ? 1 - c / r : 0));
    const ins_real yaw[4] = {ins_sqrt(INS_C(0.5) * (c > -r ? 1 + c / r : 0)), 0, 0, s < 0 ? -half_s : half_s};
    ins_quat_mul(yaw, q, q);
    for (unsigned step = 0; step < NEWTON; step++)
    {
        product_of(self->M, q, N);
        const ins_real g[3] = {N[7] - N[5], N[2] - N[6], N[3] - N[1]};
        const ins_real trace = N[0] + N[4] + N[8];
        ins_real H[9];
        ins_real phi[3];
        for (unsigned i = 0; i < 9; i++)
        {
            H[i] = (i % 4 == 0 ? trace : 0) - INS_C(0.5) * (N[i] + N[3 * (i % 3) + i / 3]);
        }
        if (!solve_step(H, g, phi) || !(ins_vec_dot(phi, phi) < 1) || ins_quat_from_rotvec(phi, dq) != INS_OK)
        {
            return 0;
        }
        ins_quat_mul(dq, q, q);
    }
    return ins_quat_normalise(q) == INS_OK;
}

static int is_fix(const ins_gnss_fix_t* fix)
{
    for (unsigned i = 0; i < 3; i++)
    {
        const ins_real sum = fix->position.anchor[i] + fix->position.offset[i] + fix->v_n[i];
        if (!(fix->sigma_p[i] > 0) || !(fix->sigma_v[i] > 0) || !(sum - sum == 0))
        {
            return 0;
        }
    }
    return 1;
}

/// The antenna's fix, and what is known beside it, for the IMU of now.
static ins_status_t begin_with(const ins_gps_ins_align_t* self, const ins_gnss_fix_t* fix, ins_real late,
                               ins_gps_ins_start_t* start)
{
    static const ins_gps_ins_start_t zero; // all 0
    ins_strapdown_t at;
    ins_real w[3];
    ins_real arm[3];
    const ins_real q[4] = {start->q_nb[0], start->q_nb[1], start->q_nb[2], start->q_nb[3]};
    const ins_real sigma[3] = {start->sigma[0], start->sigma[1], start->sigma[2]};
    *start = zero;
    for (unsigned i = 0; i < 4; i++)
    {
        start->q_nb[i] = q[i];
    }
    if (ins_strapdown_init(&at, INS_CONING_ONE, self->dt, q, fix->v_n, &fix->position) != INS_OK)
    {
        return INS_E_RANGE;
    }
    for (unsigned i = 0; i < 3; i++)
    {
        w[i] = self->turned.prev[0].theta_b[i] / self->dt;
        arm[i] = -self->antenna_b[i];
        start->sigma[INS_KF15_PHI + i] = sigma[i];
        start->sigma[INS_KF15_V + i] = fix->sigma_v[i] + ACCEL_LATE * late;
        start->sigma[INS_KF15_P + i] = fix->sigma_p[i] + fix->sigma_v[i] * late;
        start->sigma[INS_KF15_BG + i] = self->bg_sigma;
        start->sigma[INS_KF15_BA + i] = self->sensors.ba_sigma;
    }
    ins_strapdown_point(&at, arm, w, start->v_n, &start->position);
    earth_t earth;
    earth_at(at.sin_lat, fix->position.anchor[2], &earth);
    start->position.offset[0] += late * start->v_n[0] / earth.meridian;
    start->position.offset[1] += late * start->v_n[1] / (earth.normal * at.cos_lat);
    start->position.offset[2] -= late * start->v_n[2];
    ins_vec_copy(self->gyro_bias, start->gyro_bias);
    start->t_ns = self->t_ns;
    return INS_OK;
}

ins_status_t ins_gps_ins_align_gnss(ins_gps_ins_align_t* self, const ins_gnss_fix_t* fix, ins_gps_ins_start_t* start)
{
    const int64_t late_ns = self->t_ns - fix->t_ns;
    const ins_real late = (ins_real)late_ns * TO_S;
    if (!(self->dt > 0) || !is_fix(fix) || !(late <= LATE_MAX && late >= -2 * self->dt))
    {
        return INS_E_RANGE;
    }
    const ins_real T = self->felt_s;
    const ins_real var = ins_vec_dot(fix->sigma_v, fix->sigma_v) / 3;
    turn_to_now(self);
    if (!self->has_fix || T >= INTERVAL)
    {
        if (self->has_fix)
        {
            // The difference of two white velocities has up to 4 times their variance, at some frequency; 2 times, all in all.
            const ins_real n[3] = {fix->v_n[0] - self->v_n[0], fix->v_n[1] - self->v_n[1],
                                   fix->v_n[2] - self->v_n[2] - GRAVITY * T};
            learn(self, self->felt, n, T, 4 * var + self->sensors.vrw * self->sensors.vrw * T, 2 * var);
        }
        self->has_fix = 1;
        self->felt_s = 0;
        self->felt[0] = 0;
        self->felt[1] = 0;
        self->felt[2] = 0;
        ins_vec_copy(fix->v_n, self->v_n);
    }
    self->rests = ins_vec_dot(fix->v_n, fix->v_n) <= REST_GATE * var;
    const ins_real speed = ins_sqrt(fix->v_n[0] * fix->v_n[0] + fix->v_n[1] * fix->v_n[1]);
    if (self->how.course_speed > 0 && speed >= self->how.course_speed)
    {
        ins_vec_copy(nose, self->nose_b);
        self->nose_n[0] = fix->v_n[0];
        self->nose_n[1] = fix->v_n[1];
        self->nose_n[2] = 0;
        self->nose_sigma = self->how.course_sigma + ins_sqrt(var) / speed;
    }

    ins_real level;
    ins_real heading;
    deviations(self, &level, &heading);
    const int by_nose = self->nose_sigma > 0 && !(heading <= self->nose_sigma);
    if (by_nose)
    {
        heading = self->nose_sigma;
    }
    if (!(level <= self->how.heading_max && heading <= self->how.heading_max) ||
        (by_nose ? ins_align_triad(self->sum_b, self->nose_b, self->sum_n, self->nose_n, start->q_nb) != INS_OK
                 : !attitude(self, start->q_nb)))
    {
        return INS_S_START;
    }
    start->sigma[0] = level;
    start->sigma[1] = level;
    start->sigma[2] = heading;
    return begin_with(self, fix, late > 0 ? late : 0, start);
}
