/// \file   drive.c
/// \brief  Body rate and specific force from rows or manoeuvres. Frames b and n; SI, rad.
/// SPDX-License-Identifier: MIT
#include "ins_truth/drive.h"
#include "ramp_internal.h"
#include "rotation_internal.h"
#include "track_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct ins_drive_t
{
    ins_spline_t rate, force; ///< of a table
    ins_track_t* earth;       ///< of manoeuvres: gravity and the Earth's rate
    size_t count;
    ins_manoeuvre_t* plan;
    double* start_s; ///< [count + 1], the last: the end
    double speed;
};

static const ins_spline_kind_t rates = {{"w_x", "w_y", "w_z"}, "rad/s", 1e4, (double)INFINITY};
static const ins_spline_kind_t forces = {{"f_x", "f_y", "f_z"}, "m/s^2", 1e6, (double)INFINITY};

/// Columns of rows of three, then a spline through them.
static bool spline_of_rows(ins_spline_t* out, const ins_spline_kind_t* kind, size_t rows, const double* t,
                           const double* values, const ins_why_t* why)
{
    double* const column = malloc(3 * rows * sizeof *column);
    if (column == NULL)
    {
        ins_why_say(why, "no memory for a table of %zu rows", rows);
        return false;
    }
    const double* const y[3] = {column, column + rows, column + 2 * rows};
    for (size_t k = 0; k < rows; k++)
    {
        for (size_t i = 0; i < 3; i++)
        {
            column[i * rows + k] = values[3 * k + i];
        }
    }
    const bool taken = ins_spline_init(out, kind, rows, t, y, why);
    free(column);
    return taken;
}

static ins_drive_t* create(const ins_why_t* why)
{
    ins_drive_t* const self = calloc(1, sizeof *self);
    if (self == NULL)
    {
        ins_why_say(why, "no memory for a drive");
    }
    return self;
}

ins_drive_t* ins_drive_create_table(size_t rows, const double* t, const double* w_ib_b, const double* f_b, char* text,
                                    size_t size)
{
    const ins_why_t why = {text, size};
    ins_drive_t* const self = create(&why);
    if (self == NULL || !spline_of_rows(&self->rate, &rates, rows, t, w_ib_b, &why) ||
        !spline_of_rows(&self->force, &forces, rows, t, f_b, &why))
    {
        ins_drive_destroy(self);
        return NULL;
    }
    return self;
}

static bool check_plan(const ins_manoeuvre_t* plan, size_t count, const ins_why_t* why)
{
    for (size_t k = 0; k < count; k++)
    {
        if (plan[k].kind < INS_MANOEUVRE_HOLD || plan[k].kind > INS_MANOEUVRE_YAW ||
            !(plan[k].duration_s >= 1e-3 && plan[k].duration_s <= 1e6) || !(fabs(plan[k].amount) <= 1e4))
        {
            ins_why_say(why,
                        "manoeuvre %zu: kind %d, %.9g s, amount %.9g: give a kind of ins_manoeuvre_kind_t, 0.001 to "
                        "1000000 s, and an amount within +-10000",
                        k + 1, (int)plan[k].kind, plan[k].duration_s, plan[k].amount);
            return false;
        }
    }
    return count > 0 || (ins_why_say(why, "no manoeuvre: give one at least"), false);
}

ins_drive_t* ins_drive_create_manoeuvres(const ins_track_site_t* site, const ins_manoeuvre_t* plan, size_t count,
                                         double start_s, double speed, char* text, size_t size)
{
    const ins_why_t why = {text, size};
    if (!check_plan(plan, count, &why) || !ins_why_range(&why, "", "start_s", start_s, -1e9, 1e9) ||
        !ins_why_range(&why, "", "speed", speed, -1e4, 1e4))
    {
        return NULL;
    }
    ins_drive_t* const self = create(&why);
    if (self == NULL)
    {
        return NULL;
    }
    self->earth = ins_track_create_at(INS_TRACK_LINE, site, &why);
    self->plan = malloc(count * sizeof *plan);
    self->start_s = malloc((count + 1) * sizeof *self->start_s);
    if (self->earth == NULL || self->plan == NULL || self->start_s == NULL)
    {
        if (self->earth != NULL)
        {
            ins_why_say(&why, "no memory for %zu manoeuvres", count);
        }
        ins_drive_destroy(self);
        return NULL;
    }
    memcpy(self->plan, plan, count * sizeof *plan);
    self->count = count;
    self->speed = speed;
    self->start_s[0] = start_s;
    for (size_t k = 0; k < count; k++)
    {
        self->start_s[k + 1] = self->start_s[k] + plan[k].duration_s;
    }
    return self;
}

void ins_drive_destroy(ins_drive_t* self)
{
    if (self != NULL)
    {
        ins_spline_free(&self->rate);
        ins_spline_free(&self->force);
        ins_track_destroy(self->earth);
        free(self->plan);
        free(self->start_s);
    }
    free(self);
}

static bool table_at(void* ctx, double t, const ins_track_state_t* state, double w_ib_b[3], double f_b[3])
{
    const ins_drive_t* const self = ctx;
    double slope[3];
    (void)state;
    if (!(t >= self->rate.t[0] && t <= self->rate.t[self->rate.rows - 1]))
    {
        return false;
    }
    ins_spline_at(&self->rate, t, w_ib_b, slope);
    ins_spline_at(&self->force, t, f_b, slope);
    return true;
}

static double table_break(void* ctx, double t)
{
    const ins_drive_t* const self = ctx;
    return ins_spline_next_knot(&self->rate, t);
}

/// Speed, its rate, and the rate of turning about b's axes and the site's down.
typedef struct
{
    double speed, acceleration;
    double w_b[3];
    double w_down;
} order_t;

static order_t order_at(const ins_drive_t* self, double t)
{
    order_t order = {.speed = self->speed};
    for (size_t k = 0; k < self->count && t > self->start_s[k]; k++)
    {
        const ins_manoeuvre_t* const m = &self->plan[k];
        const ins_ramp_t ramp = ins_ramp_at(m->duration_s, t - self->start_s[k]);
        const double rate = m->amount * ramp.slope;
        switch (m->kind)
        {
        case INS_MANOEUVRE_HOLD:
            break;
        case INS_MANOEUVRE_ACCELERATE:
            order.speed += m->amount * ramp.value;
            order.acceleration += rate;
            break;
        case INS_MANOEUVRE_TURN:
            order.w_down += rate;
            break;
        case INS_MANOEUVRE_ROLL:
        case INS_MANOEUVRE_PITCH:
        case INS_MANOEUVRE_YAW:
            order.w_b[m->kind - INS_MANOEUVRE_ROLL] += rate;
            break;
        }
    }
    return order;
}

static bool manoeuvre_at(void* ctx, double t, const ins_track_state_t* state, double w_ib_b[3], double f_b[3])
{
    const ins_drive_t* const self = ctx;
    const ins_track_t* const earth = self->earth;
    const order_t order = order_at(self, t);
    const double down[3] = {0.0, 0.0, order.w_down};
    double w_turn[3];
    double w_ie_b[3];
    double g_n[3];
    double carried[3]; // C_bn (2 w_ie x v_n - g)
    ins_rotation_into_b(state->q_nb, down, w_turn);
    ins_rotation_into_b(state->q_nb, earth->w_ie_n, w_ie_b);
    ins_track_gravity(earth, state->p_n, g_n);
    const double* const w = earth->w_ie_n;
    const double* const v = state->v_n;
    const double carried_n[3] = {2.0 * (w[1] * v[2] - w[2] * v[1]) - g_n[0], 2.0 * (w[2] * v[0] - w[0] * v[2]) - g_n[1],
                                 2.0 * (w[0] * v[1] - w[1] * v[0]) - g_n[2]};
    ins_rotation_into_b(state->q_nb, carried_n, carried);
    double w_nb_b[3];
    for (int i = 0; i < 3; i++)
    {
        w_nb_b[i] = order.w_b[i] + w_turn[i];
        w_ib_b[i] = w_nb_b[i] + w_ie_b[i];
    }
    f_b[0] = order.acceleration + carried[0];
    f_b[1] = order.speed * w_nb_b[2] + carried[1];
    f_b[2] = -order.speed * w_nb_b[1] + carried[2];
    return true;
}

static double manoeuvre_break(void* ctx, double t)
{
    const ins_drive_t* const self = ctx;
    for (size_t k = 0; k <= self->count; k++)
    {
        if (self->start_s[k] > t)
        {
            return self->start_s[k];
        }
    }
    return (double)INFINITY;
}

void ins_drive_input(const ins_drive_t* self, ins_body_input_t* input)
{
    *input = (ins_body_input_t){.at = self->plan != NULL ? manoeuvre_at : table_at,
                                .next_break = self->plan != NULL ? manoeuvre_break : table_break,
                                .ctx = (void*)(uintptr_t)self};
}
