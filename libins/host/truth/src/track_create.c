/// \file   track_create.c
/// \brief  Constructors of tracks: what is asked of sites, speeds, sizes and rows of waypoints.
/// SPDX-License-Identifier: MIT
#include "ins_truth/elementary.h"
#include "rotation_internal.h"
#include "track_internal.h"
#include <math.h>
#include <stdlib.h>

#define HEADING_MAX 1e6  ///< [rad]
#define CLIMB_MAX   1.57 ///< below pi/2: the heading of a vertical line is not defined [rad]
#define SIZE_MIN_M  1e-2
#define SIZE_MAX_M  1e6
#define SLOW        0.01 ///< a direction cannot be told below it [m/s]
#define HALVINGS    40

static bool check_site(const ins_track_site_t* site, const ins_why_t* why)
{
    if (site->gravity != INS_TRACK_G_THESIS && site->gravity != INS_TRACK_G_NORMAL)
    {
        ins_why_say(why, "site: gravity is %d, give INS_TRACK_G_THESIS or INS_TRACK_G_NORMAL", (int)site->gravity);
        return false;
    }
    return ins_why_range(why, "site: ", "latitude", site->latitude, -0.5 * INS_TRUTH_PI, 0.5 * INS_TRUTH_PI) &&
           ins_why_range(why, "site: ", "longitude", site->longitude, -2.0 * INS_TRUTH_PI, 2.0 * INS_TRUTH_PI) &&
           ins_why_range(why, "site: ", "height", site->height, -1e4, 1e5);
}

static bool check_speed(const ins_track_speed_t* speed, const ins_why_t* why)
{
    return ins_why_range(why, "speed: ", "speed", speed->speed, 0.0, 1e4) &&
           ins_why_range(why, "speed: ", "start_s", speed->start_s, -1e9, 1e9) &&
           ins_why_range(why, "speed: ", "accelerate_s", speed->accelerate_s, 1e-2, 1e6) &&
           (speed->cruise_s == (double)INFINITY ||
            ins_why_range(why, "speed: ", "cruise_s (or infinity)", speed->cruise_s, 0.0, 1e9)) &&
           ins_why_range(why, "speed: ", "brake_s", speed->brake_s, 1e-2, 1e6);
}

ins_track_t* ins_track_create_at(ins_track_kind_t kind, const ins_track_site_t* site, const ins_why_t* why)
{
    if (!check_site(site, why))
    {
        return NULL;
    }
    ins_track_t* const self = calloc(1, sizeof *self);
    if (self == NULL)
    {
        ins_why_say(why, "no memory for a track");
        return NULL;
    }
    const double llh[3] = {site->latitude, site->longitude, site->height};
    self->kind = kind;
    self->site = *site;
    ins_place_of_llh(llh, &self->place);
    ins_place_rotation(&self->place, self->q_en);
    if (site->rotating)
    {
        const double w_ie_e[3] = {0.0, 0.0, INS_PLACE_EARTH_RATE};
        ins_place_into_n(&self->place, w_ie_e, self->w_ie_n);
    }
    return self;
}

static ins_track_t* create(ins_track_kind_t kind, const ins_track_site_t* site, const ins_track_speed_t* speed,
                           const ins_motion_t* attitude, const ins_why_t* why)
{
    ins_track_t* const self = check_speed(speed, why) ? ins_track_create_at(kind, site, why) : NULL;
    if (self != NULL)
    {
        self->speed = *speed;
        self->attitude = attitude;
    }
    return self;
}

/// Axes of a plane curve that leaves at `heading`.
static ins_track_curve_t curve_at(double heading, double climb)
{
    double s;
    double c;
    double sc;
    double cc;
    ins_truth_sincos(heading, &s, &c);
    ins_truth_sincos(climb, &sc, &cc);
    return (ins_track_curve_t){.along = {cc * c, cc * s, -sc}, .across = {-s, c, 0.0}, .u_per_way = 1.0};
}

ins_track_t* ins_track_create_still(const ins_track_site_t* site, const ins_motion_t* attitude, char* text, size_t size)
{
    static const ins_track_speed_t none = {.accelerate_s = 1.0, .brake_s = 1.0};
    return ins_track_create_line(site, 0.0, 0.0, &none, attitude, text, size);
}

ins_track_t* ins_track_create_line(const ins_track_site_t* site, double heading, double climb,
                                   const ins_track_speed_t* speed, const ins_motion_t* attitude, char* text,
                                   size_t size)
{
    const ins_why_t why = {text, size};
    if (!ins_why_range(&why, "", "heading", heading, -HEADING_MAX, HEADING_MAX) ||
        !ins_why_range(&why, "", "climb", climb, -CLIMB_MAX, CLIMB_MAX))
    {
        return NULL;
    }
    ins_track_t* const self = create(INS_TRACK_LINE, site, speed, attitude, &why);
    if (self != NULL)
    {
        self->curve = curve_at(heading, climb);
    }
    return self;
}

ins_track_t* ins_track_create_circle(const ins_track_site_t* site, double heading, double radius,
                                     const ins_track_speed_t* speed, const ins_motion_t* attitude, char* text,
                                     size_t size)
{
    const ins_why_t why = {text, size};
    if (!ins_why_range(&why, "", "heading", heading, -HEADING_MAX, HEADING_MAX) ||
        !ins_why_range(&why, "", "|radius|", fabs(radius), SIZE_MIN_M, SIZE_MAX_M))
    {
        return NULL;
    }
    ins_track_t* const self = create(INS_TRACK_CIRCLE, site, speed, attitude, &why);
    if (self != NULL)
    {
        self->curve = curve_at(heading, 0.0);
        self->curve.radius = radius;
    }
    return self;
}

ins_track_t* ins_track_create_eight(const ins_track_site_t* site, double heading, double length, double width,
                                    const ins_track_speed_t* speed, const ins_motion_t* attitude, char* text,
                                    size_t size)
{
    const ins_why_t why = {text, size};
    if (!ins_why_range(&why, "", "heading", heading, -HEADING_MAX, HEADING_MAX) ||
        !ins_why_range(&why, "", "length", length, SIZE_MIN_M, SIZE_MAX_M) ||
        !ins_why_range(&why, "", "width", width, SIZE_MIN_M, SIZE_MAX_M))
    {
        return NULL;
    }
    ins_track_t* const self = create(INS_TRACK_EIGHT, site, speed, attitude, &why);
    if (self != NULL)
    {
        self->curve = curve_at(heading, 0.0);
        self->curve.length = length;
        self->curve.width = width;
        self->curve.u_per_way = 1.0 / sqrt(0.25 * length * length + width * width);
    }
    return self;
}

/// Whether the horizontal speed falls below SLOW between a and b, two instants of one piece of the spline.
static bool is_slow(const ins_spline_t* table, double a, double b, int halvings)
{
    double value[3];
    double slope[3];
    double bend[2][3];
    const double middle = 0.5 * (a + b);
    ins_spline_at(table, middle, value, slope);
    ins_spline_bend(table, a, bend[0]);
    ins_spline_bend(table, b, bend[1]);
    const double speed = sqrt(slope[0] * slope[0] + slope[1] * slope[1]);
    double most = 0.0; // of the acceleration, which is linear in between
    for (int i = 0; i < 2; i++)
    {
        const double there = sqrt(bend[i][0] * bend[i][0] + bend[i][1] * bend[i][1]);
        most = there > most ? there : most;
    }
    if (speed < SLOW || halvings == 0)
    {
        return true;
    }
    return speed - 0.5 * most * (b - a) < SLOW &&
           (is_slow(table, a, middle, halvings - 1) || is_slow(table, middle, b, halvings - 1));
}

static bool check_moving(const ins_spline_t* table, const ins_why_t* why)
{
    for (size_t k = 0; k + 1 < table->rows; k++)
    {
        if (is_slow(table, table->t[k], table->t[k + 1], HALVINGS))
        {
            ins_why_say(why,
                        "rows %zu and %zu: the horizontal speed falls below %g m/s between them, so the path has no "
                        "direction: give an attitude, or rows that keep moving",
                        k + 1, k + 2, SLOW);
            return false;
        }
    }
    return true;
}

ins_track_t* ins_track_create_waypoints(const ins_track_site_t* site, size_t rows, const double* t, const double* north,
                                        const double* east, const double* up, const ins_motion_t* attitude, char* text,
                                        size_t size)
{
    const ins_why_t why = {text, size};
    static const ins_track_speed_t unused = {.accelerate_s = 1.0, .brake_s = 1.0};
    const double* const y[3] = {north, east, up};
    ins_track_t* const self = create(INS_TRACK_WAYPOINTS, site, &unused, attitude, &why);
    if (self == NULL)
    {
        return NULL;
    }
    if (!ins_spline_init(&self->table, &ins_spline_metres, rows, t, y, &why) ||
        (attitude == NULL && !check_moving(&self->table, &why)))
    {
        ins_track_destroy(self);
        return NULL;
    }
    return self;
}

void ins_track_destroy(ins_track_t* self)
{
    if (self != NULL)
    {
        ins_spline_free(&self->table); // nothing to free for the other kinds, and below
        ins_dense_free(&self->body.motion);
        free(self->body.happening);
    }
    free(self);
}
