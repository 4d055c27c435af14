/// \file   kf15_model.c
/// \brief  F dt and Q of one step of the 15-error model. Frames: b -> n (NED). SI, rad.
/// SPDX-License-Identifier: MIT
#include "earth_internal.h"
#include "kf15_internal.h"
#include "strapdown_internal.h"

ins_status_t ins_kf15_model_init(ins_kf15_model_t* self, ins_real dt, const ins_kf15_sensors_t* sensors)
{
    ins_markov_t bg;
    ins_markov_t ba;
    if (!(dt > 0 && dt <= INS_STRAPDOWN_PERIOD_MAX) || !(sensors->arw >= 0 && sensors->arw <= INS_REAL_MAX) ||
        !(sensors->vrw >= 0 && sensors->vrw <= INS_REAL_MAX) ||
        !(sensors->bg_sigma <= INS_REAL_MAX && sensors->ba_sigma <= INS_REAL_MAX) ||
        !(sensors->bg_tau >= dt && sensors->ba_tau >= dt) ||
        ins_markov_init(&bg, dt, sensors->bg_tau, sensors->bg_sigma) != INS_OK ||
        ins_markov_init(&ba, dt, sensors->ba_tau, sensors->ba_sigma) != INS_OK)
    {
        return INS_E_RANGE;
    }
    const ins_kf15_model_t start = {
        .dt = dt, .q_phi = sensors->arw * sensors->arw * dt, .q_v = sensors->vrw * sensors->vrw * dt};
    *self = start;
    self->bg = bg;
    self->ba = ba;
    return INS_OK;
}

void ins_kf15_model(ins_kf15_model_t* self, const ins_strapdown_t* at, const ins_real v_b[3])
{
    const ins_real* q = at->sculling.q_nb;
    const ins_real* v = at->v_n;
    const ins_real dt = self->dt;
    ins_real* C = self->C;
    // C_nb dt; the norm of q, 1 to some 1e-7, is left as it is.
    const ins_real x = 2 * dt * q[1];
    const ins_real y = 2 * dt * q[2];
    const ins_real z = 2 * dt * q[3];
    const ins_real xx = x * q[1];
    const ins_real yy = y * q[2];
    const ins_real zz = z * q[3];
    C[0] = dt - (yy + zz);
    C[1] = x * q[2] - z * q[0];
    C[2] = x * q[3] + y * q[0];
    C[3] = x * q[2] + z * q[0];
    C[4] = dt - (xx + zz);
    C[5] = y * q[3] - x * q[0];
    C[6] = x * q[3] - y * q[0];
    C[7] = y * q[3] + x * q[0];
    C[8] = dt - (xx + yy);
    const ins_real rate = 1 / dt;
    const ins_real f[3] = {rate * v_b[0], rate * v_b[1], rate * v_b[2]};
    self->dv[0] = C[0] * f[0] + C[1] * f[1] + C[2] * f[2];
    self->dv[1] = C[3] * f[0] + C[4] * f[1] + C[5] * f[2];
    self->dv[2] = C[6] * f[0] + C[7] * f[1] + C[8] * f[2];

    ins_real s;
    ins_real c;
    earth_t earth;
    strapdown_sin_cos(at, at->position.offset[0], &s, &c);
    earth_at(s, at->position.anchor[2] + at->position.offset[2], &earth);
    const ins_real meridian = dt / earth.meridian;
    const ins_real normal = dt / earth.normal;
    const ins_real slope = normal * s / c;
    const ins_real north = dt * INS_EARTH_RATE * c; // w_ie dt
    const ins_real up = dt * INS_EARTH_RATE * s;
    const ins_real east = normal * v[1]; // w_en dt, about north
    const ins_real tilt = slope * v[1];  // and up
    self->curve[0] = -normal;
    self->curve[1] = meridian;
    self->curve[2] = slope;
    self->turn[0] = north + east;
    self->turn[1] = -meridian * v[0];
    self->turn[2] = -(up + tilt);
    // Groves 14.68 (F22), with R_M and R_N each in its place.
    ins_real* V = self->coriolis;
    V[0] = meridian * v[2];
    V[1] = -2 * (up + tilt);
    V[2] = meridian * v[0];
    V[3] = 2 * up + tilt;
    V[4] = slope * v[0] + normal * v[2];
    V[5] = 2 * north + east;
    V[6] = -2 * V[2];
    V[7] = -2 * self->turn[0];
    V[8] = 2 * meridian * earth.gravity;
}

void ins_kf15_transition(const ins_kf15_model_t* self, ins_real Phi[INS_KF15_N * INS_KF15_N])
{
    for (unsigned j = 0; j < INS_KF15_N; j++)
    {
        ins_real unit[INS_KF15_N] = {0};
        unit[j] = 1;
        for (unsigned i = 0; i < 3; i++)
        {
            Phi[(INS_KF15_PHI + i) * INS_KF15_N + j] = kf15_attitude(self, i, unit, 1);
            Phi[(INS_KF15_V + i) * INS_KF15_N + j] = kf15_velocity(self, i, unit, 1);
            Phi[(INS_KF15_P + i) * INS_KF15_N + j] = kf15_position(self, i, unit, 1);
            Phi[(INS_KF15_BG + i) * INS_KF15_N + j] = self->bg.phi * unit[INS_KF15_BG + i];
            Phi[(INS_KF15_BA + i) * INS_KF15_N + j] = self->ba.phi * unit[INS_KF15_BA + i];
        }
    }
}
