/// \file   unicycle.c
/// \brief  Extended filter of a vehicle with a yaw-rate gyro and an odometer.
///
///     m = heading + w T/2, w = yaw rate - bias
///     east += V T sin m, north += V T cos m, heading += w T
/// SPDX-License-Identifier: MIT
#include "ins/unicycle.h"
#include "elementary_internal.h"
#include "ins/ins_math.h"

#define N         6
#define ANGLE_MAX INS_C(1000.0)

ins_status_t ins_unicycle_init(ins_unicycle_t* self, const ins_unicycle_config_t* cfg, const ins_real x[6],
                               const ins_real var[6])
{
    if (!(cfg->q_speed >= 0) || !(cfg->q_bias >= 0) || !(cfg->q_scale >= 0) || !(cfg->r_rate > 0) ||
        !(cfg->r_distance > 0) || !(cfg->gate >= 0) || !(cfg->gate_gps >= 0) ||
        !(ins_fabs(x[INS_UNICYCLE_HEADING]) <= ANGLE_MAX))
    {
        return INS_E_RANGE;
    }
    for (unsigned i = 0; i < N; i++)
    {
        if (!(var[i] >= 0) || !(ins_fabs(x[i]) <= INS_REAL_MAX))
        {
            return INS_E_RANGE;
        }
    }
    static const ins_unicycle_t zero; // all 0
    *self = zero;
    self->cfg = *cfg;
    for (unsigned i = 0; i < N; i++)
    {
        self->x[i] = x[i];
        self->P[(N + 1) * i] = var[i];
    }
    self->x[INS_UNICYCLE_HEADING] = ins_elementary_wrap(x[INS_UNICYCLE_HEADING]);
    return INS_OK;
}

ins_status_t ins_unicycle_predict(ins_unicycle_t* self, ins_real dt, ins_real yaw_rate)
{
    ins_real* const x = self->x;
    const ins_real turn = (yaw_rate - x[INS_UNICYCLE_BIAS]) * dt;
    ins_real work[INS_KALMAN_WORK(N)];
    ins_real s;
    ins_real c;
    if (!(dt > 0) || !(ins_fabs(turn) <= ANGLE_MAX))
    {
        return INS_E_RANGE;
    }
    ins_elementary_turn(x[INS_UNICYCLE_HEADING] + turn / 2, &s, &c);
    const ins_real d = x[INS_UNICYCLE_SPEED] * dt;
    const ins_real Phi[N * N] = {1, 0, d * c,  dt * s, -d * c * dt / 2,
                                 0, // east
                                 0, 1, -d * s, dt * c, d * s * dt / 2,
                                 0, // north
                                 0, 0, 1,      0,      -dt,
                                 0, // heading
                                 0, 0, 0,      1,      0,
                                 0, // speed
                                 0, 0, 0,      0,      1,
                                 0, // bias
                                 0, 0, 0,      0,      0,
                                 1};
    // The gyro's noise w enters as the bias does, with the opposite sign: Q = g g' r_rate, g = -column of the bias, but not into it.
    const ins_real g[3] = {d * c * dt / 2, -d * s * dt / 2, dt};
    ins_real Q[N * N] = {0};
    for (unsigned i = 0; i < 3; i++)
    {
        for (unsigned j = 0; j < 3; j++)
        {
            Q[N * i + j] = g[i] * g[j] * self->cfg.r_rate;
        }
    }
    Q[(N + 1) * INS_UNICYCLE_SPEED] = self->cfg.q_speed * dt;
    Q[(N + 1) * INS_UNICYCLE_BIAS] = self->cfg.q_bias * dt;
    Q[(N + 1) * INS_UNICYCLE_SCALE] = self->cfg.q_scale * dt;
    ins_kalman_predict(N, 0, self->P, Phi, Q, work);
    x[INS_UNICYCLE_EAST] += d * s;
    x[INS_UNICYCLE_NORTH] += d * c;
    x[INS_UNICYCLE_HEADING] = ins_elementary_wrap(x[INS_UNICYCLE_HEADING] + turn);
    return INS_OK;
}

ins_status_t ins_unicycle_travel(ins_unicycle_t* self, ins_real dt, ins_real yaw_rate, ins_real distance)
{
    ins_real* const x = self->x;
    const ins_real k = x[INS_UNICYCLE_SCALE];
    const ins_real turn = (yaw_rate - x[INS_UNICYCLE_BIAS]) * dt;
    const ins_real d = distance / k;
    ins_real work[INS_KALMAN_WORK(N)];
    ins_real s;
    ins_real c;
    if (!(dt > 0) || !(ins_fabs(turn) <= ANGLE_MAX) || !(k > 0) || !(ins_fabs(d) <= INS_REAL_MAX))
    {
        return INS_E_RANGE;
    }
    ins_elementary_turn(x[INS_UNICYCLE_HEADING] + turn / 2, &s, &c);
    // Columns of bias and scale are those of the noise of gyro and odometer, but for sign and factor: P' = Phi P Phi' + Q.
    const ins_real g[N] = {d * c * dt / 2, -d * s * dt / 2, dt, 0, 0, 0}; // of the yaw rate
    const ins_real o[N] = {s / k, c / k, 0, 1 / (k * dt), 0, 0};          // of the distance
    ins_real Phi[N * N] = {0};
    ins_real Q[N * N];
    for (unsigned i = 0; i < N; i++)
    {
        Phi[(N + 1) * i] = i == INS_UNICYCLE_SPEED ? 0 : 1; // the speed before does not matter
        Phi[N * i + INS_UNICYCLE_BIAS] -= g[i];
        Phi[N * i + INS_UNICYCLE_SCALE] -= d * o[i];
        for (unsigned j = 0; j < N; j++)
        {
            Q[N * i + j] = g[i] * g[j] * self->cfg.r_rate + o[i] * o[j] * self->cfg.r_distance;
        }
    }
    Phi[INS_UNICYCLE_HEADING] = d * c;
    Phi[N + INS_UNICYCLE_HEADING] = -d * s;
    Q[(N + 1) * INS_UNICYCLE_BIAS] += self->cfg.q_bias * dt;
    Q[(N + 1) * INS_UNICYCLE_SCALE] += self->cfg.q_scale * dt;
    ins_kalman_predict(N, 0, self->P, Phi, Q, work);
    x[INS_UNICYCLE_EAST] += d * s;
    x[INS_UNICYCLE_NORTH] += d * c;
    x[INS_UNICYCLE_HEADING] = ins_elementary_wrap(x[INS_UNICYCLE_HEADING] + turn);
    x[INS_UNICYCLE_SPEED] = d / dt;
    return INS_OK;
}

static ins_status_t update(ins_unicycle_t* self, const ins_real h[N], ins_innovation_t* z)
{
    ins_real work[2 * N];
    const ins_status_t status = ins_kalman_update(N, self->x, self->P, h, z, work);
    self->x[INS_UNICYCLE_HEADING] = ins_elementary_wrap(self->x[INS_UNICYCLE_HEADING]);
    return status;
}

ins_status_t ins_unicycle_odometer(ins_unicycle_t* self, ins_real dt, ins_real distance, ins_real* nis)
{
    const ins_real v = self->x[INS_UNICYCLE_SPEED];
    const ins_real k = self->x[INS_UNICYCLE_SCALE];
    const ins_real h[N] = {0, 0, 0, k * dt, 0, v * dt};
    ins_innovation_t z = {distance - k * v * dt, self->cfg.r_distance, self->cfg.gate, 0};
    const ins_status_t status = update(self, h, &z);
    if (nis)
    {
        *nis = z.nis;
    }
    return status;
}

ins_status_t ins_unicycle_still(ins_unicycle_t* self, ins_real yaw_rate, ins_real r_speed)
{
    static const ins_real bias[N] = {0, 0, 0, 0, 1, 0};
    static const ins_real speed[N] = {0, 0, 0, 1, 0, 0};
    ins_innovation_t zb = {0, self->cfg.r_rate, 0, 0};
    ins_innovation_t zv = {-self->x[INS_UNICYCLE_SPEED], r_speed, 0, 0};
    if (!(r_speed > 0) || !(ins_fabs(yaw_rate) <= ANGLE_MAX))
    {
        return INS_E_RANGE;
    }
    const ins_status_t status = update(self, speed, &zv);
    if (status != INS_OK)
    {
        return status;
    }
    zb.v = yaw_rate - self->x[INS_UNICYCLE_BIAS];
    return update(self, bias, &zb);
}

ins_status_t ins_unicycle_judge(const ins_unicycle_t* self, ins_real east, ins_real north, ins_real r, ins_real* nis,
                                ins_real* det)
{
    const ins_real ve = east - self->x[INS_UNICYCLE_EAST];
    const ins_real vn = north - self->x[INS_UNICYCLE_NORTH];
    const ins_real see = self->P[0] + r;
    const ins_real sen = self->P[1];
    const ins_real snn = self->P[N + 1] + r;
    const ins_real d = see * snn - sen * sen;
    const ins_real joint = (ve * ve * snn - 2 * ve * vn * sen + vn * vn * see) / d;
    if (!(r > 0) || !(d > 0) || !(joint <= INS_REAL_MAX))
    {
        return INS_E_RANGE;
    }
    *nis = joint;
    *det = d;
    return INS_OK;
}

ins_status_t ins_unicycle_gps(ins_unicycle_t* self, ins_real east, ins_real north, ins_real r, ins_real* nis)
{
    static const ins_real to_east[N] = {1, 0, 0, 0, 0, 0};
    static const ins_real to_north[N] = {0, 1, 0, 0, 0, 0};
    ins_real joint;
    ins_real det;
    ins_innovation_t z = {east - self->x[INS_UNICYCLE_EAST], r, 0, 0};
    if (ins_unicycle_judge(self, east, north, r, &joint, &det) != INS_OK)
    {
        return INS_E_RANGE;
    }
    if (nis)
    {
        *nis = joint;
    }
    if (self->cfg.gate_gps > 0 && joint > self->cfg.gate_gps)
    {
        return INS_E_GATE;
    }
    const ins_status_t status = update(self, to_east, &z);
    if (status != INS_OK)
    {
        return status;
    }
    z.v = north - self->x[INS_UNICYCLE_NORTH];
    return update(self, to_north, &z);
}

ins_status_t ins_unicycle_course(ins_unicycle_t* self, ins_real course, ins_real r, ins_real gate, ins_real* nis)
{
    static const ins_real to_heading[N] = {0, 0, 1, 0, 0, 0};
    if (!(ins_fabs(course) < ANGLE_MAX))
    {
        return INS_E_RANGE;
    }
    ins_innovation_t z = {ins_elementary_wrap(course - self->x[INS_UNICYCLE_HEADING]), r, gate, 0};
    const ins_status_t status = update(self, to_heading, &z);
    if (nis)
    {
        *nis = z.nis;
    }
    return status;
}
