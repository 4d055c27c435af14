/// \file   emu_8051/mcs51.h
/// \brief  MCS-51 CPU with the peripherals of an AT89S51 (Atmel 2487D) or AT89S52 (Atmel 1919D): ports, timers, UART, interrupts,
///         watchdog, dual DPTR, external code and data memory.
///
/// Time is the machine cycle (12 oscillator periods), counted from reset release at create. All pins are levels the outside sets and
/// latches the outside is told about; the UART drives P3.1 and samples P3.0 bit by bit. An instruction reads and writes SFRs and pins
/// at its end; P3 inputs are sampled once a cycle: a change at cycle c acts at c + 1.
/// SPDX-License-Identifier: MIT
#ifndef EMU_8051_MCS51_H_INCLUDED
#define EMU_8051_MCS51_H_INCLUDED
#include "emu/state.h"
#include "emu_8051/mcs51_config.h"
#include <stdbool.h>
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

typedef struct mcs51_t mcs51_t;

typedef enum mcs51_stop_t
{
    MCS51_RAN = 0, ///< reached until_cycle
    MCS51_HALTED, ///< a jump to itself with interrupts off (EA = 0): nothing can ever happen; time still passes if run again
    MCS51_POWER_DOWN, ///< PCON.1: the oscillator is stopped until reset, or INT0 or INT1 enabled; cycles pass, nothing counts
    MCS51_STOPPED ///< by mcs51_stop(), an observer or a breakpoint; run again to go on
} mcs51_stop_t;

/// \return NULL when memory is out, or config asks for a part or a size that there is not.
EMU_API mcs51_t* mcs51_create(const mcs51_config_t* config);
/// NULL is allowed.
EMU_API void mcs51_destroy(mcs51_t* self);
/// Reset: SFRs to their reset values, RAM kept. power_on also clears RAM, external too (see ram_seed), and sets POF. This and the next two
/// are for any instant; called from inside a callback, they take effect at the next instruction boundary.
EMU_API void mcs51_reset(mcs51_t* self, bool power_on);
/// VCC was too low for the part and is back: reset, POF set, RAM random by `seed` or kept if that is 0. External RAM is kept.
EMU_API void mcs51_brown_out(mcs51_t* self, uint64_t seed);
/// Level of the RST pin, now. High for two cycles resets the part and holds it so; it starts when the pin goes low.
EMU_API void mcs51_hold_reset(mcs51_t* self, bool high);
/// Into code memory. \return 0, or -1 if it does not fit (nothing written).
EMU_API int mcs51_load(mcs51_t* self, uint16_t address, const uint8_t* octets, size_t count);

/// Execute instructions until the cycle counter is at or past until_cycle (the last instruction may pass it by up to 3 cycles).
/// Peripheral events (overflow, UART bit) later than until_cycle are left for the next call, so that outside events at that
/// instant come first. Only an instruction that passes it and touches an SFR brings them up to its end, after calling sync.
EMU_API mcs51_stop_t mcs51_run(mcs51_t* self, uint64_t until_cycle);
/// From inside a callback: return from mcs51_run at the next instruction boundary at or after `cycle`, if that is earlier.
EMU_API void mcs51_shorten(mcs51_t* self, uint64_t cycle);
/// Now; exact also inside callbacks (an edge of TXD may be told up to 3 cycles late, with its own cycle in the call).
EMU_API uint64_t mcs51_cycle(const mcs51_t* self);
/// Instructions executed since create.
EMU_API uint64_t mcs51_instructions(const mcs51_t* self);
/// Interrupts taken since create.
EMU_API uint64_t mcs51_interrupts(const mcs51_t* self);
/// Times since create that the CPU came to an event or to a waiting loop, which is what waiting costs the host.
EMU_API uint64_t mcs51_passes(const mcs51_t* self);

/// Levels the outside puts on a port's pins (1 where nothing pulls low). Pin read = latch AND outside. Edges reach INT0/1, T0/1, RXD.
EMU_API void mcs51_set_pins(mcs51_t* self, unsigned port, uint8_t outside, uint64_t cycle);
/// What the port drives now (latch AND alternate output).
EMU_API uint8_t mcs51_port_out(const mcs51_t* self, unsigned port);

/// Save or load everything that a run can change, between two runs. Loading needs a part of the same configuration with the same image
/// loaded, else it is refused (io->bad); observers, breakpoints and coverage are not in it.
EMU_API void mcs51_state(mcs51_t* self, emu_state_t* io);

/// Debug access without side effects, this and all below: program counter, internal RAM, SFRs, code, external RAM.
EMU_API uint16_t mcs51_pc(const mcs51_t* self);
EMU_API void mcs51_set_pc(mcs51_t* self, uint16_t pc);                      ///< the next instruction is fetched there
EMU_API uint8_t mcs51_iram(const mcs51_t* self, uint8_t address);           ///< 00..7F, to FF on the AT89S52
EMU_API void mcs51_set_iram(mcs51_t* self, uint8_t address, uint8_t value); ///< as mcs51_iram
EMU_API uint8_t mcs51_sfr(mcs51_t* self,
                          uint8_t address); ///< 80..FF; ports: the latch; TL, TH: as of until_cycle of the run
EMU_API void mcs51_set_sfr(mcs51_t* self, uint8_t address, uint8_t value);    ///< as mcs51_sfr
EMU_API uint8_t mcs51_code(const mcs51_t* self, uint16_t address);            ///< A5h where there is none
EMU_API void mcs51_set_code(mcs51_t* self, uint16_t address, uint8_t value);  ///< nothing where there is none
EMU_API uint8_t mcs51_xdata(const mcs51_t* self, uint16_t address);           ///< FFh where there is none
EMU_API void mcs51_set_xdata(mcs51_t* self, uint16_t address, uint8_t value); ///< nothing where there is none

typedef enum mcs51_space_t
{
    MCS51_IRAM,  ///< 00..FF of internal RAM, direct or indirect
    MCS51_SFR,   ///< 80..FF
    MCS51_XDATA, ///< MOVX
    MCS51_CODE   ///< MOVC; fetches are not told
} mcs51_space_t;

/// What the program does, as it does it. Any function may be NULL. None may change the CPU but by mcs51_stop() and mcs51_shorten().
typedef struct mcs51_observer_t
{
    void* ctx;
    /// Before each instruction, also one that MCS51_HALTED leaves unexecuted. \return false: mcs51_run() returns MCS51_STOPPED with
    /// it not executed; it is told again in the next run.
    bool (*step)(void* ctx, uint16_t pc, uint64_t cycle);
    /// Data memory and SFRs that the instruction names (A, PSW, SP, pointers as implied operands are not told), and what calls and
    /// interrupts do to the stack. A read-modify-write is told as both. SFRs and pins: value read or written; cycle: of the access.
    void (*access)(void* ctx, mcs51_space_t space, uint16_t address, uint8_t value, bool write, uint64_t cycle);
    /// An interrupt takes the place of the instruction at from_pc; its handler begins 2 cycles later. irq: bit of IE, vector 8 irq + 3.
    void (*vector)(void* ctx, unsigned irq, uint16_t from_pc, uint64_t cycle);
} mcs51_observer_t;

/// The observer is copied; NULL takes it away. Without one nothing is paid for it.
EMU_API void mcs51_observe(mcs51_t* self, const mcs51_observer_t* observer);
/// mcs51_run() returns MCS51_STOPPED at the next instruction boundary: from inside a callback, or before the run.
EMU_API void mcs51_stop(mcs51_t* self);
/// Stop before the instruction at pc is executed, once each time it is reached; running again executes it.
/// \return 0, or -1 where there is no code memory.
EMU_API int mcs51_set_break(mcs51_t* self, uint16_t pc, bool on);
/// On: forget what was covered, and note it from here. Off: what was noted stays.
EMU_API void mcs51_cover(mcs51_t* self, bool on);
/// \return whether an instruction at pc was executed.
EMU_API bool mcs51_covered(const mcs51_t* self, uint16_t pc);
/// Conditional branch at pc: bit 0: was not taken once, bit 1: was taken once. 0 for other instructions.
EMU_API unsigned mcs51_branches(const mcs51_t* self, uint16_t pc);
/// Waiting loops are passed over in one step unless this is off: nothing but speed depends on it. On at create.
EMU_API void mcs51_spin(mcs51_t* self, bool on);

#ifdef __cplusplus
}
#endif
#endif // EMU_8051_MCS51_H_INCLUDED
