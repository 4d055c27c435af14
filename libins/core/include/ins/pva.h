/// \file   ins/pva.h
/// \brief  Position, velocity and acceleration of one axis from position and velocity fixes. Units: m, s.
///
///     ins_pva_t east;
///     ins_pva_init(&east, var);                          // var: variances of the unknown start, m^2, (m/s)^2, (m/s^2)^2
///     ins_pva_predict(&east, dt, q);
///     ins_innovation_t z = {fix - east.x[0], r, INS_KALMAN_GATE_99, 0};
///     ins_pva_update(&east, INS_PVA_POSITION, &z);
///
/// Jerk is white noise of spectral density q [m^2/s^5]. One filter an axis.
/// Source: the GPS filter of the 2006 GIMU thesis, 5.10 to 5.24 (it prints no A, Q, R, H; this model gives its gains k1 to k3).
/// SPDX-License-Identifier: MIT
#ifndef INS_PVA_H_INCLUDED
#define INS_PVA_H_INCLUDED
#include "ins/kalman.h"
#ifdef __cplusplus
extern "C" {
#endif

enum
{
    INS_PVA_POSITION,
    INS_PVA_VELOCITY,
    INS_PVA_ACCELERATION
};

/// Owned by the caller; readable.
typedef struct ins_pva_t
{
    ins_real x[3]; ///< position, velocity, acceleration
    ins_real P[9]; ///< their covariance
    ins_real K[3]; ///< gain of the last update
} ins_pva_t;

/// x = 0; set it if it is known. \param[in] var  [3] variances of x. \return INS_E_RANGE if one is negative or not a number.
INS_API ins_status_t ins_pva_init(ins_pva_t* self, const ins_real var[3]);
/// \param[in] dt  time step [s], >= 0. \param[in] q  [m^2/s^5], >= 0. \return INS_E_RANGE and no change if either is not.
INS_API ins_status_t ins_pva_predict(ins_pva_t* self, ins_real dt, ins_real q);
/// \param[in] what  INS_PVA_POSITION, VELOCITY or ACCELERATION: what was measured. Refusals as ins_kalman_update().
INS_API ins_status_t ins_pva_update(ins_pva_t* self, int what, ins_innovation_t* z);

#ifdef __cplusplus
}
#endif
#endif // INS_PVA_H_INCLUDED
