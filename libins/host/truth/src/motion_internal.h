/// \file   motion_internal.h
/// \brief  What a motion is: a kind with its parameters. Made in motion_create.c, evaluated in motion.c.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_MOTION_INTERNAL_H_INCLUDED
#define INS_TRUTH_MOTION_INTERNAL_H_INCLUDED
#include "ins_truth/motion.h"
#include "spline_internal.h"

#define INS_MOTION_TIME_MAX_S 1e9

typedef enum
{
    INS_MOTION_RATE,
    INS_MOTION_SINES,
    INS_MOTION_CONING,
    INS_MOTION_TABLE,
    INS_MOTION_ONWARD
} ins_motion_kind_t;

typedef struct
{
    double q_nb0[4];
    double w_ib_b[3];
} ins_motion_turn_t;

typedef struct
{
    double half_angle;
    double frequency_hz;
} ins_motion_coning_t;

typedef struct
{
    const ins_motion_t* base;
    double from_s;
    ins_motion_turn_t turn; ///< from there on
} ins_motion_onward_t;

struct ins_motion_t
{
    ins_motion_kind_t kind;
    double ramp_s;
    double panel_s; ///< Gauss-Legendre panels are no longer than this
    union
    {
        ins_motion_turn_t turn;
        ins_motion_sine_t sine[3]; ///< yaw, pitch, roll
        ins_motion_coning_t coning;
        ins_spline_t table;
        ins_motion_onward_t onward;
    } of;
};

/// What the motion is at t: itself, or what an onward motion goes on from.
const ins_motion_t* ins_motion_at(const ins_motion_t* self, double t);
/// The first instant after t where some derivative of the motion jumps.
double ins_motion_next_break(const ins_motion_t* self, double t);

#endif // INS_TRUTH_MOTION_INTERNAL_H_INCLUDED
