/// \file   coning.c
/// \brief  The coning family: coefficients and rotation vector. Frame: b. Unit: rad. Derivation and drift: docs/coning.md.
/// SPDX-License-Identifier: MIT
#include "coning_internal.h"

/// Two previous, K1 + 2 K2 = 1/12, the given -K2 of least peak drift over a band (tools/band.py).
#define SHAPED(minus_k2)                                                                                               \
    {                                                                                                                  \
        3, 0,                                                                                                          \
        {                                                                                                              \
            R(1, 12) + 2 * INS_C(minus_k2), -INS_C(minus_k2)                                                           \
        }                                                                                                              \
    }

const ins_coning_row_t ins_coning_rows[INS_CONING_FORM_COUNT] = {
    [INS_CONING_ONE] = {1, 0, {0}},
    [INS_CONING_HIST1] = {2, 0, {R(1, 12)}},
    [INS_CONING_HIST2_FIT] = {3, 0, {R(121, 720), R(-31, 720), 0, R(1, 720)}},
    [INS_CONING_HIST2_OPT] = CONING_ROW_HIST2_OPT,
    [INS_CONING_HIST3_FIT] = {4, 0, {R(473, 1890), R(-1919, 15120), R(53, 1890), R(2, 315), R(-29, 15120), R(1, 3780)}},
    [INS_CONING_HIST3_OPT] = {4, 0, {R(113, 840), R(-13, 420), R(1, 280)}},
    [INS_CONING_BLOCK2] = {2, 1, {R(2, 3)}},
    [INS_CONING_BLOCK3_FIT] = {3, 1, {R(57, 80), R(33, 80), 0, R(57, 80)}},
    [INS_CONING_BLOCK3_OPT] = {3, 1, {R(27, 40), R(9, 20), 0, R(27, 40)}},
    [INS_CONING_BLOCK4_FIT] = {4, 1, {R(736, 945), R(334, 945), R(526, 945), R(654, 945), R(334, 945), R(736, 945)}},
    [INS_CONING_BLOCK4_OPT] = {4, 1, {R(214, 105), R(92, 105), R(54, 105)}},
    [INS_CONING_HIST2_MU03] = SHAPED(0.0169571190),
    [INS_CONING_HIST2_MU06] = SHAPED(0.0178664520),
    [INS_CONING_HIST2_MU10] = SHAPED(0.0202721873),
};

int ins_coning_samples(int form)
{
    return form >= 0 && form < INS_CONING_FORM_COUNT ? ins_coning_rows[form].samples : 0;
}

int ins_coning_is_block(int form)
{
    return ins_coning_samples(form) > 0 && ins_coning_rows[form].block;
}

ins_status_t ins_coning_phi(int form, const ins_real* theta_b, ins_real phi_b[3])
{
    const int n = ins_coning_samples(form);
    if (n == 0)
    {
        return INS_E_RANGE;
    }
    const ins_coning_row_t* row = &ins_coning_rows[form];
    const ins_real* t[INS_CONING_SAMPLES_MAX] = {theta_b, theta_b, theta_b, theta_b};
    for (int i = 0; i < n; i++)
    {
        t[i] = theta_b + 3 * (n - 1 - i);
    }
    ins_real phi[3];
    ins_vec_copy(t[0], phi);
    for (int i = 1; row->block && i < n; i++)
    {
        ins_vec_add_scaled(phi, 1, t[i]);
    }
    coning_add(row, t[0], t[1], t[2], t[3], phi);
    ins_vec_copy(phi, phi_b);
    return INS_OK;
}
