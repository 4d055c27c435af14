/// \file   track.c
/// \brief  Tracks at an instant: attitude along the path or given, body rate, specific force, geodetic position. SI, rad.
/// SPDX-License-Identifier: MIT
#include "ins_truth/elementary.h"
#include "rotation_internal.h"
#include "track_internal.h"
#include <math.h>

#define PS_PER_S 1e12

/// Heading and pitch of the tangent; roll 0.
static void along_path(const ins_track_path_t* path, double q_nb[4], double w_nb_b[3])
{
    const double* const p = path->tangent;
    const double* const b = path->bend;
    const double h2 = p[0] * p[0] + p[1] * p[1];
    const double h = sqrt(h2);
    const double ypr[3] = {ins_truth_atan2(p[1], p[0]), ins_truth_atan2(-p[2], h), 0.0};
    const double h_slope = (p[0] * b[0] + p[1] * b[1]) / h;
    const double speed[3] = {(p[0] * b[1] - p[1] * b[0]) / h2 * path->speed,
                             (p[2] * h_slope - h * b[2]) / (h2 + p[2] * p[2]) * path->speed, 0.0};
    ins_rotation_of_angles(ypr, q_nb);
    ins_rotation_rate(ypr, speed, w_nb_b);
}

/// Where p_n is on the Earth.
static void place_at(const ins_track_t* self, const double p_n[3], ins_place_t* place)
{
    double xyz[3];
    ins_place_into_e(&self->place, p_n, xyz);
    for (int i = 0; i < 3; i++)
    {
        xyz[i] += self->place.xyz_e[i];
    }
    ins_place_of_xyz(xyz, place);
}

void ins_track_gravity(const ins_track_t* self, const double p_n[3], double g_n[3])
{
    if (self->site.gravity == INS_TRACK_G_THESIS)
    {
        g_n[0] = g_n[1] = 0.0;
        g_n[2] = INS_TRACK_G;
        return;
    }
    ins_place_t here;
    place_at(self, p_n, &here);
    ins_place_into_n(&self->place, here.C_ne + 6, g_n);
    const double gravity = ins_place_gravity(&here);
    for (int i = 0; i < 3; i++)
    {
        g_n[i] *= gravity;
    }
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static void fill_nan(ins_track_state_t* out)
{
    const double nan = (double)NAN;
    *out = (ins_track_state_t){{nan, nan, nan},      {nan, nan, nan}, {nan, nan, nan},
                               {nan, nan, nan, nan}, {nan, nan, nan}, {nan, nan, nan}};
}

void ins_track_state_of(const double y[INS_DENSE_SIZE], ins_track_state_t* out)
{
    const double length = sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + y[3] * y[3]);
    *out = (ins_track_state_t){.p_n = {y[7], y[8], y[9]},
                               .v_n = {y[4], y[5], y[6]},
                               .q_nb = {y[0] / length, y[1] / length, y[2] / length, y[3] / length}};
}

static void body_at(const ins_track_t* self, double t, ins_track_state_t* out)
{
    const ins_track_body_t* const body = &self->body;
    double y[INS_DENSE_SIZE];
    double w_ib_b[3];
    double f_b[3];
    double g_n[3];
    double coriolis[3];
    if (!(t >= body->motion.start && t <= body->motion.end))
    {
        fill_nan(out);
        return;
    }
    ins_dense_at(&body->motion, t, y);
    ins_track_state_of(y, out);
    if (!body->input.at(body->input.ctx, t, out, w_ib_b, f_b))
    {
        fill_nan(out);
        return;
    }
    const double back[4] = {out->q_nb[0], -out->q_nb[1], -out->q_nb[2], -out->q_nb[3]};
    ins_rotation_into_b(back, f_b, out->a_n);
    ins_track_gravity(self, out->p_n, g_n);
    cross(self->w_ie_n, out->v_n, coriolis);
    for (int i = 0; i < 3; i++)
    {
        out->a_n[i] += g_n[i] - 2.0 * coriolis[i];
        out->w_ib_b[i] = w_ib_b[i];
        out->f_b[i] = f_b[i];
    }
}

void ins_track_at(const ins_track_t* self, double t, ins_track_state_t* out)
{
    if (!(fabs(t) <= INS_TRACK_TIME_MAX_S))
    {
        fill_nan(out);
        return;
    }
    if (self->kind == INS_TRACK_BODY)
    {
        body_at(self, t, out);
        return;
    }
    ins_track_path_t path;
    double g_n[3];
    double coriolis[3];
    double f_n[3];
    double w_ie_b[3];
    ins_track_path(self, t, &path);
    ins_track_gravity(self, path.p, g_n);
    cross(self->w_ie_n, path.v, coriolis);
    if (self->attitude != NULL)
    {
        ins_motion_attitude(self->attitude, t, out->q_nb);
        ins_motion_rate(self->attitude, t, out->w_ib_b);
    }
    else
    {
        along_path(&path, out->q_nb, out->w_ib_b);
    }
    ins_rotation_into_b(out->q_nb, self->w_ie_n, w_ie_b);
    for (int i = 0; i < 3; i++)
    {
        out->p_n[i] = path.p[i];
        out->v_n[i] = path.v[i];
        out->a_n[i] = path.a[i];
        out->w_ib_b[i] += w_ie_b[i];
        f_n[i] = path.a[i] + 2.0 * coriolis[i] - g_n[i];
    }
    ins_rotation_into_b(out->q_nb, f_n, out->f_b);
}

void ins_track_geodetic(const ins_track_t* self, double t, ins_track_geodetic_t* out)
{
    ins_track_state_t state;
    ins_place_t here;
    double v_e[3];
    double q_en[4];
    double q_eb[4];
    ins_track_at(self, t, &state);
    place_at(self, state.p_n, &here);
    ins_place_into_e(&self->place, state.v_n, v_e);
    ins_place_into_n(&here, v_e, out->v_n);
    ins_place_rotation(&here, q_en);
    ins_rotation_product(self->q_en, state.q_nb, q_eb);
    const double q_ne[4] = {q_en[0], -q_en[1], -q_en[2], -q_en[3]};
    ins_rotation_product(q_ne, q_eb, out->q_nb);
    for (int i = 0; i < 3; i++)
    {
        out->llh[i] = here.llh[i];
    }
}

void ins_track_motion(void* track, int64_t t_ps, double w_ib_b[3], double f_b[3])
{
    ins_track_state_t state;
    ins_track_at(track, (double)t_ps / PS_PER_S, &state);
    for (int i = 0; i < 3; i++)
    {
        w_ib_b[i] = state.w_ib_b[i];
        f_b[i] = state.f_b[i];
    }
}

size_t ins_track_happenings(const ins_track_t* track, const ins_body_happening_t** happenings)
{
    *happenings = track->body.happening;
    return track->body.happenings;
}
