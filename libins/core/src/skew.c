/// \file   skew.c
/// \brief  Channel-skew compensation: each channel interpolated back to the instant of its scan. Any unit.
/// SPDX-License-Identifier: MIT
#include "ins/rates.h"
#include "ins/vec.h"

#define SKEW_ORDER_MAX 3

ins_status_t ins_skew_init(ins_skew_t* self, uint_least8_t order, const ins_real delay_s[3], ins_real period_s)
{
    if (order < 1 || order > SKEW_ORDER_MAX || !(period_s > 0 && period_s - period_s == 0))
    {
        return INS_E_RANGE;
    }
    ins_skew_t start = {order, 0, {0}, {{0}}};
    for (int i = 0; i < 3; i++)
    {
        if (!(delay_s[i] >= 0 && delay_s[i] < period_s))
        {
            return INS_E_RANGE;
        }
        start.fraction[i] = delay_s[i] / period_s;
    }
    *self = start;
    return INS_OK;
}

ins_status_t ins_skew_add(ins_skew_t* self, const ins_real raw[3], ins_real out[3])
{
    if (!ins_vec_is_finite(raw))
    {
        return INS_E_RANGE;
    }
    for (int k = SKEW_ORDER_MAX; k > 0; k--)
    {
        ins_vec_copy(self->x[k - 1], self->x[k]);
    }
    ins_vec_copy(raw, self->x[0]);
    if (self->count <= self->order)
    {
        self->count++;
    }
    const int degree = self->count - 1;
    for (int i = 0; i < 3; i++)
    {
        // Newton's backward differences at s = -fraction: x0 + s d1 + s (s + 1) / 2 d2 + s (s + 1) (s + 2) / 6 d3
        ins_real difference[SKEW_ORDER_MAX + 1] = {self->x[0][i], self->x[1][i], self->x[2][i], self->x[3][i]};
        ins_real term = 1;
        ins_real value = difference[0];
        for (int k = 1; k <= degree; k++)
        {
            for (int j = 0; j <= degree - k; j++)
            {
                difference[j] -= difference[j + 1];
            }
            term *= ((ins_real)(k - 1) - self->fraction[i]) / (ins_real)k;
            value += term * difference[0];
        }
        out[i] = value;
    }
    return degree < self->order ? INS_S_START : INS_OK;
}

void ins_skew_restart(ins_skew_t* self)
{
    self->count = 0;
}
