/// \file   strapdown.c
/// \brief  The strapdown step in NED over WGS-84, earth terms at mid-step. Frames: b -> n. SI, rad.
/// SPDX-License-Identifier: MIT
#include "ins/strapdown.h"
#include "earth_internal.h"
#include "ins/vec.h"
#include "strapdown_internal.h"

/// Offset beyond which the anchor is moved [rad], 1.6 km: the sine of the latitude then errs by 2.4e-12, in the Earth terms alone.
#define ANCHOR_REACH INS_C(2.44140625e-4)

/// Half of q v q*, the specific force turned into n.
static void half_force(const ins_real q[4], const ins_real v[3], ins_real out[3])
{
    ins_real t[3];
    ins_real r_t[3];
    ins_vec_cross(q + 1, v, t);
    ins_vec_cross(q + 1, t, r_t);
    out[0] = INS_C(0.5) * v[0] + (q[0] * t[0] + r_t[0]);
    out[1] = INS_C(0.5) * v[1] + (q[0] * t[1] + r_t[1]);
    out[2] = INS_C(0.5) * v[2] + (q[0] * t[2] + r_t[2]);
}

/// Velocity and position over one step. \param[in] h  [3] half of the specific force's integral, in n as it stood at the start.
/// \param[in] s, c  sine and cosine of the latitude at mid-step.
/// \param[out] z  [3] half of the rotation of n against i over the step, in n: north, west, up.
static void advance(ins_strapdown_t* self, const ins_real h[3], ins_real s, ins_real c, ins_real z[3])
{
    ins_position_t* p = &self->position;
    const ins_real half = self->half_period;
    const ins_real v[3] = {self->v_n[0], self->v_n[1], self->v_n[2]};
    // The Earth at mid-step.
    const ins_real vm[3] = {v[0] + self->half_dv[0], v[1] + self->half_dv[1], v[2] + self->half_dv[2]};
    earth_t earth;
    earth_at(s, p->anchor[2] + p->offset[2] - half * v[2], &earth);
    const ins_real meridian = half / earth.meridian;
    const ins_real parallel = half / (earth.normal * c);
    const ins_real earth_turn = half * INS_EARTH_RATE;
    const ins_real turn = earth_turn + parallel * vm[1]; // about the Earth's axis
    z[0] = turn * c;
    z[1] = meridian * vm[0];
    z[2] = turn * s;

    // Half of the velocity's change: (f - z x f + (g - (2 w_ie + w_en) x vm) T) / 2, the rates being 2 (z + w_ie T / 2) / T.
    const ins_real x[3] = {vm[0] + h[0], vm[1] + h[1], vm[2] + h[2]};
    const ins_real y[3] = {turn * x[0] + earth_turn * vm[0], turn * x[1] + earth_turn * vm[1],
                           turn * x[2] + earth_turn * vm[2]};
    self->half_dv[0] = h[0] + (z[1] * x[2] - s * y[1]);
    self->half_dv[1] = h[1] + (s * y[0] + c * y[2]);
    self->half_dv[2] = h[2] + (half * earth.gravity - z[1] * x[0] - c * y[1]);
    const ins_real* half_dv = self->half_dv;
    const ins_real mean[3] = {v[0] + half_dv[0], v[1] + half_dv[1], v[2] + half_dv[2]};
    const ins_real half_dlat = meridian * mean[0];
    const ins_real half_dlon = parallel * mean[1];
    const ins_real half_fall = half * mean[2];
    self->half_dlat = half_dlat;
    p->offset[0] += 2 * half_dlat;
    p->offset[1] += 2 * half_dlon;
    p->offset[2] -= 2 * half_fall;
    self->v_n[0] = mean[0] + half_dv[0];
    self->v_n[1] = mean[1] + half_dv[1];
    self->v_n[2] = mean[2] + half_dv[2];
}

/// q(-2 z) b; its norm is left z^2 / 2 too long, which the next step takes out.
static void turn_n(const ins_real z[3], const ins_real b[4], ins_real q[4])
{
    // Pairs of lanes as in quat_mul.
    const ins_real a[4] = {-b[1], b[0], -b[3], b[2]};
    const ins_real w = b[0] - (z[0] * a[0] + z[1] * b[2] + z[2] * b[3]);
    const ins_real x = b[1] - (z[0] * a[1] + z[1] * a[2] + z[2] * b[2]);
    const ins_real y = b[2] - (z[0] * a[2] - z[1] * b[0] - z[2] * b[1]);
    const ins_real k = b[3] - (z[0] * a[3] - z[1] * a[0] - z[2] * b[0]);
    q[0] = w;
    q[1] = x;
    q[2] = y;
    q[3] = k;
}

static int is_far(const ins_strapdown_t* self)
{
    const ins_real* d = self->position.offset;
    return d[0] * d[0] + d[1] * d[1] > ANCHOR_REACH * ANCHOR_REACH;
}

ins_status_t ins_strapdown_step(ins_strapdown_t* self, const ins_increment_t* increment)
{
    ins_real* q = self->sculling.q_nb;
    const ins_real start[4] = {q[0], q[1], q[2], q[3]};
    ins_real s;
    ins_real c;
    strapdown_sin_cos(self, self->position.offset[0] + self->half_dlat, &s, &c);
    if (!(c >= INS_STRAPDOWN_COS_MIN))
    {
        return INS_E_RANGE;
    }
    ins_real dv[3];
    const ins_status_t status = ins_sculling_step(&self->sculling, increment, dv);
    if (status < INS_OK)
    {
        return status;
    }
    ins_real h[3];
    ins_real z[3];
    half_force(start, dv, h);
    advance(self, h, s, c, z);
    turn_n(z, q, q);
    if (is_far(self))
    {
        ins_strapdown_anchor(self);
    }
    return status;
}
