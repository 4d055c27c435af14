/// \file   kf15_internal.h
/// \brief  Rows of I + F dt applied to a vector of the 15 errors, in place of calls. Frame: n (NED). SI, rad.
///
/// x and y have their elements `dx` and `dy` apart: the columns and the rows of a matrix alike.
/// SPDX-License-Identifier: MIT
#ifndef INS_KF15_INTERNAL_H_INCLUDED
#define INS_KF15_INTERNAL_H_INCLUDED
#include "ins/ins_math.h"
#include "ins/kf15.h"

/// y[3] = attitude rows.
static inline void kf15_attitude(const ins_kf15_model_t* m, const ins_real* x, unsigned dx, ins_real* y, unsigned dy)
{
    const ins_real a[3] = {x[0], x[dx], x[2 * dx]};
    const ins_real v[2] = {x[3 * dx], x[4 * dx]};
    const ins_real b[3] = {x[9 * dx], x[10 * dx], x[11 * dx]};
    const ins_real* w = m->turn;
    const ins_real* C = m->C;
    y[0] = a[0] + (w[2] * a[1] - w[1] * a[2]) - m->curve[1] * v[1] - (C[0] * b[0] + C[1] * b[1] + C[2] * b[2]);
    y[dy] = a[1] + (w[0] * a[2] - w[2] * a[0]) + m->curve[0] * v[0] - (C[3] * b[0] + C[4] * b[1] + C[5] * b[2]);
    y[2 * dy] = a[2] + (w[1] * a[0] - w[0] * a[1]) + m->curve[2] * v[1] - (C[6] * b[0] + C[7] * b[1] + C[8] * b[2]);
}

/// y[3] = velocity rows.
static inline void kf15_velocity(const ins_kf15_model_t* m, const ins_real* x, unsigned dx, ins_real* y, unsigned dy)
{
    const ins_real a[3] = {x[0], x[dx], x[2 * dx]};
    const ins_real v[3] = {x[3 * dx], x[4 * dx], x[5 * dx]};
    const ins_real b[3] = {x[12 * dx], x[13 * dx], x[14 * dx]};
    const ins_real* f = m->dv;
    const ins_real* C = m->C;
    const ins_real* V = m->coriolis;
    y[0] = v[0] + (f[2] * a[1] - f[1] * a[2]) + (V[0] * v[0] + V[1] * v[1] + V[2] * v[2]) -
           (C[0] * b[0] + C[1] * b[1] + C[2] * b[2]);
    y[dy] = v[1] + (f[0] * a[2] - f[2] * a[0]) + (V[3] * v[0] + V[4] * v[1] + V[5] * v[2]) -
            (C[3] * b[0] + C[4] * b[1] + C[5] * b[2]);
    y[2 * dy] = v[2] + (f[1] * a[0] - f[0] * a[1]) + (V[6] * v[0] + V[7] * v[1] + m->fall * x[8 * dx]) -
                (C[6] * b[0] + C[7] * b[1] + C[8] * b[2]);
}

/// y[3] = position rows.
static inline void kf15_position(const ins_kf15_model_t* m, const ins_real* x, unsigned dx, ins_real* y, unsigned dy)
{
    y[0] = x[6 * dx] + m->dt * x[3 * dx];
    y[dy] = x[7 * dx] + m->dt * x[4 * dx];
    y[2 * dy] = x[8 * dx] + m->dt * x[5 * dx];
}

#endif // INS_KF15_INTERNAL_H_INCLUDED
