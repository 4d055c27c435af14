/// \file   solver.c
/// \brief  Numbered samples -> attitude: codes to rates, channels to one instant, rates to increments, increments to quaternion.
/// Frame: b -> n. Units: rad/s, rad. Sources: ins/rates.h, ins/attitude.h.
/// SPDX-License-Identifier: MIT
#include "ins/quat.h"
#include "ins_nav/nav.h"
#include <math.h>
#include <string.h>

/// Largest component of one jump [rad]: |phi| stays below INS_ROTVEC_MAX. A longer gap takes several equal ones, which about one axis
/// is the same rotation.
#define JUMP_MAX (INS_ROTVEC_MAX / 2.0)

ins_status_t ins_nav_solver_init(ins_nav_solver_t* self, const ins_nav_config_t* cfg)
{
    if (ins_nav_config_problem(cfg) != NULL)
    {
        return INS_E_RANGE;
    }
    memset(self, 0, sizeof *self);
    self->cfg = *cfg;
    for (int i = 0; i < 3; i++)
    {
        self->skewed = (uint8_t)(self->skewed || cfg->delay_s[i] > 0.0);
    }
    (void)ins_attitude_init(&self->attitude, cfg->form, cfg->q_nb); // ins_nav_config_problem() has tried these
    (void)ins_rates_init(&self->rates, cfg->rate_order, cfg->period_s);
    (void)ins_skew_init(&self->skew, cfg->skew_order, cfg->delay_s, cfg->period_s);
    return INS_OK;
}

/// \return INS_OK; INS_S_START.
static ins_status_t bridge(ins_nav_solver_t* self, uint64_t lost, const double w_ib_b[3], double dtheta_b[3])
{
    const uint32_t missing = lost < UINT32_MAX - 1u ? (uint32_t)lost : UINT32_MAX - 1u;
    const ins_status_t status = ins_rates_bridge(&self->rates, missing, w_ib_b, dtheta_b);
    double longest = 0.0;
    for (int i = 0; i < 3; i++)
    {
        longest = fmax(longest, fabs(dtheta_b[i]));
    }
    const double jumps = floor(longest / JUMP_MAX) + 1.0;
    const double phi[3] = {dtheta_b[0] / jumps, dtheta_b[1] / jumps, dtheta_b[2] / jumps};
    for (double n = 0.0; n < jumps; n += 1.0)
    {
        (void)ins_attitude_jump(&self->attitude, phi);
    }
    self->missed += lost;
    if (lost > self->cfg.bridge_max)
    {
        self->sticky |= INS_NAV_LONG_GAP;
    }
    return status;
}

ins_status_t ins_nav_solver_step(ins_nav_solver_t* self, const ins_nav_sample_t* sample, ins_nav_state_t* state)
{
    const int first = self->used == 0;
    if (!first && sample->index <= self->index)
    {
        return INS_E_RANGE;
    }
    for (int i = 0; i < 3; i++)
    {
        if (sample->code[i] > self->cfg.code_max)
        {
            return INS_E_RANGE;
        }
    }
    memset(state, 0, sizeof *state);
    for (int i = 0; i < 3; i++)
    {
        state->w_ib_b[i] = ((double)sample->code[i] - self->cfg.null_code[i]) * self->cfg.lsb_rad_s[i];
        if (sample->code[i] == 0 || sample->code[i] == self->cfg.code_max)
        {
            state->status |= INS_NAV_CLIPPED;
        }
    }
    const uint64_t lost = first ? 0u : sample->index - self->index - 1u;
    int start = 0;
    if (self->skewed)
    {
        if (lost > 0)
        {
            ins_skew_restart(&self->skew);
        }
        start = ins_skew_add(&self->skew, state->w_ib_b, state->w_ib_b) == INS_S_START;
    }
    if (lost > 0)
    {
        start |= bridge(self, lost, state->w_ib_b, state->dtheta_b) == INS_S_START;
        state->status |= INS_NAV_BRIDGED;
    }
    else
    {
        start |= ins_rates_add(&self->rates, state->w_ib_b, state->dtheta_b) == INS_S_START;
        if (!first)
        {
            start |= ins_attitude_step(&self->attitude, state->dtheta_b) == INS_S_START;
        }
    }
    if (sample->disagree)
    {
        self->sticky |= INS_NAV_DISAGREE;
    }
    self->used++;
    self->index = sample->index;
    state->status |= self->sticky | (start || first ? (uint32_t)INS_NAV_START : 0u);
    state->index = sample->index;
    state->t_s = (double)sample->index * self->cfg.period_s;
    memcpy(state->q_nb, self->attitude.q_nb, sizeof state->q_nb);
    ins_quat_to_euler(state->q_nb, state->euler_rad);
    state->seq = sample->seq;
    state->bridged = lost < UINT32_MAX ? (uint32_t)lost : UINT32_MAX;
    state->used = self->used;
    state->missed = self->missed;
    state->counts = sample->counts;
    return INS_OK;
}

ins_status_t ins_nav_init(ins_nav_t* self, const ins_nav_config_t* cfg)
{
    const ins_status_t status = ins_nav_link_init(&self->link, cfg);
    return status == INS_OK ? ins_nav_solver_init(&self->solver, cfg) : status;
}

int ins_nav_octet(ins_nav_t* self, ins_octet_t octet, uint64_t now_ms, int* reply, ins_nav_state_t* state)
{
    ins_nav_sample_t sample;
    if (ins_nav_link_octet(&self->link, octet, now_ms, reply, &sample) != 1)
    {
        return 0;
    }
    return ins_nav_solver_step(&self->solver, &sample, state) == INS_OK;
}

void ins_nav_tick(ins_nav_t* self, uint64_t now_ms)
{
    ins_nav_link_tick(&self->link, now_ms);
}

ins_status_t ins_nav_codes(ins_nav_t* self, const uint16_t code[3], uint32_t lost, ins_nav_state_t* state)
{
    ins_nav_sample_t sample = {0};
    sample.index = self->solver.used > 0 ? self->solver.index + 1u + lost : 0u;
    memcpy(sample.code, code, 3 * sizeof *code);
    sample.counts.accepted = self->solver.used + 1u;
    sample.counts.lost = self->solver.used > 0 ? self->solver.missed + lost : 0u;
    return ins_nav_solver_step(&self->solver, &sample, state);
}
