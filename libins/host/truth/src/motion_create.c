/// \file   motion_create.c
/// \brief  The motions' constructors: checks, copies, and how finely an increment must be integrated.
/// SPDX-License-Identifier: MIT
#include "ins_truth/elementary.h"
#include "motion_internal.h"
#include <math.h>
#include <stdlib.h>

#define RATE_MAX         1e4 ///< [rad/s]
#define FREQUENCY_MAX_HZ 1e6
#define ANGLE_MAX        1e6 ///< offset, amplitude, phase [rad]

/// A motion with its ramp checked; the constructors fill in the rest.
static ins_motion_t* create(ins_motion_kind_t kind, double ramp_s, const ins_why_t* why)
{
    if (!ins_why_range(why, "", "ramp_s", ramp_s, 0.0, INS_MOTION_TIME_MAX_S))
    {
        return NULL;
    }
    ins_motion_t* const self = calloc(1, sizeof *self);
    if (self == NULL)
    {
        ins_why_say(why, "no memory for a motion");
        return NULL;
    }
    self->kind = kind;
    self->ramp_s = ramp_s;
    return self;
}

/// Panels of half a period of the fastest component; excursion [rad] is what the ramp adds, at its steepest 1.875 /
/// ramp_s.
static void set_panel(ins_motion_t* self, double bandwidth_hz, double excursion)
{
    const double ramp_hz = self->ramp_s > 0.0 ? 1.875 / (2.0 * INS_TRUTH_PI) * excursion / self->ramp_s : 0.0;
    const double hz = bandwidth_hz + ramp_hz;
    self->panel_s = hz > 0.0 ? 0.5 / hz : (double)INFINITY;
}

static bool check_rate(const double w_ib_b[3], const ins_why_t* why)
{
    return ins_why_range(why, "", "w_ib_b[0]", w_ib_b[0], -RATE_MAX, RATE_MAX) &&
           ins_why_range(why, "", "w_ib_b[1]", w_ib_b[1], -RATE_MAX, RATE_MAX) &&
           ins_why_range(why, "", "w_ib_b[2]", w_ib_b[2], -RATE_MAX, RATE_MAX);
}

ins_motion_t* ins_motion_create_rate(const double w_ib_b[3], const double q_nb0[4], double ramp_s, char* text,
                                     size_t size)
{
    const ins_why_t why = {text, size};
    const double length = sqrt(q_nb0[0] * q_nb0[0] + q_nb0[1] * q_nb0[1] + q_nb0[2] * q_nb0[2] + q_nb0[3] * q_nb0[3]);
    if (!check_rate(w_ib_b, &why) || !ins_why_range(&why, "", "the length of q_nb0", length, 1.0 - 1e-6, 1.0 + 1e-6))
    {
        return NULL;
    }
    ins_motion_t* const self = create(INS_MOTION_RATE, ramp_s, &why);
    if (self != NULL)
    {
        for (int i = 0; i < 3; i++)
        {
            self->of.turn.w_ib_b[i] = w_ib_b[i];
        }
        for (int i = 0; i < 4; i++)
        {
            self->of.turn.q_nb0[i] = q_nb0[i] / length;
        }
    }
    return self;
}

ins_motion_t* ins_motion_create_euler(const ins_motion_sines_t* sines, double ramp_s, char* text, size_t size)
{
    const ins_why_t why = {text, size};
    const ins_motion_sine_t sine[3] = {sines->yaw, sines->pitch, sines->roll};
    static const char* const where[3] = {"yaw: ", "pitch: ", "roll: "};
    double bandwidth_hz = 0.0;
    double excursion = 0.0;
    for (int i = 0; i < 3; i++)
    {
        if (!ins_why_range(&why, where[i], "offset", sine[i].offset, -ANGLE_MAX, ANGLE_MAX) ||
            !ins_why_range(&why, where[i], "amplitude", sine[i].amplitude, -ANGLE_MAX, ANGLE_MAX) ||
            !ins_why_range(&why, where[i], "frequency_hz", sine[i].frequency_hz, 0.0, FREQUENCY_MAX_HZ) ||
            !ins_why_range(&why, where[i], "phase", sine[i].phase, -ANGLE_MAX, ANGLE_MAX))
        {
            return NULL;
        }
        // The sine of a swinging angle reaches about (1 + amplitude) times the swing's frequency (Carson's rule).
        bandwidth_hz += sine[i].frequency_hz * (1.0 + fabs(sine[i].amplitude));
        excursion += fabs(sine[i].amplitude);
    }
    ins_motion_t* const self = create(INS_MOTION_SINES, ramp_s, &why);
    if (self != NULL)
    {
        for (int i = 0; i < 3; i++)
        {
            self->of.sine[i] = sine[i];
        }
        set_panel(self, bandwidth_hz, excursion);
    }
    return self;
}

ins_motion_t* ins_motion_create_coning(double half_angle, double frequency_hz, double ramp_s, char* text, size_t size)
{
    const ins_why_t why = {text, size};
    if (!ins_why_range(&why, "", "half_angle", half_angle, 0.0, INS_TRUTH_PI) ||
        !ins_why_range(&why, "", "frequency_hz", frequency_hz, 0.0, FREQUENCY_MAX_HZ))
    {
        return NULL;
    }
    ins_motion_t* const self = create(INS_MOTION_CONING, ramp_s, &why);
    if (self != NULL)
    {
        self->of.coning = (ins_motion_coning_t){half_angle, frequency_hz};
        set_panel(self, frequency_hz, half_angle);
    }
    return self;
}

ins_motion_t* ins_motion_create_table(size_t rows, const double* t, const double* yaw, const double* pitch,
                                      const double* roll, double ramp_s, char* text, size_t size)
{
    const ins_why_t why = {text, size};
    const double* const y[3] = {yaw, pitch, roll};
    ins_motion_t* const self = create(INS_MOTION_TABLE, ramp_s, &why);
    if (self == NULL || !ins_spline_init(&self->of.table, &ins_spline_angles, rows, t, y, &why))
    {
        free(self);
        return NULL;
    }
    set_panel(self, self->of.table.speed_bound / (2.0 * INS_TRUTH_PI), self->of.table.excursion);
    return self;
}

ins_motion_t* ins_motion_create_onward(const ins_motion_t* base, double from_s, const double w_ib_b[3], char* text,
                                       size_t size)
{
    const ins_why_t why = {text, size};
    if (!ins_why_range(&why, "", "from_s", from_s, -INS_MOTION_TIME_MAX_S, INS_MOTION_TIME_MAX_S) ||
        !check_rate(w_ib_b, &why))
    {
        return NULL;
    }
    ins_motion_t* const self = create(INS_MOTION_ONWARD, 0.0, &why);
    if (self != NULL)
    {
        ins_motion_onward_t* const onward = &self->of.onward;
        onward->base = base;
        onward->from_s = from_s;
        for (int i = 0; i < 3; i++)
        {
            onward->turn.w_ib_b[i] = w_ib_b[i];
        }
        ins_motion_attitude(base, from_s, onward->turn.q_nb0);
        self->panel_s = base->kind == INS_MOTION_RATE ? (double)INFINITY : base->panel_s;
    }
    return self;
}

void ins_motion_destroy(ins_motion_t* self)
{
    if (self != NULL && self->kind == INS_MOTION_TABLE)
    {
        ins_spline_free(&self->of.table);
    }
    free(self);
}

void ins_motion_span(const ins_motion_t* self, double* first, double* last)
{
    *last = self->kind == INS_MOTION_TABLE ? self->of.table.t[self->of.table.rows - 1] : (double)INFINITY;
    self = ins_motion_at(self, -(double)INFINITY);
    *first = self->kind == INS_MOTION_TABLE ? self->of.table.t[0] : -(double)INFINITY;
}
