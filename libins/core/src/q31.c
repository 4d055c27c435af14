/// \file   q31.c
/// \brief  The fixed-point attitude step with q in 32 bits, two previous increments, coning-optimal. Frame: b -> n. Qn: x / 2^n.
/// SPDX-License-Identifier: MIT
#include "ins/q31.h"
#include "q31_internal.h"

Q31_IS(Q31_COS_1, -1, 8, 33, 33);
Q31_IS(Q31_COS_2, 1, 384, 33, 19);
Q31_IS(Q31_COS_3, -1, 46080, 33, 9);
Q31_IS(Q31_SINC_1, -1, 48, 34, 29);
Q31_IS(Q31_SINC_2, 1, 3840, 34, 20);
Q31_IS(Q31_SINC_3, -1, 645120, 34, 9);
Q31_IS(Q31_CONING, 2, 15, 33, 30);

#define HALF_RAD      (INT32_C(0x40000000) - 1) ///< largest |component| of theta and phi, Q31
#define U_MAX         (INT64_C(1) << 60)        ///< |phi| <= 0.5, in Q62
#define ONE_Q60       (INT64_C(1) << 60)
#define NORM2_TOL     (INT64_C(1) << 51) ///< 2^-9 of |q|^2, about 1e-3 of |q|
#define COMPONENT_MAX (INS_Q31_ONE + INS_Q31_ONE / 512)

static int out_of_range(const int32_t v[3])
{
    return v[0] > HALF_RAD || v[0] < -HALF_RAD || v[1] > HALF_RAD || v[1] < -HALF_RAD || v[2] > HALF_RAD ||
           v[2] < -HALF_RAD;
}

/// out = the coning term, Q31 [rad].
static void coning(int32_t prev[2][3], const int32_t theta[3], int32_t out[3])
{
    int32_t w[3]; // (7 theta_1 - theta_2) / 8; the bits that the shifts drop weigh |theta| 2^-31
    for (int i = 0; i < 3; i++)
    {
        w[i] = prev[0][i] - (prev[0][i] >> 3) - (prev[1][i] >> 3);
    }
    out[0] = q31_high(q31_mac(q31_mac(0, w[1], theta[2]), -w[2], theta[1]));
    out[1] = q31_high(q31_mac(q31_mac(0, w[2], theta[0]), -w[0], theta[2]));
    out[2] = q31_high(q31_mac(q31_mac(0, w[0], theta[1]), -w[1], theta[0]));
    for (int i = 0; i < 3; i++)
    {
        out[i] = q31_high(q31_mac(0, out[i], Q31_CONING));
    }
}

int ins_q31_turn(int32_t prev[2][3], const int32_t theta[3], int32_t d[4])
{
    if (out_of_range(theta))
    {
        return 0;
    }
    int32_t phi[3];
    coning(prev, theta, phi);
    for (int i = 0; i < 3; i++)
    {
        phi[i] += theta[i];
    }
    if (out_of_range(phi))
    {
        return 0;
    }
    const int64_t u62 = q31_mac(q31_mac(q31_mac(0, phi[0], phi[0]), phi[1], phi[1]), phi[2], phi[2]);
    if (u62 > U_MAX)
    {
        return 0;
    }
    const int32_t u = (int32_t)((u62 + (INT64_C(1) << 29)) >> 30); // Q32
    const int32_t c = Q31_COS_1 + q31_high(q31_mac(0, u, Q31_COS_2 + q31_high(q31_mac(0, u, Q31_COS_3))));
    const int32_t s = Q31_SINC_1 + q31_high(q31_mac(0, u, Q31_SINC_2 + q31_high(q31_mac(0, u, Q31_SINC_3))));
    const int32_t s_u = q31_high(q31_mac(0, u, s)); // sinc - 1/2, Q34
    d[0] = q31_high(q31_mac(0, u, c));
    for (int i = 0; i < 3; i++)
    {
        d[i + 1] = 2 * phi[i] + q31_high(q31_mac(0, s_u, phi[i]));
    }
    return 1;
}

static int64_t norm2_q60(const int32_t q[4])
{
    return q31_mac(q31_mac(q31_mac(q31_mac(0, q[0], q[0]), q[1], q[1]), q[2], q[2]), q[3], q[3]);
}

void ins_q31_change(const int32_t q[4], const int32_t d[4], int64_t out[4])
{
    const int32_t w = d[0] + (int32_t)((ONE_Q60 - norm2_q60(q)) >> 28);
    const int32_t x = d[1];
    const int32_t y = d[2];
    const int32_t z = d[3];
    out[0] = q31_mac(q31_mac(q31_mac(q31_mac(0, q[0], w), q[1], -x), q[2], -y), q[3], -z);
    out[1] = q31_mac(q31_mac(q31_mac(q31_mac(0, q[0], x), q[1], w), q[2], z), q[3], -y);
    out[2] = q31_mac(q31_mac(q31_mac(q31_mac(0, q[0], y), q[1], -z), q[2], w), q[3], x);
    out[3] = q31_mac(q31_mac(q31_mac(q31_mac(0, q[0], z), q[1], y), q[2], -x), q[3], w);
}

ins_status_t ins_q31_remember(int32_t prev[2][3], uint_least8_t* count, const int32_t theta[3])
{
    for (int i = 0; i < 3; i++)
    {
        // With one increment known, an earlier one of twice its size makes 7/60, -1/60 the 1/12 of the one-previous form.
        prev[1][i] = *count == 0 ? 2 * theta[i] : prev[0][i];
        prev[0][i] = theta[i];
    }
    if (*count == 2)
    {
        return INS_OK;
    }
    (*count)++;
    return INS_S_START;
}

ins_status_t ins_q31_step(ins_q31_t* self, const int32_t dtheta_b[3])
{
    int32_t d[4];
    if (!ins_q31_turn(self->prev, dtheta_b, d))
    {
        return INS_E_RANGE;
    }
    int64_t by[4];
    ins_q31_change(self->q_nb, d, by);
    for (int i = 0; i < 4; i++)
    {
        self->q_nb[i] += (int32_t)((by[i] + (INT64_C(1) << 32)) >> 33);
    }
    return ins_q31_remember(self->prev, &self->count, dtheta_b);
}

int ins_q31_is_unit(const int32_t q[4])
{
    for (int i = 0; i < 4; i++)
    {
        if (q[i] > COMPONENT_MAX || q[i] < -COMPONENT_MAX) // the sum of four squares could leave 64 bits
        {
            return 0;
        }
    }
    const int64_t off = norm2_q60(q) - ONE_Q60;
    return off <= NORM2_TOL && off >= -NORM2_TOL;
}

ins_status_t ins_q31_init(ins_q31_t* self, const int32_t q_nb[4])
{
    if (!ins_q31_is_unit(q_nb))
    {
        return INS_E_RANGE;
    }
    static const int32_t still[3] = {0, 0, 0};
    const ins_q31_t start = {{q_nb[0], q_nb[1], q_nb[2], q_nb[3]}, {{0}}, 0};
    *self = start;
    (void)ins_q31_step(self, still); // the norm's error becomes 3/8 of its square each time: 1e-6, 1e-12
    (void)ins_q31_step(self, still);
    self->count = 0;
    return INS_OK;
}
