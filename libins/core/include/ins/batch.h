/// \file   ins/batch.h
/// \brief  Attitude of many trajectories at once, for Monte Carlo: structure of arrays, the bits of ins/attitude.h. Frame: b -> n.
///
///     ins_real state[INS_BATCH_ROWS * N];                 // row r, trajectory i: state[r * N + i]
///     ins_batch_t b;
///     ins_batch_init(&b, N, state, q_nb0);                // q_nb0[4 * N] by rows
///     for (;;) { ins_batch_step(&b, state, dtheta_b); }   // dtheta_b[3 * N] by rows; q_nb in the first four rows of state
///
/// The form is INS_CONING_HIST2_OPT. Plain C that compilers turn into vector code: -O3, with -fno-tree-slp-vectorize on gcc 12, whose other
/// vectoriser contracts. A step in which any increment, or one of the two before, has a component above 0.25 rad is done one by one.
/// SPDX-License-Identifier: MIT
#ifndef INS_BATCH_H_INCLUDED
#define INS_BATCH_H_INCLUDED
#include "ins/config.h"
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

#define INS_BATCH_ROWS 10 ///< w, x, y, z of q_nb; x, y, z of two previous increments [rad]

/// Start with ins_batch_init(). Members are private. The state stays with the caller.
typedef struct ins_batch_t
{
    size_t n;
    uint_least8_t count;  ///< previous increments held
    uint_least8_t large;  ///< bit k: a component above 0.25 rad k + 1 steps ago
    uint_least8_t newest; ///< first row of the newest increment, 4 or 7
} ins_batch_t;

/// \param[in] q_nb  [4 * n] by rows, scalar first. \param[out] state  [INS_BATCH_ROWS * n]
/// \return INS_OK; INS_E_RANGE for n = 0, NaN, or a norm not within 1e-3 of 1 (they are normalised), and then nothing has changed.
INS_API ins_status_t ins_batch_init(ins_batch_t* self, size_t n, ins_real* state, const ins_real* q_nb);
/// \param[in] dtheta_b  [3 * n] by rows [rad]; not part of state.
/// \return INS_OK; INS_S_START; INS_E_RANGE if any is NaN or any |component| > pi, and then nothing has changed.
INS_API ins_status_t ins_batch_step(ins_batch_t* self, ins_real* state, const ins_real* dtheta_b);

#ifdef __cplusplus
}
#endif
#endif // INS_BATCH_H_INCLUDED
