/// \file   report.c
/// \brief  The board's side of the handshake to the PC. Unit: ms.
///
/// A block takes 18.7 ms at 19200 Bd; the PC may be silent for REPLY_TIMEOUT_MS before it is asked again.
/// SPDX-License-Identifier: MIT
#include "report.h"

#define RETRIES          5
#define REPLY_TIMEOUT_MS 100 ///< above the PC's octet time-out of 30 ms and one block

void report_begin(report_t* self)
{
    static const ins_hs_config_t config = {INS_NAV_BLOCK_LEN, 1, RETRIES, REPLY_TIMEOUT_MS, 0};
    (void)ins_hs_board_init(&self->link, &config);
    self->has_waiting = 0;
    self->seq = 0;
}

void report_put(report_t* self, const ins_nav_block_t* block)
{
    self->waiting = *block;
    self->has_waiting = 1;
    self->seq++;
}

void report_tick(report_t* self, uint16_t now_ms)
{
    ins_octet_t octets[INS_NAV_BLOCK_LEN];
    ins_hs_board_tick(&self->link, now_ms);
    if (self->has_waiting && !ins_hs_board_busy(&self->link))
    {
        self->has_waiting = 0;
        if (ins_nav_block_put(&self->waiting, octets) == INS_OK)
        {
            (void)ins_hs_board_offer(&self->link, octets, (uint_least8_t)(self->seq & 0xFFu), now_ms);
        }
    }
}

int16_t report_tx(report_t* self, uint16_t now_ms)
{
    return ins_hs_board_tx(&self->link, now_ms);
}

uint16_t report_rx(report_t* self, uint16_t octet, uint16_t now_ms)
{
    switch (octet)
    {
    case 'n':
    case 'i':
    case 'f':
    case COMMAND_FILTER_ON:
    case COMMAND_FILTER_OFF:
    case COMMAND_LEVEL_ON:
    case COMMAND_LEVEL_OFF:
        return octet;
    default:
        ins_hs_board_rx(&self->link, (ins_octet_t)octet, now_ms);
        return COMMAND_NONE;
    }
}
