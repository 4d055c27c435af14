/// \file   q31w.c
/// \brief  The fixed-point attitude step with q in 64 bits. Frame: b -> n. Qn: x / 2^n.
/// SPDX-License-Identifier: MIT
#include "q31_internal.h"

ins_status_t ins_q31w_step(ins_q31w_t* self, const int32_t dtheta_b[3])
{
    int32_t q[4];
    int32_t d[4];
    ins_q31w_get(self, q);
    if (!q31_turn(self->prev, dtheta_b, q, d))
    {
        return INS_E_RANGE;
    }
    q31_change(q, d, self->q_nb);
    return q31_remember(self->prev, &self->count, dtheta_b);
}

ins_status_t ins_q31w_init(ins_q31w_t* self, const int32_t q_nb[4])
{
    if (!q31_is_unit(q_nb))
    {
        return INS_E_RANGE;
    }
    const ins_q31w_t start = {{0}, {{0}}, 0};
    *self = start;
    for (int i = 0; i < 4; i++)
    {
        self->q_nb[i] = (int64_t)q_nb[i] * (INT64_C(1) << 32);
    }
    (void)ins_q31w_step(self, self->prev[0]); // as ins_q31_init
    (void)ins_q31w_step(self, self->prev[0]);
    self->count = 0;
    return INS_OK;
}

void ins_q31w_get(const ins_q31w_t* self, int32_t q_nb[4])
{
    for (int i = 0; i < 4; i++)
    {
        q_nb[i] = (int32_t)((self->q_nb[i] + INT64_C(0x80000000)) >> 32);
    }
}
