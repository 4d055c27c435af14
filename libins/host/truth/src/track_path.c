/// \file   track_path.c
/// \brief  Curves in n and the way along them: position, velocity, acceleration. m, s.
/// SPDX-License-Identifier: MIT
#include "ins_truth/elementary.h"
#include "motion_internal.h"
#include "ramp_internal.h"
#include "track_internal.h"
#include <math.h>

/// Way, speed and acceleration along the path.
static void way_at(const ins_track_speed_t* speed, double t, double way[3])
{
    const double brake_s = speed->start_s + speed->accelerate_s + speed->cruise_s;
    const double end_s = brake_s + speed->brake_s;
    const double until = t < end_s ? t : end_s;
    const ins_ramp_t start = ins_ramp_at(speed->accelerate_s, until - speed->start_s);
    const ins_ramp_t brake = ins_ramp_at(speed->brake_s, until - brake_s);
    way[0] = speed->speed * (start.integral - brake.integral);
    way[1] = speed->speed * (start.value - brake.value);
    way[2] = speed->speed * (start.slope - brake.slope);
}

/// along and across of a plane curve, and their first and second derivatives by u.
static void plane_at(const ins_track_t* self, double u, double at[2], double slope[2], double bend[2])
{
    const ins_track_curve_t* const c = &self->curve;
    double s;
    double k;
    at[0] = u;
    at[1] = 0.0;
    slope[0] = 1.0;
    slope[1] = 0.0;
    bend[0] = bend[1] = 0.0;
    if (self->kind == INS_TRACK_CIRCLE)
    {
        ins_truth_sincos(u / c->radius, &s, &k);
        double sh;
        double kh;
        ins_truth_sincos(0.5 * u / c->radius, &sh, &kh);
        at[0] = c->radius * s;
        at[1] = c->radius * 2.0 * sh * sh; // 1 - cos without cancellation
        slope[0] = k;
        slope[1] = s;
        bend[0] = -s / c->radius;
        bend[1] = k / c->radius;
    }
    if (self->kind == INS_TRACK_EIGHT)
    {
        double s2;
        double k2;
        ins_truth_sincos(u, &s, &k);
        ins_truth_sincos(2.0 * u, &s2, &k2);
        at[0] = 0.5 * c->length * s;
        at[1] = 0.5 * c->width * s2;
        slope[0] = 0.5 * c->length * k;
        slope[1] = c->width * k2;
        bend[0] = -0.5 * c->length * s;
        bend[1] = -2.0 * c->width * s2;
    }
}

static void waypoints_at(const ins_track_t* self, double t, ins_track_path_t* out)
{
    double neu[3][3];
    ins_spline_at(&self->table, t, neu[0], neu[1]);
    ins_spline_bend(&self->table, t, neu[2]);
    for (int i = 0; i < 3; i++)
    {
        const double sense = i == 2 ? -1.0 : 1.0; // up to down
        out->p[i] = sense * neu[0][i];
        out->v[i] = out->tangent[i] = sense * neu[1][i];
        out->a[i] = out->bend[i] = sense * neu[2][i];
    }
    out->speed = 1.0;
}

void ins_track_path(const ins_track_t* self, double t, ins_track_path_t* out)
{
    if (self->kind == INS_TRACK_WAYPOINTS)
    {
        waypoints_at(self, t, out);
        return;
    }
    const ins_track_curve_t* const c = &self->curve;
    double u[3];
    double at[2];
    double slope[2];
    double bend[2];
    way_at(&self->speed, t, u);
    for (int i = 0; i < 3; i++)
    {
        u[i] *= c->u_per_way;
    }
    plane_at(self, u[0], at, slope, bend);
    for (int i = 0; i < 3; i++)
    {
        out->p[i] = at[0] * c->along[i] + at[1] * c->across[i];
        out->tangent[i] = slope[0] * c->along[i] + slope[1] * c->across[i];
        out->bend[i] = bend[0] * c->along[i] + bend[1] * c->across[i];
        out->v[i] = out->tangent[i] * u[1];
        out->a[i] = out->bend[i] * u[1] * u[1] + out->tangent[i] * u[2];
    }
    out->speed = u[1];
}

/// Where the spline or the speed of a path breaks.
static double path_break(const ins_track_t* self, double t)
{
    const ins_track_speed_t* const s = &self->speed;
    const double brake_s = s->start_s + s->accelerate_s + s->cruise_s;
    const double stop[4] = {s->start_s, s->start_s + s->accelerate_s, brake_s, brake_s + s->brake_s};
    double next = (double)INFINITY;
    if (self->kind == INS_TRACK_WAYPOINTS)
    {
        return ins_spline_next_knot(&self->table, t);
    }
    for (int i = 0; i < 4; i++)
    {
        next = stop[i] > t && stop[i] < next ? stop[i] : next;
    }
    return next;
}

double ins_track_next_break(const ins_track_t* self, double t)
{
    const ins_body_input_t* const input = &self->body.input;
    if (self->kind == INS_TRACK_BODY)
    {
        return input->next_break != NULL ? input->next_break(input->ctx, t) : (double)INFINITY;
    }
    const double path = path_break(self, t);
    const double attitude = self->attitude != NULL ? ins_motion_next_break(self->attitude, t) : (double)INFINITY;
    return path < attitude ? path : attitude;
}

double ins_track_panel(const ins_track_t* self)
{
    double u_rate = 0.0;              // [rad/s]
    if (self->kind == INS_TRACK_BODY) // the integrator takes some 30 steps a period
    {
        const ins_dense_t* const motion = &self->body.motion;
        return 15.0 * (motion->end - motion->start) / (double)motion->steps;
    }
    u_rate = self->kind == INS_TRACK_CIRCLE ? self->speed.speed / fabs(self->curve.radius) : u_rate;
    u_rate = self->kind == INS_TRACK_EIGHT ? 2.0 * self->speed.speed * self->curve.u_per_way : u_rate;
    const double path_s = u_rate > 0.0 ? INS_TRUTH_PI / u_rate : (double)INFINITY;
    return self->attitude != NULL && self->attitude->panel_s < path_s ? self->attitude->panel_s : path_s;
}
