/// \file   step_back.c
/// \brief  A load for callgrind: N steps back of a bare CPU from random cycles, with a snapshot each 100,000 cycles.
///
///     bench_step_back IMAGE.bin N
///
/// As the debugger does it: restore, run at full speed to just before, look for the last instruction boundary, go there. Run twice with
/// different N: the difference over the difference is a step back. Prints the mean and the longest wall time of one [us].
/// SPDX-License-Identifier: MIT
#include "emu/state.h"
#include "emu_8051/mcs51.h"
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define SPACING   100000u
#define SNAPSHOTS 20u
#define NEAR      64u ///< cycles before, from where boundaries are looked for
#define OCTETS    2048u

typedef struct snapshot_t
{
    uint8_t octets[OCTETS];
    size_t size;
} snapshot_t;

typedef struct search_t
{
    uint64_t end, last, stop;
} search_t;

static void save(mcs51_t* cpu, snapshot_t* snapshot)
{
    emu_state_t io = {.to = snapshot->octets, .size = OCTETS};
    mcs51_state(cpu, &io);
    snapshot->size = io.at;
    if (io.bad)
    {
        fputs("bench_step_back: a snapshot has no room\n", stderr);
        exit(2);
    }
}

static void restore(mcs51_t* cpu, const snapshot_t* snapshot)
{
    emu_state_t io = {.from = snapshot->octets, .size = snapshot->size};
    mcs51_state(cpu, &io);
}

static bool on_step(void* ctx, uint16_t pc, uint64_t cycle)
{
    search_t* const search = ctx;
    (void)pc;
    search->last = cycle < search->end ? cycle : search->last;
    return cycle < search->stop;
}

/// To where the CPU was before the instruction that ended at `cycle`. \return the cycle reached.
static uint64_t step_back(mcs51_t* cpu, const snapshot_t* from, uint64_t cycle)
{
    snapshot_t near;
    search_t search = {.end = cycle, .stop = UINT64_MAX};
    const mcs51_observer_t observer = {.ctx = &search, .step = on_step};
    restore(cpu, from);
    mcs51_run(cpu, cycle - NEAR);
    save(cpu, &near);
    mcs51_observe(cpu, &observer);
    mcs51_run(cpu, cycle);
    restore(cpu, &near);
    search.stop = search.last;
    mcs51_run(cpu, cycle);
    mcs51_observe(cpu, NULL);
    return mcs51_cycle(cpu);
}

static double now_us(void)
{
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return (double)t.tv_sec * 1e6 + (double)t.tv_nsec * 1e-3;
}

int main(int argc, char** argv)
{
    static uint8_t image[65536];
    static snapshot_t snapshots[SNAPSHOTS];
    FILE* const file = argc == 3 ? fopen(argv[1], "rb") : NULL;
    const mcs51_config_t config = {.clock = {.hz = 11059200, .divider = 12}};
    mcs51_t* const cpu = mcs51_create(&config);
    if (file == NULL || cpu == NULL)
    {
        fputs("usage: bench_step_back IMAGE.bin N\n", stderr);
        return 2;
    }
    const size_t size = fread(image, 1, sizeof image, file);
    fclose(file);
    mcs51_load(cpu, 0, image, size);
    for (unsigned i = 0; i < SNAPSHOTS; i++)
    {
        mcs51_run(cpu, (uint64_t)i * SPACING);
        save(cpu, &snapshots[i]);
    }
    const long n = strtol(argv[2], NULL, 10);
    uint64_t seed = 1, wrong = 0;
    double total_us = 0.0, longest_us = 0.0;
    for (long i = 0; i < n; i++)
    {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        const uint64_t place = (seed >> 33) % ((SNAPSHOTS - 1u) * SPACING) + 2u * NEAR;
        const double start = now_us();
        const uint64_t reached = step_back(cpu, &snapshots[(place - NEAR) / SPACING], place);
        const double took_us = now_us() - start;
        wrong += reached >= place || place - reached > 8u;
        total_us += took_us;
        longest_us = took_us > longest_us ? took_us : longest_us;
    }
    printf("steps %ld mean_us %.1f longest_us %.1f wrong %llu\n", n, n > 0 ? total_us / (double)n : 0.0, longest_us,
           (unsigned long long)wrong);
    mcs51_destroy(cpu);
    return wrong != 0;
}
