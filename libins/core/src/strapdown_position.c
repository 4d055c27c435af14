/// \file   strapdown_position.c
/// \brief  Start of the strapdown, its two-part position, other points of the body. Frames: b -> n. SI, rad.
/// SPDX-License-Identifier: MIT
#include "earth_internal.h"
#include "ins/ins_math.h"
#include "ins/quat.h"
#include "ins/vec.h"
#include "strapdown_internal.h"

#define HALF_TURN  INS_C(3.14159265358979324)
#define TURN_REST  INS_TOL(2.4492935982947064e-16, -1.7484556e-7f) ///< a turn less 2 HALF_TURN as rounded
#define OFFSET_MAX INS_C(1e-3)                                     ///< [rad], that ins_strapdown_init takes
#define HEIGHT_MAX INS_C(1e6)                                      ///< [m]

/// sum + rest = a + b exactly, sum the rounded one (Knuth's two-sum).
static void two_sum(ins_real a, ins_real b, ins_real* sum, ins_real* rest)
{
    const ins_real s = a + b;
    const ins_real of_b = s - a;
    *rest = (a - (s - of_b)) + (b - of_b);
    *sum = s;
}

void ins_strapdown_anchor(ins_strapdown_t* self)
{
    ins_position_t* p = &self->position;
    for (int i = 0; i < 3; i++)
    {
        two_sum(p->anchor[i], p->offset[i], &p->anchor[i], &p->offset[i]);
    }
    const ins_real turns = p->anchor[1] > HALF_TURN ? 1 : p->anchor[1] < -HALF_TURN ? -1 : 0;
    p->anchor[1] -= turns * (2 * HALF_TURN); // exact: the two are within a factor of two
    p->offset[1] -= turns * TURN_REST;
    // {cos, -, -, sin} of the latitude as a quaternion of twice the angle: no libm.
    const ins_real twice[3] = {0, 0, 2 * p->anchor[0]};
    ins_real q[4] = {1, 0, 0, 0};
    (void)ins_quat_from_rotvec(twice, q);
    self->cos_lat = q[0];
    self->sin_lat = q[3];
}

ins_status_t ins_strapdown_init(ins_strapdown_t* self, int form, ins_real period_s, const ins_real q_nb[4],
                                const ins_real v_n[3], const ins_position_t* position)
{
    const ins_real* a = position->anchor;
    const ins_real* o = position->offset;
    if (!(period_s > 0 && period_s <= INS_STRAPDOWN_PERIOD_MAX) ||
        !(ins_fabs(a[0]) <= HALF_TURN / 2 && ins_fabs(a[1]) <= 2 * HALF_TURN && ins_fabs(a[2]) <= HEIGHT_MAX) ||
        !(ins_fabs(o[0]) <= OFFSET_MAX && ins_fabs(o[1]) <= OFFSET_MAX && ins_fabs(o[2]) <= HEIGHT_MAX) ||
        !(ins_vec_dot(v_n, v_n) <= INS_STRAPDOWN_SPEED_MAX * INS_STRAPDOWN_SPEED_MAX))
    {
        return INS_E_RANGE;
    }
    ins_strapdown_t start = {.v_n = {v_n[0], v_n[1], v_n[2]}, .half_period = INS_C(0.5) * period_s};
    start.position = *position;
    const ins_status_t status = ins_sculling_init(&start.sculling, form, q_nb);
    ins_strapdown_anchor(&start);
    if (status != INS_OK || !(start.cos_lat >= INS_STRAPDOWN_COS_MIN))
    {
        return INS_E_RANGE;
    }
    *self = start;
    return INS_OK;
}

void ins_strapdown_correct(ins_strapdown_t* self, const ins_real x[9])
{
    ins_real dq[4];
    ins_real s;
    ins_real c;
    earth_t earth;
    if (ins_quat_from_rotvec(x, dq) == INS_OK)
    {
        ins_quat_mul(dq, self->sculling.q_nb, self->sculling.q_nb);
    }
    strapdown_sin_cos(self, self->position.offset[0], &s, &c);
    earth_at(s, self->position.anchor[2] + self->position.offset[2], &earth);
    ins_vec_add_scaled(self->v_n, 1, x + 3);
    self->position.offset[0] += x[6] / earth.meridian;
    self->position.offset[1] += x[7] / (earth.normal * c);
    self->position.offset[2] -= x[8];
}

void ins_strapdown_point(const ins_strapdown_t* self, const ins_real l_b[3], const ins_real w_ib_b[3], ins_real v_n[3],
                         ins_position_t* position)
{
    // v + C (w_ib_b x l_b) - w_ie_n x C l_b
    ins_real s;
    ins_real c;
    earth_t earth;
    ins_real w_ie_n[3];
    ins_real cross[3];
    ins_real l_n[3];
    ins_real turning[3];
    strapdown_sin_cos(self, self->position.offset[0], &s, &c);
    earth_at(s, self->position.anchor[2] + self->position.offset[2], &earth);
    ins_earth_rate(s, c, w_ie_n);
    ins_quat_rotate(self->sculling.q_nb, l_b, l_n);
    ins_vec_cross(w_ib_b, l_b, cross);
    ins_quat_rotate(self->sculling.q_nb, cross, turning);
    ins_vec_cross(w_ie_n, l_n, cross);
    for (int i = 0; i < 3; i++)
    {
        v_n[i] = self->v_n[i] + turning[i] - cross[i];
    }
    *position = self->position;
    position->offset[0] += l_n[0] / earth.meridian;
    position->offset[1] += l_n[1] / (earth.normal * c);
    position->offset[2] -= l_n[2];
}

void ins_position_difference(const ins_position_t* a, const ins_position_t* b, ins_real ned[3])
{
    // Across 180 degrees the turn is taken off first: b's anchor less a turn is exact, its difference to a's is not.
    const ins_real across = b->anchor[1] - a->anchor[1];
    const ins_real turns = across > HALF_TURN ? 1 : across < -HALF_TURN ? -1 : 0;
    const ins_real lon = (b->anchor[1] - turns * (2 * HALF_TURN)) - a->anchor[1];
    const ins_real d[3] = {(b->anchor[0] - a->anchor[0]) + (b->offset[0] - a->offset[0]),
                           lon + (b->offset[1] - a->offset[1] - turns * TURN_REST),
                           (b->anchor[2] - a->anchor[2]) + (b->offset[2] - a->offset[2])};
    const ins_real twice[3] = {0, 0, 2 * (a->anchor[0] + a->offset[0])};
    ins_real q[4] = {1, 0, 0, 0};
    (void)ins_quat_from_rotvec(twice, q);
    earth_t earth;
    earth_at(q[3], a->anchor[2] + a->offset[2], &earth);
    ned[0] = d[0] * earth.meridian;
    ned[1] = d[1] * earth.normal * q[0];
    ned[2] = -d[2];
}
