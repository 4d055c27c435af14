/// \file   ins_truth/drive.h
/// \brief  What drives a body without a function of one's own: rows of rates and specific force, or manoeuvres by name. SI, rad.
///
///     const ins_manoeuvre_t plan[] = {{INS_MANOEUVRE_HOLD, 5.0, 0.0}, {INS_MANOEUVRE_TURN, 10.0, 1.57}};
///     ins_drive_t* drive = ins_drive_create_manoeuvres(&site, plan, 2, 0.0, 15.0, why, sizeof why);
///     ins_drive_input(drive, &input);                       // then ins_track_create_body()
///
/// A manoeuvre's rate is amount * d/dt (10 x^3 - 15 x^4 + 6 x^5), x from 0 to 1 over its time: it turns by amount exactly, and begins and
/// ends at rest with continuous angular acceleration. The body keeps its velocity along x (no slip): with V its speed,
///
///     f_b = (V', 0, 0) + w_nb_b x (V, 0, 0) + C_bn (2 w_ie x v_n - g)       w_ib_b = w_nb_b + C_bn w_ie
///
/// so start it with v_n = C_nb (V, 0, 0). Before the first and after the last manoeuvre it holds.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_DRIVE_H_INCLUDED
#define INS_TRUTH_DRIVE_H_INCLUDED
#include "ins_truth/body.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef enum ins_manoeuvre_kind_t
{
    INS_MANOEUVRE_HOLD,       ///< attitude and speed
    INS_MANOEUVRE_ACCELERATE, ///< amount: change of speed [m/s]
    INS_MANOEUVRE_TURN,       ///< about the site's down, flat; amount > 0: to the right [rad]
    INS_MANOEUVRE_ROLL,       ///< about x [rad]
    INS_MANOEUVRE_PITCH,      ///< about y; 2 pi: a loop [rad]
    INS_MANOEUVRE_YAW         ///< about z [rad]
} ins_manoeuvre_kind_t;

typedef struct ins_manoeuvre_t
{
    ins_manoeuvre_kind_t kind;
    double duration_s; ///< 1e-3 .. 1e6
    double amount;     ///< |amount| <= 1e4; not looked at by HOLD
} ins_manoeuvre_t;

typedef struct ins_drive_t ins_drive_t;

/// Natural cubic splines through rows of t [s], w_ib_b[rows][3] [rad/s], f_b[rows][3] [m/s^2]; at least 4 rows, times increasing; copied.
/// Outside the rows nothing is known. NULL, and why: refused.
INS_TRUTH_API ins_drive_t* ins_drive_create_table(size_t rows, const double* t, const double* w_ib_b, const double* f_b,
                                                  char* why, size_t why_size);
/// One after the other from start_s on. \param[in] speed  before the first [m/s]. NULL, and why: refused.
INS_TRUTH_API ins_drive_t* ins_drive_create_manoeuvres(const ins_track_site_t* site, const ins_manoeuvre_t* plan,
                                                       size_t count, double start_s, double speed, char* why,
                                                       size_t why_size);
INS_TRUTH_API void ins_drive_destroy(ins_drive_t* self); ///< NULL is allowed.
/// The drive must outlive whoever uses the input.
INS_TRUTH_API void ins_drive_input(const ins_drive_t* self, ins_body_input_t* input);

#ifdef __cplusplus
}
#endif
#endif // INS_TRUTH_DRIVE_H_INCLUDED
