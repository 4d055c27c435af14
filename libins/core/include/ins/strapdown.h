/// \file   ins/strapdown.h
/// \brief  Attitude, velocity and position from increments, over the WGS-84 Earth. Frames: b -> n (NED). SI, rad.
///
///     ins_strapdown_t s;
///     const ins_position_t start = {{lat, lon, height}, {0, 0, 0}};
///     ins_strapdown_init(&s, INS_CONING_HIST2_OPT, period_s, q_nb0, v_n0, &start);
///     for (;;) { ins_strapdown_step(&s, &increment); }                 // s.sculling.q_nb, s.v_n, s.position
///
/// Coning and sculling over the last increments; Earth rate, transport rate, Coriolis acceleration and normal gravity at the
/// middle of the step, extrapolated from the step before, so the whole is second order in the period.
/// A position is an anchor plus an offset: steps accumulate in the offset, small and therefore fine even in float (0.1 mm), and
/// the anchor follows it. In float the anchor's own rounding, 0.4 m, is a constant of the start, not an error that grows.
/// No libm but sqrt: the state is the same bits everywhere. Not within 6.4 km of a pole, where NED has no meaning.
/// Source: P. G. Savage, J. Guid. Control Dyn. 21(1), 1998, 19-28 and 21(2), 1998, 208-221; NIMA TR8350.2 (gravity).
/// SPDX-License-Identifier: MIT
#ifndef INS_STRAPDOWN_H_INCLUDED
#define INS_STRAPDOWN_H_INCLUDED
#include "ins/config.h"
#include "ins/sculling.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_STRAPDOWN_PERIOD_MAX INS_C(1.)   ///< [s]
#define INS_STRAPDOWN_SPEED_MAX  INS_C(1e4)  ///< at the start [m/s]
#define INS_STRAPDOWN_COS_MIN    INS_C(1e-3) ///< cosine of the latitude nearest to a pole

/// Latitude, longitude [rad] and height above WGS-84 [m]: the sum of both.
typedef struct ins_position_t
{
    ins_real anchor[3];
    ins_real offset[3];
} ins_position_t;

/// Owned by the caller. Start with ins_strapdown_init(); read sculling.q_nb, v_n and position.
typedef struct ins_strapdown_t
{
    ins_sculling_t sculling; ///< its q_nb is the attitude
    ins_real v_n[3];         ///< velocity over ground [m/s]
    ins_position_t position;
    ins_real sin_lat, cos_lat; ///< of the anchor
    ins_real half_period;      ///< [s]
    ins_real half_dv[3];       ///< half of the last step's change of velocity [m/s]
    ins_real half_dlat;        ///< and of latitude [rad]
} ins_strapdown_t;

/// \return INS_OK; INS_E_RANGE for what ins_attitude_init refuses, NaN, a period not in (0, INS_STRAPDOWN_PERIOD_MAX], a speed above INS_STRAPDOWN_SPEED_MAX, |height| > 1e6 m,
///         |longitude| > 2 pi, an offset of more than 1e-3 rad, or a latitude too near to a pole.
INS_API ins_status_t ins_strapdown_init(ins_strapdown_t* self, int form, ins_real period_s, const ins_real q_nb[4],
                                        const ins_real v_n[3], const ins_position_t* position);
/// \return INS_OK; INS_S_START; INS_E_RANGE as ins_sculling_step, or if the step would lead too near to a pole; nothing is changed
///         then.
INS_API ins_status_t ins_strapdown_step(ins_strapdown_t* self, const ins_increment_t* increment);

/// Another point of the body: an antenna, a wheel.
/// \param[in] l_b  [3] from the IMU to the point [m]. \param[in] w_ib_b  [3] angular rate now, e.g. increment / period [rad/s].
/// \param[out] v_n  [3] its velocity over ground [m/s]. \param[out] position  of the point.
INS_API void ins_strapdown_point(const ins_strapdown_t* self, const ins_real l_b[3], const ins_real w_ib_b[3],
                                 ins_real v_n[3], ins_position_t* position);
/// From a to b along the meridian and the parallel through a, and down [m]. Offsets and anchors are subtracted one from the other
/// first, so nothing is lost in float.
INS_API void ins_position_difference(const ins_position_t* a, const ins_position_t* b, ins_real ned[3]);

#ifdef __cplusplus
}
#endif
#endif // INS_STRAPDOWN_H_INCLUDED
