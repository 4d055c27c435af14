/// \file   markov.c
/// \brief  First-order Gauss-Markov state.
/// SPDX-License-Identifier: MIT
#include "ins/markov.h"
#include "elementary_internal.h"

ins_status_t ins_markov_init(ins_markov_t* self, ins_real dt, ins_real tau, ins_real sigma)
{
    if (!(dt >= 0) || !(tau > 0) || !(sigma >= 0))
    {
        return INS_E_RANGE;
    }
    ins_real rest;
    self->phi = ins_elementary_decay(dt / tau, 0);
    (void)ins_elementary_decay(2 * dt / tau, &rest);
    self->q = sigma * sigma * rest;
    return INS_OK;
}
