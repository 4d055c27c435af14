/// \file   cpu/mcs51_state.h
/// \brief  State of one part. Not installed.
///
/// Time: now = horizon - left. The engines only count `left` down and come back when it is below 0; `horizon` is the last cycle
/// before anything can happen by itself. `budget` holds left, and below it the instructions that were executed meanwhile. An instruction
/// reads and writes SFRs and pins at its end (Intel: latch at S6P2 of the last cycle, timers step at S3P1), so inside one, now is its end.
/// SPDX-License-Identifier: MIT
#ifndef MCS51_STATE_H_INCLUDED
#define MCS51_STATE_H_INCLUDED
#include "emu_8051/mcs51.h"

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

enum
{
    TIMERS = 3,
    COUNTING_TH0 = 0x80 ///< in mode 3 of timer 0, by itself
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
    uint8_t tx_passed; ///< bits before tx_bit that have not begun
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
    uint64_t rst_due;                      ///< cycle at which RST has been high long enough
    uint64_t flag_at[IRQ_COUNT];           ///< cycle in which the request flag went up: polled in the next one
    uint64_t gate_at;                      ///< end of the last RETI or write to IE or IP: no vector at this boundary
    uint64_t timer_at[TIMERS];             ///< TL and TH of each are true at this cycle
    uint8_t counting;                      ///< timers that count cycles, by number, and COUNTING_TH0
    uint8_t ask_tcon, ask_scon, ask_t2con; ///< flags there that request an interrupt which could be taken
    uint64_t t1_overflows, t2_overflows;
    uint64_t t2_told;           ///< overflows of timer 2 that the clock on P1.0 shows
    uint64_t overflow_at;       ///< next overflow that requests an interrupt
    uint64_t overflow_boundary; ///< boundary at which it is looked at
    bool overflow_known;        ///< nothing has moved them since
    uint64_t
        attend_at; ///< cycle at which the run loop looks at what is rare: `until`, resets, the watchdog; 0: at once
    uint64_t periph_at;                ///< next cycle at which the ports or the UART do something
    uint64_t tx_at, rx_at, t2_edge_at; ///< of those, the serial port's and the clock's on T2
    uint64_t frozen;                   ///< cycles spent in power-down, in which no clock ran
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

#endif // MCS51_STATE_H_INCLUDED
