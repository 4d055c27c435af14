/// \file   hist2.c
/// \brief  The attitude step with two previous increments, coning-optimal, its vectors and products as loops. b -> n, rad.
///
/// Sums are taken in the order of attitude_internal.h and quat_internal.h, so the results are the same bits.
/// SPDX-License-Identifier: MIT
#include "ins/hist2.h"
#include "ins/ins_math.h"
#include "ins/vec.h"
#include "rotvec_internal.h"

#define NORM2_TOL INS_C(2e-3)
#define SCALINGS  3 ///< of q at the start: its norm's error becomes 3/2 of its square each time, 2e-6, 4e-12, 0

static ins_real norm2(const ins_real* v, int n)
{
    ins_real sum = v[0] * v[0];
    for (int i = 1; i < n; i++)
    {
        sum += v[i] * v[i];
    }
    return sum;
}

/// phi = theta + w x theta, w = 7/60 theta_1 - 1/60 theta_2. With one previous increment known w = 1/12 theta_1; theta_2 is 0.
static void phi_of_increment(const ins_hist2_t* self, const ins_real theta[3], ins_real phi[3])
{
    const ins_real newest = self->count == 1 ? INS_C(1.0) / 12 : INS_C(7.0) / 60;
    ins_real w[3];
    for (int i = 0; i < 3; i++)
    {
        w[i] = newest * self->prev[0][i] + INS_C(-1.0) / 60 * self->prev[1][i];
    }
    ins_vec_cross(w, theta, phi);
    for (int i = 0; i < 3; i++)
    {
        phi[i] += theta[i];
    }
}

/// q := q d, in every component the terms of a small rotation before that of its scalar d[0].
static void turn(ins_real q[4], const ins_real d[4])
{
    // What d[0] .. d[3] meet in each row of the product: w, x, y, z of q are 0 .. 3, -x, -y, -z are 4 .. 6.
    static const uint_least8_t row[4][4] = {{0, 4, 5, 6}, {1, 0, 6, 2}, {2, 3, 0, 4}, {3, 5, 1, 0}};
    const ins_real p[7] = {q[0], q[1], q[2], q[3], -q[1], -q[2], -q[3]};
    for (int i = 0; i < 4; i++)
    {
        const uint_least8_t* at = row[i];
        q[i] = p[at[0]] * d[0] + (p[at[1]] * d[1] + p[at[2]] * d[2] + p[at[3]] * d[3]);
    }
}

ins_status_t ins_hist2_step(ins_hist2_t* self, const ins_real dtheta_b[3])
{
    ins_real d[4];
    ins_real* phi = d + 1;
    phi_of_increment(self, dtheta_b, phi);
    const ins_real u = norm2(phi, 3);
    if (!(u <= HALF_U_MAX)) // |phi| >= |dtheta_b|: what is added is normal to it
    {
        return INS_E_RANGE;
    }
    const ins_real s = half_sinc(u);
    d[0] = half_cos_and_half(u) - INS_C(0.5) * norm2(self->q_nb, 4); // as attitude_internal.h
    for (int i = 0; i < 3; i++)
    {
        phi[i] *= s;
        self->prev[1][i] = self->prev[0][i];
        self->prev[0][i] = dtheta_b[i];
    }
    turn(self->q_nb, d);
    if (self->count == 2)
    {
        return INS_OK;
    }
    self->count++;
    return INS_S_START;
}

ins_status_t ins_hist2_init(ins_hist2_t* self, const ins_real q_nb[4])
{
    ins_real off = norm2(q_nb, 4) - 1;
    if (!(ins_fabs(off) <= NORM2_TOL))
    {
        return INS_E_RANGE;
    }
    for (int i = 0; i < 4; i++)
    {
        self->q_nb[i] = q_nb[i];
    }
    for (int i = 0; i < 3; i++)
    {
        self->prev[0][i] = 0;
        self->prev[1][i] = 0;
    }
    self->count = 0;
    for (int n = 0; n < SCALINGS; n++)
    {
        off = norm2(self->q_nb, 4) - 1;
        for (int i = 0; i < 4; i++)
        {
            self->q_nb[i] -= INS_C(0.5) * off * self->q_nb[i];
        }
    }
    return INS_OK;
}
