/// \file   board_internal.h
/// \brief  State of an acquisition board. Not installed.
/// SPDX-License-Identifier: MIT
#ifndef BOARD_INTERNAL_H_INCLUDED
#define BOARD_INTERNAL_H_INCLUDED
#include "emu/ticker.h"
#include "emu_8051/acq_board.h"

#define ACQ_PINS 32u
#define ACQ_NAME 16 ///< octets of a net's name

typedef struct acq_net_t
{
    acq_board_t* board;
    uint8_t port, mask;
    bool driving;        ///< the CPU is changing its own drive
    bool cut;            ///< between the CPU's pin and the rest of the net
    char name[ACQ_NAME]; ///< of the wire
    emu_wire_t wire;
} acq_net_t;

struct acq_board_t
{
    acq_board_config_t config;
    emu_ticker_t clock;
    emu_sched_t* sched;
    mcs51_t* cpu;
    tlc2543_t* adcs[ACQ_ADCS_MAX];
    acq_net_t nets[4][8];
    uint8_t outside[4];
    bool running;         ///< inside mcs51_run()
    emu_time_t goal;      ///< of acq_board_run()
    uint64_t synced;      ///< the last cycle up to which events were fired ...
    emu_time_t synced_at; ///< ... and its instant
};

#endif // BOARD_INTERNAL_H_INCLUDED
