/// \file   kf15_internal.h
/// \brief  Rows of I + F dt times a vector of the 15 errors, in place of calls. Frame: n (NED). SI, rad.
///
/// Elements of x are d apart, so that columns and rows of a matrix serve alike. i is a constant where it is called.
/// SPDX-License-Identifier: MIT
#ifndef INS_KF15_INTERNAL_H_INCLUDED
#define INS_KF15_INTERNAL_H_INCLUDED
#include "ins/kf15.h"

/// Elements of a row that loops go over: the one beyond the last is 0, and stays so.
#define KF15_COLUMNS (INS_VECTORS ? INS_KF15_ROW : INS_KF15_N)
#define KF15_FALL    128 ///< a variance that falls by more is put right: what is left of it has lost as many digits

/// P = P - K g with K = g / s. As sqrt(1/s) g times itself, it stays symmetric to the last bit. \param[in] g  [INS_KF15_ROW]
void ins_kf15_downdate(ins_kf15_t* restrict self, const ins_real* restrict g, ins_real s);

/// (C_nb dt b)(i), b the first of three biases.
static inline ins_real kf15_bias(const ins_kf15_model_t* m, unsigned i, const ins_real* b, unsigned d)
{
    const ins_real* const C = m->C + 3 * i;
    return C[0] * b[0] + C[1] * b[d] + C[2] * b[2 * d];
}

/// phi(i) - (w_in x phi + dw_en(dv) + C dbg)(i) dt
static inline ins_real kf15_attitude(const ins_kf15_model_t* m, unsigned i, const ins_real* x, unsigned d)
{
    const unsigned j = (i + 1) % 3;
    const unsigned k = (i + 2) % 3;
    const ins_real* const w = m->turn;
    return x[i * d] + (w[k] * x[j * d] - w[j] * x[k * d]) + m->curve[i] * x[(i == 1 ? 3 : 4) * d] -
           kf15_bias(m, i, x + 9 * d, d);
}

/// dv(i) + (phi x f - (2 w_ie + w_en) x dv - dw_en(dv) x v + 2 g/R dp_D - C dba)(i) dt
static inline ins_real kf15_velocity(const ins_kf15_model_t* m, unsigned i, const ins_real* x, unsigned d)
{
    const unsigned j = (i + 1) % 3;
    const unsigned k = (i + 2) % 3;
    const ins_real* const f = m->dv;
    const ins_real* const V = m->coriolis + 3 * i;
    return x[(3 + i) * d] + (f[k] * x[j * d] - f[j] * x[k * d]) +
           (V[0] * x[3 * d] + V[1] * x[4 * d] + V[2] * x[(i == 2 ? 8 : 5) * d]) - kf15_bias(m, i, x + 12 * d, d);
}

/// dp(i) + dv(i) dt
static inline ins_real kf15_position(const ins_kf15_model_t* m, unsigned i, const ins_real* x, unsigned d)
{
    return x[(6 + i) * d] + m->dt * x[(3 + i) * d];
}

/// The nine navigation rows of (I + F dt) P. Loops of one kind of row each: coefficients stay in registers.
/// \param[in] P  15 rows of INS_KF15_ROW. \param[out] T  9 rows, `pitch` apart.
static inline void kf15_turn(const ins_kf15_model_t* m, const ins_real* restrict P, ins_real* restrict T,
                             unsigned pitch)
{
    for (unsigned j = 0; j < KF15_COLUMNS; j++)
    {
        T[0 * pitch + j] = kf15_attitude(m, 0, P + j, INS_KF15_ROW);
        T[1 * pitch + j] = kf15_attitude(m, 1, P + j, INS_KF15_ROW);
        T[2 * pitch + j] = kf15_attitude(m, 2, P + j, INS_KF15_ROW);
    }
    for (unsigned j = 0; j < KF15_COLUMNS; j++)
    {
        T[3 * pitch + j] = kf15_velocity(m, 0, P + j, INS_KF15_ROW);
        T[4 * pitch + j] = kf15_velocity(m, 1, P + j, INS_KF15_ROW);
        T[5 * pitch + j] = kf15_velocity(m, 2, P + j, INS_KF15_ROW);
    }
    for (unsigned j = 0; j < KF15_COLUMNS; j++)
    {
        T[6 * pitch + j] = kf15_position(m, 0, P + j, INS_KF15_ROW);
        T[7 * pitch + j] = kf15_position(m, 1, P + j, INS_KF15_ROW);
        T[8 * pitch + j] = kf15_position(m, 2, P + j, INS_KF15_ROW);
    }
}

#endif // INS_KF15_INTERNAL_H_INCLUDED
