/// \file   singer.c
/// \brief  Discrete Singer model. The closed forms cancel like (dt/tau)^5, so below dt/tau = 1 their power series are summed.
///
/// With a = dt/tau and e = exp(-a), each element is a numerator N(a) over a power of a, times a power of dt:
///     N11 = 1 - e^2 + 2a - 2a^2 + 2a^3/3 - 4a e    = sum from 5 of (-a)^n/n! (4n - 2^n)       q11 = dt^4 N11/a^4
///     N12 = 1 + e^2 - 2e + 2a e - 2a + a^2         = sum from 4 of (-a)^n/n! (2^n - 2 - 2n)   q12 = dt^3 N12/a^3
///     N13 = 1 - e^2 - 2a e                         = sum from 3 of (-a)^n/n! (2n - 2^n)       q13 = dt^2 N13/a^2
///     N22 = 4e - 3 - e^2 + 2a                      = sum from 3 of (-a)^n/n! (4 - 2^n)        q22 = dt^2 N22/a^2
///     N1  = a - 1 + e                              = sum from 2 of (-a)^n/n!                  p13 = dt^2 N1/a^2
///     NU  = 1 - a + a^2/2 - e                      = - sum from 3 of (-a)^n/n!                u1  = dt^2 NU/a^2
/// q23 = dt (1 - e)^2/a and q33 = 1 - e^2 do not cancel.
/// SPDX-License-Identifier: MIT
#include "elementary_internal.h"
#include "singer_internal.h"

#define SERIES_BELOW INS_C(1.0)
#define SERIES_TERMS 28 ///< 2^28/28! = 9e-22

/// sum from n = first of (-a)^n/n! (c + l n + p 2^n), over a^power.
static ins_real series(ins_real a, unsigned first, unsigned power, ins_real c, ins_real l, ins_real p)
{
    ins_real sum = 0;
    for (unsigned n = SERIES_TERMS; n >= first; n--)
    {
        ins_real term = c + l * (ins_real)n + p * (ins_real)(1UL << n);
        for (unsigned k = 1; k <= n; k++)
        {
            term *= (k <= power ? INS_C(-1.0) : -a) / (ins_real)k;
        }
        sum += term;
    }
    return sum;
}

void ins_singer(ins_real dt, ins_real tau, ins_singer_t* out)
{
    const ins_real a = dt / tau;
    const ins_real t2 = dt * dt;
    ins_real r;  // 1 - e
    ins_real rr; // 1 - e^2
    const ins_real e = ins_elementary_decay(a, &r);
    const ins_real ee = ins_elementary_decay(2 * a, &rr);
    ins_real n11, n12, n13, n22, n1, nu; // over their powers of a
    if (a < SERIES_BELOW)
    {
        n11 = series(a, 5, 4, 0, 4, -1);
        n12 = series(a, 4, 3, -2, -2, 1);
        n13 = series(a, 3, 2, 0, 2, -1);
        n22 = series(a, 3, 2, 4, 0, -1);
        n1 = series(a, 2, 2, 1, 0, 0);
        nu = -series(a, 3, 2, 1, 0, 0);
    }
    else
    {
        const ins_real a2 = a * a;
        n11 = (1 - ee + 2 * a - 2 * a2 + 2 * a2 * a / 3 - 4 * a * e) / (a2 * a2);
        n12 = (1 + ee - 2 * e + 2 * a * e - 2 * a + a2) / (a2 * a);
        n13 = (1 - ee - 2 * a * e) / a2;
        n22 = (4 * e - 3 - ee + 2 * a) / a2;
        n1 = (a - 1 + e) / a2;
        nu = (1 - a + a2 / 2 - e) / a2;
    }
    out->p12 = dt;
    out->p13 = t2 * n1;
    out->p23 = tau * r;
    out->p33 = e;
    out->q11 = t2 * t2 * n11;
    out->q12 = t2 * dt * n12;
    out->q13 = t2 * n13;
    out->q22 = t2 * n22;
    out->q23 = tau * r * r;
    out->q33 = rr;
    out->u[0] = t2 * nu;
    out->u[1] = dt * a * n1;
    out->u[2] = r;
}
