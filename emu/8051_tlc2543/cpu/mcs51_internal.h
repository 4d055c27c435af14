/// \file   cpu/mcs51_internal.h
/// \brief  What the files of a part offer each other, and what the data sheets leave open. Not installed.
/// SPDX-License-Identifier: MIT
#ifndef MCS51_INTERNAL_H_INCLUDED
#define MCS51_INTERNAL_H_INCLUDED
#include "mcs51_state.h"
#include "registers.h"

#define MCS51_NEVER UINT64_MAX

/// What the data sheet leaves open, chosen once and named here.
#define MCS51_ABSENT_SFR 0xFFu ///< read of an SFR address that the part does not have (silicon: undefined)
#define MCS51_ABSENT_RAM 0xFFu ///< indirect read of 80..FF, where a 128-octet part has no RAM (silicon: undefined)
#define MCS51_ABSENT_CODE                                                                                              \
    0xA5u ///< code fetched where there is none: the reserved opcode, so that a runaway shows at once
#define MCS51_ABSENT_XRAM 0xFFu  ///< MOVX reads where there is no external RAM
#define MCS51_WDT_CYCLES  16383u ///< overflow of the 14-bit watchdog, from the cycle in which it was last cleared
#define MCS51_WDT_RESET   9u     ///< 98 oscillator periods of RST, in whole machine cycles

/// Reports given once after each reset.
enum
{
    ONCE_A5 = 1,
    ONCE_CODE = 2,
    ONCE_RAM = 4,
    ONCE_XRAM = 8,
    ONCE_WDTRST = 16,
    ONCE_STACK = 32,
    ONCE_BUS = 64
};

/// In units of budget: cycles, and instructions executed in them.
#define MCS51_SPENT(cycles, n) ((int64_t)(cycles) * (INT64_C(1) << 32) - (int64_t)(n))
static inline int32_t mcs51_left(const mcs51_t* self)
{
    return (int32_t)(self->budget >> 32);
}
static inline uint64_t mcs51_now(const mcs51_t* self)
{
    return self->horizon - (uint64_t)(int64_t)mcs51_left(self);
}
static inline void mcs51_set_left(mcs51_t* self, int64_t left)
{
    self->budget = left * (INT64_C(1) << 32) + (uint32_t)self->budget;
}

/// An SFR is plain memory to the engine while left > limit.
extern const int32_t mcs51_read_limit[256], mcs51_latch_limit[256], mcs51_write_limit[256];
uint8_t mcs51_read(mcs51_t* self, unsigned address, unsigned mask); ///< of it, only `mask` matters to the instruction
uint8_t mcs51_read_latch(mcs51_t* self, unsigned address);          ///< for read-modify-write
void mcs51_write(mcs51_t* self, unsigned address, uint8_t value);
void mcs51_write_port(mcs51_t* self, unsigned address, uint8_t value);
uint8_t mcs51_psw(const mcs51_t* self);

int mcs51_memory_create(mcs51_t* self);                    ///< of the size that the configuration says; 0, or -1
void mcs51_memory_clear(mcs51_t* self);                    ///< RAM, external too
void mcs51_memory_randomise(mcs51_t* self, uint64_t seed); ///< internal RAM; 0: as it is
uint8_t mcs51_absent_ram(mcs51_t* self, unsigned address);
uint8_t mcs51_absent_code(mcs51_t* self, unsigned address);
uint8_t mcs51_xread(mcs51_t* self, unsigned address);
void mcs51_xwrite(mcs51_t* self, unsigned address, uint8_t value);
void mcs51_push_beyond(mcs51_t* self, unsigned address, uint8_t value); ///< the stack is past stack_top
uint32_t mcs51_image_term(unsigned address, uint8_t octet);
void mcs51_reserved_opcode(mcs51_t* self);
void mcs51_report(mcs51_t* self, emu_report_kind_t kind, uint32_t once, const char* text, uint32_t detail);

/// A reset that was asked for, or RST. \return whether one was made.
bool mcs51_reset_due(mcs51_t* self, uint64_t now);
void mcs51_watchdog_reset(mcs51_t* self);

/// Come back to the run loop at the first instruction boundary at or after `cycle`.
void mcs51_look_at(mcs51_t* self, uint64_t cycle);
/// Find the horizon anew, after anything that can move it, at the end of an instruction.
void mcs51_look_ahead(mcs51_t* self, uint64_t now);
void mcs51_reti(mcs51_t* self);
/// Find anew which flags can request an interrupt: after a change of IE, IP, what is in service, or the mode of timer 2.
void mcs51_requests_change(mcs51_t* self);
/// An interrupt is requested that the handler in progress does not hold back.
static inline bool mcs51_requested(const mcs51_t* self)
{
    const uint8_t* const mem = self->mem;
    return (mem[TCON] & self->ask_tcon) | (mem[SCON] & self->ask_scon) | (mem[T2CON] & self->ask_t2con);
}
/// Take the request that is due at this boundary. \return whether one was taken (two cycles passed).
bool mcs51_interrupt(mcs51_t* self, uint64_t now);
void mcs51_raise(mcs51_t* self, unsigned irq, unsigned sfr, uint8_t flag, uint64_t at);

/// Fire what ports and UART do by themselves, up to and with cycle t. Timers are brought up to date apart, where they matter.
void mcs51_sync_events(mcs51_t* self, uint64_t t);
static inline void mcs51_sync(mcs51_t* self, uint64_t t)
{
    if (self->periph_at <= t)
    {
        mcs51_sync_events(self, t);
    }
}
/// An instruction that ends at now writes a register.
static inline void mcs51_before_write(mcs51_t* self, uint64_t now)
{
    if (now > self->until && self->config.sync)
    {
        self->config.sync(self->config.ctx, now);
    }
    mcs51_sync(self, now);
}
/// Find periph_at anew, after anything that can move it.
void mcs51_plan(mcs51_t* self);

void mcs51_timer_sync(mcs51_t* self, unsigned n, uint64_t t); ///< timer 0 (with TH0 in mode 3) or 1
void mcs51_timers_sync(mcs51_t* self, uint64_t t);
void mcs51_timers_mode(mcs51_t* self);               ///< TCON, TMOD or a gate has changed
void mcs51_timers_fell(mcs51_t* self, uint8_t fell); ///< falls on T0, T1 were sampled
/// First boundary that an overflow which requests an interrupt can bring; overflow_at becomes the cycle of the overflow.
uint64_t mcs51_overflow_next(mcs51_t* self);
uint64_t mcs51_timer_next(const mcs51_t* self, unsigned n); ///< next overflow that sets TFn
/// \return overflows within k counts; the first is after *first.
uint64_t mcs51_advance(mcs51_counter_t* c, uint64_t k, uint64_t* first);
uint64_t mcs51_t1_time(const mcs51_t* self, uint64_t number); ///< cycle of T1's overflow of that number

void mcs51_t2_sync(mcs51_t* self, uint64_t t);
uint8_t mcs51_t2_requests(const mcs51_t* self); ///< flags of T2CON that request an interrupt
uint64_t mcs51_t2_next(const mcs51_t* self);    ///< next overflow that sets TF2
uint64_t mcs51_t2_time(const mcs51_t* self, uint64_t number);
uint64_t mcs51_t2_edge_time(const mcs51_t* self); ///< of the clock on P1.0
void mcs51_t2_edge(mcs51_t* self, uint64_t at);
void mcs51_t2_sampled(mcs51_t* self, uint8_t pins, uint64_t at);
void mcs51_t2_mode_changed(mcs51_t* self, uint64_t now);

#define PORT_AT(address) ((unsigned)(address) >> 4 & 3u)
static inline uint8_t mcs51_port_drives(const mcs51_t* self, unsigned port)
{
    return (uint8_t)(self->mem[P0 + 0x10u * port] & self->alternate[port]);
}
void mcs51_port_drive(mcs51_t* self, unsigned port, uint64_t at);
uint8_t mcs51_port_pins(const mcs51_t* self, unsigned port);
void mcs51_alternate(mcs51_t* self, unsigned port, uint8_t mask, bool level, uint64_t at);
void mcs51_level_requests(mcs51_t* self, uint64_t at);

void mcs51_uart_reset(mcs51_t* self);
void mcs51_uart_plan(mcs51_t* self); ///< tx_at and rx_at
void mcs51_uart_tx(mcs51_t* self, uint64_t at);
void mcs51_uart_clock_changes(mcs51_t* self, uint64_t now); ///< PCON or T2CON is about to be written
void mcs51_uart_rx(mcs51_t* self, uint64_t at);
void mcs51_uart_pins_change(mcs51_t* self, uint64_t at); ///< p3_sampled is about to
void mcs51_uart_rxd_fell(mcs51_t* self, uint64_t at);
void mcs51_uart_sbuf(mcs51_t* self, uint8_t value, uint64_t now);
void mcs51_uart_scon(mcs51_t* self, uint8_t old, uint64_t now);
void mcs51_uart_t2con(mcs51_t* self, uint8_t old, uint64_t at); ///< RCLK or TCLK may have changed

#endif // MCS51_INTERNAL_H_INCLUDED
