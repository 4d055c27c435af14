/// \file   run_bin.c
/// \brief  Runs an image (flat, from address 0) on the bare CPU and prints its state, for tests and measurements.
///
///     run_bin IMAGE.bin [CYCLES]        stops at CYCLES (default: none), at a jump to itself with EA = 0, or in power-down
/// SPDX-License-Identifier: MIT
#include "emu_8051/mcs51.h"
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

static void print_report(void* ctx, emu_report_kind_t kind, const char* text, uint32_t detail, emu_time_t at)
{
    (void)ctx;
    (void)at;
    fprintf(stderr, "%s: %s: 0x%" PRIX32 "\n", kind == EMU_GUEST_ERROR ? "guest error" : "not modelled", text, detail);
}

static void print_range(const char* name, mcs51_t* cpu, uint8_t (*get)(mcs51_t*, uint8_t), unsigned from, unsigned to)
{
    printf("%s", name);
    for (unsigned a = from; a <= to; ++a)
    {
        printf(" %02X", get(cpu, (uint8_t)a));
    }
    putchar('\n');
}

static uint8_t iram(mcs51_t* cpu, uint8_t address)
{
    return mcs51_iram(cpu, address);
}

static int load(mcs51_t* cpu, const char* path)
{
    uint8_t image[4097];
    FILE* const file = fopen(path, "rb");
    if (!file)
    {
        fprintf(stderr, "run_bin: cannot open %s\n", path);
        return -1;
    }
    const size_t count = fread(image, 1, sizeof image, file);
    fclose(file);
    if (mcs51_load(cpu, 0, image, count) != 0)
    {
        fprintf(stderr, "run_bin: %s is larger than the 4096 octets of flash\n", path);
        return -1;
    }
    return 0;
}

int main(int argc, char** argv)
{
    const mcs51_config_t config = {.clock = {11059200, 12}, .report = {print_report, NULL}};
    mcs51_t* cpu;

    if (argc < 2 || argc > 3)
    {
        fprintf(stderr, "usage: run_bin IMAGE.bin [CYCLES]\n");
        return 2;
    }
    cpu = mcs51_create(&config);
    if (!cpu || load(cpu, argv[1]) != 0)
    {
        mcs51_destroy(cpu);
        return 2;
    }
    const mcs51_stop_t stop = mcs51_run(cpu, argc == 3 ? strtoull(argv[2], NULL, 0) : UINT64_MAX);
    printf("stop %d pc %04X cycles %" PRIu64 " instructions %" PRIu64 " interrupts %" PRIu64 "\n", (int)stop,
           mcs51_pc(cpu), mcs51_cycle(cpu), mcs51_instructions(cpu), mcs51_interrupts(cpu));
    print_range("iram", cpu, iram, 0x00, 0x7F);
    print_range("sfr", cpu, mcs51_sfr, 0x80, 0xFF);
    mcs51_destroy(cpu);
    return 0;
}
