/// \file   report.h
/// \brief  Blocks to the PC over the handshake (board side), and the PC's command octets. No register is touched here.
/// SPDX-License-Identifier: MIT
#ifndef THESIS_REPORT_H_INCLUDED
#define THESIS_REPORT_H_INCLUDED
#include "ins/handshake.h"
#include "ins/nav_block.h"

/// Octets that the PC may send between those of the handshake; beside them NULL_NONE, NULL_INTEGER, NULL_FRACTION: calibrate again.
enum
{
    COMMAND_NONE = 0,
    COMMAND_FILTER_ON = 'K',
    COMMAND_FILTER_OFF = 'k',
    COMMAND_LEVEL_ON = 'L',
    COMMAND_LEVEL_OFF = 'l'
};

typedef struct report_t
{
    ins_hs_board_t link;
    ins_nav_block_t waiting;
    uint16_t has_waiting;
    uint16_t seq; ///< blocks made: what is replaced before it is sent shows as a gap
} report_t;

void report_begin(report_t* self);
/// The newest result; one that still waits is replaced.
void report_put(report_t* self, const ins_nav_block_t* block);
/// Time passes: call often.
void report_tick(report_t* self, uint16_t now_ms);
/// \return the next octet for the line, or -1. Call when the transmitter has room.
int16_t report_tx(report_t* self, uint16_t now_ms);
/// An octet came. \return a command, or COMMAND_NONE.
uint16_t report_rx(report_t* self, uint16_t octet, uint16_t now_ms);

#endif // THESIS_REPORT_H_INCLUDED
