/// \file   dense.c
/// \brief  Looking a solution up: the step by bisection, its polynomial by Horner.
/// SPDX-License-Identifier: MIT
#include "dense_internal.h"
#include <stdlib.h>

void ins_dense_free(ins_dense_t* self)
{
    free(self->step);
    free(self->value);
}

void ins_dense_at(const ins_dense_t* self, double t, double y[INS_DENSE_SIZE])
{
    size_t low = 0; // the step is low or behind it
    size_t high = self->steps - 1;
    while (low < high)
    {
        const size_t middle = (low + high) / 2;
        if (self->step[middle].end < t)
        {
            low = middle + 1;
        }
        else
        {
            high = middle;
        }
    }
    const ins_dense_step_t* const s = &self->step[low];
    const double* const a = self->value + s->first;
    const double x = (t - s->end) / s->length;
    for (int i = 0; i < INS_DENSE_SIZE; i++)
    {
        double sum = a[s->order * INS_DENSE_SIZE + i];
        for (int j = s->order - 1; j >= 0; j--)
        {
            sum = a[j * INS_DENSE_SIZE + i] + x * sum;
        }
        y[i] = sum;
    }
}
