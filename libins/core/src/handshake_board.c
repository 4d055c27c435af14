/// \file   handshake_board.c
/// \brief  Board side (A) of the handshake. Kept small: it runs in 4 KB of an AT89S51 beside the sampling, hence one file of its own.
/// SPDX-License-Identifier: MIT
#include "ins/handshake.h"

#define TIMEOUT_MAX 32767u
#define SEQ_LEN_MIN 4 ///< octets 0 and 2 carry the sequence number, and the layout is of 16-bit codes

enum
{
    BOARD_IDLE,
    BOARD_REQUEST,    ///< AA is to be transmitted
    BOARD_WAIT_READY, ///< AA is out, BB is due
    BOARD_FRAME,      ///< block and sum are being transmitted
    BOARD_WAIT_ACK    ///< the sum is out, 00 or FF is due
};

ins_status_t ins_hs_board_init(INS_HS_MEM ins_hs_board_t* self, const ins_hs_config_t* cfg)
{
    if (cfg->block_len == 0 || cfg->block_len > INS_HS_BLOCK_MAX || (cfg->seq && cfg->block_len < SEQ_LEN_MIN) ||
        cfg->reply_timeout == 0 || cfg->reply_timeout > TIMEOUT_MAX)
    {
        return INS_E_RANGE;
    }
    self->cfg = *cfg;
    self->state = BOARD_IDLE;
    self->sent = 0;
    self->resent = 0;
    self->given_up = 0;
    return INS_OK;
}

ins_status_t ins_hs_board_offer(INS_HS_MEM ins_hs_board_t* self, const INS_HS_MEM ins_octet_t* block, uint_least8_t seq,
                                uint16_t now)
{
    ins_octet_t octet;
    uint_least8_t i;
    (void)now;
    if (self->state != BOARD_IDLE)
    {
        return INS_E_STATE;
    }
    self->sum = 0;
    for (i = 0; i < self->cfg.block_len; i++)
    {
        octet = block[i] & 0xFFu;
        if (self->cfg.seq && i == 0)
        {
            octet = (ins_octet_t)((octet & 0x0Fu) | (seq & 0xF0u));
        }
        if (self->cfg.seq && i == 2)
        {
            octet = (ins_octet_t)((octet & 0x0Fu) | ((seq & 0x0Fu) << 4));
        }
        self->block[i] = octet;
        self->sum = (self->sum + (unsigned)octet) & 0xFFu;
    }
    self->tries = 0;
    self->state = BOARD_REQUEST;
    return INS_OK;
}

uint_least8_t ins_hs_board_busy(const INS_HS_MEM ins_hs_board_t* self)
{
    return self->state != BOARD_IDLE;
}

int16_t ins_hs_board_tx(INS_HS_MEM ins_hs_board_t* self, uint16_t now)
{
    ins_octet_t octet;
    if (self->state == BOARD_REQUEST)
    {
        octet = INS_HS_REQUEST;
        self->state = BOARD_WAIT_READY;
    }
    else if (self->state != BOARD_FRAME)
    {
        return -1;
    }
    else if (self->next < self->cfg.block_len)
    {
        octet = self->block[self->next];
        self->next++;
    }
    else
    {
        octet = self->sum;
        self->state = BOARD_WAIT_ACK;
    }
    self->since = now;
    return (int16_t)octet;
}

/// Another try from `state` on, or the block is dropped.
static void board_retry(INS_HS_MEM ins_hs_board_t* self, uint_least8_t state)
{
    if (self->tries == self->cfg.retries)
    {
        self->given_up++;
        self->state = BOARD_IDLE;
        return;
    }
    self->tries++;
    self->resent++;
    self->next = 0;
    self->state = state;
}

void ins_hs_board_rx(INS_HS_MEM ins_hs_board_t* self, ins_octet_t octet, uint16_t now)
{
    (void)now;
    octet &= 0xFFu;
    if (self->state == BOARD_WAIT_READY && octet == INS_HS_READY)
    {
        self->next = 0;
        self->state = BOARD_FRAME;
    }
    else if (self->state == BOARD_WAIT_ACK && octet == INS_HS_ACCEPT)
    {
        self->sent++;
        self->state = BOARD_IDLE;
    }
    else if (self->state == BOARD_WAIT_ACK && octet == INS_HS_RESEND)
    {
        board_retry(self, BOARD_FRAME);
    }
}

void ins_hs_board_tick(INS_HS_MEM ins_hs_board_t* self, uint16_t now)
{
    if ((self->state == BOARD_WAIT_READY || self->state == BOARD_WAIT_ACK) &&
        (uint16_t)(now - self->since) >= self->cfg.reply_timeout)
    {
        board_retry(self, BOARD_REQUEST);
    }
}

void ins_hs_block_put(const INS_HS_MEM uint16_t* codes, INS_HS_MEM ins_octet_t* block)
{
    uint_least8_t i;
    for (i = 0; i < 3; i++)
    {
        block[2 * i] = (ins_octet_t)((codes[i] >> 8) & 0x0Fu);
        block[2 * i + 1] = (ins_octet_t)(codes[i] & 0xFFu);
    }
}
