/// \file   handshake_host.c
/// \brief  Host side (B) of the handshake.
///
/// Where an octet or a reply is lost the host falls silent and goes back to idle after octet_timeout; the board, whose reply_timeout is
/// longer, then begins again with AA. docs/handshake.md has both machines as tables.
/// SPDX-License-Identifier: MIT
#include "ins/handshake.h"

#define TIMEOUT_MAX 32767u
#define SEQ_LEN_MIN 4

enum
{
    HOST_IDLE,
    HOST_BLOCK ///< BB or FF is out; block and sum are due
};

ins_status_t ins_hs_host_init(ins_hs_host_t* self, const ins_hs_config_t* cfg)
{
    if (cfg->block_len == 0 || cfg->block_len > INS_HS_BLOCK_MAX || (cfg->seq && cfg->block_len < SEQ_LEN_MIN) ||
        cfg->octet_timeout == 0 || cfg->octet_timeout > TIMEOUT_MAX ||
        (cfg->reply_timeout != 0 && cfg->reply_timeout <= cfg->octet_timeout))
    {
        return INS_E_RANGE;
    }
    self->cfg = *cfg;
    self->state = HOST_IDLE;
    self->tries = 0;
    self->count = 0;
    self->sum = 0;
    self->have_seq = 0;
    self->seq = 0;
    self->gap = 0;
    self->since = 0;
    self->accepted = 0;
    self->duplicates = 0;
    self->corrupt = 0;
    self->timeouts = 0;
    self->stray = 0;
    return INS_OK;
}

static void expect_block(ins_hs_host_t* self)
{
    self->state = HOST_BLOCK;
    self->count = 0;
    self->sum = 0;
}

/// A block whose sum agrees: new, or the last one again.
static int take_block(ins_hs_host_t* self)
{
    uint_least8_t seq;
    uint_least8_t step;
    self->state = HOST_IDLE;
    if (self->cfg.seq)
    {
        seq = (uint_least8_t)((self->block[0] & 0xF0u) | (self->block[2] >> 4));
        self->block[0] &= 0x0Fu;
        self->block[2] &= 0x0Fu;
        step = (uint_least8_t)((unsigned)(seq - self->seq) & 0xFFu);
        if (self->have_seq && step == 0)
        {
            self->duplicates++;
            return INS_HS_DUPLICATE;
        }
        self->gap = self->have_seq ? (uint_least8_t)(step - 1) : 0;
        self->seq = seq;
        self->have_seq = 1;
    }
    self->accepted++;
    return INS_HS_BLOCK;
}

int ins_hs_host_rx(ins_hs_host_t* self, ins_octet_t octet, uint16_t now, int16_t* reply)
{
    const uint16_t silence = (uint16_t)(now - self->since);
    octet &= 0xFFu;
    *reply = -1;
    self->since = now;
    if (self->state == HOST_IDLE || (self->count == 0 && octet == INS_HS_REQUEST && silence > self->cfg.octet_timeout))
    {
        if (octet != INS_HS_REQUEST)
        {
            self->stray++;
            return INS_HS_NOTHING;
        }
        if (self->state == HOST_BLOCK) // BB or FF was lost, and the board asks again before a tick said so
        {
            self->timeouts++;
        }
        self->tries = 0;
        expect_block(self);
        *reply = INS_HS_READY;
        return INS_HS_NOTHING;
    }
    if (self->count < self->cfg.block_len)
    {
        self->block[self->count] = octet;
        self->sum = (uint_least8_t)((self->sum + (unsigned)octet) & 0xFFu);
        self->count++;
        return INS_HS_NOTHING;
    }
    if (self->sum == octet)
    {
        *reply = INS_HS_ACCEPT;
        return take_block(self);
    }
    self->corrupt++;
    *reply = INS_HS_RESEND;
    if (self->tries == self->cfg.retries)
    {
        self->state = HOST_IDLE;
    }
    else
    {
        self->tries++;
        expect_block(self);
    }
    return INS_HS_CORRUPT;
}

void ins_hs_host_tick(ins_hs_host_t* self, uint16_t now)
{
    if (self->state == HOST_BLOCK && (uint16_t)(now - self->since) > self->cfg.octet_timeout)
    {
        self->timeouts++;
        self->state = HOST_IDLE;
    }
}

void ins_hs_block_codes(const ins_octet_t* block, uint16_t* codes)
{
    uint_least8_t i;
    for (i = 0; i < 3; i++)
    {
        codes[i] = (uint16_t)(((block[2 * i] & 0x0Fu) << 8) | (block[2 * i + 1] & 0xFFu));
    }
}
