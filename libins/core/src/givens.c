/// \file   givens.c
/// \brief  Least squares row by row with Givens rotations.
/// SPDX-License-Identifier: MIT
#include "givens_internal.h"
#include "ins/ins_math.h"

#define RANK_MIN (100 * INS_EPSILON) ///< smallest diagonal of R, relative to its column

void ins_givens_add(unsigned n, ins_real* R, ins_real* row, unsigned m, ins_real* z, ins_real* p)
{
    for (unsigned i = 0; i < n; i++)
    {
        ins_real* const Ri = R + i * n;
        if (row[i] == 0)
        {
            continue;
        }
        const ins_real length = ins_sqrt(Ri[i] * Ri[i] + row[i] * row[i]);
        const ins_real c = Ri[i] / length;
        const ins_real s = row[i] / length;
        for (unsigned k = i; k < n; k++)
        {
            const ins_real r = Ri[k];
            Ri[k] = c * r + s * row[k];
            row[k] = c * row[k] - s * r;
        }
        for (unsigned j = 0; j < m; j++)
        {
            const ins_real old = z[j * n + i];
            z[j * n + i] = c * old + s * p[j];
            p[j] = c * p[j] - s * old;
        }
    }
}

ins_status_t ins_givens_solve(unsigned n, const ins_real* R, const ins_real* z, ins_real* x)
{
    for (unsigned i = 0; i < n; i++)
    {
        ins_real column2 = 0;
        for (unsigned k = 0; k <= i; k++)
        {
            column2 += R[k * n + i] * R[k * n + i];
        }
        if (!(R[i * n + i] * R[i * n + i] > RANK_MIN * RANK_MIN * column2))
        {
            return INS_E_STATE;
        }
    }
    for (unsigned i = n; i-- > 0;)
    {
        ins_real sum = z[i];
        for (unsigned k = i + 1; k < n; k++)
        {
            sum -= R[i * n + k] * x[k];
        }
        x[i] = sum / R[i * n + i];
    }
    return INS_OK;
}
