/// \file   track_internal.h
/// \brief  What a track is: a curve p(u) in n, u as a function of time, and a site. Made in track_create.c, evaluated in track.c.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_TRACK_INTERNAL_H_INCLUDED
#define INS_TRUTH_TRACK_INTERNAL_H_INCLUDED
#include "dense_internal.h"
#include "ins_truth/body.h"
#include "place_internal.h"
#include "spline_internal.h"

#define INS_TRACK_TIME_MAX_S 1e9

typedef enum
{
    INS_TRACK_LINE, ///< also a still one, whose u stays 0
    INS_TRACK_CIRCLE,
    INS_TRACK_EIGHT,
    INS_TRACK_WAYPOINTS, ///< u is time
    INS_TRACK_BODY
} ins_track_kind_t;

/// Integrated from rates and specific force.
typedef struct ins_track_body_t
{
    ins_body_input_t input;
    ins_dense_t motion;
    size_t happenings;
    ins_body_happening_t* happening;
} ins_track_body_t;

/// Axes of a plane curve and its sizes. u is way for a line and a circle, an angle for an eight.
typedef struct ins_track_curve_t
{
    double along[3], across[3]; ///< unit vectors in n: the heading (climbing for a line), and right of it
    double radius;              ///< of a circle; negative to the left
    double length, width;       ///< of an eight
    double u_per_way;
} ins_track_curve_t;

struct ins_track_t
{
    ins_track_kind_t kind;
    ins_track_site_t site;
    ins_place_t place; ///< of the site
    double q_en[4];    ///< of the site's n
    double w_ie_n[3];
    const ins_motion_t* attitude; ///< NULL: along the path
    ins_track_speed_t speed;
    ins_track_curve_t curve;
    ins_spline_t table;
    ins_track_body_t body;
};

/// A place on the curve with its derivatives by time, and the tangent that gives the direction at a standstill too.
typedef struct ins_track_path_t
{
    double p[3], v[3], a[3]; ///< [m], [m/s], [m/s^2]
    double tangent[3];       ///< dp/du, not 0
    double bend[3];          ///< d2p/du2
    double speed;            ///< du/dt
} ins_track_path_t;

/// A track at its site with nothing else set; NULL when the site is refused.
ins_track_t* ins_track_create_at(ins_track_kind_t kind, const ins_track_site_t* site, const ins_why_t* why);
/// Gravity at p_n [m/s^2].
void ins_track_gravity(const ins_track_t* self, const double p_n[3], double g_n[3]);
/// p_n, v_n, q_nb of a solution's numbers; the quaternion normalised, the rest 0.
void ins_track_state_of(const double y[INS_DENSE_SIZE], ins_track_state_t* out);
void ins_track_path(const ins_track_t* self, double t, ins_track_path_t* out);

/// The first instant after t where some derivative of rate or specific force jumps.
double ins_track_next_break(const ins_track_t* self, double t);
/// Half a period of the fastest motion of path and attitude [s]; infinity where nothing swings.
double ins_track_panel(const ins_track_t* self);

#endif // INS_TRUTH_TRACK_INTERNAL_H_INCLUDED
