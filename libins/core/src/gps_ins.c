/// \file   gps_ins.c
/// \brief  GPS/INS filter: start, the step of an IMU sample, the answer. Frames: b, n (NED). SI, rad.
/// SPDX-License-Identifier: MIT
#include "ins/gps_ins.h"
#include "gps_ins_internal.h"
#include "ins/ins_math.h"
#include "ins/quat.h"
#include "ins/vec.h"

#define BRIDGE_STEP INS_C(0.05) ///< longest step over a gap [s]
#define DEAD_TIME   INS_C(1.)   ///< correlation of the motion that a dead axis hides [s]
#define DT_RATIO    INS_C(0.01) ///< change of the period that makes a new model
#define ARM_MAX     INS_C(1e3)  ///< longest lever arm [m]

void ins_gps_ins_config(ins_gps_ins_config_t* cfg)
{
    static const ins_gps_ins_config_t mems = {.sensors = {.arw = INS_C(8.7e-5),
                                                          .vrw = INS_C(1.7e-3),
                                                          .bg_sigma = INS_C(1.7e-3),
                                                          .bg_tau = 1000,
                                                          .ba_sigma = INS_C(0.05),
                                                          .ba_tau = 1000},
                                              .unseen_rate = INS_C(0.1),
                                              .unseen_accel = 1,
                                              .rate_max = 35,
                                              .force_max = 160,
                                              .gap_max = 1,
                                              .stuck = 100,
                                              .decimate = 1,
                                              .gate_position = INS_GPS_INS_GATE3_999,
                                              .gate_velocity = INS_GPS_INS_GATE3_999,
                                              .gate = INS_KALMAN_GATE_999,
                                              .refused_max = 10,
                                              .nhc = INS_C(0.1),
                                              .zupt = INS_C(0.02),
                                              .zaru = INS_C(5e-4)};
    *cfg = mems;
}

static int in(ins_real x, ins_real low, ins_real high)
{
    return x >= low && x <= high;
}

static int is_vector(const ins_real x[3], ins_real most)
{
    return ins_fabs(x[0]) <= most && ins_fabs(x[1]) <= most && ins_fabs(x[2]) <= most;
}

static int is_config(const ins_gps_ins_config_t* c)
{
    return in(c->unseen_rate, 0, INS_REAL_MAX) && in(c->unseen_accel, 0, INS_REAL_MAX) && c->rate_max > 0 &&
           c->force_max > 0 && in(c->gap_max, 0, INS_REAL_MAX) && c->decimate > 0 && is_vector(c->antenna_b, ARM_MAX) &&
           is_vector(c->wheel_b, ARM_MAX) && ins_fabs(c->gnss_late) <= INS_GPS_INS_DELAY_MAX && c->gate_position >= 0 &&
           c->gate_velocity >= 0 && c->gate >= 0 && c->nhc > 0 && c->zupt > 0 && c->zaru > 0;
}

static int is_start(const ins_gps_ins_config_t* c, const ins_gps_ins_start_t* start)
{
    const ins_real* sigma = start->sigma;
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        if (!in(sigma[i], 0, i < INS_KF15_V ? INS_GPS_INS_TILT_MAX : INS_REAL_MAX))
        {
            return 0;
        }
    }
    return start->t_ns <= INS_GNSS_TIME_MAX_NS && start->t_ns >= -INS_GNSS_TIME_MAX_NS &&
           is_vector(start->gyro_bias, c->rate_max) && is_vector(start->accel_bias, c->force_max);
}

/// All but what init sets; member by member, since a constant to copy would take 2 KB of flash.
static void clear(ins_gps_ins_t* self)
{
    static const ins_gps_ins_check_t no_check; // all 0
    static const ins_gps_ins_count_t no_count;
    static const ins_gps_ins_past_t no_past;
    self->check = no_check;
    self->count = no_count;
    for (unsigned k = 0; k < INS_GPS_INS_PAST; k++)
    {
        self->past[k] = no_past;
    }
    for (unsigned i = 0; i < 3; i++)
    {
        self->w_ib_b[i] = 0;
        self->pending_v[i] = 0;
        self->way_n[i] = 0;
    }
    for (unsigned i = 0; i < 6; i++)
    {
        self->value[i] = 0;
        self->same[i] = 0;
    }
    self->dt = 0;
    self->pending_dt = 0;
    self->pending = 0;
    self->odd_t_ns = 0;
    self->odd = 0;
    self->refused = 0;
    self->stuck = 0;
    self->lost = 0;
    self->newest = 0;
    self->held = 0;
    self->plain = 0;
    self->form = GPS_INS_P;
}

ins_status_t ins_gps_ins_init(ins_gps_ins_t* self, const ins_gps_ins_config_t* cfg, const ins_gps_ins_start_t* start)
{
    ins_strapdown_t nav;
    ins_still_t still;
    ins_kf15_model_t model;
    if (!is_config(cfg) || !is_start(cfg, start) ||
        ins_kf15_model_init(&model, INS_STRAPDOWN_PERIOD_MAX, &cfg->sensors) != INS_OK ||
        ins_still_init(&still, &cfg->still) != INS_OK ||
        ins_strapdown_init(&nav, INS_CONING_HIST2_OPT, INS_STRAPDOWN_PERIOD_MAX, start->q_nb, start->v_n,
                           &start->position) != INS_OK)
    {
        return INS_E_RANGE;
    }
    clear(self);
    self->cfg = *cfg;
    self->nav = nav;
    self->still = still;
    self->model = model;
    ins_vec_copy(start->gyro_bias, self->gyro_bias);
    ins_vec_copy(start->accel_bias, self->accel_bias);
    self->t_ns = start->t_ns;
    ins_gps_ins_restart(self, start->sigma);
    return INS_OK;
}

ins_status_t ins_gps_ins_ud_init(ins_gps_ins_ud_t* self, const ins_gps_ins_config_t* cfg,
                                 const ins_gps_ins_start_t* start)
{
    const ins_status_t status = ins_gps_ins_init(&self->base, cfg, start);
    if (status == INS_OK)
    {
        self->base.form = GPS_INS_UD;
        ins_gps_ins_restart(&self->base, start->sigma);
    }
    return status;
}

void ins_gps_ins_restart(ins_gps_ins_t* self, const ins_real sigma[INS_KF15_N])
{
    (void)ins_kf15_init(&self->kf, sigma); // both refuse what start and fixes were refused for
    if (self->form == GPS_INS_UD)
    {
        (void)ins_kf15_ud_init(gps_ins_ud(self), sigma);
    }
    if (self->form == GPS_INS_SCALE)
    {
        ins_gps_ins_scale_part(self);
    }
}

/// Covariance over a time with its specific force; \param[in] unseen  length of a gap that it is part of, or 0 [s].
static void propagate(ins_gps_ins_t* self, ins_real dt, const ins_real v_b[3], ins_real unseen)
{
    const ins_gps_ins_config_t* c = &self->cfg;
    const ins_real gyros = unseen + ((self->stuck & GPS_INS_GYROS) ? DEAD_TIME : 0);
    const ins_real accels = unseen + ((self->stuck & GPS_INS_ACCELS) ? DEAD_TIME : 0);
    const int plain = gyros == 0 && accels == 0;
    if (!plain || !self->plain || !(ins_fabs(dt - self->model.dt) <= DT_RATIO * dt))
    {
        // A rate of this rms that lasts T turns by rms T: as random walk, with density rms^2 T.
        ins_kf15_sensors_t sensors;
        sensors = c->sensors;
        sensors.arw = ins_sqrt(sensors.arw * sensors.arw + c->unseen_rate * c->unseen_rate * gyros);
        sensors.vrw = ins_sqrt(sensors.vrw * sensors.vrw + c->unseen_accel * c->unseen_accel * accels);
        (void)ins_kf15_model_init(&self->model, dt, &sensors);
        self->plain = (uint_least8_t)plain;
    }
    ins_kf15_model(&self->model, &self->nav, v_b);
    if (self->form == GPS_INS_P)
    {
        ins_kf15_propagate(&self->kf, &self->model);
    }
    else if (self->form == GPS_INS_UD)
    {
        ins_kf15_ud_propagate(gps_ins_ud(self), &self->model);
    }
    else
    {
        ins_gps_ins_scale_propagate(self, v_b);
    }
}

void ins_gps_ins_settle(ins_gps_ins_t* self)
{
    if (self->pending > 0)
    {
        propagate(self, self->pending_dt, self->pending_v, 0);
        self->pending = 0;
        self->pending_dt = 0;
        self->pending_v[0] = 0;
        self->pending_v[1] = 0;
        self->pending_v[2] = 0;
    }
}

/// Attitude, velocity, position over dt. \param[in] x  biases taken off.
static ins_status_t mechanise(ins_gps_ins_t* self, ins_real dt, const ins_increment_t* x)
{
    const ins_real before[3] = {self->nav.v_n[0], self->nav.v_n[1], self->nav.v_n[2]};
    self->nav.half_period = INS_C(0.5) * dt;
    const ins_status_t status = ins_strapdown_step(&self->nav, x);
    if (status < INS_OK)
    {
        return status;
    }
    const ins_real way[3] = {before[0] + self->nav.v_n[0], before[1] + self->nav.v_n[1], before[2] + self->nav.v_n[2]};
    ins_vec_add_scaled(self->way_n, self->nav.half_period, way);
    ins_vec_add_scaled(self->gyro_bias, -dt / self->cfg.sensors.bg_tau, self->gyro_bias);
    ins_vec_add_scaled(self->accel_bias, -dt / self->cfg.sensors.ba_tau, self->accel_bias);
    return INS_OK;
}

/// Over a gap: the mean of the increments on both sides is held.
static ins_status_t bridge(ins_gps_ins_t* self, ins_real gap, ins_real dt, const ins_increment_t* x)
{
    const ins_increment_t* last = x;
    const ins_real per_last = INS_C(0.5) / (self->dt > 0 ? self->dt : dt);
    const ins_real per_now = INS_C(0.5) / dt;
    unsigned steps = 1 + (unsigned)(gap / BRIDGE_STEP);
    const ins_real h = gap / (ins_real)steps;
    ins_increment_t hold;
    if (self->nav.sculling.count > 0)
    {
        last = &self->nav.sculling.prev[0];
    }
    for (unsigned i = 0; i < 3; i++)
    {
        hold.theta_b[i] = h * (per_last * last->theta_b[i] + per_now * x->theta_b[i]);
        hold.v_b[i] = h * (per_last * last->v_b[i] + per_now * x->v_b[i]);
    }
    self->count.imu_gaps++;
    ins_still_restart(&self->still);
    ins_gps_ins_settle(self);
    for (; steps > 0; steps--)
    {
        self->nav.sculling.count = 0; // its history has another period
        if (mechanise(self, h, &hold) != INS_OK)
        {
            return INS_E_RANGE;
        }
        if (self->form == GPS_INS_SCALE)
        {
            ins_gps_ins_scale_pend(self, hold.theta_b);
        }
        propagate(self, h, hold.v_b, gap);
    }
    self->nav.sculling.count = 0;
    return INS_OK;
}

ins_status_t ins_gps_ins_step(ins_gps_ins_t* self, int64_t t_ns, ins_real dt, const ins_increment_t* increment)
{
    ins_real gap;
    if (self->lost)
    {
        return INS_E_STATE;
    }
    if (!(dt > 0 && dt <= INS_STRAPDOWN_PERIOD_MAX) || !is_vector(increment->theta_b, self->cfg.rate_max * dt) ||
        !is_vector(increment->v_b, self->cfg.force_max * dt))
    {
        self->count.imu_refused++;
        return INS_E_RANGE;
    }
    const ins_status_t status = ins_gps_ins_follow(self, t_ns, dt, &gap);
    if (status != INS_OK)
    {
        return status;
    }
    ins_increment_t x;
    x = *increment; // SDCC copies no struct in a definition
    ins_vec_add_scaled(x.theta_b, -dt, self->gyro_bias);
    ins_vec_add_scaled(x.v_b, -dt, self->accel_bias);
    if (self->form == GPS_INS_SCALE)
    {
        ins_gps_ins_scale_take_off(self, dt, &x);
    }
    if ((gap > 0 && bridge(self, gap, dt, &x) != INS_OK) || mechanise(self, dt, &x) != INS_OK)
    {
        self->lost = 1; // too near to a pole
        return INS_E_STATE;
    }
    self->count.steps++;
    self->dt = dt;
    self->pending_dt += dt;
    for (unsigned i = 0; i < 3; i++)
    {
        self->w_ib_b[i] = x.theta_b[i] / dt;
        self->pending_v[i] += x.v_b[i];
    }
    if (self->form == GPS_INS_SCALE)
    {
        ins_gps_ins_scale_pend(self, x.theta_b);
    }
    self->pending++;
    if (self->pending >= self->cfg.decimate)
    {
        ins_gps_ins_settle(self);
    }
    ins_gps_ins_keep_past(self);
    ins_gps_ins_watch(self, increment, &x);
    return INS_OK;
}

static void block(const ins_real* all, unsigned first, ins_real P[9])
{
    for (unsigned i = 0; i < 9; i++)
    {
        P[i] = all[INS_KF15_ROW * (first + i / 3) + first + i % 3];
    }
}

void ins_gps_ins_state(const ins_gps_ins_t* self, ins_gps_ins_state_t* state)
{
    const ins_real* q = self->nav.sculling.q_nb;
    const ins_real* P = self->kf.P;
    ins_real of_factors[INS_KF15_N * INS_KF15_ROW];
    if (self->form == GPS_INS_UD)
    {
        ins_kf15_ud_covariance(&((const ins_gps_ins_ud_t*)self)->ud, of_factors);
        P = of_factors;
    }
    state->t_ns = self->t_ns;
    for (unsigned i = 0; i < 4; i++)
    {
        state->q_nb[i] = q[i];
    }
    ins_vec_copy(self->nav.v_n, state->v_n);
    state->position = self->nav.position;
    ins_vec_copy(self->gyro_bias, state->gyro_bias);
    ins_vec_copy(self->accel_bias, state->accel_bias);
    block(P, INS_KF15_PHI, state->P_phi);
    block(P, INS_KF15_V, state->P_v);
    block(P, INS_KF15_P, state->P_p);
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        state->sigma[i] = ins_sqrt(P[(INS_KF15_ROW + 1) * i]);
    }
}
