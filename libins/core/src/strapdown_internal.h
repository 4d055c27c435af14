/// \file   strapdown_internal.h
/// \brief  The parts of a strapdown step: Earth at mid-step, velocity, position, turn of n. Frames: b -> n. SI, rad.
/// SPDX-License-Identifier: MIT
#ifndef INS_STRAPDOWN_INTERNAL_H_INCLUDED
#define INS_STRAPDOWN_INTERNAL_H_INCLUDED
#include "earth_internal.h"
#include "ins/strapdown.h"
#include "quat_internal.h"

/// Offset beyond which the anchor is moved [rad], 1.6 km: the series below then err by d^3/6 = 2.4e-12, in the Earth terms alone.
#define ANCHOR_REACH INS_C(2.44140625e-4)

static inline void strapdown_sin_cos(const ins_strapdown_t* self, ins_real d, ins_real* s, ins_real* c)
{
    const ins_real s0 = self->sin_lat;
    const ins_real c0 = self->cos_lat;
    const ins_real half = INS_C(0.5) * d;
    *s = s0 + d * (c0 - half * s0);
    *c = c0 - d * (s0 + half * c0);
}

static inline int strapdown_is_far(const ins_strapdown_t* self)
{
    const ins_real* d = self->position.offset;
    return d[0] * d[0] + d[1] * d[1] > ANCHOR_REACH * ANCHOR_REACH;
}

/// Moves the anchor to the position, and makes its sine and cosine. \return INS_OK, so that the step can end in it.
ins_status_t ins_strapdown_anchor(ins_strapdown_t* self);

/// Velocity and position over one step with sculling.q_nb still at its start. \param[in] dv  [3] in b at the start.
/// \param[out] z  [3] half of the rotation of n against i over the step, in n. \return INS_OK or INS_E_RANGE.
static inline ins_status_t strapdown_advance(ins_strapdown_t* self, const ins_real dv[3], ins_real z[3])
{
    const ins_real* v = self->v_n;
    ins_position_t* p = &self->position;
    const ins_real half = self->half_period;
    // The Earth at mid-step.
    const ins_real vm[3] = {v[0] + self->half_dv[0], v[1] + self->half_dv[1], v[2] + self->half_dv[2]};
    ins_real s;
    ins_real c;
    earth_t earth;
    strapdown_sin_cos(self, p->offset[0] + self->half_dlat, &s, &c);
    earth_at(s, p->anchor[2] + p->offset[2] + self->half_dh, &earth);
    const ins_real per_cos = 1 / c;
    const ins_real half_en = half * vm[1] * earth.per_normal;
    const ins_real e[2] = {half * INS_EARTH_RATE * c, -(half * INS_EARTH_RATE) * s}; // half of w_ie T: north, down
    z[0] = e[0] + half_en;
    z[1] = -(half * vm[0]) * earth.per_meridian;
    z[2] = e[1] - half_en * s * per_cos;

    // Half of the velocity's change, with f the specific force turned by the attitude at the start:
    // (f - z x f + (g - (2 w_ie + w_en) x vm) T) / 2, the rates being 2 (z + e) / T.
    ins_real f[3];
    quat_rotate(self->sculling.q_nb, dv, f);
    const ins_real h[3] = {INS_C(0.5) * f[0], INS_C(0.5) * f[1], INS_C(0.5) * f[2]};
    const ins_real x[3] = {vm[0] + h[0], vm[1] + h[1], vm[2] + h[2]};
    const ins_real half_dv[3] = {h[0] - (z[1] * x[2] - z[2] * x[1]) + e[1] * vm[1],
                                 h[1] - (z[2] * x[0] - z[0] * x[2]) - (e[1] * vm[0] - e[0] * vm[2]),
                                 h[2] - (z[0] * x[1] - z[1] * x[0]) - (e[0] * vm[1] - half * earth.gravity)};
    if (!(c >= INS_STRAPDOWN_COS_MIN))
    {
        return INS_E_RANGE;
    }
    const ins_real mean[3] = {v[0] + half_dv[0], v[1] + half_dv[1], v[2] + half_dv[2]};
    const ins_real half_dlat = half * mean[0] * earth.per_meridian;
    const ins_real half_dlon = half * mean[1] * earth.per_normal * per_cos;
    const ins_real half_dh = -half * mean[2];
    self->half_dlat = half_dlat;
    self->half_dh = half_dh;
    p->offset[0] += 2 * half_dlat;
    p->offset[1] += 2 * half_dlon;
    p->offset[2] += 2 * half_dh;
    for (int i = 0; i < 3; i++)
    {
        self->half_dv[i] = half_dv[i];
        self->v_n[i] = mean[i] + half_dv[i];
    }
    return INS_OK;
}

/// q(-2 z) b; its norm is left z^2 / 2 too long, which the next step takes out.
static inline void strapdown_turn_n(const ins_real z[3], const ins_real b[4], ins_real q[4])
{
    const ins_real x = b[1] - (z[0] * b[0] + z[1] * b[3] - z[2] * b[2]);
    const ins_real y = b[2] - (z[1] * b[0] + z[2] * b[1] - z[0] * b[3]);
    const ins_real k = b[3] - (z[2] * b[0] + z[0] * b[2] - z[1] * b[1]);
    q[0] = b[0] + (z[0] * b[1] + z[1] * b[2] + z[2] * b[3]);
    q[1] = x;
    q[2] = y;
    q[3] = k;
}

/// Any form, at start-up too, any size of increment; refuses what is out of range.
ins_status_t ins_strapdown_step_any(ins_strapdown_t* self, const ins_increment_t* increment);

#endif // INS_STRAPDOWN_INTERNAL_H_INCLUDED
