/// \file   sculling_any.c
/// \brief  The general sculling correction: any form, start-up, large increments, refusals. Frame: b. Units: rad, m/s.
/// SPDX-License-Identifier: MIT
#include "attitude_internal.h"
#include "sculling_internal.h"

/// out += k x cross y
static void add_cross(ins_real k, const ins_real x[3], const ins_real y[3], ins_real out[3])
{
    ins_real cross[3];
    ins_vec_cross(x, y, cross);
    ins_vec_add_scaled(out, k, cross);
}

/// x[0] is the newest of row->samples.
static void correct(const ins_coning_row_t* row, const ins_increment_t* x, ins_real dv[3])
{
    static const uint_least8_t older[6] = {1, 2, 3, 2, 3, 3}; // the order of row->c
    static const uint_least8_t newer[6] = {0, 0, 0, 1, 1, 2};
    const int spanned = row->block ? row->samples : 1;
    ins_real half[3] = {0, 0, 0};
    ins_real sum[3] = {0, 0, 0};
    for (int i = 0; i < spanned; i++)
    {
        ins_vec_add_scaled(half, INS_C(0.5), x[i].theta_b);
        ins_vec_add_scaled(sum, 1, x[i].v_b);
    }
    ins_vec_copy(sum, dv);
    add_cross(1, half, sum, dv);
    for (int i = 0; i < 6; i++)
    {
        if (row->c[i] != 0)
        {
            const ins_increment_t* a = &x[older[i]];
            const ins_increment_t* b = &x[newer[i]];
            add_cross(row->c[i], a->theta_b, b->v_b, dv);
            add_cross(row->c[i], a->v_b, b->theta_b, dv);
        }
    }
}

ins_status_t ins_sculling_init(ins_sculling_t* self, int form, const ins_real q_nb[4])
{
    ins_attitude_t attitude;
    const ins_status_t status = ins_attitude_init(&attitude, form, q_nb);
    if (status == INS_OK)
    {
        const ins_real* q = attitude.q_nb;
        const ins_sculling_t start = {{q[0], q[1], q[2], q[3]}, {{{0}, {0}}}, attitude.form, 0};
        *self = start;
    }
    return status;
}

ins_status_t ins_sculling_step_any(ins_sculling_t* self, const ins_increment_t* increment, ins_real dv_b[3])
{
    ins_increment_t x[INS_CONING_SAMPLES_MAX];
    ins_attitude_t attitude = {
        {self->q_nb[0], self->q_nb[1], self->q_nb[2], self->q_nb[3]}, {{0}}, self->form, self->count};
    x[0] = *increment;
    for (int i = 0; i < 3; i++)
    {
        x[i + 1] = self->prev[i];
        ins_vec_copy(self->prev[i].theta_b, attitude.prev[i]);
    }
    ins_real dv[3];
    correct(ins_attitude_row(&attitude), x, dv);
    if (!ins_vec_is_finite(dv))
    {
        return INS_E_RANGE;
    }
    const ins_status_t status = ins_attitude_step_any(&attitude, increment->theta_b);
    if (status >= INS_OK)
    {
        for (int i = 0; i < 4; i++)
        {
            self->q_nb[i] = attitude.q_nb[i];
        }
        self->prev[2] = self->prev[1];
        sculling_keep(self, increment);
        self->count = attitude.count;
        ins_vec_copy(dv, dv_b);
    }
    return status;
}

ins_status_t ins_sculling_dv(int form, const ins_increment_t* increments, ins_real dv_b[3])
{
    const int n = ins_coning_samples(form);
    if (n == 0)
    {
        return INS_E_RANGE;
    }
    ins_increment_t x[INS_CONING_SAMPLES_MAX];
    for (int i = 0; i < n; i++)
    {
        x[i] = increments[n - 1 - i];
    }
    correct(&ins_coning_rows[form], x, dv_b);
    return INS_OK;
}
