/// \file   load_kf15.c
/// \brief  A load for tools/insncount.c: the covariance of 15 errors on a target, propagated or updated by six scalars.
///
/// LOAD_KF15 or LOAD_KF15_UPDATE6, LOAD_KF15_UD or LOAD_KF15_UD_UPDATE6 names it. All data is static: what a call stores on the stack is its
/// own.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"

#define STEPS   80
#define SCALARS 6

#if defined(LOAD_KF15_UD) || defined(LOAD_KF15_UD_UPDATE6)
typedef ins_kf15_ud_t filter_t;
#define INIT      ins_kf15_ud_init
#define PROPAGATE ins_kf15_ud_propagate
#define UPDATE    ins_kf15_ud_update_state
#else
typedef ins_kf15_t filter_t;
#define INIT      ins_kf15_init
#define PROPAGATE ins_kf15_propagate
#define UPDATE    ins_kf15_update_state
#endif

typedef struct state_t
{
    filter_t filter;
    ins_kf15_model_t model;
} state_t;

static state_t state;

/// Three velocities, three positions.
ins_status_t load_kf15_update6(filter_t* filter);
ins_status_t load_kf15_update6(filter_t* filter)
{
    ins_status_t status = INS_OK;
    for (unsigned i = 0; i < SCALARS; i++)
    {
        ins_innovation_t z = {INS_C(0.1), INS_C(0.01), 0, 0};
        status = UPDATE(filter, INS_KF15_V + i, &z) == INS_OK ? status : INS_E_RANGE;
    }
    return status;
}

int main(void)
{
    static const ins_kf15_sensors_t sensors = {INS_C(1e-4), INS_C(1e-3), INS_C(1e-4), 300, INS_C(1e-2), 200};
    static const ins_real v_b[3] = {INS_C(0.013), INS_C(-0.021), INS_C(-0.098)};
    static const ins_strapdown_t at = {.sculling = {.q_nb = {INS_C(0.8), INS_C(-0.2), INS_C(0.4), INS_C(0.4)}},
                                       .v_n = {30, -20, 1},
                                       .position = {{INS_C(0.4), 2, 100}, {0, 0, 0}},
                                       .sin_lat = INS_C(0.38941834),
                                       .cos_lat = INS_C(0.92106099)};
    static const ins_real sigma[INS_KF15_N] = {INS_C(0.02), INS_C(0.02), INS_C(0.02), INS_C(0.5),  INS_C(0.5),
                                               INS_C(0.5),  10,          10,          10,          INS_C(1e-4),
                                               INS_C(1e-4), INS_C(1e-4), INS_C(1e-2), INS_C(1e-2), INS_C(1e-2)};
    if (ins_kf15_model_init(&state.model, INS_C(0.01), &sensors) != INS_OK || INIT(&state.filter, sigma) != INS_OK)
    {
        return 1;
    }
    ins_kf15_model(&state.model, &at, v_b);
    for (int k = 0; k < STEPS; k++)
    {
#if defined(LOAD_KF15_UPDATE6) || defined(LOAD_KF15_UD_UPDATE6)
        if (load_kf15_update6(&state.filter) != INS_OK)
        {
            return 2;
        }
#else
        PROPAGATE(&state.filter, &state.model);
#endif
    }
    return 0;
}
