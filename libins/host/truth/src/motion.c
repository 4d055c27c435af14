/// \file   motion.c
/// \brief  Closed forms of attitude and body rate; Gauss-Legendre for the increments. Frames b and n; rad, s.
/// SPDX-License-Identifier: MIT
#include "gauss_internal.h"
#include "ins_truth/elementary.h"
#include "motion_internal.h"
#include "ramp_internal.h"
#include "rotation_internal.h"
#include <math.h>

/// Under way for ever without a ramp.
static ins_ramp_t ramp_at(const ins_motion_t* self, double t)
{
    return self->ramp_s == 0.0 ? (ins_ramp_t){t, 1.0, 0.0} : ins_ramp_at(self->ramp_s, t);
}

/// Yaw, pitch, roll of the two Euler kinds, and their derivatives.
static void angles_at(const ins_motion_t* self, double t, double angle[3], double speed[3])
{
    const ins_ramp_t ramp = ramp_at(self, t);
    double rest[3];
    if (self->kind == INS_MOTION_TABLE)
    {
        ins_spline_at(&self->of.table, t, angle, speed);
        for (int i = 0; i < 3; i++)
        {
            rest[i] = self->of.table.y[i][0];
            angle[i] -= rest[i];
        }
    }
    else
    {
        for (int i = 0; i < 3; i++)
        {
            const ins_motion_sine_t* const p = &self->of.sine[i];
            const double w = 2.0 * INS_TRUTH_PI * p->frequency_hz;
            double s;
            double c;
            ins_truth_sincos(w * t + p->phase, &s, &c);
            rest[i] = p->offset;
            angle[i] = p->amplitude * s;
            speed[i] = p->amplitude * w * c;
        }
    }
    for (int i = 0; i < 3; i++)
    {
        speed[i] = ramp.value * speed[i] + ramp.slope * angle[i];
        angle[i] = rest[i] + ramp.value * angle[i];
    }
}

static bool known(double t)
{
    return fabs(t) <= INS_MOTION_TIME_MAX_S;
}

static void fill_nan(double* x, int n)
{
    for (int i = 0; i < n; i++)
    {
        x[i] = (double)NAN;
    }
}

static void turn_attitude(const ins_motion_turn_t* turn, double elapsed_s, double q_nb[4])
{
    const double* const v = turn->w_ib_b;
    const double w = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    double s;
    double c;
    ins_truth_sincos(0.5 * w * elapsed_s, &s, &c);
    const double k = w > 0.0 ? s / w : 0.0;
    const double dq[4] = {c, k * v[0], k * v[1], k * v[2]};
    ins_rotation_product(turn->q_nb0, dq, q_nb);
}

static void coning_attitude(const ins_motion_coning_t* coning, double amplitude, double t, double q_nb[4])
{
    double s;
    double c;
    double sw;
    double cw;
    ins_truth_sincos(0.5 * coning->half_angle * amplitude, &s, &c);
    ins_truth_sincos(2.0 * INS_TRUTH_PI * coning->frequency_hz * t, &sw, &cw);
    q_nb[0] = c;
    q_nb[1] = 0.0;
    q_nb[2] = s * cw;
    q_nb[3] = s * sw;
}

const ins_motion_t* ins_motion_at(const ins_motion_t* self, double t)
{
    while (self->kind == INS_MOTION_ONWARD && t < self->of.onward.from_s)
    {
        self = self->of.onward.base;
    }
    return self;
}

void ins_motion_attitude(const ins_motion_t* motion, double t, double q_nb[4])
{
    const ins_motion_t* const self = ins_motion_at(motion, t);
    double angle[3];
    double speed[3];
    if (!known(t))
    {
        fill_nan(q_nb, 4);
        return;
    }
    switch (self->kind)
    {
    case INS_MOTION_RATE:
        turn_attitude(&self->of.turn, ramp_at(self, t).integral, q_nb);
        break;
    case INS_MOTION_CONING:
        coning_attitude(&self->of.coning, ramp_at(self, t).value, t, q_nb);
        break;
    case INS_MOTION_SINES:
    case INS_MOTION_TABLE:
        angles_at(self, t, angle, speed);
        ins_rotation_of_angles(angle, q_nb);
        break;
    case INS_MOTION_ONWARD:
        turn_attitude(&self->of.onward.turn, t - self->of.onward.from_s, q_nb);
        break;
    }
}

void ins_motion_euler(const ins_motion_t* self, double t, double rpy[3])
{
    double q[4];
    ins_motion_attitude(self, t, q);
    const double c_xx = 1.0 - 2.0 * (q[2] * q[2] + q[3] * q[3]);
    const double c_yx = 2.0 * (q[1] * q[2] + q[0] * q[3]);
    const double c_zx = 2.0 * (q[1] * q[3] - q[0] * q[2]);
    const double c_zy = 2.0 * (q[2] * q[3] + q[0] * q[1]);
    const double c_zz = 1.0 - 2.0 * (q[1] * q[1] + q[2] * q[2]);
    rpy[0] = ins_truth_atan2(c_zy, c_zz);
    rpy[1] = ins_truth_atan2(-c_zx, sqrt(c_xx * c_xx + c_yx * c_yx));
    rpy[2] = ins_truth_atan2(c_yx, c_xx);
}

/// Rotation by a about u = (0, cos wt, sin wt): w_ib_b = a' u + sin a u' - (1 - cos a) u x u'.
static void coning_rate(const ins_motion_coning_t* coning, ins_ramp_t ramp, double t, double w_ib_b[3])
{
    const double w = 2.0 * INS_TRUTH_PI * coning->frequency_hz;
    const double a_half = 0.5 * coning->half_angle * ramp.value;
    const double a_speed = coning->half_angle * ramp.slope;
    double s;
    double c;
    double sw;
    double cw;
    ins_truth_sincos(a_half, &s, &c);
    ins_truth_sincos(w * t, &sw, &cw);
    w_ib_b[0] = -2.0 * w * s * s;
    w_ib_b[1] = a_speed * cw - 2.0 * w * s * c * sw;
    w_ib_b[2] = a_speed * sw + 2.0 * w * s * c * cw;
}

void ins_motion_rate(const ins_motion_t* motion, double t, double w_ib_b[3])
{
    const ins_motion_t* const self = ins_motion_at(motion, t);
    double angle[3];
    double speed[3];
    if (!known(t))
    {
        fill_nan(w_ib_b, 3);
        return;
    }
    switch (self->kind)
    {
    case INS_MOTION_RATE:
        for (int i = 0; i < 3; i++)
        {
            w_ib_b[i] = self->of.turn.w_ib_b[i] * ramp_at(self, t).value;
        }
        break;
    case INS_MOTION_CONING:
        coning_rate(&self->of.coning, ramp_at(self, t), t, w_ib_b);
        break;
    case INS_MOTION_SINES:
    case INS_MOTION_TABLE:
        angles_at(self, t, angle, speed);
        ins_rotation_rate(angle, speed, w_ib_b);
        break;
    case INS_MOTION_ONWARD:
        for (int i = 0; i < 3; i++)
        {
            w_ib_b[i] = self->of.onward.turn.w_ib_b[i];
        }
        break;
    }
}

static double base_next_break(const ins_motion_t* self, double t)
{
    double next = self->kind == INS_MOTION_TABLE ? ins_spline_next_knot(&self->of.table, t) : (double)INFINITY;
    next = self->ramp_s > t && self->ramp_s < next ? self->ramp_s : next;
    return self->ramp_s > 0.0 && 0.0 > t && 0.0 < next ? 0.0 : next;
}

double ins_motion_next_break(const ins_motion_t* self, double t)
{
    double next = (double)INFINITY;
    for (; self->kind == INS_MOTION_ONWARD && t < self->of.onward.from_s; self = self->of.onward.base)
    {
        next = self->of.onward.from_s;
    }
    const double inner = self->kind == INS_MOTION_ONWARD ? next : base_next_break(self, t);
    return inner < next ? inner : next;
}

static void rate_at(const void* self, double t, double value[])
{
    ins_motion_rate(self, t, value);
}

void ins_motion_increment(const ins_motion_t* self, double t0, double t1, double dtheta_b[3])
{
    const double sense = t1 < t0 ? -1.0 : 1.0;
    const double end = t1 < t0 ? t0 : t1;
    double t = t1 < t0 ? t1 : t0;
    double sum[3] = {0.0, 0.0, 0.0};
    if (!known(t0) || !known(t1))
    {
        fill_nan(dtheta_b, 3);
        return;
    }
    if (self->kind == INS_MOTION_RATE)
    {
        for (int i = 0; i < 3; i++)
        {
            dtheta_b[i] = self->of.turn.w_ib_b[i] * (ramp_at(self, t1).integral - ramp_at(self, t0).integral);
        }
        return;
    }
    while (t < end)
    {
        const double next = ins_motion_next_break(self, t);
        const double stop = next < end ? next : end;
        const double panels = floor((stop - t) / self->panel_s) + 1.0;
        const double width = (stop - t) / panels;
        for (double k = 0.0; k < panels; k += 1.0)
        {
            ins_gauss_add(rate_at, self, t + k * width, t + (k + 1.0) * width, 3, sum);
        }
        t = stop;
    }
    for (int i = 0; i < 3; i++)
    {
        dtheta_b[i] = sense * sum[i];
    }
}
