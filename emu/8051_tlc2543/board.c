/// The wiring of the acquisition board (Zheng and Zhou 2010, figure 3): every pin of an MCS-51 as a net, and TLC2543s on some of them.
/// SPDX-License-Identifier: MIT
#include "board_internal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CPU   0 ///< driver of each net
#define PROBE 1

/// What a pin is to a converter, as in acq_adc_t.
enum
{
    EOC,
    IO_CLOCK,
    DATA_IN,
    DATA_OUT,
    CS_N,
    ROLES
};

static const struct
{
    const char* name;
    size_t pin; ///< offset in acq_adc_t
} roles[ROLES] = {[EOC] = {"EOC", offsetof(acq_adc_t, eoc)},
                  [IO_CLOCK] = {"I/O CLOCK", offsetof(acq_adc_t, io_clock)},
                  [DATA_IN] = {"DATA IN", offsetof(acq_adc_t, data_in)},
                  [DATA_OUT] = {"DATA OUT", offsetof(acq_adc_t, data_out)},
                  [CS_N] = {"/CS", offsetof(acq_adc_t, cs_n)}};

void acq_board_default_config(acq_board_config_t* config)
{
    *config = (acq_board_config_t){.crystal_hz = 11059200, .adc_count = 1};
    config->adcs[0] =
        (acq_adc_t){.eoc = {1, 0}, .io_clock = {1, 1}, .data_in = {1, 2}, .data_out = {1, 3}, .cs_n = {1, 4}};
    tlc2543_default_config(&config->adc);
}

void acq_board_six_config(acq_board_config_t* config)
{
    acq_board_default_config(config);
    config->adcs[1] = config->adcs[0];
    config->adcs[1].eoc = (acq_pin_t){1, 5};
    config->adcs[1].data_out = (acq_pin_t){1, 6};
    config->adcs[1].first_channel = 3;
    config->adc_count = 2;
}

static acq_pin_t pin_of(const acq_adc_t* adc, unsigned role)
{
    acq_pin_t pin;
    memcpy(&pin, (const char*)adc + roles[role].pin, sizeof pin);
    return pin;
}

/// What the outside puts on a pin, for the CPU.
static void set_outside(acq_net_t* net, bool level, uint64_t cycle)
{
    uint8_t* const outside = &net->board->outside[net->port];
    *outside = (uint8_t)(level ? *outside | net->mask : *outside & ~net->mask);
    mcs51_set_pins(net->board->cpu, net->port, *outside, cycle);
}

static void net_changed(void* ctx, bool level, emu_time_t at)
{
    acq_net_t* const net = ctx;
    acq_board_t* const self = net->board;
    if (!net->driving && !net->cut)
    {
        set_outside(net, level, at == self->synced_at ? self->synced : emu_ticker_tick(&self->clock, at));
    }
}

static void sync_to(void* ctx, uint64_t cycle)
{
    acq_board_t* const self = ctx;
    if (cycle != self->synced)
    {
        self->synced = cycle;
        self->synced_at = emu_ticker_time(&self->clock, cycle);
    }
    emu_sched_advance(self->sched, self->synced_at);
}

static unsigned lowest_bit(unsigned mask)
{
    static const uint8_t bit[11] = {[1] = 0,       [2] = 1,       [4] = 2,       [8] = 3,
                                    [16 % 11] = 4, [32 % 11] = 5, [64 % 11] = 6, [128 % 11] = 7};
    return bit[(mask & (0u - mask)) % 11u];
}

/// Quasi-bidirectional: a 1 is a weak pull-up, on port 0 nothing; a 0 a strong low.
static emu_drive_t drive_of(const acq_net_t* net, bool released)
{
    return net->cut ? EMU_Z : !released ? EMU_STRONG0 : net->port == 0 ? EMU_Z : EMU_WEAK1;
}

/// While the CPU pulls low, what others put there does not matter to it; when it lets go, it does.
static void port_changed(void* ctx, unsigned port, uint8_t out, uint8_t changed, uint64_t cycle)
{
    acq_board_t* const self = ctx;
    sync_to(self, cycle);
    for (unsigned bits = changed; bits != 0; bits &= bits - 1u)
    {
        acq_net_t* const net = &self->nets[port][lowest_bit(bits)];
        const bool released = (out & net->mask) != 0;
        net->driving = true;
        emu_wire_drive(&net->wire, CPU, drive_of(net, released), self->sched->now);
        net->driving = false;
        if (released && !net->cut && net->wire.level != ((self->outside[port] & net->mask) != 0))
        {
            set_outside(net, net->wire.level, cycle);
        }
    }
}

static uint8_t undriven(void* ctx, unsigned port)
{
    acq_board_t* const self = ctx;
    unsigned pins = 0;
    for (unsigned bit = 0; bit < 8; bit++)
    {
        pins |= (unsigned)self->nets[port][bit].wire.floating << bit;
    }
    return (uint8_t)pins;
}

/// The cycle up to which the CPU runs alone.
static uint64_t next_cycle(const acq_board_t* self)
{
    const emu_time_t event = emu_sched_next(self->sched), now = self->sched->now;
    const emu_time_t next = event < self->goal ? event : self->goal;
    return emu_ticker_tick(&self->clock, next < now ? now : next);
}

static void event_earlier(void* ctx, emu_time_t at)
{
    acq_board_t* const self = ctx;
    (void)at;
    if (self->running)
    {
        mcs51_shorten(self->cpu, next_cycle(self));
    }
}

/// The CPU knows no drift: its reports get the board's time.
static void report(void* ctx, emu_report_kind_t kind, const char* text, uint32_t detail, emu_time_t at)
{
    acq_board_t* const self = ctx;
    (void)at;
    self->config.report.put(self->config.report.ctx, kind, text, detail,
                            emu_ticker_time(&self->clock, mcs51_cycle(self->cpu)));
}

static bool good(const acq_board_config_t* config)
{
    bool on_pins = true;
    for (unsigned n = 0; n < config->adc_count && n < ACQ_ADCS_MAX; n++)
    {
        for (unsigned role = 0; role < ROLES; role++)
        {
            const acq_pin_t pin = pin_of(&config->adcs[n], role);
            on_pins = on_pins && pin.port < 4 && pin.bit < 8;
        }
    }
    return on_pins && config->adc_count <= ACQ_ADCS_MAX && config->crystal_hz >= 1 && config->crystal_hz <= 1000000000;
}

static void pin_name(const acq_net_t* net, char name[ACQ_NAME])
{
    (void)snprintf(name, ACQ_NAME, "P%u.%u", (unsigned)net->port, lowest_bit(net->mask));
}

/// Pins of all converters, ROLES a converter.
static void role_name(unsigned i, char name[ACQ_NAME])
{
    (void)snprintf(name, ACQ_NAME, i < ROLES ? "%s" : "%s %u", roles[i % ROLES].name, i / ROLES + 1u);
}

static acq_net_t* net_of(acq_board_t* self, unsigned i)
{
    const acq_pin_t pin = pin_of(&self->config.adcs[i / ROLES], i % ROLES);
    return &self->nets[pin.port][pin.bit];
}

static void make_nets(acq_board_t* self)
{
    for (unsigned i = 0; i < ACQ_PINS; i++)
    {
        acq_net_t* const net = &self->nets[i / 8u][i % 8u];
        *net = (acq_net_t){.board = self, .port = (uint8_t)(i / 8u), .mask = (uint8_t)(1u << i % 8u)};
        pin_name(net, net->name);
        emu_wire_init(&net->wire, net->name, true);
        (void)emu_wire_add_driver(&net->wire);
        (void)emu_wire_add_driver(&net->wire);
        emu_wire_drive(&net->wire, CPU, drive_of(net, true), self->sched->now);
        (void)emu_wire_watch(&net->wire, net_changed, net);
    }
    memcpy(self->nets[3][0].name, "RXD", sizeof "RXD");
    memcpy(self->nets[3][1].name, "TXD", sizeof "TXD");
    for (unsigned i = ROLES * self->config.adc_count; i-- > 0;) // a shared net has its first converter's name
    {
        role_name(i, net_of(self, i)->name);
    }
}

static bool make_adcs(acq_board_t* self)
{
    bool made = true;
    for (unsigned n = 0; n < self->config.adc_count; n++)
    {
        emu_wire_t* wire[ROLES];
        for (unsigned role = 0; role < ROLES; role++)
        {
            wire[role] = &net_of(self, n * ROLES + role)->wire;
        }
        tlc2543_config_t config = self->config.adc;
        config.first_channel = self->config.adcs[n].first_channel;
        self->adcs[n] =
            tlc2543_create(&config, self->sched, wire[EOC], wire[IO_CLOCK], wire[DATA_IN], wire[DATA_OUT], wire[CS_N]);
        made = made && self->adcs[n] != NULL;
    }
    return made;
}

acq_board_t* acq_board_create(const acq_board_config_t* config, emu_sched_t* sched)
{
    acq_board_t* const self = good(config) ? calloc(1, sizeof *self) : NULL;
    if (self == NULL)
    {
        return NULL;
    }
    self->config = *config;
    self->sched = sched;
    const emu_clock_t clock = {.hz = config->crystal_hz, .divider = 12};
    emu_ticker_init(&self->clock, &clock);
    memset(self->outside, 0xFF, sizeof self->outside);
    make_nets(self);
    const mcs51_config_t cpu = {.clock = clock,
                                .port = port_changed,
                                .sync = sync_to,
                                .undriven = undriven,
                                .ctx = self,
                                .report = {config->report.put != NULL ? report : NULL, self},
                                .part = config->part,
                                .code_octets = config->code_octets,
                                .xdata_octets = config->xdata_octets,
                                .stack_limit = config->stack_limit};
    self->cpu = mcs51_create(&cpu);
    if (self->cpu == NULL || !make_adcs(self))
    {
        acq_board_destroy(self);
        return NULL;
    }
    sched->earlier = event_earlier;
    sched->earlier_ctx = self;
    return self;
}

void acq_board_destroy(acq_board_t* self)
{
    if (self != NULL)
    {
        self->sched->earlier = NULL;
        for (unsigned n = 0; n < ACQ_ADCS_MAX; n++)
        {
            tlc2543_destroy(self->adcs[n]);
        }
        mcs51_destroy(self->cpu);
        free(self);
    }
}

mcs51_stop_t acq_board_run(acq_board_t* self, emu_time_t t)
{
    mcs51_stop_t stop = MCS51_RAN;
    sync_to(self, mcs51_cycle(self->cpu));
    while (stop != MCS51_STOPPED && self->synced_at < t)
    {
        self->goal = t;
        self->running = true;
        stop = mcs51_run(self->cpu, next_cycle(self));
        self->running = false;
        sync_to(self, mcs51_cycle(self->cpu));
    }
    if (stop != MCS51_STOPPED)
    {
        emu_sched_advance(self->sched, t);
    }
    return stop;
}

emu_time_t acq_board_time(acq_board_t* self, uint64_t cycle)
{
    return emu_ticker_time(&self->clock, cycle);
}

mcs51_t* acq_board_cpu(acq_board_t* self)
{
    return self->cpu;
}

static acq_net_t* find_net(acq_board_t* self, const char* name)
{
    char other[ACQ_NAME];
    for (unsigned i = 0; i < ACQ_PINS; i++)
    {
        acq_net_t* const net = &self->nets[i / 8u][i % 8u];
        pin_name(net, other);
        if (strcmp(name, net->name) == 0 || strcmp(name, other) == 0)
        {
            return net;
        }
    }
    for (unsigned i = 0; i < ROLES * self->config.adc_count; i++)
    {
        role_name(i, other);
        if (strcmp(name, other) == 0)
        {
            return net_of(self, i);
        }
    }
    return NULL;
}

emu_wire_t* acq_board_wire(acq_board_t* self, const char* name)
{
    acq_net_t* const net = find_net(self, name);
    return net == NULL ? NULL : &net->wire;
}

int acq_board_cut(acq_board_t* self, const char* name, bool cut)
{
    acq_net_t* const net = find_net(self, name);
    if (net == NULL)
    {
        return -1;
    }
    const bool released = (mcs51_port_out(self->cpu, net->port) & net->mask) != 0;
    net->cut = cut;
    emu_wire_drive(&net->wire, CPU, drive_of(net, released), self->sched->now);
    set_outside(net, cut ? net->port != 0 || net->wire.level : net->wire.level, mcs51_cycle(self->cpu));
    return 0;
}

bool acq_board_pin(const acq_board_t* self, unsigned port, unsigned bit)
{
    return self->nets[port][bit].wire.level;
}

void acq_board_drive_pin(acq_board_t* self, unsigned port, unsigned bit, emu_drive_t drive)
{
    emu_wire_drive(&self->nets[port][bit].wire, PROBE, drive, self->sched->now);
}

void acq_board_set_crystal(acq_board_t* self, int32_t ppb)
{
    emu_ticker_rate(&self->clock, mcs51_cycle(self->cpu), ppb);
    event_earlier(self, self->sched->now);
}
