/// \file   dense_internal.h
/// \brief  A solution of differential equations as the polynomials of its steps: a pure function of time.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_DENSE_INTERNAL_H_INCLUDED
#define INS_TRUTH_DENSE_INTERNAL_H_INCLUDED
#include <stdbool.h>
#include <stddef.h>

#define INS_DENSE_ORDER_MAX 12
#define INS_DENSE_SIZE      10 ///< q_nb, v_n, p_n

/// y(t) = sum over j of a[j] x^j, x = (t - end) / length, for end - length <= t <= end.
typedef struct ins_dense_step_t
{
    double end, length;
    int order;
    size_t first; ///< of its (order + 1) * INS_DENSE_SIZE numbers in values
} ins_dense_step_t;

typedef struct ins_dense_t
{
    double start, end; ///< known between them
    size_t steps, steps_room;
    ins_dense_step_t* step;
    size_t values, values_room;
    double* value;
} ins_dense_t;

void ins_dense_free(ins_dense_t* self);
/// Between start and end.
void ins_dense_at(const ins_dense_t* self, double t, double y[INS_DENSE_SIZE]);

#endif // INS_TRUTH_DENSE_INTERNAL_H_INCLUDED
