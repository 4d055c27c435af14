/// \file   board_edge.c
/// \brief  A load for callgrind: N machine cycles of a program that complements a bit for ever: of RAM, of an idle pin, or of the
///         converter's clock while it is selected.
///
///     bench_board_edge ram|pin|clock N
///
/// The runs differ in the path of an edge alone: port, net, converter and back. Prints the edges.
/// SPDX-License-Identifier: MIT
#include "emu_8051/acq_board.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void count(void* ctx, bool level, emu_time_t at)
{
    (void)level;
    (void)at;
    ++*(unsigned long*)ctx;
}

int main(int argc, char** argv)
{
    if (argc != 3)
    {
        return 2;
    }
    const bool pin = strcmp(argv[1], "pin") == 0, clock = strcmp(argv[1], "clock") == 0;
    const uint8_t bit = pin ? 0x97 : clock ? 0x91 : 0x00;         // P1.7, P1.1, 20h.0
    const uint8_t code[] = {0xC2, (uint8_t)(clock ? 0x94 : 0x01), // CLR P1.4, or 20h.1
                            0xB2, bit,
                            0xB2, bit,
                            0xB2, bit,
                            0xB2, bit,
                            0x80, 0xF6};
    unsigned long edges = 0;
    emu_sched_t sched;
    emu_sched_init(&sched);
    acq_board_config_t config;
    acq_board_default_config(&config);
    config.crystal_hz = 12000000;
    acq_board_t* const board = acq_board_create(&config, &sched);
    if (board == NULL || mcs51_load(acq_board_cpu(board), 0, code, sizeof code) != 0 ||
        emu_wire_watch(acq_board_wire(board, clock ? "P1.1" : "P1.7"), count, &edges) != 0)
    {
        return 1;
    }
    acq_board_run(board, atol(argv[2]) * EMU_PS_PER_US);
    printf("edges %lu\n", edges);
    acq_board_destroy(board);
    return 0;
}
