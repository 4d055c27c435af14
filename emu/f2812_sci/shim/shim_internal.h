/// \file   shim_internal.h
/// \brief  State of the shim, and what its files offer each other. Not installed.
/// SPDX-License-Identifier: MIT
#ifndef F2812_SHIM_INTERNAL_H_INCLUDED
#define F2812_SHIM_INTERNAL_H_INCLUDED
#include "../cpu/device.h"
#include "shim.h"

// Cost of what firmware does [cycles of SYSCLKOUT]. A model: the host's compiler makes other instructions than the C28x's.
#define F2812_CYCLES_REGISTER                                                                                          \
    2u ///< an access of a volatile object (SPRS174: peripheral frames take 2 wait states or none)
#define F2812_CYCLES_MEMORY 1u ///< any other access of memory
#define F2812_CYCLES_BLOCK  4u ///< a basic block: a branch not taken, and some arithmetic
#define F2812_CYCLES_TURN   4u ///< a turn of a loop: a branch taken (SPRU430)
#define F2812_CYCLES_ASM    1u ///< an asm() statement
#define F2812_CYCLES_FOREIGN                                                                                           \
    20u ///< a call of a function that is not instrumented (the C library, core); f2812-cc puts it in
#define F2812_CYCLES_INTERRUPT 14u ///< from the interrupt to the first instruction of its function (SPRU430, minimum)
#define F2812_CYCLES_IRET      8u  ///< IRET (SPRU430)

// Pseudo addresses in the map: M0 RAM, where no register is.
#define F2812_MAP_NONE    0u
#define F2812_MAP_IER     1u
#define F2812_MAP_IFR     2u
#define F2812_MAP_ZERO    3u ///< reads 0
#define F2812_MAP_VECTOR  4u
#define F2812_MAP_ADDRESS 0x7FFFu
#define F2812_MAP_RESTLESS                                                                                             \
    0x8000u ///< a counter, or reading it has an effect: a loop that looks at it is not passed over

#define F2812_LOOPS        16u   ///< loops whose last turn is remembered
#define F2812_FRAME_OCTETS 2048u ///< a loop in a function with a larger frame is never passed over

/// The last turn of a loop.
typedef struct f2812_loop_t
{
    uintptr_t where; ///< return address of the tick
    uintptr_t frame;
    uint64_t changes, cycle, due, interrupts;
    uint64_t accesses, blocks, turns; ///< counts at it
    size_t octets;                    ///< of the copy; 0: none taken
    uint8_t copy[F2812_FRAME_OCTETS]; ///< kept registers and frame
} f2812_loop_t;

struct f2812_shim_t
{
    f2812_t* device;
    emu_sched_t* sched;
    const f2812_program_t* program;
    emu_report_t report;

    uintptr_t base; ///< of the register objects; map[(at - base) / 2] is a word address of the device, or F2812_MAP_*
    size_t span;    ///< octets
    uint16_t* map;
    uintptr_t store; ///< address of the store that the next hook commits; 0: none
    unsigned store_words;
    uint16_t store_address; ///< of the device, if that is all the store changes; else 0
    bool midway;            ///< a volatile object was read, and nothing stored since: no interrupt comes between
    bool stop;              ///< f2812_shim_break()
    bool skip;
    bool waiting;           ///< the firmware's last loop was such, and nothing is due before `until`
    uint64_t vector_before; ///< what the entry of the table held
    f2812_shim_stats_t stats;

    struct f2812_shim_t* next; ///< of those alive
    void* coroutine;           ///< shim.c
    emu_event_t until;
    uint8_t* initial; ///< the variables as loaded
    const char* end;
    f2812_loop_t loops[F2812_LOOPS];
};

/// The shim whose firmware runs.
extern f2812_shim_t* f2812_shim_current;
/// Cycles that passed since the last hook that lets time pass.
extern uint32_t f2812_shim_debt;
/// Stores, reads that change something, and calls of what is not instrumented: a turn of a loop without any waits.
extern uint64_t f2812_shim_changes;

/// Fill base, span and map. \return false: no memory, or the objects lie too far apart.
bool f2812_shim_make_map(f2812_shim_t* self);
/// The pending store goes to the device.
void f2812_shim_commit(f2812_shim_t* self);
void f2812_shim_commit_words(f2812_shim_t* self, uint16_t* word);
/// Interrupts, reset, break.
void f2812_shim_attend(f2812_shim_t* self);
/// So many cycles of waiting, in which interrupts come.
void f2812_shim_wait(f2812_shim_t* self, uint64_t cycles);
/// IDLE.
void f2812_shim_idle(f2812_shim_t* self);
/// The firmware stops for good.
_Noreturn void f2812_shim_finish(f2812_shim_t* self, const char* why);
void f2812_shim_error(f2812_shim_t* self, emu_report_kind_t kind, const char* text, uint32_t detail);
/// Whether an address is just below the stack of the firmware that runs.
bool f2812_shim_overflows(uintptr_t at);
/// Called by tick.S. kept: the registers a function keeps, lowest first, the return address, and the caller's frame.
void f2812_shim_turn(const uintptr_t* kept);

/// Store what is pending, let time pass, and take interrupts. In every hook, so it looks into the device instead of asking.
static inline void f2812_shim_step(f2812_shim_t* self, uint32_t cycles)
{
    f2812_t* const device = self->device;
    if (self->store != 0)
    {
        f2812_shim_commit(self);
    }
    device->cycle += cycles + f2812_shim_debt;
    f2812_shim_debt = 0;
    if (device->cycle >= device->due)
    {
        f2812_advance(device, 0);
    }
    if ((device->pending || self->stop) && !self->midway)
    {
        f2812_shim_attend(self);
    }
}

#endif // F2812_SHIM_INTERNAL_H_INCLUDED
