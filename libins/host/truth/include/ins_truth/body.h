/// \file   ins_truth/body.h
/// \brief  Rigid-body motion from body rate and specific force: what drives it, and the track that it makes. SI, rad.
///
///     ins_body_config_t c = {.site = site, .q_nb = {1, 0, 0, 0}, .end_s = 60.0, .tolerance = INS_BODY_TIGHTEST};
///     ins_body_input_t input;
///     ins_drive_input(drive, &input);                       // or a function of your own
///     ins_track_t* track = ins_track_create_body(&c, &input, NULL, 0, why, sizeof why);
///
///     q_nb' = q_nb (0, w_ib_b - C_bn w_ie) / 2       v_n' = C_nb f_b + g(p_n) - 2 w_ie x v_n       p_n' = v_n
///
/// in the site's n of ins_truth/track.h, gravity and Earth rate as the site says. The result is an ins_track_t: a pure function of time
/// between start_s and end_s (not a number outside), from the integrator's own polynomials of order up to 12; receivers, increments
/// and errors take it like any other.
/// ins_track_create_body() is in libins_truth_cvode, which is built where SUNDIALS 6 is found (Debian: libsundials-dev). It uses libm:
/// its bits hold for one build of SUNDIALS and libm, so no trace that is compared by bytes may come from it.
/// Source: CVODE's variable-order Adams method in Nordsieck form, fixed-point iteration (Hindmarsh et al., ACM TOMS 31(3), 2005).
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_BODY_H_INCLUDED
#define INS_TRUTH_BODY_H_INCLUDED
#include "ins_truth/track.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_BODY_TIGHTEST 1e-14 ///< tolerance; below it rounding decides

/// Body rate and specific force at t. \param[in] state  p_n, v_n, q_nb of the body then; the rest is 0.
/// \return false: it cannot be said, and the integration ends.
typedef bool ins_body_drive_t(void* ctx, double t, const ins_track_state_t* state, double w_ib_b[3], double f_b[3]);

/// What drives the body. ctx must outlive the track.
typedef struct ins_body_input_t
{
    ins_body_drive_t* at;
    double (*next_break)(void* ctx,
                         double t); ///< first instant after t where a derivative jumps, or infinity; NULL: none
    void* ctx;
} ins_body_input_t;

typedef struct ins_body_config_t
{
    ins_track_site_t site;
    double p_n[3], v_n[3]; ///< at start_s, |p_n| <= 1e7, |v_n| <= 1e4
    double q_nb[4];        ///< unit length within 1e-6; it is normalised
    double start_s, end_s; ///< start_s < end_s, |t| <= 1e9
    double tolerance; ///< of a step, INS_BODY_TIGHTEST .. 1e-3: of q_nb, and relative to 1 m/s + |v_n|, 1 m + |p_n|
} ins_body_config_t;

/// An instant is looked for at which a function changes its sign.
typedef struct ins_body_event_t
{
    bool (*value)(void* ctx, double t, const ins_track_state_t* state,
                  double* value); ///< state as for a drive; false ends all
    void* ctx;
    int direction; ///< 1: rising alone, -1: falling alone, 0: both
    bool stops;    ///< the track ends there
} ins_body_event_t;

/// It happened.
typedef struct ins_body_happening_t
{
    double t;
    size_t event;  ///< which of those given
    int direction; ///< 1: it rose, -1: it fell
} ins_body_happening_t;

/// Integrates from start_s to end_s, or to the first event that stops. \return NULL when it refuses or fails: see track.h.
INS_TRUTH_API ins_track_t* ins_track_create_body(const ins_body_config_t* config, const ins_body_input_t* input,
                                                 const ins_body_event_t* events, size_t count, char* why,
                                                 size_t why_size);
/// What happened, in time order; valid as long as the track. \return how many; 0 for a track of another kind.
INS_TRUTH_API size_t ins_track_happenings(const ins_track_t* track, const ins_body_happening_t** happenings);

#ifdef __cplusplus
}
#endif
#endif // INS_TRUTH_BODY_H_INCLUDED
