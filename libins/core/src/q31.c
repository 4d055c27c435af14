/// \file   q31.c
/// \brief  The fixed-point attitude step with q in 32 bits, two previous increments, coning-optimal. Frame: b -> n. Qn: x / 2^n.
/// SPDX-License-Identifier: MIT
#include "q31_internal.h"

Q31_IS(Q31_COS_2, 1, 384, 36, 18);
Q31_IS(Q31_COS_3, 1, 46080, 22, 8);
Q31_IS(Q31_SINC_1, 1, 48, 36, 28);
Q31_IS(Q31_SINC_2, 1, 3840, 41, 18);
Q31_IS(Q31_SINC_3, 1, 645120, 27, 8);
Q31_IS(Q31_CONING, 2, 15, 33, 30);

ins_status_t ins_q31_step(ins_q31_t* self, const int32_t dtheta_b[3])
{
    int32_t d[4];
    if (!q31_turn(self->prev, dtheta_b, self->q_nb, d))
    {
        return INS_E_RANGE;
    }
    q31_rotate(self->q_nb, d);
    return q31_remember(self->prev, &self->count, dtheta_b);
}

ins_status_t ins_q31_init(ins_q31_t* self, const int32_t q_nb[4])
{
    if (!q31_is_unit(q_nb))
    {
        return INS_E_RANGE;
    }
    const q31_vector_t rest = {{0, 0, 0}};
    *(q31_quaternion_t*)self->q_nb = *(const q31_quaternion_t*)q_nb;
    *(q31_vector_t*)self->prev[0] = rest;
    *(q31_vector_t*)self->prev[1] = rest;
    self->count = 0;
    do
    {
        (void)ins_q31_step(self, self->prev[0]); // the norm's error becomes 3/8 of its square each time: 1e-6, 1e-12
    } while (self->count < 2);
    self->count = 0;
    return INS_OK;
}
