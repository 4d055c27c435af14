/// \file   shim.h
/// \brief  Runs firmware that was compiled for the host with its memory accesses instrumented, on an emulated F2812.
///
/// f2812-cc compiles firmware so that the compiler calls a hook before each access, at each basic block and at each turn of a loop. In a
/// hook virtual time passes, registers are read and written, and interrupts are taken, on the firmware's own stack. The firmware is a
/// coroutine: f2812_shim_run() returns at exactly the instant asked for, and the next call goes on there.
///
///     f2812_shim_t* shim = f2812_shim_create(device, sched, &f2812_program, &report);
///     while (f2812_shim_run(shim, sched->now + EMU_PS_PER_S) == F2812_REACHED) { ... }
///
/// A reset of the device (watchdog, /XRS) starts the program again from main(), its variables as they were loaded.
/// One shim runs at a time in a process, and a program has one shim: its variables are the process's.
/// SPDX-License-Identifier: MIT
#ifndef F2812_SHIM_H_INCLUDED
#define F2812_SHIM_H_INCLUDED
#include "emu_f2812/f2812.h"
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

/// A register object of the firmware, such as SciaRegs.
typedef struct f2812_object_t
{
    void* at;         ///< NULL: the firmware has none
    uint16_t address; ///< word address on the device
    uint16_t words;
} f2812_object_t;

/// What f2812-cc makes of firmware: one object file with this as its only name.
typedef struct f2812_program_t
{
    const char* name;
    void (*main)(void);
    uint8_t *data, *data_end;      ///< the firmware's variables, as loaded
    const f2812_object_t* objects; ///< object_count of them
    size_t object_count;
    void (**vectors)(void); ///< PieVectTable: F2812_VECTORS entries; NULL: the firmware has none
} f2812_program_t;

typedef enum f2812_stop_t
{
    F2812_REACHED, ///< the instant asked for
    F2812_BROKEN,  ///< f2812_shim_break()
    F2812_ENDED    ///< ESTOP0, main() returned, or the firmware did what cannot go on (reported)
} f2812_stop_t;

/// Counts since creation.
typedef struct f2812_shim_stats_t
{
    uint64_t accesses;   ///< of volatile objects, registers among them
    uint64_t blocks;     ///< basic blocks
    uint64_t turns;      ///< turns of loops, those passed over among them
    uint64_t skipped;    ///< turns passed over in waiting
    uint64_t interrupts; ///< taken
    uint64_t starts;     ///< of main()
} f2812_shim_stats_t;

typedef struct f2812_shim_t f2812_shim_t;

/// \param[in] report  where guest errors go; put may be NULL. \return NULL: no memory, or the program has a shim already.
EMU_API f2812_shim_t* f2812_shim_create(f2812_t* device, emu_sched_t* sched, const f2812_program_t* program,
                                        const emu_report_t* report);
EMU_API void f2812_shim_destroy(f2812_shim_t* self);
/// Let the firmware run until sched->now is exactly `until` and everything due up to then has happened, or it stops before.
EMU_API f2812_stop_t f2812_shim_run(f2812_shim_t* self, emu_time_t until);
/// From an observer or an event: f2812_shim_run() returns F2812_BROKEN at the present instant, at the firmware's next hook.
EMU_API void f2812_shim_break(f2812_shim_t* self);
/// From an event: the run that is going on ends at that instant, if it would not before.
EMU_API void f2812_shim_end_by(f2812_shim_t* self, emu_time_t until);
/// After F2812_REACHED: the firmware waits, and does nothing before the queue's next event.
EMU_API bool f2812_shim_waiting(const f2812_shim_t* self);
/// Off: every turn of a waiting loop is executed. The same octets come at the same instants, later. On at first.
EMU_API void f2812_shim_set_skip(f2812_shim_t* self, bool on);
/// Why it ended: "ESTOP0", "main() returned", or the error. NULL before.
EMU_API const char* f2812_shim_end(const f2812_shim_t* self);
EMU_API const f2812_shim_stats_t* f2812_shim_stats(const f2812_shim_t* self);

#ifdef __cplusplus
}
#endif
#endif // F2812_SHIM_H_INCLUDED
