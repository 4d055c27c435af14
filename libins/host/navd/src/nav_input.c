/// \file   nav_input.c
/// \brief  Octets of the handshake -> what a navigating board says. Units: SI. Source: ins/nav_block.h.
/// SPDX-License-Identifier: MIT
#include "ins_nav/nav_input.h"
#include "ins/quat.h"
#include <string.h>

void ins_nav_input_config_default(ins_nav_input_config_t* cfg)
{
    memset(cfg, 0, sizeof *cfg);
    cfg->retries = 3;
    cfg->octet_timeout_ms = 30;
}

ins_status_t ins_nav_input_init(ins_nav_input_t* self, const ins_nav_input_config_t* cfg)
{
    ins_hs_config_t hs = {0};
    hs.block_len = INS_NAV_BLOCK_LEN;
    hs.seq = 1;
    hs.retries = cfg->retries;
    hs.octet_timeout = cfg->octet_timeout_ms;
    if (cfg->octet_timeout_ms < 1 || cfg->octet_timeout_ms > INT16_MAX)
    {
        return INS_E_RANGE;
    }
    memset(self, 0, sizeof *self);
    (void)ins_tm_init_twd97(&self->zone[0], 121);
    (void)ins_tm_init_twd97(&self->zone[1], 119);
    return ins_hs_host_init(&self->hs, &hs);
}

static void copy_counts(ins_nav_input_t* self)
{
    self->counts.duplicates = self->hs.duplicates;
    self->counts.corrupt = self->hs.corrupt;
    self->counts.timeouts = self->hs.timeouts;
    self->counts.stray = self->hs.stray;
}

/// The board's clock goes on. \return 1: it went back.
static int restarted(ins_nav_input_t* self, uint32_t time_ms)
{
    const int back = self->started && time_ms - self->last_ms > INT32_MAX;
    if (back)
    {
        self->rounds_ms = 0;
    }
    else if (time_ms < self->last_ms)
    {
        self->rounds_ms += (uint64_t)1 << 32;
    }
    self->last_ms = time_ms;
    return back;
}

static void fill(const ins_nav_input_t* self, const ins_nav_block_t* nav, ins_nav_solution_t* s)
{
    memset(s, 0, sizeof *s);
    s->index = self->index;
    s->t_s = (double)(self->rounds_ms + nav->time_ms) * 1e-3;
    memcpy(s->q_nb, nav->q_nb, sizeof s->q_nb);
    ins_quat_to_euler(s->q_nb, s->euler_rad);
    s->fix_age_s = nav->fix_age * 0.1;
    s->sats = nav->sats;
    s->seq = self->hs.seq;
    s->status = nav->status;
    if ((nav->status & INS_NAV_BLOCK_POSITION) != 0)
    {
        const int penghu = (nav->status & INS_NAV_BLOCK_ZONE_119) != 0;
        s->zone = penghu ? 119 : 121;
        for (int i = 0; i < 2; i++)
        {
            s->en_m[i] = nav->en_cm[i] * 0.01;
            s->v_en_m_s[i] = nav->v_en[i];
        }
        (void)ins_tm_inverse(&self->zone[penghu], s->en_m, s->lat_lon_rad); // far from the zone: stays 0
    }
}

int ins_nav_input_octet(ins_nav_input_t* self, ins_octet_t octet, uint64_t now_ms, int* reply,
                        ins_nav_solution_t* solution)
{
    int16_t answer = -1;
    const int event = ins_hs_host_rx(&self->hs, octet, (uint16_t)(now_ms & 0xFFFFu), &answer);
    *reply = answer;
    copy_counts(self);
    ins_nav_block_t nav;
    if (event != INS_HS_BLOCK)
    {
        return 0;
    }
    if (ins_nav_block_get(self->hs.block, &nav) != INS_OK)
    {
        self->counts.invalid++;
        self->counts.lost += self->started;
        self->index += self->started;
        return 0;
    }
    const int back = restarted(self, nav.time_ms);
    const uint32_t lost = self->started && !back ? self->hs.gap : 0u;
    self->index += self->started ? lost + 1u : 0u;
    self->started = 1;
    self->counts.accepted++;
    self->counts.lost += lost;
    fill(self, &nav, solution);
    solution->lost = lost;
    solution->status |= back ? INS_NAV_RESTARTED : 0u;
    solution->counts = self->counts;
    return 1;
}

void ins_nav_input_tick(ins_nav_input_t* self, uint64_t now_ms)
{
    ins_hs_host_tick(&self->hs, (uint16_t)(now_ms & 0xFFFFu));
    copy_counts(self);
}
