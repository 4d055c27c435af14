/// \file   cpu/device.h
/// \brief  State of an F2812, and what its files offer each other. Not installed.
/// SPDX-License-Identifier: MIT
#ifndef F2812_DEVICE_H_INCLUDED
#define F2812_DEVICE_H_INCLUDED
#include "../periph/clock.h"
#include "../sci/sci.h"
#include "emu_f2812/f2812.h"
#include "map.h"

#define F2812_TIMERS    3u
#define F2812_XINTS     2u
#define F2812_SCIS      2u
#define F2812_PORTS     6u ///< A, B, D, E, F, G
#define F2812_PORT_PINS 16u

/// A CPU timer as it was at a cycle.
typedef struct f2812_timer_t
{
    struct f2812_t* device;
    uint64_t at;       ///< cycle
    uint32_t tim, psc; ///< TIMH:TIM and PSCH:PSC then
    emu_event_t event; ///< the next zero, if it interrupts
} f2812_timer_t;

typedef struct f2812_watchdog_t
{
    uint64_t at;            ///< tick of OSCCLK at which the counter was `count` and the prescaler began
    uint8_t count;          ///< WDCNTR then
    bool armed;             ///< the last write of WDKEY was 55h
    bool resets;            ///< it holds /XRS low
    uint64_t overflow_tick; ///< of OSCCLK
    uint64_t pulse_tick;    ///< end of the pulse of /WDRST or /WDINT
    emu_event_t overflow, pulse;
} f2812_watchdog_t;

typedef struct f2812_pin_t
{
    emu_wire_t wire;
    char name[8];  ///< "GPIOA15"; empty: there is no such pin
    uint16_t* dat; ///< GPxDAT, its bit
    uint16_t bit;
    int driver;
} f2812_pin_t;

typedef struct f2812_serial_t
{
    struct f2812_t* device;
    unsigned number; ///< 0: SCI-A
    sci_t sci;
} f2812_serial_t;

struct f2812_t
{
    emu_sched_t* sched;
    uint64_t cycle; ///< of SYSCLKOUT, now
    uint64_t due;   ///< first cycle at which an event is due
    bool pending;   ///< f2812_interrupt_pending()
    bool restart;   ///< there was a reset that the program has not seen
    bool in_reset;  ///< /XRS is low
    bool firing;    ///< within an event
    uint16_t
        unobserved; ///< accesses of addresses below may go by the map alone: F2812_WORDS, or 0 while observer.access is there
    uint32_t told; ///< F2812_ONCE_* since the last reset
    f2812_cpu_t cpu;
    f2812_config_t config;
    f2812_observer_t observer;

    emu_ticker_t osc, sysclk; ///< ticks of OSCCLK, cycles of SYSCLKOUT
    f2812_clock_t lspclk;
    uint16_t clocks;    ///< PCLKCR in force
    uint64_t lock_tick; ///< of OSCCLK: the PLL is locked
    emu_event_t lock, clocks_change;

    f2812_timer_t timer[F2812_TIMERS];
    f2812_watchdog_t watchdog;
    uint64_t xint_edge[F2812_XINTS]; ///< cycle of the last one
    uint16_t latch[F2812_PORTS], outputs[F2812_PORTS];
    f2812_pin_t pin[F2812_PORTS][F2812_PORT_PINS];
    f2812_serial_t serial[F2812_SCIS];
    emu_wire_t xrs;
    int xrs_driver;

    uint16_t mem[F2812_WORDS]; ///< registers, as far as they are memory
    f2812_slot_t map[F2812_WORDS];
};

/// Reports given once after each reset, beside those of an address.
enum
{
    F2812_ONCE_ENPIE = 1,
    F2812_ONCE_LPM = 2,
    F2812_ONCE_OUTSIDE = 4
};

/// sched->now becomes the instant of the present cycle; within an event it is that of the event.
static inline emu_time_t f2812_sync(f2812_t* self)
{
    if (!self->firing)
    {
        self->sched->now = emu_ticker_time(&self->sysclk, self->cycle);
    }
    return self->sched->now;
}

/// cpu/access.c
void f2812_map_reset(f2812_t* self);
void f2812_map_clocks(f2812_t* self); ///< PCLKCR has come into force
/// What a unit does for an access. A write finds sched->now as it is: who needs the time calls f2812_sync().
typedef struct f2812_unit_access_t
{
    uint16_t (*peek)(const f2812_t* self, uint16_t address);
    void (*write)(f2812_t* self, uint16_t address, uint16_t value);
} f2812_unit_access_t;
extern const f2812_unit_access_t f2812_units[F2812_UNITS];
/// An access that is more than memory.
uint16_t f2812_access_read(f2812_t* self, uint16_t address);
void f2812_access_write(f2812_t* self, uint16_t address, uint16_t value);
uint16_t f2812_access_peek(const f2812_t* self, uint16_t address);
/// What there is to say of an address, headed by its name.
void f2812_report(f2812_t* self, emu_report_kind_t kind, uint16_t address, const char* text);
/// The same, once for each bit of `once` after a reset.
void f2812_report_once(f2812_t* self, emu_report_kind_t kind, uint32_t once, uint16_t address, const char* text);

/// cpu/device.c: clocks run at another rate from now on, so whatever is due at a cycle is due at another instant.
void f2812_rate_changed(f2812_t* self);

/// cpu/interrupts.c
void f2812_interrupts_reset(f2812_t* self);
void f2812_update_pending(f2812_t* self);             ///< after any change of ST1, IER, IFR, PIECTRL
void f2812_cpu_request(f2812_t* self, unsigned line); ///< INT(line + 1)

/// cpu/pie.c
void f2812_pie_request(f2812_t* self, unsigned vector);  ///< a pulse of the peripheral that has this entry
unsigned f2812_pie_fetch(f2812_t* self, unsigned group); ///< entry of INT(group + 1), 0 .. 11
void f2812_pie_write(f2812_t* self, uint16_t address, uint16_t value);
void f2812_pie_acknowledge(f2812_t* self, uint16_t address, uint16_t value);

/// periph/sysctl.c: clock tree
void f2812_sysctl_init(f2812_t* self);
void f2812_sysctl_reset(f2812_t* self);
void f2812_sysctl_write(f2812_t* self, uint16_t address, uint16_t value);
void f2812_sysctl_plan(f2812_t* self);
uint64_t f2812_osc_tick(const f2812_t* self); ///< the last tick of OSCCLK up to now

/// periph/watchdog.c
void f2812_watchdog_init(f2812_t* self);
void f2812_watchdog_reset(f2812_t* self, f2812_reset_t cause);
uint16_t f2812_watchdog_peek(const f2812_t* self, uint16_t address);
void f2812_watchdog_write(f2812_t* self, uint16_t address, uint16_t value);
void f2812_watchdog_plan(f2812_t* self);

/// periph/timers.c
void f2812_timers_init(f2812_t* self);
void f2812_timers_reset(f2812_t* self);
uint16_t f2812_timer_peek(const f2812_t* self, uint16_t address);
void f2812_timer_write(f2812_t* self, uint16_t address, uint16_t value);
void f2812_timers_plan(f2812_t* self);

/// periph/gpio.c
void f2812_gpio_init(f2812_t* self);
void f2812_gpio_reset(f2812_t* self);
void f2812_gpio_write(f2812_t* self, uint16_t address, uint16_t value);

/// periph/serial.c
int f2812_serial_init(f2812_t* self); ///< 0; -1: a wire has no room
void f2812_serial_reset(f2812_t* self);
void f2812_serial_clocks(f2812_t* self);        ///< PCLKCR has come into force
void f2812_serial_clock_changed(f2812_t* self); ///< LSPCLK has another rate
void f2812_serial_pins(f2812_t* self);          ///< GPFMUX or GPGMUX was written
uint16_t f2812_serial_read(f2812_t* self, uint16_t address);
/// What a read gives; if `plain`, NULL where it does more than that.
const uint16_t* f2812_serial_value(const f2812_t* self, uint16_t address, bool plain);
void f2812_serial_write(f2812_t* self, uint16_t address, uint16_t value);

/// periph/xint.c
void f2812_xint_init(f2812_t* self);
uint16_t f2812_xint_peek(const f2812_t* self, uint16_t address);

#endif // F2812_DEVICE_H_INCLUDED
