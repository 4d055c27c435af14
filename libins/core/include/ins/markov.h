/// \file   ins/markov.h
/// \brief  First-order Gauss-Markov state in discrete time: x(k+1) = phi x(k) + w, var w = q. Units: s, and those of x.
///
///     ins_markov_t m;
///     ins_markov_init(&m, dt, INS_MARKOV_STRAPDOWN_TAU_S, INS_MARKOV_STRAPDOWN_SIGMA);
///     Phi[0] = m.phi; Q[0] = m.q;                                             // P0[0] = sigma^2
///
/// phi = exp(-T/tau), q = sigma^2 (1 - phi^2); the white noise that drives it has the spectral density 2 sigma^2/tau.
/// Source: 2006 GIMU thesis, 2-27 to 2-29 and the values after them (its 2-28 prints the square root of the density).
/// SPDX-License-Identifier: MIT
#ifndef INS_MARKOV_H_INCLUDED
#define INS_MARKOV_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_MARKOV_DEG_PER_HOUR INS_C(4.84813681109535993590e-6) ///< rad/s

#define INS_MARKOV_GIMBAL_SIGMA    (INS_C(0.01) * INS_MARKOV_DEG_PER_HOUR) ///< gimballed gyro [rad/s]
#define INS_MARKOV_GIMBAL_TAU_S    INS_C(7200.0)
#define INS_MARKOV_STRAPDOWN_SIGMA INS_MARKOV_DEG_PER_HOUR ///< strapdown gyro [rad/s]
#define INS_MARKOV_STRAPDOWN_TAU_S INS_C(300.0)

typedef struct ins_markov_t
{
    ins_real phi; ///< transition over one step
    ins_real q;   ///< variance that a step adds
} ins_markov_t;

/// \param[in] dt  step [s], >= 0. \param[in] tau  time constant [s], > 0. \param[in] sigma  standard deviation of x, >= 0.
/// \return INS_E_RANGE, and self unchanged, if one is not, or not a number.
INS_API ins_status_t ins_markov_init(ins_markov_t* self, ins_real dt, ins_real tau, ins_real sigma);

#ifdef __cplusplus
}
#endif
#endif // INS_MARKOV_H_INCLUDED
