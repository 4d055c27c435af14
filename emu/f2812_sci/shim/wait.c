/// Waiting: a loop that does nothing but look is passed over in whole turns, up to the turn in which something happens.
///
/// At a loop's tick, when since its last one nothing was stored, read for effect or called that is not instrumented, no event fired,
/// and the registers that functions keep and the frame hold the same, then the next turn will be the same as well, for the device
/// changes by events and by what the program does alone. So turns may be left out, each for as many cycles as the last one took.
/// SPDX-License-Identifier: MIT
#include "shim_internal.h"
#include <string.h>

#ifdef __x86_64__
#define KEPT_FRAME 5u ///< index of the frame pointer
#else
#define KEPT_FRAME 3u
#endif
#define KEPT_WHERE (KEPT_FRAME + 1u)

/// Octets from the kept registers to the caller's frame pointer; 0: not known, or too many.
static size_t frame_octets(const uintptr_t* kept)
{
    const size_t octets = kept[KEPT_FRAME] - (uintptr_t)kept;
    return kept[KEPT_FRAME] > (uintptr_t)kept && octets <= F2812_FRAME_OCTETS ? octets : 0;
}

/// Whether the turn that ends now did nothing but look.
static bool idle_turn(const f2812_shim_t* self, const f2812_loop_t* loop, const uintptr_t* kept)
{
    return loop->where == kept[KEPT_WHERE] && loop->frame == (uintptr_t)kept && loop->changes == f2812_shim_changes &&
           loop->due == f2812_due(self->device) && loop->interrupts == self->stats.interrupts;
}

/// So many turns like the last one, all of which end before anything happens.
static void pass_over(f2812_shim_t* self, const f2812_loop_t* loop)
{
    const uint64_t now = f2812_cycle(self->device);
    const uint64_t turn = now - loop->cycle;
    const uint64_t quiet = loop->due - now - 1;
    uint64_t turns = quiet / turn;
    const uint64_t most = UINT32_MAX / turn;
    turns = turns < most ? turns : most;
    f2812_advance(self->device, (uint32_t)(turns * turn));
    self->stats.skipped += turns;
    self->stats.turns += turns * (self->stats.turns - loop->turns);
    self->stats.accesses += turns * (self->stats.accesses - loop->accesses);
    self->stats.blocks += turns * (self->stats.blocks - loop->blocks);
}

void f2812_shim_turn(const uintptr_t* kept)
{
    f2812_shim_t* const self = f2812_shim_current;
    self->midway = false;
    f2812_shim_step(self, F2812_CYCLES_TURN);
    self->stats.turns++;
    self->waiting = false;
    if (!self->skip)
    {
        return;
    }
    f2812_loop_t* const loop = &self->loops[(kept[KEPT_WHERE] >> 3) % F2812_LOOPS];
    size_t octets = 0;
    if (idle_turn(self, loop, kept) && f2812_cycle(self->device) > loop->cycle)
    {
        octets = frame_octets(kept);
        if (octets != 0 && loop->octets == octets && memcmp(loop->copy, kept, octets) == 0)
        {
            pass_over(self, loop);
            self->waiting = self->sched->head == &self->until;
        }
        memcpy(loop->copy, kept, octets);
    }
    loop->octets = octets;
    loop->where = kept[KEPT_WHERE];
    loop->frame = (uintptr_t)kept;
    loop->changes = f2812_shim_changes;
    loop->interrupts = self->stats.interrupts;
    loop->cycle = f2812_cycle(self->device);
    loop->due = f2812_due(self->device);
    loop->accesses = self->stats.accesses;
    loop->blocks = self->stats.blocks;
    loop->turns = self->stats.turns;
}

void f2812_shim_wait(f2812_shim_t* self, uint64_t cycles)
{
    while (cycles > 0)
    {
        const uint64_t quiet = f2812_due(self->device) - f2812_cycle(self->device);
        uint64_t pass = quiet > 0 && quiet < cycles ? quiet : cycles;
        pass = pass < UINT32_MAX ? pass : UINT32_MAX;
        f2812_shim_step(self, (uint32_t)pass);
        cycles -= pass;
    }
}

void DSP28x_usDelay(uint32_t count); // declared to firmware in DSP281x_GlobalPrototypes.h

void DSP28x_usDelay(uint32_t count)
{
    f2812_shim_current->midway = false;
    f2812_shim_wait(f2812_shim_current, 9u + 5u * (uint64_t)count);
}
