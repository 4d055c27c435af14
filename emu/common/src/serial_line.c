/// A line that copies one wire to another with declared faults. Bit slots lie on a fixed grid of 1/baud from the instant of init.
/// SPDX-License-Identifier: MIT
#include "emu/random.h"
#include "emu/serial.h"

#define FRAME_SLOTS   9.5   ///< a swallowed frame ends inside its stop bit, so that the next start edge is seen
#define LOOK_AHEAD    65536 ///< slots drawn at a time; keeps a tiny probability from drawing for ever
#define PROBABLE_MOST 0.5

/// A fraction in [0, 1).
static double draw(uint64_t* state)
{
    return (double)(emu_random(state) >> 11) * 0x1p-53;
}

static void update(emu_serial_line_t* self, emu_time_t at)
{
    const bool level = self->cut || self->swallowing || self->from->level != self->inverted;
    emu_wire_drive(self->to, self->driver, level ? EMU_STRONG1 : EMU_STRONG0, at);
}

static void edge(void* ctx, bool level, emu_time_t at)
{
    emu_serial_line_t* const self = ctx;
    if (self->faults.octet_loss > 0.0 && !level && !self->loss_event.pending)
    {
        self->swallowing = draw(&self->rng) < self->faults.octet_loss;
        self->octets_swallowed += self->swallowing;
        emu_sched_at(self->sched, &self->loss_event, at + (emu_time_t)(FRAME_SLOTS * 1e12 / self->faults.baud + 0.5));
    }
    update(self, at);
}

static void frame_end(void* ctx, emu_time_t at)
{
    emu_serial_line_t* const self = ctx;
    self->swallowing = false;
    update(self, at);
}

static emu_time_t slot_time(const emu_serial_line_t* self)
{
    return self->slot_origin + (emu_time_t)((double)self->slot * 1e12 / self->faults.baud + 0.5);
}

static void noise_arm(emu_serial_line_t* self)
{
    emu_sched_at(self->sched, &self->noise_event, slot_time(self));
}

/// At the start of slot self->slot: invert it if it was drawn, and look for the next.
static void noise(void* ctx, emu_time_t at)
{
    emu_serial_line_t* const self = ctx;
    self->inverted = self->hit;
    self->slots_inverted += self->hit;
    update(self, at);
    self->hit = false;
    const unsigned most = self->inverted ? 1 : LOOK_AHEAD;
    for (unsigned i = 0; i < most && !self->hit; i++)
    {
        self->slot++;
        self->hit = draw(&self->rng) < self->faults.bit_error;
    }
    noise_arm(self);
}

static void cut_edge(void* ctx, emu_time_t at)
{
    emu_serial_line_t* const self = ctx;
    self->cut = !self->cut;
    if (self->cut)
    {
        emu_sched_at(self->sched, &self->cut_event, self->faults.cuts[self->next_cut].to);
    }
    else if (++self->next_cut < self->faults.cut_count)
    {
        emu_sched_at(self->sched, &self->cut_event, self->faults.cuts[self->next_cut].from);
    }
    update(self, at);
}

static bool probability(double p)
{
    return p >= 0.0 && p <= PROBABLE_MOST;
}

static bool baud_known(const emu_serial_faults_t* faults)
{
    const bool needed = faults->bit_error > 0.0 || faults->octet_loss > 0.0;
    return !needed || (faults->baud >= EMU_BAUD_MIN && faults->baud <= EMU_BAUD_MAX);
}

static bool cuts_sorted(const emu_serial_faults_t* faults)
{
    emu_time_t last = -1;
    for (unsigned i = 0; i < faults->cut_count; i++)
    {
        if (faults->cuts[i].from <= last || faults->cuts[i].to <= faults->cuts[i].from)
        {
            return false;
        }
        last = faults->cuts[i].to;
    }
    return true;
}

int emu_serial_line_init(emu_serial_line_t* self, emu_sched_t* sched, emu_wire_t* from, emu_wire_t* to,
                         const emu_serial_faults_t* faults)
{
    *self = (emu_serial_line_t){
        .sched = sched,
        .from = from,
        .to = to,
        .faults = *faults,
        .noise_event = {.fire = noise, .ctx = self},
        .cut_event = {.fire = cut_edge, .ctx = self},
        .loss_event = {.fire = frame_end, .ctx = self},
        .rng = faults->seed,
        .slot_origin = sched->now,
    };
    if (!probability(faults->bit_error) || !probability(faults->octet_loss) || !cuts_sorted(faults) ||
        !baud_known(faults) || emu_wire_watch(from, edge, self) != 0)
    {
        return -1;
    }
    self->driver = emu_wire_add_driver(to);
    if (self->driver < 0)
    {
        return -1;
    }
    if (faults->bit_error > 0.0)
    {
        self->hit = draw(&self->rng) < faults->bit_error;
        noise_arm(self);
    }
    if (faults->cut_count > 0)
    {
        emu_sched_at(sched, &self->cut_event, faults->cuts[0].from);
    }
    update(self, sched->now);
    return 0;
}

static bool on_grid(const emu_serial_line_t* self)
{
    const double slots_ps = (double)self->slot * 1e12 / self->faults.baud;
    return !self->noise_event.pending || (emu_state_time(self->slot_origin) && slots_ps < (double)EMU_TIME_LOADED_MAX &&
                                          self->noise_event.at == slot_time(self));
}

void emu_serial_line_state(emu_serial_line_t* self, emu_state_t* io)
{
    uint32_t next_cut = self->next_cut;
    emu_state_tag(io, "LINE", 1);
    emu_event_state(self->sched, &self->noise_event, io);
    emu_event_state(self->sched, &self->cut_event, io);
    emu_event_state(self->sched, &self->loss_event, io);
    emu_state_u64(io, &self->rng);
    emu_state_bool(io, &self->inverted);
    emu_state_bool(io, &self->cut);
    emu_state_bool(io, &self->swallowing);
    emu_state_u32(io, &next_cut);
    emu_state_i64(io, &self->slot_origin);
    emu_state_u64(io, &self->slot);
    emu_state_bool(io, &self->hit);
    emu_state_u64(io, &self->slots_inverted);
    emu_state_u64(io, &self->octets_swallowed);
    emu_state_check(io, next_cut < self->faults.cut_count ||
                            (next_cut == self->faults.cut_count && !self->cut_event.pending));
    emu_state_check(io, on_grid(self));
    self->next_cut = io->bad ? self->next_cut : next_cut;
}
