/// \file   coning_internal.h
/// \brief  The coefficient table of the coning family and its one evaluation, shared by the public function and the attitude step.
/// SPDX-License-Identifier: MIT
#ifndef INS_CONING_INTERNAL_H_INCLUDED
#define INS_CONING_INTERNAL_H_INCLUDED
#include "ins/coning.h"
#include "ins/vec.h"

typedef struct ins_coning_row_t
{
    uint_least8_t samples;
    uint_least8_t block; ///< 1: the form spans all its samples
    /// Coefficients of theta_a x theta_b, counted back from the newest (0): a > b in the order 10, 20, 30, 21, 31, 32.
    ins_real c[6];
} ins_coning_row_t;

#define R(numerator, denominator) ((ins_real)(numerator) / (ins_real)(denominator))
/// The default form's row, here so that the attitude step can be compiled for it.
#define CONING_ROW_HIST2_OPT                                                                                           \
    {                                                                                                                  \
        3, 0,                                                                                                          \
        {                                                                                                              \
            R(7, 60), R(-1, 60)                                                                                        \
        }                                                                                                              \
    }

extern const ins_coning_row_t ins_coning_rows[INS_CONING_FORM_COUNT];

/// phi += sum c_ab t_a x t_b; t0 is the newest. Increments that the form does not read are not touched.
static inline void coning_add(const ins_coning_row_t* row, const ins_real t0[3], const ins_real t1[3],
                              const ins_real t2[3], const ins_real t3[3], ins_real phi[3])
{
    if (row->samples < 2)
    {
        return;
    }
    const ins_real* c = row->c;
    ins_real w[3] = {c[0] * t1[0], c[0] * t1[1], c[0] * t1[2]};
    if (row->samples > 2)
    {
        ins_vec_add_scaled(w, c[1], t2);
    }
    if (row->samples > 3)
    {
        ins_vec_add_scaled(w, c[2], t3);
    }
    ins_real cross[3];
    ins_vec_cross(w, t0, cross);
    ins_vec_add_scaled(phi, 1, cross);
    if (c[3] != 0) // forms without 21 have no 31 and no 32 either
    {
        ins_real v[3] = {c[3] * t2[0], c[3] * t2[1], c[3] * t2[2]};
        if (row->samples > 3)
        {
            ins_vec_add_scaled(v, c[4], t3);
            ins_vec_cross(t3, t2, cross);
            ins_vec_add_scaled(phi, c[5], cross);
        }
        ins_vec_cross(v, t1, cross);
        ins_vec_add_scaled(phi, 1, cross);
    }
}

#endif // INS_CONING_INTERNAL_H_INCLUDED
