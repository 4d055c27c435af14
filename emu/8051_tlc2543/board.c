/// The wiring of the acquisition board (Zheng and Zhou 2010, figure 3): seven nets between an AT89S51 and a TLC2543 and the outside.
/// SPDX-License-Identifier: MIT
#include "emu_8051/acq_board.h"
#include <stdlib.h>
#include <string.h>

#define NETS (sizeof pins / sizeof pins[0])

static const struct
{
    const char* name;
    uint8_t port, bit;
} pins[] = {{"EOC", 1, 0}, {"I/O CLOCK", 1, 1}, {"DATA IN", 1, 2}, {"DATA OUT", 1, 3},
            {"/CS", 1, 4}, {"RXD", 3, 0},       {"TXD", 3, 1}};

typedef struct net_t
{
    acq_board_t* board;
    unsigned port, mask;
    emu_wire_t wire;
    int driver, probe; ///< the CPU's, and acq_board_drive_pin()'s
} net_t;

struct acq_board_t
{
    emu_clock_t clock;
    emu_sched_t* sched;
    mcs51_t* cpu;
    tlc2543_t* adc;
    net_t nets[NETS];
    uint8_t outside[4];
};

void acq_board_default_config(acq_board_config_t* config)
{
    *config = (acq_board_config_t){.crystal_hz = 11059200};
    tlc2543_default_config(&config->adc);
}

static void net_changed(void* ctx, bool level, emu_time_t at)
{
    const net_t* const net = ctx;
    uint8_t* const outside = &net->board->outside[net->port];
    *outside = (uint8_t)(level ? *outside | net->mask : *outside & ~net->mask);
    mcs51_set_pins(net->board->cpu, net->port, *outside, emu_clock_tick(&net->board->clock, at));
}

static void sync_to(void* ctx, uint64_t cycle)
{
    acq_board_t* const self = ctx;
    emu_sched_advance(self->sched, emu_clock_time(&self->clock, cycle));
}

/// Quasi-bidirectional: a 1 is a weak pull-up, a 0 a strong low.
static void port_changed(void* ctx, unsigned port, uint8_t out, uint8_t changed, uint64_t cycle)
{
    acq_board_t* const self = ctx;
    sync_to(self, cycle);
    for (net_t* net = self->nets; net < self->nets + NETS; net++)
    {
        if (net->port == port && (changed & net->mask) != 0)
        {
            emu_wire_drive(&net->wire, net->driver, (out & net->mask) != 0 ? EMU_WEAK1 : EMU_STRONG0, self->sched->now);
        }
    }
}

static void event_earlier(void* ctx, emu_time_t at)
{
    acq_board_t* const self = ctx;
    mcs51_shorten(self->cpu, emu_clock_tick(&self->clock, at));
}

acq_board_t* acq_board_create(const acq_board_config_t* config, emu_sched_t* sched)
{
    const bool crystal = config->crystal_hz >= 1 && config->crystal_hz <= 1000000000;
    acq_board_t* const self = crystal ? calloc(1, sizeof *self) : NULL;
    if (self == NULL)
    {
        return NULL;
    }
    self->clock = (emu_clock_t){.hz = config->crystal_hz, .divider = 12};
    self->sched = sched;
    const mcs51_config_t cpu = {.clock = self->clock,
                                .port = port_changed,
                                .sync = sync_to,
                                .ctx = self,
                                .report = config->report,
                                .part = config->part,
                                .code_octets = config->code_octets,
                                .xdata_octets = config->xdata_octets,
                                .stack_limit = config->stack_limit};
    self->cpu = mcs51_create(&cpu);
    memset(self->outside, 0xFF, sizeof self->outside);
    for (unsigned i = 0; i < NETS; i++)
    {
        net_t* const net = &self->nets[i];
        *net = (net_t){.board = self, .port = pins[i].port, .mask = 1u << pins[i].bit};
        emu_wire_init(&net->wire, pins[i].name, true);
        net->driver = emu_wire_add_driver(&net->wire);
        emu_wire_drive(&net->wire, net->driver, EMU_WEAK1, sched->now);
        net->probe = emu_wire_add_driver(&net->wire);
        emu_wire_watch(&net->wire, net_changed, net);
    }
    self->adc =
        tlc2543_create(&config->adc, sched, acq_board_wire(self, "EOC"), acq_board_wire(self, "I/O CLOCK"),
                       acq_board_wire(self, "DATA IN"), acq_board_wire(self, "DATA OUT"), acq_board_wire(self, "/CS"));
    if (self->cpu == NULL || self->adc == NULL)
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
        tlc2543_destroy(self->adc);
        mcs51_destroy(self->cpu);
        free(self);
    }
}

mcs51_stop_t acq_board_run(acq_board_t* self, emu_time_t t)
{
    const uint64_t end = emu_clock_tick(&self->clock, t);
    mcs51_stop_t stop = MCS51_RAN;
    while (mcs51_cycle(self->cpu) < end)
    {
        const uint64_t event = emu_clock_tick(&self->clock, emu_sched_next(self->sched));
        stop = mcs51_run(self->cpu, event < end ? event : end);
        sync_to(self, mcs51_cycle(self->cpu));
        if (stop == MCS51_STOPPED)
        {
            return stop;
        }
    }
    emu_sched_advance(self->sched, t);
    return stop;
}

mcs51_t* acq_board_cpu(acq_board_t* self)
{
    return self->cpu;
}

emu_wire_t* acq_board_wire(acq_board_t* self, const char* name)
{
    for (unsigned i = 0; i < NETS; i++)
    {
        if (strcmp(pins[i].name, name) == 0)
        {
            return &self->nets[i].wire;
        }
    }
    return NULL;
}

bool acq_board_pin(const acq_board_t* self, unsigned port, unsigned bit)
{
    return (mcs51_port_out(self->cpu, port) & self->outside[port] & 1u << bit) != 0;
}

void acq_board_drive_pin(acq_board_t* self, unsigned port, unsigned bit, emu_drive_t drive)
{
    const unsigned mask = 1u << bit;
    for (net_t* net = self->nets; net < self->nets + NETS; net++)
    {
        if (net->port == port && net->mask == mask)
        {
            emu_wire_drive(&net->wire, net->probe, drive, self->sched->now);
            return;
        }
    }
    const bool low = drive == EMU_WEAK0 || drive == EMU_STRONG0;
    self->outside[port] = (uint8_t)(low ? self->outside[port] & ~mask : self->outside[port] | mask);
    mcs51_set_pins(self->cpu, port, self->outside[port], mcs51_cycle(self->cpu));
}
