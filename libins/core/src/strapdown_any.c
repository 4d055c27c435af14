/// \file   strapdown_any.c
/// \brief  The general strapdown step: any form, start-up, large increments, refusals. Frames: b -> n. SI, rad.
/// SPDX-License-Identifier: MIT
#include "sculling_internal.h"
#include "strapdown_internal.h"

ins_status_t ins_strapdown_step_any(ins_strapdown_t* self, const ins_increment_t* increment)
{
    ins_sculling_t next;
    ins_real dv[3];
    ins_real z[3];
    next = self->sculling;
    const ins_status_t status = ins_sculling_step_any(&next, increment, dv);
    if (status < INS_OK || strapdown_advance(self, dv, z) != INS_OK)
    {
        return INS_E_RANGE;
    }
    self->sculling = next;
    strapdown_turn_n(z, next.q_nb, self->sculling.q_nb);
    if (strapdown_is_far(self))
    {
        (void)ins_strapdown_anchor(self);
    }
    return status;
}
