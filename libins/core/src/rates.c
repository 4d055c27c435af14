/// \file   rates.c
/// \brief  Adams-Moulton integration of point-sampled angular rates. Frame: b. Units: rad/s -> rad.
/// SPDX-License-Identifier: MIT
#include "ins/rates.h"
#include "ins/vec.h"

/// Weights of the samples, newest first, over the common denominator, for 2, 3, 4 and 5 samples.
static const struct
{
    int_least16_t weight[INS_RATES_ORDER_MAX];
    int_least16_t denominator;
} adams_moulton[] = {{{1, 1}, 2}, {{5, 8, -1}, 12}, {{9, 19, -5, 1}, 24}, {{251, 646, -264, 106, -19}, 720}};

ins_status_t ins_rates_init(ins_rates_t* self, uint_least8_t order, ins_real period_s)
{
    if (order < 2 || order > INS_RATES_ORDER_MAX || !(period_s > 0 && period_s - period_s == 0))
    {
        return INS_E_RANGE;
    }
    const ins_rates_t start = {order, 0, period_s, {{0}}};
    *self = start;
    return INS_OK;
}

ins_status_t ins_rates_add(ins_rates_t* self, const ins_real w_ib_b[3], ins_real dtheta_b[3])
{
    if (!ins_vec_is_finite(w_ib_b))
    {
        return INS_E_RANGE;
    }
    for (int i = INS_RATES_ORDER_MAX - 1; i > 0; i--)
    {
        ins_vec_copy(self->w[i - 1], self->w[i]);
    }
    ins_vec_copy(w_ib_b, self->w[0]);
    if (self->count < self->order)
    {
        self->count++;
    }
    const int n = self->count;
    ins_real sum[3] = {0, 0, 0};
    if (n >= 2)
    {
        const ins_real unit = self->T / adams_moulton[n - 2].denominator;
        for (int i = 0; i < n; i++)
        {
            ins_vec_add_scaled(sum, unit * adams_moulton[n - 2].weight[i], self->w[i]);
        }
    }
    ins_vec_copy(sum, dtheta_b);
    return n < self->order ? INS_S_START : INS_OK;
}

ins_status_t ins_rates_bridge(ins_rates_t* self, uint32_t missing, const ins_real w_ib_b[3], ins_real dtheta_b[3])
{
    if (missing == 0 || !ins_vec_is_finite(w_ib_b))
    {
        return INS_E_RANGE;
    }
    ins_real sum[3] = {0, 0, 0};
    const ins_status_t status = self->count > 0 ? INS_OK : INS_S_START;
    if (self->count > 0)
    {
        const ins_real half_span = INS_C(0.5) * self->T * ((ins_real)missing + 1);
        ins_vec_add_scaled(sum, half_span, self->w[0]);
        ins_vec_add_scaled(sum, half_span, w_ib_b);
    }
    ins_vec_copy(w_ib_b, self->w[0]);
    self->count = 1;
    ins_vec_copy(sum, dtheta_b);
    return status;
}
