/// \file   linfit.c
/// \brief  Linear maps of accelerometers by recursive least squares (Givens rotations). Golub, Van Loan, Matrix Computations, 5.1.8.
/// SPDX-License-Identifier: MIT
#include "ins/ins_math.h"
#include "ins/sixacc.h"
#include "ins/vec.h"

#define RANK_MIN (100 * INS_EPSILON) ///< smallest diagonal of R, relative to its column

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
    for (int i = 0; i < 4; i++)
    {
        const ins_real length = ins_sqrt(self->R[i][i] * self->R[i][i] + row[i] * row[i]);
        if (row[i] == 0)
        {
            continue;
        }
        const ins_real c = self->R[i][i] / length;
        const ins_real s = row[i] / length;
        for (int k = i; k < 4; k++)
        {
            const ins_real r = self->R[i][k];
            self->R[i][k] = c * r + s * row[k];
            row[k] = c * row[k] - s * r;
        }
        for (unsigned j = 0; j < self->count; j++)
        {
            const ins_real z = self->z[j][i];
            self->z[j][i] = c * z + s * p[j];
            p[j] = c * p[j] - s * z;
        }
    }
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
    ins_real x[4];
    for (int i = 3; i >= 0; i--)
    {
        ins_real column2 = 0;
        for (int k = 0; k <= i; k++)
        {
            column2 += self->R[k][i] * self->R[k][i];
        }
        if (!(self->R[i][i] * self->R[i][i] > RANK_MIN * RANK_MIN * column2))
        {
            return INS_E_STATE;
        }
        x[i] = self->z[index][i];
        for (int k = i + 1; k < 4; k++)
        {
            x[i] -= self->R[i][k] * x[k];
        }
        x[i] /= self->R[i][i];
    }
    for (int i = 0; i < 4; i++)
    {
        map[i] = x[i];
    }
    return INS_OK;
}
