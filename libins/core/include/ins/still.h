/// \file   ins/still.h
/// \brief  Is the body at rest? Blocks of samples whose rate and specific force keep still. Frame: b. SI, rad.
///
///     ins_still_t s;
///     ins_still_init(&s, &config);
///     for (;;) { if (ins_still_add(&s, dt, &increment)) { use(s.rate); } }          // once a block of rest
///
/// A block is at rest if the standard deviation of every axis is below the bounds and so is the mean rate: what I. Skog et al.,
/// IEEE Trans. Biomed. Eng. 57(11), 2010, 2657-2666 call the acceleration moving variance, with the angular rate beside it. A steady,
/// straight drive on a smooth road looks the same to any IMU: who uses the answer asks the filter's velocity too (its NIS gate).
/// No libm; one division a sample.
/// SPDX-License-Identifier: MIT
#ifndef INS_STILL_H_INCLUDED
#define INS_STILL_H_INCLUDED
#include "ins/config.h"
#include "ins/sculling.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct ins_still_config_t
{
    uint16_t samples;     ///< of a block; 0: never at rest
    ins_real rate_sigma;  ///< largest standard deviation of an axis within a block [rad/s]
    ins_real force_sigma; ///< [m/s^2]
    ins_real rate_mean;   ///< largest mean of an axis [rad/s]
} ins_still_config_t;

/// Owned by the caller. Start with ins_still_init(); rate and force are readable.
typedef struct ins_still_t
{
    ins_still_config_t cfg;
    uint16_t count;
    ins_real first[6]; ///< of the block: sums are taken from it, so that they do not cancel
    ins_real sum[6], squares[6];
    ins_real rate[3], force[3]; ///< means of the last block of rest [rad/s], [m/s^2]
} ins_still_t;

/// \return INS_E_RANGE, self unchanged: samples 1, or with samples a bound that is not positive.
INS_API ins_status_t ins_still_init(ins_still_t* self, const ins_still_config_t* cfg);
/// \param[in] increment  finite, of the last dt > 0 [s]. \return 1 at the end of a block of rest, else 0.
INS_API int ins_still_add(ins_still_t* self, ins_real dt, const ins_increment_t* increment);
/// After lost samples: a new block.
INS_API void ins_still_restart(ins_still_t* self);

#ifdef __cplusplus
}
#endif
#endif // INS_STILL_H_INCLUDED
