/// \file   load.c
/// \brief  A load for tools/insncount.c: attitude steps on a target, with no component of an increment zero (soft float is quick there).
///
/// LOAD_ATTITUDE, LOAD_LEAN, LOAD_Q31 or LOAD_Q31W names the step. All data is static: what a step stores on the stack is its own.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#ifdef __AVR__
#include "load_avr.h"
#else
#define MEASURED(call) (call)
#define END(code)      (code)
#endif

#define SAMPLES 16
#define STEPS   80 // the first 16 are start-up

#if defined(LOAD_ATTITUDE) || defined(LOAD_LEAN)
typedef ins_real number_t;
#define ONE    INS_C(1.0)
#define RAD(x) INS_C(x)
#ifdef LOAD_LEAN
typedef ins_hist2_t state_t;
#define INIT ins_hist2_init
#define STEP ins_hist2_step
#else
typedef ins_attitude_t state_t;
#define INIT(state, q)      ins_attitude_init(state, INS_CONING_HIST2_OPT, q)
#define STEP(state, dtheta) ins_attitude_step(state, dtheta)
#endif
#else
typedef int32_t number_t;
#define ONE    INS_Q31_ONE
#define RAD(x) (int32_t)((x)*2147483648.0)
#ifdef LOAD_Q31
typedef ins_q31_t state_t;
#define INIT ins_q31_init
#define STEP ins_q31_step
#else
typedef ins_q31w_t state_t;
#define INIT ins_q31w_init
#define STEP ins_q31w_step
#endif
#endif

#define ROW(x, y, z)                                                                                                   \
    {                                                                                                                  \
        RAD(x), RAD(y), RAD(z)                                                                                         \
    }
static const number_t increment[SAMPLES][3] = {
    ROW(-0.0183, 0.0214, 0.0071),  ROW(-0.0117, 0.0163, 0.0129),  ROW(0.0032, 0.0081, -0.0148),
    ROW(0.0121, 0.0013, 0.0066),   ROW(0.0209, -0.0092, 0.0113),  ROW(-0.0174, -0.0151, -0.0127),
    ROW(-0.0085, -0.0229, 0.0048), ROW(0.0027, 0.0237, 0.0137),   ROW(0.0136, 0.0142, -0.0109),
    ROW(0.0194, 0.0077, 0.0055),   ROW(-0.0191, -0.0019, 0.0132), ROW(-0.0103, -0.0088, -0.0141),
    ROW(0.0039, -0.0167, 0.0062),  ROW(0.0098, -0.0241, 0.0125),  ROW(0.0217, 0.0228, -0.0133),
    ROW(-0.0168, 0.0155, 0.0059)};
static const number_t level[4] = {ONE, 0, 0, 0};
static state_t state;

int main(void)
{
    if (INIT(&state, level) != INS_OK)
    {
        return END(1);
    }
    for (int k = 0; k < STEPS; k++)
    {
        if (MEASURED(STEP(&state, increment[k % SAMPLES])) < INS_OK)
        {
            return END(2);
        }
    }
#ifdef LOAD_ATTITUDE
    static const number_t large[3] = {RAD(2.0), RAD(-1.0), RAD(0.5)}; // takes the longest way, and the deepest
    if (MEASURED(STEP(&state, large)) < INS_OK)
    {
        return END(3);
    }
#endif
    return END(0);
}
