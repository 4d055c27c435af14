/// \file   link_host.c
/// \brief  Host side of the extended frame. Block, number and counters are those of the paper's machine inside.
/// SPDX-License-Identifier: MIT
#include "ins/link.h"

#define HS_IDLE 0 ///< of ins_hs_host_t.state

enum
{
    HOST_PAPER, ///< idle, or the paper's machine is at work
    HOST_FRAME  ///< 44 or FF is out, the frame is due
};

ins_status_t ins_link_host_init(ins_link_host_t* self, const ins_hs_config_t* cfg)
{
    static const ins_link_host_t zero; // all 0
    ins_link_host_t start;
    start = zero;
    const ins_status_t status = cfg->block_len <= INS_LINK_BLOCK_MAX ? ins_hs_host_init(&start.hs, cfg) : INS_E_RANGE;
    if (status == INS_OK)
    {
        *self = start;
    }
    return status;
}

static void expect_frame(ins_link_host_t* self)
{
    self->state = HOST_FRAME;
    self->crc = INS_LINK_CRC_START;
    self->hs.count = 0;
}

/// A frame whose CRC agrees, and its number: new, or the last one again.
static int take_frame(ins_link_host_t* self)
{
    ins_hs_host_t* const hs = &self->hs;
    const uint_least8_t step = (uint_least8_t)((unsigned)(hs->sum - hs->seq) & 0xFFu);
    if (hs->have_seq && step == 0)
    {
        hs->duplicates++;
        return INS_HS_DUPLICATE;
    }
    hs->gap = hs->have_seq ? (uint_least8_t)(step - 1) : 0;
    hs->seq = hs->sum;
    hs->have_seq = 1;
    hs->accepted++;
    return INS_HS_BLOCK;
}

int ins_link_host_rx(ins_link_host_t* self, ins_octet_t octet, uint16_t now, int16_t* reply)
{
    ins_hs_host_t* const hs = &self->hs;
    const uint16_t silence = (uint16_t)(now - hs->since);
    octet &= 0xFFu;
    *reply = -1;
    if (self->state == HOST_FRAME && hs->count == 0 && silence > hs->cfg.octet_timeout)
    {
        hs->timeouts++; // 44 or FF was lost, and the board asks again before a tick said so
        self->state = HOST_PAPER;
    }
    if (self->state == HOST_PAPER)
    {
        if (hs->state != HS_IDLE || octet != INS_LINK_REQUEST)
        {
            const int event = ins_hs_host_rx(hs, octet, now, reply);
            self->extended = event == INS_HS_NOTHING ? self->extended : 0;
            hs->have_seq =
                event == INS_HS_BLOCK ? hs->cfg.seq != 0 : hs->have_seq; // without a number in it the count is lost
            return event;
        }
        hs->since = now;
        hs->tries = 0;
        self->extended = 1;
        expect_frame(self);
        *reply = INS_LINK_READY;
        return INS_HS_NOTHING;
    }
    hs->since = now;
    if (hs->count == 0)
    {
        hs->sum = octet; // the number, until the frame is judged
    }
    else if (hs->count <= hs->cfg.block_len)
    {
        hs->block[hs->count - 1] = octet;
    }
    self->crc = ins_link_crc(self->crc, octet);
    hs->count++;
    if (hs->count < hs->cfg.block_len + 3)
    {
        return INS_HS_NOTHING;
    }
    if (self->crc == 0) // a CRC over itself
    {
        self->state = HOST_PAPER;
        *reply = INS_HS_ACCEPT;
        return take_frame(self);
    }
    hs->corrupt++;
    *reply = INS_HS_RESEND;
    if (hs->tries == hs->cfg.retries)
    {
        self->state = HOST_PAPER;
    }
    else
    {
        hs->tries++;
        expect_frame(self);
    }
    return INS_HS_CORRUPT;
}

void ins_link_host_tick(ins_link_host_t* self, uint16_t now)
{
    if (self->state == HOST_PAPER)
    {
        ins_hs_host_tick(&self->hs, now);
    }
    else if ((uint16_t)(now - self->hs.since) > self->hs.cfg.octet_timeout)
    {
        self->hs.timeouts++;
        self->state = HOST_PAPER;
    }
}
