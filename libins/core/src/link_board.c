/// \file   link_board.c
/// \brief  Board side of the extended frame, and its CRC.
/// SPDX-License-Identifier: MIT
#include "ins/link.h"

#define POLYNOMIAL 0x90D9u
#define TOP_BIT    0x8000u

enum
{
    LINK_PAPER,      ///< idle, or the paper's machine is at work
    LINK_REQUEST,    ///< 55 is to be transmitted
    LINK_WAIT_READY, ///< 55 is out, 44 is due
    LINK_FRAME,
    LINK_WAIT_ACK
};

uint16_t ins_link_crc(uint16_t crc, ins_octet_t octet)
{
    unsigned c = (unsigned)crc ^ ((unsigned)(octet & 0xFFu) << 8);
    for (unsigned bit = 0; bit < 8; bit++)
    {
        c = (c & TOP_BIT) ? (c << 1) ^ POLYNOMIAL : c << 1;
    }
    return (uint16_t)(c & 0xFFFFu);
}

ins_status_t ins_link_board_init(ins_link_board_t* self, const ins_hs_config_t* cfg)
{
    static const ins_link_board_t zero; // all 0
    ins_link_board_t start;
    start = zero;
    const ins_status_t status = cfg->block_len <= INS_LINK_BLOCK_MAX ? ins_hs_board_init(&start.hs, cfg) : INS_E_RANGE;
    if (status == INS_OK)
    {
        *self = start;
    }
    return status;
}

uint_least8_t ins_link_board_busy(const ins_link_board_t* self)
{
    return self->state != LINK_PAPER || ins_hs_board_busy(&self->hs);
}

ins_status_t ins_link_board_offer(ins_link_board_t* self, const ins_octet_t* block, uint_least8_t seq, uint16_t now)
{
    if (ins_link_board_busy(self))
    {
        return INS_E_STATE;
    }
    self->seq = seq & 0xFFu;
    if (self->paper_left > 0)
    {
        self->paper_left--;
        return ins_hs_board_offer(&self->hs, block, seq, now);
    }
    self->crc = ins_link_crc(INS_LINK_CRC_START, self->seq);
    for (uint_least8_t i = 0; i < self->hs.cfg.block_len; i++)
    {
        self->hs.block[i] = block[i] & 0xFFu;
        self->crc = ins_link_crc(self->crc, block[i]);
    }
    self->hs.tries = 0;
    self->state = LINK_REQUEST;
    return INS_OK;
}

int16_t ins_link_board_tx(ins_link_board_t* self, uint16_t now)
{
    const uint_least8_t length = self->hs.cfg.block_len;
    const uint_least8_t next = self->hs.next;
    int16_t octet;
    if (self->state == LINK_PAPER)
    {
        return ins_hs_board_tx(&self->hs, now);
    }
    if (self->state == LINK_REQUEST)
    {
        octet = INS_LINK_REQUEST;
        self->state = LINK_WAIT_READY;
    }
    else if (self->state != LINK_FRAME)
    {
        return -1;
    }
    else
    {
        octet = (int16_t)(next == 0            ? self->seq
                          : next <= length     ? self->hs.block[next - 1]
                          : next == length + 1 ? (self->crc >> 8) & 0xFFu
                                               : self->crc & 0xFFu);
        self->hs.next++;
        self->state = next == length + 2 ? LINK_WAIT_ACK : LINK_FRAME;
    }
    self->hs.since = now;
    return octet;
}

/// Another try from `state` on, or else the block is dropped, or goes out in the paper's form if the host was silent.
static void link_retry(ins_link_board_t* self, uint_least8_t state, uint16_t now)
{
    const int silent = self->state == LINK_WAIT_READY;
    if (self->hs.tries < self->hs.cfg.retries && !(silent && !self->known))
    {
        self->hs.tries++;
        self->hs.resent++;
        self->hs.next = 0;
        self->state = state;
        return;
    }
    self->state = LINK_PAPER;
    if (!silent)
    {
        self->hs.given_up++;
        return;
    }
    self->known = 0;
    self->paper_left = INS_LINK_PROBE_EVERY - 1;
    self->fallbacks++;
    (void)ins_hs_board_offer(&self->hs, self->hs.block, self->seq, now); // idle: cannot refuse
}

void ins_link_board_rx(ins_link_board_t* self, ins_octet_t octet, uint16_t now)
{
    octet &= 0xFFu;
    if (self->state == LINK_PAPER)
    {
        ins_hs_board_rx(&self->hs, octet, now);
    }
    else if (self->state == LINK_WAIT_READY && octet == INS_LINK_READY)
    {
        self->known = 1;
        self->hs.next = 0;
        self->state = LINK_FRAME;
    }
    else if (self->state == LINK_WAIT_ACK && octet == INS_HS_ACCEPT)
    {
        self->hs.sent++;
        self->extended++;
        self->state = LINK_PAPER;
    }
    else if (self->state == LINK_WAIT_ACK && octet == INS_HS_RESEND)
    {
        link_retry(self, LINK_FRAME, now);
    }
}

void ins_link_board_tick(ins_link_board_t* self, uint16_t now)
{
    if (self->state == LINK_PAPER)
    {
        ins_hs_board_tick(&self->hs, now);
    }
    else if ((self->state == LINK_WAIT_READY || self->state == LINK_WAIT_ACK) &&
             (uint16_t)(now - self->hs.since) >= self->hs.cfg.reply_timeout)
    {
        link_retry(self, LINK_REQUEST, now);
    }
}
