/// \file   link.c
/// \brief  Octets of the handshake -> numbered samples. Unit: code.
///
/// The 8-bit sequence number gives the number of lost samples modulo 256. The arrival time gives it within half of that: of the
/// numbers lost = gap + 256 k, the one nearest to elapsed / period - 1 is taken.
/// SPDX-License-Identifier: MIT
#include "ins_nav/nav.h"
#include <math.h>
#include <string.h>

#define SEQ_COUNT 256.0

ins_status_t ins_nav_link_init(ins_nav_link_t* self, const ins_nav_config_t* cfg)
{
    if (ins_nav_config_problem(cfg) != NULL)
    {
        return INS_E_RANGE;
    }
    memset(self, 0, sizeof *self);
    self->cfg = *cfg;
    ins_hs_config_t hs = {0};
    hs.block_len = cfg->block_len;
    hs.seq = cfg->seq;
    hs.retries = cfg->retries;
    hs.octet_timeout = cfg->octet_timeout_ms;
    return ins_hs_host_init(&self->hs, &hs);
}

/// Samples lost before this one. \param[out] disagree 1: arrival time and sequence number differ too much.
static uint64_t lost_before(const ins_nav_link_t* self, uint64_t now_ms, uint8_t* disagree)
{
    if (!self->cfg.seq || !self->started)
    {
        *disagree = 0;
        return 0;
    }
    const double elapsed = (double)(now_ms - self->last_ms) * 1e-3 / self->cfg.period_s;
    const double gap = self->hs.gap;
    const double rounds = floor((elapsed - (gap + 1.0)) / SEQ_COUNT + 0.5);
    const double lost = rounds > 0.0 ? gap + SEQ_COUNT * rounds : gap;
    *disagree = fabs(elapsed - (lost + 1.0)) > (double)self->cfg.clock_tolerance;
    return (uint64_t)lost;
}

static void copy_counts(ins_nav_link_t* self)
{
    self->counts.duplicates = self->hs.duplicates;
    self->counts.corrupt = self->hs.corrupt;
    self->counts.timeouts = self->hs.timeouts;
    self->counts.stray = self->hs.stray;
}

int ins_nav_link_octet(ins_nav_link_t* self, ins_octet_t octet, uint64_t now_ms, int* reply, ins_nav_sample_t* sample)
{
    int16_t answer = -1;
    const int event = ins_hs_host_rx(&self->hs, octet, (uint16_t)(now_ms & 0xFFFFu), &answer);
    *reply = answer;
    copy_counts(self);
    if (event != INS_HS_BLOCK)
    {
        return 0;
    }
    int valid = 1;
    memset(sample->code, 0, sizeof sample->code);
    for (int i = 0; i < self->cfg.channels; i++)
    {
        sample->code[i] = (uint16_t)(self->hs.block[2 * i] << 8 | self->hs.block[2 * i + 1]);
        valid = valid && sample->code[i] <= self->cfg.code_max;
    }
    if (!valid && !self->started)
    {
        self->counts.invalid++;
        return 0;
    }
    uint8_t disagree;
    const uint64_t lost = lost_before(self, now_ms, &disagree);
    self->index += self->started ? lost + 1u : 0u;
    self->started = 1;
    self->last_ms = now_ms;
    self->counts.lost += lost;
    if (!valid)
    {
        self->counts.invalid++;
        self->counts.lost++;
        return 0;
    }
    self->counts.accepted++;
    sample->index = self->index;
    sample->seq = self->hs.seq;
    sample->disagree = disagree;
    sample->counts = self->counts;
    return 1;
}

void ins_nav_link_tick(ins_nav_link_t* self, uint64_t now_ms)
{
    ins_hs_host_tick(&self->hs, (uint16_t)(now_ms & 0xFFFFu));
    copy_counts(self);
}
