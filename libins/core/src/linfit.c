/// \file   linfit.c
/// \brief  Linear maps of accelerometers by recursive least squares.
/// SPDX-License-Identifier: MIT
#include "givens_internal.h"
#include "ins/sixacc.h"
#include "ins/vec.h"

ins_status_t ins_linfit_init(ins_linfit_t* self, unsigned count)
{
    if (count < 1 || count > INS_SIXACC_MAX)
    {
        return INS_E_RANGE;
    }
    const ins_linfit_t start = {.count = (uint_least8_t)count};
    *self = start;
    return INS_OK;
}

ins_status_t ins_linfit_add(ins_linfit_t* self, const ins_real f_b[3], const ins_real* readings)
{
    ins_real row[4] = {1, f_b[0], f_b[1], f_b[2]};
    ins_real p[INS_SIXACC_MAX];
    int finite = ins_vec_is_finite(f_b);
    for (unsigned j = 0; j < self->count; j++)
    {
        p[j] = readings[j];
        finite = finite && p[j] - p[j] == 0;
    }
    if (!finite)
    {
        return INS_E_RANGE;
    }
    ins_givens_add(4, self->R, row, self->count, self->z, p);
    for (unsigned j = 0; j < self->count; j++)
    {
        self->residual2[j] += p[j] * p[j];
    }
    return INS_OK;
}

ins_status_t ins_linfit_solve(const ins_linfit_t* self, unsigned index, ins_real map[4])
{
    if (index >= self->count)
    {
        return INS_E_RANGE;
    }
    return ins_givens_solve(4, self->R, self->z + 4 * index, map);
}
