/// \file   ins_truth/track.h
/// \brief  Known trajectories as pure functions of time: position, velocity, attitude, body rate, specific force. SI, rad.
///
///     const ins_track_site_t site = {lat, lon, 50.0, INS_TRACK_G_NORMAL, false};
///     const ins_track_speed_t speed = {10.0, 60.0, 5.0, 120.0, 4.0};
///     ins_track_t* circle = ins_track_create_circle(&site, 0.3, 50.0, &speed, NULL, why, sizeof why);
///     ins_track_at(circle, t, &moment);
///     ins_track_destroy(circle);
///
/// Frame n: north, east, down at the site, fixed to the Earth; it does not follow the vehicle. ins_track_geodetic() gives
/// latitude, longitude, height and the same attitude and velocity in the NED frame of where the vehicle is: 157 urad from n
/// at 1 km. Body b: x forward, y right, z down. q_nb rotates body vectors into n.
///
///     f_b    = C_bn (a_n + 2 w_ie x v_n - g)          w_ib_b = w_nb_b + C_bn w_ie, with w_ie = 0 unless site.rotating
///
/// Attitude: an ins_motion_t (its q_nb against n), or, where NULL is given, that of the path: heading and pitch along its
/// tangent, roll 0; it is known at a standstill too. Times beyond +-1e9 s and NaN give NaN. A track is never written after
/// creation: several threads may read it.
/// Source: gravity and ellipsoid NIMA TR8350.2, 3rd ed., tables 3.1 to 3.4, eq. 4-1, 4-3; geodetic: Bowring 1976, 1985.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_TRACK_H_INCLUDED
#define INS_TRUTH_TRACK_H_INCLUDED
#include "ins_truth/motion.h"
#include <stdbool.h>
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

#define INS_TRACK_G 9.8 ///< the thesis's g [m/s^2]

typedef enum ins_track_gravity_t
{
    INS_TRACK_G_THESIS, ///< INS_TRACK_G along the site's down, everywhere (2006 thesis, section 4.1)
    INS_TRACK_G_NORMAL ///< WGS-84, centrifugal acceleration included, of the vehicle's latitude and height, along its own down
} ins_track_gravity_t;

/// The origin of n.
typedef struct ins_track_site_t
{
    double latitude, longitude; ///< [rad], |latitude| <= pi/2, |longitude| <= 2 pi
    double height;              ///< above the ellipsoid [m], -1e4 .. 1e5
    ins_track_gravity_t gravity;
    bool rotating; ///< the Earth turns: 7.292115e-5 rad/s in w_ib_b, Coriolis in f_b
} ins_track_site_t;

/// Speed along a path: 0, a start of accelerate_s as 10 x^3 - 15 x^4 + 6 x^5, cruise, brakes likewise, 0.
typedef struct ins_track_speed_t
{
    double speed;        ///< while cruising [m/s], 0 .. 1e4
    double start_s;      ///< when it leaves, may be negative; |start_s| <= 1e9
    double accelerate_s; ///< 1e-2 .. 1e6; way: speed * accelerate_s / 2
    double cruise_s;     ///< 0 .. 1e9, or infinity: it never brakes
    double brake_s;      ///< as accelerate_s
} ins_track_speed_t;

typedef struct ins_track_state_t
{
    double p_n[3];    ///< position from the site [m]
    double v_n[3];    ///< [m/s]
    double a_n[3];    ///< acceleration against the Earth [m/s^2]
    double q_nb[4];   ///< scalar first
    double w_ib_b[3]; ///< [rad/s]
    double f_b[3];    ///< specific force; at rest and level {0, 0, -g} [m/s^2]
} ins_track_state_t;

/// In the NED frame of where the vehicle is.
typedef struct ins_track_geodetic_t
{
    double llh[3];  ///< latitude, longitude [rad], height above the ellipsoid [m]
    double v_n[3];  ///< [m/s]
    double q_nb[4]; ///< scalar first
} ins_track_geodetic_t;

typedef struct ins_track_t ins_track_t;

// Each constructor returns NULL when it refuses, and then writes the place, the value found and what would be right into
// why[why_size] (why may be NULL). Arrays and structs are copied; an attitude must outlive the track.

/// At the site for ever. attitude NULL: level, heading north.
INS_TRUTH_API ins_track_t* ins_track_create_still(const ins_track_site_t* site, const ins_motion_t* attitude, char* why,
                                                  size_t why_size);
/// A straight line from the site. \param[in] climb  of the line above the horizontal, |climb| < pi/2.
INS_TRUTH_API ins_track_t* ins_track_create_line(const ins_track_site_t* site, double heading, double climb,
                                                 const ins_track_speed_t* speed, const ins_motion_t* attitude,
                                                 char* why, size_t why_size);
/// A level circle that leaves the site at `heading`. \param[in] radius  [m]; negative turns left. 1e-2 .. 1e6.
INS_TRUTH_API ins_track_t* ins_track_create_circle(const ins_track_site_t* site, double heading, double radius,
                                                   const ins_track_speed_t* speed, const ins_motion_t* attitude,
                                                   char* why, size_t why_size);
/// A level figure of eight, length/2 sin u along `heading`, width/2 sin 2u to the right of it, whose crossing is the site.
/// It leaves between the two, atan(2 width / length) to the right of `heading`. u runs at a constant pace while cruising; the
/// speed given is that at the crossing, elsewhere it is less.
INS_TRUTH_API ins_track_t* ins_track_create_eight(const ins_track_site_t* site, double heading, double length,
                                                  double width, const ins_track_speed_t* speed,
                                                  const ins_motion_t* attitude, char* why, size_t why_size);
/// Natural cubic splines through rows of t [s], north, east, up [m]: at least 4, times increasing. Outside the rows it goes
/// on at its end velocity. attitude NULL: rows between which the horizontal speed falls below 0.01 m/s are refused.
INS_TRUTH_API ins_track_t* ins_track_create_waypoints(const ins_track_site_t* site, size_t rows, const double* t,
                                                      const double* north, const double* east, const double* up,
                                                      const ins_motion_t* attitude, char* why, size_t why_size);
INS_TRUTH_API void ins_track_destroy(ins_track_t* self); ///< NULL is allowed.

/// Everything in n at t [s].
INS_TRUTH_API void ins_track_at(const ins_track_t* self, double t, ins_track_state_t* out);
/// Geodetic position at t [s], velocity and attitude in the frame there.
INS_TRUTH_API void ins_track_geodetic(const ins_track_t* self, double t, ins_track_geodetic_t* out);
/// Body rate and specific force; has the type of a sensor part's motion input. \param[in] track  an ins_track_t
INS_TRUTH_API void ins_track_motion(void* track, int64_t t_ps, double w_ib_b[3], double f_b[3]);

#ifdef __cplusplus
}
#endif
#endif // INS_TRUTH_TRACK_H_INCLUDED
