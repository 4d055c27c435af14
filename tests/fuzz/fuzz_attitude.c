/// \file   fuzz_attitude.c
/// \brief  libFuzzer: the steps that take numbers from outside, with any bit patterns, NaN and infinity among them.
///
/// A refusal leaves the state as it was, to the bit; what was taken leaves a norm near 1. Where the lean form takes
/// an increment it gives the general one's attitude, to the bit.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#define NORM2_TOL 1e-2
#define FORMS     16 ///< some of them are none

int LLVMFuzzerTestOneInput(const unsigned char* data, size_t size);

static void demand(int condition)
{
    if (!condition)
    {
        abort();
    }
}

/// The next `octets` of the input, of any bits. \return 0 at its end.
static int take(const unsigned char** data, size_t* size, void* out, size_t octets)
{
    if (*size < octets)
    {
        return 0;
    }
    memcpy(out, *data, octets);
    *data += octets;
    *size -= octets;
    return 1;
}

static int is_unit(const ins_real q[4])
{
    const double n2 = (double)(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    return n2 > 1 - NORM2_TOL && n2 < 1 + NORM2_TOL;
}

static int equal(const ins_real p[4], const ins_real q[4])
{
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2] && p[3] == q[3];
}

int LLVMFuzzerTestOneInput(const unsigned char* data, size_t size)
{
    static const ins_real level[4] = {1, 0, 0, 0};
    static const int32_t unit[4] = {INS_Q31_ONE, 0, 0, 0};
    unsigned char form;
    ins_real start[4];
    int32_t fixed[4];
    ins_attitude_t a;
    ins_attitude_t same;
    ins_hist2_t lean;
    ins_sculling_t s;
    ins_q31_t q;
    if (!take(&data, &size, &form, 1) || !take(&data, &size, start, sizeof start) ||
        !take(&data, &size, fixed, sizeof fixed))
    {
        return 0;
    }
    memset(&a, 0, sizeof a); // padding too: states are compared as they lie in memory
    memset(&lean, 0, sizeof lean);
    memset(&s, 0, sizeof s);
    memset(&q, 0, sizeof q);
    demand(ins_attitude_init(&a, form % FORMS, start) == INS_OK ||
           ins_attitude_init(&a, INS_CONING_HIST2_OPT, level) == INS_OK);
    demand(ins_sculling_init(&s, form % FORMS, start) == INS_OK ||
           ins_sculling_init(&s, INS_CONING_HIST3_OPT, level) == INS_OK);
    demand(ins_hist2_init(&lean, start) == INS_OK || ins_hist2_init(&lean, level) == INS_OK);
    demand(ins_attitude_init(&same, INS_CONING_HIST2_OPT, lean.q_nb) == INS_OK);
    memcpy(same.q_nb, lean.q_nb, sizeof same.q_nb); // init normalises again
    demand(ins_q31_init(&q, fixed) == INS_OK || ins_q31_init(&q, unit) == INS_OK);
    ins_increment_t x;
    int32_t theta[3];
    ins_real dv[3];
    while (take(&data, &size, &x, sizeof x) && take(&data, &size, theta, sizeof theta))
    {
        ins_attitude_t a_before;
        ins_hist2_t lean_before;
        ins_sculling_t s_before;
        ins_q31_t q_before;
        memcpy(&a_before, &a, sizeof a);
        memcpy(&lean_before, &lean, sizeof lean);
        memcpy(&s_before, &s, sizeof s);
        memcpy(&q_before, &q, sizeof q);
        demand(ins_attitude_step(&a, x.theta_b) >= INS_OK || memcmp(&a, &a_before, sizeof a) == 0);
        const int taken = ins_hist2_step(&lean, x.theta_b) >= INS_OK;
        demand(taken ? ins_attitude_step(&same, x.theta_b) >= INS_OK && equal(lean.q_nb, same.q_nb)
                     : memcmp(&lean, &lean_before, sizeof lean) == 0);
        demand(ins_sculling_step(&s, &x, dv) >= INS_OK || memcmp(&s, &s_before, sizeof s) == 0);
        demand(ins_q31_step(&q, theta) >= INS_OK || memcmp(&q, &q_before, sizeof q) == 0);
        demand(is_unit(a.q_nb) && is_unit(lean.q_nb) && is_unit(s.q_nb));
    }
    return 0;
}
