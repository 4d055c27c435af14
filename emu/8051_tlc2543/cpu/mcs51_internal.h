/// \file   cpu/mcs51_internal.h
/// \brief  State of one part and what its files offer each other. Not installed.
///
/// Time: now = horizon - left. The engines only count `left` down and come back when it is below 0; `horizon` is the last cycle
/// before anything can happen by itself. `budget` holds left, and below it the instructions that were executed meanwhile. An instruction reads and writes SFRs and pins at its end (Intel: latch at S6P2 of the last
/// cycle, timers step at S3P1), so inside one, now is its end.
/// SPDX-License-Identifier: MIT
#ifndef MCS51_INTERNAL_H_INCLUDED
#define MCS51_INTERNAL_H_INCLUDED
#include "emu_8051/mcs51.h"
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

/// Interrupt sources in polling order; bit n of IE and IP; vector 8 n + 3.
enum
{
    IRQ_INT0,
    IRQ_T0,
    IRQ_INT1,
    IRQ_T1,
    IRQ_SERIAL,
    IRQ_T2,
    IRQ_COUNT
};

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

typedef struct mcs51_part_info_t
{
    uint32_t flash_octets, ram_octets;
    const uint8_t* sfrs; ///< bitmap of 80..FF
    const char *no_ram, *no_sfr, *no_code;
} mcs51_part_info_t;

typedef enum mcs51_reset_t
{
    RESET_NONE,
    RESET_PIN,
    RESET_POWER,
    RESET_BROWN_OUT
} mcs51_reset_t;

typedef enum uart_rx_state_t
{
    RX_IDLE,   ///< looking for a fall of RXD
    RX_WATCH,  ///< RXD fell: start at the next tick if it is still low
    RX_SAMPLE, ///< sampling bits at 7, 8, 9 of 16 ticks
    RX_WAIT,   ///< modes 2, 3: the stop bit
    RX_SHIFT   ///< mode 0
} uart_rx_state_t;

typedef struct mcs51_counter_t
{
    uint64_t left;   ///< counts to the next overflow
    uint64_t period; ///< counts from one overflow to the next
} mcs51_counter_t;

/// Due times count ticks of the baud clock: cycles (mode 0), half oscillator periods of 6 a cycle (mode 2), overflows of T1 or T2 (modes
/// 1, 3).
typedef struct uart_t
{
    uint64_t tx_due, rx_due; ///< MCS51_NEVER: nothing under way
    uint32_t tx_frame, rx_frame;
    uint8_t tx_bit, tx_bits, rx_bit, rx_samples, rx_votes;
    uart_rx_state_t rx_state;
} uart_t;

/// Where the fast engine goes on, if its handlers return; ip NULL: back to the run loop.
typedef struct mcs51_next_t
{
    const struct entry_t* ip;
    uint32_t a, cy, fx;
    uint8_t* bank;
} mcs51_next_t;

struct mcs51_t
{
    mcs51_config_t config;
    uint64_t horizon, until, instructions, interrupts, passes;
    int64_t budget; ///< left * 2^32 + instructions that `instructions` does not hold
    uint32_t pc;
    uint32_t cy; ///< 0 or 1
    uint32_t fx; ///< a ^ x ^ result of the last sum: AC is bit 4, OV is bit 7 ^ bit 8
    uint8_t
        mem[384]; ///< 00-7F RAM, 80-FF SFR latches, 100-17F RAM at 80-FF; ACC is kept here, CY AC OV P of PSW are not
    uint32_t ram_octets, code_octets;
    uint32_t stack_top; ///< a push to 1..stack_top needs no look
    uint8_t dptr;       ///< DP0L or DP1L, as AUXR1 selects
    uint8_t in_service; ///< bit 0 low, bit 1 high priority
    bool self_jump, halted;
    bool running;  ///< inside mcs51_run
    bool in_reset; ///< RST is held high
    mcs51_reset_t reset_request;
    uint64_t reset_seed;
    uint64_t rst_due;            ///< cycle at which RST has been high long enough
    uint64_t flag_at[IRQ_COUNT]; ///< cycle in which the request flag went up: polled in the next one
    uint64_t gate_at;            ///< end of the last RETI or write to IE or IP: no vector at this boundary
    uint64_t timer_at;           ///< TL0 TH0 TL1 TH1 are true at this cycle
    uint64_t t1_overflows, t2_overflows;
    uint64_t t2_told;           ///< overflows of timer 2 that the clock on P1.0 shows
    uint64_t overflow_at;       ///< next overflow that requests an interrupt
    uint64_t overflow_boundary; ///< boundary at which it is looked at
    bool overflow_known;        ///< nothing has moved them since
    uint64_t periph_at;         ///< next cycle at which the ports or the UART do something
    uint64_t tx_at, t2_edge_at; ///< of those, the transmitter's and the clock's on T2
    uint64_t frozen;            ///< cycles spent in power-down, in which no clock ran
    uint64_t wdt_due;
    bool wdt_armed; ///< 1Eh was written to WDTRST
    uint8_t outside[4], out[4];
    uint8_t alternate[4]; ///< alternate outputs: P3 TXD, and RXD in mode 0; P1.0 the clock of timer 2
    uint8_t p3_sampled, p1_sampled;
    uint8_t p1_watched; ///< pins of P1 that timer 2 looks at
    uint64_t pins_due;  ///< cycle at which a change on P3 or P1 has been sampled
    uart_t uart;
    uint32_t once;
    uint8_t absent_sfr[16]; ///< bitmap: reported since reset
    uint8_t floating[4];    ///< pins, likewise
    const mcs51_part_info_t* part;
    uint8_t* xdata; ///< NULL: none
    mcs51_observer_t observer;
    uint32_t breaks;    ///< breakpoints set
    uint32_t passed_pc; ///< the run stopped at this breakpoint: the instruction is executed next time; NO_PC
    bool covering;
    bool watched;  ///< by an observer, a breakpoint or for coverage
    bool observed; ///< the plain engine runs
    bool stop;     ///< return MCS51_STOPPED at the next boundary
    bool no_spin;
    struct entry_t* entries; ///< of the fast engine, by address, and MCS51_BEYOND more
    mcs51_next_t next;
    uint8_t marks[65536];
    uint8_t code[65536];
    uint8_t image[65536]; ///< code as it was loaded
    uint32_t image_sum;   ///< of mcs51_image_term()
    bool code_changed;    ///< mcs51_set_code() was used
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
/// Take the request that is due at this boundary. \return whether one was taken (two cycles passed).
/// If none, *next is mcs51_interrupt_next().
bool mcs51_interrupt(mcs51_t* self, uint64_t now, uint64_t* next);
/// First boundary at which a request can be taken that cannot be taken now, or MCS51_NEVER.
uint64_t mcs51_interrupt_next(mcs51_t* self, uint64_t now);
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

void mcs51_timers_sync(mcs51_t* self, uint64_t t);
void mcs51_timers_fell(mcs51_t* self, uint8_t fell); ///< falls on T0, T1 were sampled
/// First boundary that an overflow which requests an interrupt can bring; overflow_at becomes the cycle of the overflow.
uint64_t mcs51_overflow_next(mcs51_t* self);
uint64_t mcs51_timer_next(const mcs51_t* self, unsigned n); ///< next overflow that sets TFn
/// \return overflows within k counts; the first is after *first.
uint64_t mcs51_advance(mcs51_counter_t* c, uint64_t k, uint64_t* first);
uint64_t mcs51_t1_time(const mcs51_t* self, uint64_t number); ///< cycle of T1's overflow of that number

void mcs51_t2_sync(mcs51_t* self, uint64_t from, uint64_t cycles);
uint8_t mcs51_t2_requests(const mcs51_t* self); ///< flags of T2CON that request an interrupt
uint64_t mcs51_t2_next(const mcs51_t* self);    ///< next overflow that sets TF2
uint64_t mcs51_t2_time(const mcs51_t* self, uint64_t number);
uint64_t mcs51_t2_edge_time(const mcs51_t* self); ///< of the clock on P1.0
void mcs51_t2_edge(mcs51_t* self, uint64_t at);
void mcs51_t2_sampled(mcs51_t* self, uint8_t pins, uint64_t at);
void mcs51_t2_mode_changed(mcs51_t* self, uint64_t now);

void mcs51_port_drive(mcs51_t* self, unsigned port, uint64_t at);
uint8_t mcs51_port_pins(const mcs51_t* self, unsigned port);
void mcs51_alternate(mcs51_t* self, unsigned port, uint8_t mask, bool level, uint64_t at);
void mcs51_level_requests(mcs51_t* self, uint64_t at);
void mcs51_pins_sample(mcs51_t* self, uint64_t at);

void mcs51_uart_reset(mcs51_t* self);
uint64_t mcs51_uart_tx_time(const mcs51_t* self);
uint64_t mcs51_uart_rx_time(const mcs51_t* self);
void mcs51_uart_tx(mcs51_t* self, uint64_t at);
void mcs51_uart_clock_changes(mcs51_t* self); ///< PCON or T2CON is about to be written; the timers are synced
void mcs51_uart_rx(mcs51_t* self, uint64_t at);
void mcs51_uart_rxd_fell(mcs51_t* self);
void mcs51_uart_sbuf(mcs51_t* self, uint8_t value, uint64_t now);
void mcs51_uart_scon(mcs51_t* self, uint8_t old, uint64_t now);
void mcs51_uart_t2con(mcs51_t* self, uint8_t old); ///< RCLK or TCLK may have changed

#endif // MCS51_INTERNAL_H_INCLUDED
