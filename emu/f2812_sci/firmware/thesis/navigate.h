/// \file   navigate.h
/// \brief  The thesis's navigation on a DSP: null calibration, quaternion, Euler angles, P-V-A filter with GPS, TWD97. Frames: b (forward,
///         right, down) -> n (NED), grid. Units: rad, m, s.
///
/// No register of the DSP is touched here: main.c gives packets of the GIMU and takes blocks.
/// Source: "GPS/INS System Design and Integration", master's thesis, Chung Hua University, 2009, chapters 2, 4.5, 5; docs/experiments_thesis.md.
/// SPDX-License-Identifier: MIT
#ifndef THESIS_NAVIGATE_H_INCLUDED
#define THESIS_NAVIGATE_H_INCLUDED
#include "ins/align.h"
#include "ins/gimu.h"
#include "ins/nav_block.h"
#include "ins/pva.h"
#include "ins/thesis.h"
#include "ins/tm.h"

#define THESIS_DT_S (1.0f / INS_GIMU_RATE_HZ)
#ifndef THESIS_CALIBRATION_PACKETS
#define THESIS_CALIBRATION_PACKETS 180 ///< 30 s at rest: a mean good to 0.07 codes, 0.9 degrees a minute
#endif
#define THESIS_GAP_PACKETS_MAX 30    ///< a longer gap is not bridged: what was integrated is worth nothing then
#define THESIS_SATS_MIN        4     ///< the thesis's: "four for precise positioning"
#define THESIS_GATED_MAX       5     ///< refused fixes in a row after which the filter begins anew
#define THESIS_JERK            0.1f  ///< spectral density [m^2/s^5]: a car's changes of acceleration
#define THESIS_FIX_VARIANCE    9.0f  ///< of a fix [m^2]: 3 m
#define THESIS_F_VARIANCE      1.0f  ///< of an acceleration [(m/s^2)^2]: a tilt of degrees, which stays
#define THESIS_COURSE_M        30.0f ///< way between two fixes whose direction is a car's course: ten times their error
#define THESIS_COURSE_FIXES    15    ///< it was standing if that took so long
#define THESIS_COURSE_GAIN     0.5f  ///< part of the difference taken; all of it the first time

#define THESIS_LEVEL_GAIN 0.01f ///< acceleration by which the tilt is turned back, of a metre that a fix is off [1/s^2]
#ifndef THESIS_FIX_DELAY_S
#define THESIS_FIX_DELAY_S                                                                                             \
    0.91f ///< age of a fix in its packet: of the whole second, and packet 6 begins 80 ms + 5/6 s after power-up
#endif

/// How the nulls are found. Also the octet that asks for it over SCI-B.
typedef enum null_mode_t
{
    NULL_NONE = 'n',    ///< 2047, as the thesis's first experiment
    NULL_INTEGER = 'i', ///< mean at rest, rounded to a code
    NULL_FRACTION = 'f' ///< mean at rest
} null_mode_t;

/// calibrate.c: nulls of a GIMU that is level and at rest.
typedef struct calibration_t
{
    null_mode_t mode;
    ins_mean_t gyro;
    ins_mean_t accelerometer;
} calibration_t;

void calibration_begin(calibration_t* self, null_mode_t mode);
/// One more packet at rest. \return 1: scale->null is set.
int calibration_add(calibration_t* self, const uint16_t* raw, ins_gimu_scale_t* scale);

typedef struct navigation_t
{
    calibration_t calibration;
    ins_gimu_scale_t scale;
    uint16_t aligned;
    uint16_t filter; ///< 0: position and velocity are dead reckoning's
    uint16_t level;  ///< 1: fixes level the attitude too; the thesis has no such thing
    uint16_t status; ///< INS_NAV_BLOCK_*, of this packet
    uint32_t time_ms;
    ins_thesis_t attitude;
    float angle[3];    ///< integrals of P, Q, R [rad]: the thesis's angles of 4.5
    ins_pva_t axis[2]; ///< east, north from the origin
    float dead_p[2];   ///< dead reckoning: the same without GPS
    float dead_v[2];
    ins_tm_t grid;   ///< its longitudes are from the central meridian
    uint16_t zone;   ///< 121, 119; 0: no fix yet
    float origin[2]; ///< first fix, easting and northing [m]
    uint16_t course_known;
    float anchor[2];       ///< the fix from which the course is measured, from the origin [m]
    float anchor_heading;  ///< of the attitude then [rad]
    uint16_t anchor_fixes; ///< fixes since
    uint16_t gated;        ///< refused fixes in a row
    uint16_t sats;
    uint16_t fix_age; ///< packets since the last fix
} navigation_t;

/// Calibration begins; the attitude is level, heading as before or north, the position is not known.
void navigation_begin(navigation_t* self, null_mode_t mode);
/// A packet of the GIMU. \param[in] type  INS_GIMU_T1 or T2. \param[in] time_ms  when it was taken.
void navigation_packet(navigation_t* self, const ins_gimu_packet_t* packet, int type, uint32_t time_ms);
/// What goes to the PC.
void navigation_block(const navigation_t* self, ins_nav_block_t* block);

#endif // THESIS_NAVIGATE_H_INCLUDED
