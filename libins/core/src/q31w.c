/// \file   q31w.c
/// \brief  The fixed-point attitude step with q in 64 bits. Frame: b -> n. Qn: x / 2^n.
/// SPDX-License-Identifier: MIT
#include "ins/q31.h"
#include "q31_internal.h"

ins_status_t ins_q31w_init(ins_q31w_t* self, const int32_t q_nb[4])
{
    if (!ins_q31_is_unit(q_nb))
    {
        return INS_E_RANGE;
    }
    static const int32_t still[3] = {0, 0, 0};
    const ins_q31w_t start = {{0}, {{0}}, 0};
    *self = start;
    for (int i = 0; i < 4; i++)
    {
        self->q_nb[i] = (int64_t)q_nb[i] * (INT64_C(1) << 32);
    }
    (void)ins_q31w_step(self, still); // as ins_q31_init
    (void)ins_q31w_step(self, still);
    self->count = 0;
    return INS_OK;
}

ins_status_t ins_q31w_step(ins_q31w_t* self, const int32_t dtheta_b[3])
{
    int32_t d[4];
    if (!ins_q31_turn(self->prev, dtheta_b, d))
    {
        return INS_E_RANGE;
    }
    int32_t q[4];
    int64_t by[4];
    ins_q31w_get(self, q);
    ins_q31_change(q, d, by);
    for (int i = 0; i < 4; i++)
    {
        self->q_nb[i] += (by[i] + 1) >> 1;
    }
    return ins_q31_remember(self->prev, &self->count, dtheta_b);
}

void ins_q31w_get(const ins_q31w_t* self, int32_t q_nb[4])
{
    for (int i = 0; i < 4; i++)
    {
        q_nb[i] = q31_high(self->q_nb[i]);
    }
}
