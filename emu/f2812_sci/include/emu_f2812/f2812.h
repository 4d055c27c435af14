/// \file   emu_f2812/f2812.h
/// \brief  TMS320F2812 around its CPU: registers, clock tree, watchdog, timers, GPIO, PIE and interrupt flow, both SCIs (TI SPRS174, SPRU078).
///
///     f2812_config_t config;
///     emu_sched_t sched;
///     f2812_default_config(&config);
///     emu_sched_init(&sched);
///     f2812_t* const dsp = f2812_create(&config, &sched);
///     f2812_set_eallow(dsp, true);
///     f2812_write(dsp, 0x7021, 10); // PLLCR: 150 MHz, after 131072 OSCCLK
///     f2812_advance(dsp, 100);      // cycles of SYSCLKOUT that the program takes
///     if (f2812_interrupt_pending(dsp))
///     {
///         f2812_context_t saved;
///         const int vector = f2812_take_interrupt(dsp, &saved); // 96: SCIRXINTA. Run its function, then
///         f2812_iret(dsp, &saved);
///     }
///
/// There is no CPU in here: whoever runs the program says which registers it accesses and how many cycles pass. Addresses are those of
/// 16-bit words. Time is the cycle of SYSCLKOUT, counted from create; what happens by itself happens at its exact instant and is seen
/// by the first cycle at or after it.
/// SPDX-License-Identifier: MIT
#ifndef EMU_F2812_F2812_H_INCLUDED
#define EMU_F2812_F2812_H_INCLUDED
#include "emu/sched.h"
#include "emu/wire.h"
#include "emu_f2812/f2812_config.h"
#ifdef __cplusplus
extern "C" {
#endif

#define F2812_VECTORS      128u ///< entries of the PIE vector table: entry n is at 0D00 + 2 n
#define F2812_VECTOR_RESET 0
#define F2812_VECTOR_INT13 13
#define F2812_VECTOR_INT14 14
#define F2812_VECTOR_PIE   32 ///< INT1.1; INTx.y is entry 32 + 8 (x - 1) + y - 1
#define F2812_NO_VECTOR    (-1)

typedef struct f2812_t f2812_t;

typedef enum f2812_reset_t
{
    F2812_RESET_XRS,     ///< power-up, or the pin /XRS
    F2812_RESET_WATCHDOG ///< WDCR.WDFLAG is set
} f2812_reset_t;

/// What the CPU has of interrupts.
typedef struct f2812_cpu_t
{
    uint16_t ier, ifr; ///< bit 0: INT1 ... bit 13: INT14, DLOGINT, RTOSINT
    bool intm;         ///< ST1: interrupts off
    bool dbgm;         ///< ST1: debug events off
    bool eallow;       ///< ST1: protected registers may be written
} f2812_cpu_t;

/// What an interrupt saves and IRET brings back.
typedef struct f2812_context_t
{
    uint16_t ier;
    bool intm, dbgm, eallow;
    uint8_t vector;
} f2812_context_t;

/// The device has just been reset by power-up; it takes sched->earlier for itself. \return NULL when memory is out, or for a crystal
/// outside F2812_OSCCLK_HZ_MIN .. F2812_OSCCLK_HZ_MAX.
EMU_API f2812_t* f2812_create(const f2812_config_t* config, emu_sched_t* sched);
/// NULL is allowed. Its events leave the queue.
EMU_API void f2812_destroy(f2812_t* self);
/// All registers to their reset values. The program has to begin anew: f2812_take_interrupt() gives F2812_VECTOR_RESET.
EMU_API void f2812_reset(f2812_t* self, f2812_reset_t cause);
/// /XRS is low, from outside or by the watchdog: the CPU stands, pass the time with f2812_skip().
EMU_API bool f2812_in_reset(const f2812_t* self);

/// The program reads a register, with all that comes of it, now.
EMU_API uint16_t f2812_read(f2812_t* self, uint16_t address);
/// The program writes one.
EMU_API void f2812_write(f2812_t* self, uint16_t address, uint16_t value);
/// What f2812_read() would give; nothing comes of it, and no one is told.
EMU_API uint16_t f2812_peek(const f2812_t* self, uint16_t address);

/// Cycles of SYSCLKOUT pass; what is due happens.
EMU_API void f2812_advance(f2812_t* self, uint32_t cycles);
/// The program waits: time goes on to the next event, or to `limit`, EMU_TIME_LOADED_MAX at most. \return the instant; now, if an interrupt
/// is pending.
EMU_API emu_time_t f2812_skip(f2812_t* self, emu_time_t limit);
/// IDLE: as f2812_skip(), up to the first interrupt that IER lets through, whatever INTM is.
EMU_API emu_time_t f2812_idle(f2812_t* self, emu_time_t limit);
/// Instant of the present cycle.
EMU_API emu_time_t f2812_now(f2812_t* self);
/// Cycles of SYSCLKOUT since create.
EMU_API uint64_t f2812_cycle(const f2812_t* self);
/// First cycle in which something happens by itself: until then registers change by what the program does alone, but for counters.
EMU_API uint64_t f2812_due(const f2812_t* self);

/// f2812_take_interrupt() has something to give.
EMU_API bool f2812_interrupt_pending(const f2812_t* self);
/// Take the interrupt of highest priority: its bit of IFR and IER is cleared, INTM and DBGM set, EALLOW cleared, the vector fetched.
/// \return entry of the vector table; F2812_VECTOR_RESET: there was a reset, begin the program anew; F2812_NO_VECTOR: none is pending.
EMU_API int f2812_take_interrupt(f2812_t* self, f2812_context_t* saved);
/// Return from an interrupt: ST1 and IER as they were.
EMU_API void f2812_iret(f2812_t* self, const f2812_context_t* saved);
EMU_API const f2812_cpu_t* f2812_cpu(const f2812_t* self); ///< to look at
EMU_API void f2812_set_ier(f2812_t* self, uint16_t ier);   ///< IER = ier
EMU_API void f2812_set_ifr(f2812_t* self, uint16_t ifr);   ///< IFR = ifr: writing 0 clears a bit
EMU_API void f2812_set_intm(f2812_t* self, bool intm);     ///< SETC INTM, CLRC INTM
EMU_API void f2812_set_dbgm(f2812_t* self, bool dbgm);     ///< SETC DBGM, CLRC DBGM
EMU_API void f2812_set_eallow(f2812_t* self, bool eallow); ///< EALLOW, EDIS

/// A pin: "SCITXDA" "SCIRXDA" "SCITXDB" "SCIRXDB", "XRS", "GPIOA0" .. "GPIOG5" as far as they exist. NULL: no such.
EMU_API emu_wire_t* f2812_wire(f2812_t* self, const char* name);
/// The crystal is off by so many parts per billion, from the present cycle on. |ppb| <= EMU_PPB_MAX.
EMU_API void f2812_set_osc_ppb(f2812_t* self, int32_t ppb);

/// What the program does, as it does it. Either function may be NULL; neither may touch the device.
typedef struct f2812_observer_t
{
    void* ctx;
    /// Value read, or to be written.
    void (*access)(void* ctx, uint16_t address, uint16_t value, bool write, emu_time_t at);
    /// An interrupt was taken, or its IRET executed.
    void (*interrupt)(void* ctx, unsigned vector, bool enter, emu_time_t at);
} f2812_observer_t;

/// The observer is copied; NULL takes it away. Without one nothing is paid for it.
EMU_API void f2812_observe(f2812_t* self, const f2812_observer_t* observer);

#ifdef __cplusplus
}
#endif
#endif // EMU_F2812_F2812_H_INCLUDED
