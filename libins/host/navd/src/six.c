/// \file   six.c
/// \brief  Numbered samples of six accelerometers -> attitude, velocity, position. Frame: b -> n. SI, rad. Source: ins/gyro_free.h.
/// SPDX-License-Identifier: MIT
#include "ins_nav/six.h"
#include "ins/earth.h"
#include "ins/kalman.h"
#include "ins/quat.h"
#include "json_writer.h"
#include <inttypes.h>
#include <math.h>
#include <string.h>

#define AGE_MAX_S 1.0

static ins_position_t position_of(const double llh[3])
{
    const ins_position_t position = {{llh[0], llh[1], llh[2]}, {0.0, 0.0, 0.0}};
    return position;
}

ins_status_t ins_nav_six_init(ins_nav_six_t* self, const ins_nav_six_config_t* cfg)
{
    const ins_nav_config_t* link = &cfg->link;
    const ins_position_t start = position_of(cfg->lat_lon_height);
    memset(self, 0, sizeof *self);
    if (ins_nav_config_problem(link) != NULL || link->channels != INS_NAV_CHANNELS || !(cfg->lsb_m_s2 > 0.0) ||
        !(cfg->still_s >= 0.0) || (cfg->still_s > 0.0 && !(cfg->still_m_s > 0.0 && cfg->still_rad_s > 0.0)))
    {
        return INS_E_RANGE;
    }
    for (int i = 0; i < 2; i++)
    {
        if (ins_skew_init(&self->skew[i], link->skew_order, link->delay_s + 3 * i, link->period_s) != INS_OK)
        {
            return INS_E_RANGE;
        }
    }
    self->cfg = *cfg;
    return ins_gyro_free_init(&self->filter, &cfg->filter, INS_NAV_CHANNELS, cfg->accels, link->period_s, link->q_nb,
                              cfg->v_n, &start);
}

/// One sample, and that it stands still if it does.
static void step(ins_nav_six_t* self, const double readings[6], uint64_t index)
{
    (void)ins_gyro_free_step(&self->filter, readings); // finite; a pole is far
    if ((double)index * self->cfg.link.period_s < self->cfg.still_s)
    {
        (void)ins_gyro_free_still(&self->filter, self->cfg.still_m_s, self->cfg.still_rad_s);
    }
}

/// Readings at the scan's instant. \return INS_OK; INS_S_START.
static ins_status_t resolve(ins_nav_six_t* self, const ins_nav_sample_t* sample, uint64_t lost, double readings[6])
{
    ins_status_t status = INS_OK;
    for (int i = 0; i < 6; i++)
    {
        readings[i] = ((double)sample->code[i] - self->cfg.null_code) * self->cfg.lsb_m_s2;
    }
    for (int i = 0; i < 2; i++)
    {
        if (lost > 0)
        {
            ins_skew_restart(&self->skew[i]);
        }
        const ins_status_t each = ins_skew_add(&self->skew[i], readings + 3 * i, readings + 3 * i);
        status = each == INS_OK ? status : each;
    }
    return status;
}

static void fill(const ins_nav_six_t* self, const ins_nav_sample_t* sample, ins_nav_six_state_t* state)
{
    const ins_strapdown_t* s = &self->filter.strapdown;
    state->nav.index = sample->index;
    state->nav.t_s = (double)sample->index * self->cfg.link.period_s;
    memcpy(state->nav.q_nb, s->sculling.q_nb, sizeof state->nav.q_nb);
    ins_quat_to_euler(state->nav.q_nb, state->nav.euler_rad);
    memcpy(state->nav.w_ib_b, self->filter.sixacc.w_ib_b, sizeof state->nav.w_ib_b);
    state->nav.seq = sample->seq;
    state->nav.used = self->used;
    state->nav.missed = self->missed;
    state->nav.counts = sample->counts;
    for (int i = 0; i < 3; i++)
    {
        state->v_n[i] = s->v_n[i];
        state->lat_lon_height[i] = s->position.anchor[i] + s->position.offset[i];
    }
    ins_gyro_free_sigma(&self->filter, state->sigma);
    state->fixes = self->fixes;
    state->refused = self->filter.refused;
}

ins_status_t ins_nav_six_step(ins_nav_six_t* self, const ins_nav_sample_t* sample, ins_nav_six_state_t* state)
{
    const int first = self->used == 0;
    double readings[6];
    if (!first && sample->index <= self->index)
    {
        return INS_E_RANGE;
    }
    memset(state, 0, sizeof *state);
    for (int i = 0; i < 6; i++)
    {
        if (sample->code[i] > self->cfg.link.code_max)
        {
            return INS_E_RANGE;
        }
        state->nav.status |= sample->code[i] == 0 || sample->code[i] == self->cfg.link.code_max ? INS_NAV_CLIPPED : 0u;
    }
    const uint64_t lost = first ? 0u : sample->index - self->index - 1u;
    const int start = resolve(self, sample, lost, readings) == INS_S_START;
    for (uint64_t k = 1; k <= lost; k++)
    {
        const double part = (double)k / (double)(lost + 1u);
        double between[6];
        for (int i = 0; i < 6; i++)
        {
            between[i] = self->last[i] + part * (readings[i] - self->last[i]);
        }
        step(self, between, self->index + k);
    }
    step(self, readings, sample->index);
    memcpy(self->last, readings, sizeof readings);
    self->missed += lost;
    self->sticky |= lost > self->cfg.link.bridge_max ? (uint32_t)INS_NAV_LONG_GAP : 0u;
    self->sticky |= sample->disagree ? (uint32_t)INS_NAV_DISAGREE : 0u;
    self->used++;
    self->index = sample->index;
    state->nav.status |=
        self->sticky | (start || first ? (uint32_t)INS_NAV_START : 0u) | (lost > 0 ? (uint32_t)INS_NAV_BRIDGED : 0u);
    state->nav.bridged = lost < UINT32_MAX ? (uint32_t)lost : UINT32_MAX;
    fill(self, sample, state);
    return INS_OK;
}

ins_status_t ins_nav_six_fix(ins_nav_six_t* self, const double lat_lon_height[3], double age_s, const double sigma[3])
{
    static const double at_imu[3];
    const double* const v = self->filter.strapdown.v_n;
    ins_position_t fix = position_of(lat_lon_height);
    double radii[2];
    if (self->used == 0)
    {
        return INS_E_STATE;
    }
    if (!(fabs(age_s) <= AGE_MAX_S))
    {
        return INS_E_RANGE;
    }
    ins_earth_radii(sin(lat_lon_height[0]), radii);
    fix.offset[0] = v[0] * age_s / (radii[0] + lat_lon_height[2]);
    fix.offset[1] = v[1] * age_s / ((radii[1] + lat_lon_height[2]) * cos(lat_lon_height[0]));
    fix.offset[2] = -v[2] * age_s;
    const ins_status_t status = ins_gyro_free_position(&self->filter, &fix, sigma, at_imu);
    self->fixes += status == INS_OK ? 1u : 0u;
    return status;
}

void ins_nav_six_navigation(const ins_nav_six_t* self, const ins_nav_six_state_t* state, int64_t time_ns,
                            ins_navigation_t* out)
{
    double full[INS_GYRO_FREE_N * INS_GYRO_FREE_N];
    ins_navigation_from_state(&state->nav, time_ns, out);
    out->valid |= INS_NAVIGATION_VELOCITY | INS_NAVIGATION_VELOCITY_UP | INS_NAVIGATION_POSITION |
                  INS_NAVIGATION_HEIGHT | INS_NAVIGATION_COVARIANCE;
    memcpy(out->v_n, state->v_n, sizeof out->v_n);
    memcpy(out->llh, state->lat_lon_height, sizeof out->llh);
    ins_ud_covariance(INS_GYRO_FREE_N, self->filter.UD, full);
    for (int i = 0; i < INS_NAVIGATION_P; i++)
    {
        memcpy(out->P + INS_NAVIGATION_P * i, full + INS_GYRO_FREE_N * i, INS_NAVIGATION_P * sizeof *full);
    }
}

size_t ins_nav_six_json(const ins_nav_six_state_t* state, char* buffer, size_t size)
{
    json_writer_t w = {buffer, size};
    json_put(&w, "{");
    json_state(&w, &state->nav);
    json_reals(&w, "v_n", state->v_n, 3);
    json_reals(&w, "lat_lon_height", state->lat_lon_height, 3);
    json_reals(&w, "sigma", state->sigma, INS_GYRO_FREE_N);
    json_put(&w, ",\"fixes\":%" PRIu64 ",\"refused\":%" PRIu64, state->fixes, state->refused);
    return json_end(&w, buffer);
}
