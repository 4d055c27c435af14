/// \file   ins_truth/exact.h
/// \brief  What ideal integrating gyros and accelerometers on a track put out: integrals of w_ib_b and f_b. Frame b. rad, m/s.
///
///     ins_truth_increment(track, t0, t1, dtheta_b, dv_b);   // then ins_imu_apply(), then a navigator
///
/// theta = integral of w_ib_b dt, v = integral of f_b dt, each in the turning body frame: not the rotation vector, not the change of
/// velocity; coning and sculling are the navigator's work.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_EXACT_H_INCLUDED
#define INS_TRUTH_EXACT_H_INCLUDED
#include "ins_truth/track.h"
#ifdef __cplusplus
extern "C" {
#endif

/// By Gauss and Legendre with 10 nodes on panels that end where a derivative jumps and are halved until halves and whole agree. Error
/// about 1e-15 of the integral of |w_ib_b| or |f_b|. t1 < t0 gives the negative. Not a number where the track is not known.
/// Cost: 30 instants of the track an increment of up to half a period of its fastest motion.
INS_TRUTH_API void ins_truth_increment(const ins_track_t* track, double t0, double t1, double theta[3], double v[3]);

#ifdef __cplusplus
}
#endif
#endif // INS_TRUTH_EXACT_H_INCLUDED
