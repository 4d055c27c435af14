/// \file   singer_internal.h
/// \brief  Position, velocity and exponentially correlated acceleration over one step: Phi, Q and the input of a mean acceleration.
///
/// Source: R. A. Singer, IEEE Trans. AES 6(4), 1970, 473-483.
/// SPDX-License-Identifier: MIT
#ifndef INS_SINGER_INTERNAL_H_INCLUDED
#define INS_SINGER_INTERNAL_H_INCLUDED
#include "ins/config.h"

typedef struct ins_singer_t
{
    ins_real p12, p13, p23, p33;           ///< Phi = [1 p12 p13; 0 1 p23; 0 0 p33]
    ins_real q11, q12, q13, q22, q23, q33; ///< Q for an acceleration of variance 1 (m/s^2)^2
    ins_real u[3];                         ///< what a mean acceleration of 1 m/s^2 adds to x
} ins_singer_t;

/// \param[in] dt  step [s], > 0. \param[in] tau  correlation time [s], > 0.
void ins_singer(ins_real dt, ins_real tau, ins_singer_t* out);

#endif // INS_SINGER_INTERNAL_H_INCLUDED
