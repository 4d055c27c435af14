/// \file   sfr.c
/// \brief  Special function registers of the AT89S51 and AT89S52 (Atmel 2487D, 1919D, table "SFR map") as the engine reads and writes them.
/// SPDX-License-Identifier: MIT
#include "mcs51_internal.h"
#include <limits.h>

// An access is plain memory while left > limit. P: always. F: no event is due yet (registers that only scheduled events change).
// S: never, there are side effects; also for addresses that the part does not have.
#define P     INT32_MIN
#define F     (-1)
#define S     INT32_MAX
#define P8    P, P, P, P, P, P, P, P
#define P64   P8, P8, P8, P8, P8, P8, P8, P8
#define S8    S, S, S, S, S, S, S, S
#define B_ROW P, S, S, S, S, S, S, S

// clang-format off
const int32_t mcs51_read_limit[256] = {
    P64, P64,
    S, P, P, P, P, P, S, P,  S, P, S, S, S, S, P, S, // 80: P0 SP DP0 DP1 PCON, TCON TMOD TL TH AUXR
    S8,                      F, F, S, S, S, S, S, S, // 90: P1, SCON SBUF
    S, S, P, S, S, S, S, S,  B_ROW,                  // A0: P2 AUXR1 WDTRST, IE
    S8,                      B_ROW,                  // B0: P3, IP
    S8, S8,
    S8, S8,                                          // D0: PSW
    B_ROW, S8, B_ROW, S8};                           // E0: ACC, F0: B
const int32_t mcs51_latch_limit[256] = {
    P64, P64,
    P, P, P, P, P, P, S, P,  S, P, S, S, S, S, P, S,
    B_ROW,                   F, F, S, S, S, S, S, S,
    P, S, P, S, S, S, S, S,  B_ROW,
    B_ROW,                   B_ROW,
    S8, S8,
    S8, S8,
    B_ROW, S8, B_ROW, S8};
const int32_t mcs51_write_limit[256] = {
    P64, P64,
    S, P, P, P, P, P, S, S,  S8,
    S8, S8,
    S8, S8,
    S8, S8,
    S8, S8,
    S8, S8,
    B_ROW, S8, B_ROW, S8};
// clang-format on

uint8_t mcs51_psw(const mcs51_t* self)
{
    unsigned parity = self->mem[ACC];
    parity ^= parity >> 4;
    parity ^= parity >> 2;
    parity ^= parity >> 1;
    const unsigned ac = (self->fx >> 4) & 1u, ov = (self->fx >> 7 ^ self->fx >> 8) & 1u;
    return (uint8_t)(self->cy << 7 | ac << 6 | (self->mem[PSW] & 0x3Au) | ov << 2 | (parity & 1u));
}

static bool absent(const mcs51_t* self, unsigned address)
{
    return !((unsigned)self->part->sfrs[(address - 0x80u) >> 3] >> (address & 7u) & 1u);
}

static bool is_port(unsigned address)
{
    return (address & 0xCFu) == P0;
}

static void report_absent(mcs51_t* self, unsigned address)
{
    uint8_t* const seen = &self->absent_sfr[(address - 0x80u) >> 3];
    const uint8_t bit = (uint8_t)(1u << (address & 7u));
    if (!(*seen & bit))
    {
        *seen |= bit;
        mcs51_report(self, EMU_GUEST_ERROR, 0, self->part->no_sfr, address);
    }
}

/// What a register shows of timers; SCON and SBUF only events change.
static void sync_timers(mcs51_t* self, unsigned address, uint64_t now)
{
    switch (address)
    {
    case SCON:
    case SBUF:
        break;
    case TL0:
    case TH0:
    case TL1:
    case TH1:
        mcs51_timer_sync(self, address & 1u, now);
        break;
    default:
        mcs51_timers_sync(self, now);
        break;
    }
}

static uint8_t read_synced(mcs51_t* self, unsigned address)
{
    if (address == PSW)
    {
        return mcs51_psw(self);
    }
    if (absent(self, address))
    {
        report_absent(self, address);
        return MCS51_ABSENT_SFR;
    }
    if (address == WDTRST)
    {
        mcs51_report(self, EMU_GUEST_ERROR, ONCE_WDTRST, "WDTRST is write only", address);
        return MCS51_ABSENT_SFR;
    }
    const uint64_t now = mcs51_now(self);
    if (now > self->until && self->config.sync)
    {
        self->config.sync(self->config.ctx, now);
    }
    mcs51_sync(self, now);
    sync_timers(self, address, now);
    return self->mem[address];
}

/// An octet that is read whole is usually masked afterwards: it counts when nothing drives any of its pins.
static void look_for_floating(mcs51_t* self, unsigned port, unsigned mask)
{
    const unsigned floats = self->config.undriven(self->config.ctx, port) & self->mem[P0 + 0x10u * port] & mask;
    if ((floats == mask) && (floats & ~(unsigned)self->floating[port]))
    {
        self->floating[port] |= (uint8_t)floats;
        mcs51_report(self, EMU_GUEST_ERROR, 0, "read of pins that nothing drives (port << 8 | pins)",
                     port << 8 | floats);
    }
}

uint8_t mcs51_read(mcs51_t* self, unsigned address, unsigned mask)
{
    if (!is_port(address))
    {
        return read_synced(self, address);
    }
    const uint64_t now = mcs51_now(self);
    if (self->config.sync)
    {
        self->config.sync(self->config.ctx, now);
    }
    mcs51_sync(self, now);
    if (self->config.undriven)
    {
        look_for_floating(self, PORT_AT(address), mask);
    }
    return mcs51_port_pins(self, PORT_AT(address));
}

uint8_t mcs51_read_latch(mcs51_t* self, unsigned address)
{
    return read_synced(self, address);
}

/// A request flag that software raises is polled like one that hardware raises: from the next cycle on.
static void write_requests(mcs51_t* self, unsigned address, uint8_t value, uint64_t now)
{
    static const struct
    {
        uint8_t sfr, flags, irq;
    } request[] = {{TCON, 0x02, IRQ_INT0},
                   {TCON, 0x20, IRQ_T0},
                   {TCON, 0x08, IRQ_INT1},
                   {TCON, 0x80, IRQ_T1},
                   {SCON, SCON_RI | SCON_TI, IRQ_SERIAL},
                   {T2CON, T2CON_TF2 | T2CON_EXF2, IRQ_T2}};
    const uint8_t old = self->mem[address];
    for (unsigned i = 0; i < sizeof request / sizeof request[0]; ++i)
    {
        if (request[i].sfr == address && (value & request[i].flags) && !(old & request[i].flags))
        {
            self->flag_at[request[i].irq] = now;
        }
    }
    self->mem[address] = value;
}

static void write_watchdog(mcs51_t* self, uint8_t value, uint64_t now)
{
    if (value == 0xE1u && self->wdt_armed)
    {
        self->wdt_due = now + MCS51_WDT_CYCLES;
        self->attend_at = self->wdt_due < self->attend_at ? self->wdt_due : self->attend_at;
        mcs51_look_ahead(self, now);
    }
    self->wdt_armed = value == 0x1Eu;
}

/// Registers that leave timers and serial port as they are. \return whether this write is of that kind.
static bool write_quiet(mcs51_t* self, unsigned address, uint8_t value, uint64_t now)
{
    switch (address)
    {
    case IE:
    case IP:
        self->mem[address] = value;
        self->gate_at = now;
        self->overflow_known = false;
        mcs51_requests_change(self);
        mcs51_look_ahead(self, now);
        return true;
    case PSW:
        self->mem[PSW] = value;
        self->cy = value >> 7;
        self->fx = (value & 0x40u) >> 2 | (value & 0x04u) << 5;
        return true;
    case AUXR1:
        self->mem[AUXR1] = value;
        self->dptr = value & 1u ? DP1L : DP0L;
        return true;
    case WDTRST:
        write_watchdog(self, value, now);
        return true;
    default:
        return false;
    }
}

/// TL or TH of timer 0 or 1.
static void write_count(mcs51_t* self, unsigned address, uint8_t value, uint64_t now)
{
    const unsigned n = address & 1u;
    mcs51_timer_sync(self, n, now);
    self->mem[address] = value;
    self->overflow_known = false;
    if (n == 1)
    {
        mcs51_plan(self);
        mcs51_look_ahead(self, now);
    }
    else
    {
        mcs51_look_at(self, mcs51_overflow_next(self));
    }
}

static void write_serial(mcs51_t* self, unsigned address, uint8_t value, uint64_t now)
{
    const uint8_t old = self->mem[SCON];
    if (address == SBUF) // mem holds the receive buffer
    {
        mcs51_uart_sbuf(self, value, now);
    }
    else
    {
        write_requests(self, SCON, value, now);
        mcs51_uart_scon(self, old, now);
    }
    mcs51_plan(self);
    mcs51_look_at(self, self->periph_at);
    if (mcs51_requested(self))
    {
        mcs51_look_at(self, now + 1u);
    }
}

static void write_power(mcs51_t* self, uint8_t value, uint64_t now)
{
    const bool baud = (value ^ self->mem[PCON]) & PCON_SMOD;
    if (baud)
    {
        mcs51_uart_clock_changes(self, now);
    }
    self->mem[PCON] = value;
    if (baud)
    {
        mcs51_plan(self);
    }
    self->attend_at = value & PCON_PD ? 0 : self->attend_at;
    mcs51_look_at(self, now);
}

/// What decides how timers count: they have counted up to here with the old value.
static void write_mode(mcs51_t* self, unsigned address, uint8_t value, uint64_t now)
{
    const uint8_t old = self->mem[address];
    mcs51_timers_sync(self, now);
    switch (address)
    {
    case TCON:
        write_requests(self, address, value, now);
        mcs51_level_requests(self, now);
        break;
    case T2CON:
        mcs51_uart_clock_changes(self, now);
        write_requests(self, address, value, now);
        mcs51_t2_mode_changed(self, now);
        mcs51_uart_t2con(self, old, now);
        mcs51_requests_change(self);
        break;
    case T2MOD:
        self->mem[address] = value;
        mcs51_t2_mode_changed(self, now);
        mcs51_requests_change(self);
        break;
    default: // TMOD, AUXR, those of timer 2
        self->mem[address] = value;
        break;
    }
    mcs51_timers_mode(self);
    self->overflow_known = false;
    if (address != TCON || ((value ^ old) & TCON_TR1))
    {
        mcs51_plan(self);
    }
    mcs51_look_ahead(self, now);
}

static void write_register(mcs51_t* self, unsigned address, uint8_t value)
{
    const uint64_t now = mcs51_now(self);
    if (absent(self, address))
    {
        report_absent(self, address);
        return;
    }
    mcs51_before_write(self, now);
    switch (address)
    {
    case TL0:
    case TH0:
    case TL1:
    case TH1:
        write_count(self, address, value, now);
        break;
    case SCON:
    case SBUF:
        write_serial(self, address, value, now);
        break;
    case PCON:
        write_power(self, value, now);
        break;
    default:
        if (!write_quiet(self, address, value, now))
        {
            write_mode(self, address, value, now);
        }
        break;
    }
}

void mcs51_write(mcs51_t* self, unsigned address, uint8_t value)
{
    if (is_port(address))
    {
        mcs51_write_port(self, address, value);
    }
    else
    {
        write_register(self, address, value);
    }
}
