/// The event queue: a sorted list threaded through its owners' events. A board has some ten events, so a list beats a heap.
/// SPDX-License-Identifier: MIT
#include "emu/sched.h"
#include <stddef.h>

void emu_sched_init(emu_sched_t* self)
{
    *self = (emu_sched_t){.order = 1}; // 0 is that of emu_sched_first()
}

void emu_sched_cancel(emu_sched_t* self, emu_event_t* event)
{
    if (!event->pending)
    {
        return;
    }
    emu_event_t** link = &self->head;
    while (*link != event)
    {
        link = &(*link)->next;
    }
    *link = event->next;
    event->pending = false;
}

static bool before(const emu_event_t* a, const emu_event_t* b)
{
    return a->at < b->at || (a->at == b->at && a->order < b->order);
}

static void insert(emu_sched_t* self, emu_event_t* event)
{
    event->pending = true;
    emu_event_t** link = &self->head;
    while (*link != NULL && !before(event, *link))
    {
        link = &(*link)->next;
    }
    event->next = *link;
    *link = event;
}

static void set(emu_sched_t* self, emu_event_t* event, emu_time_t at, uint64_t order)
{
    emu_sched_cancel(self, event);
    event->at = at < self->now ? self->now : at;
    event->order = order;
    insert(self, event);
    if (self->head == event && self->earlier != NULL)
    {
        self->earlier(self->earlier_ctx, event->at);
    }
}

void emu_sched_at(emu_sched_t* self, emu_event_t* event, emu_time_t at)
{
    set(self, event, at, self->order++);
}

void emu_sched_first(emu_sched_t* self, emu_event_t* event, emu_time_t at)
{
    set(self, event, at, 0);
}

emu_time_t emu_sched_next(const emu_sched_t* self)
{
    return self->head != NULL ? self->head->at : EMU_TIME_MAX;
}

void emu_sched_advance(emu_sched_t* self, emu_time_t t)
{
    while (self->head != NULL && self->head->at <= t)
    {
        emu_event_t* const event = self->head;
        self->head = event->next;
        event->pending = false;
        self->now = self->now < event->at ? event->at : self->now;
        event->fire(event->ctx, self->now);
    }
    if (self->now < t)
    {
        self->now = t;
    }
}

void emu_sched_state(emu_sched_t* self, emu_state_t* io)
{
    emu_state_tag(io, "SCHD", 1);
    emu_state_i64(io, &self->now);
    emu_state_check(io, emu_state_time(self->now));
    emu_state_u64(io, &self->order);
}

void emu_event_state(emu_sched_t* sched, emu_event_t* event, emu_state_t* io)
{
    bool pending = event->pending;
    emu_time_t at = event->at;
    uint64_t order = event->order;
    emu_state_bool(io, &pending);
    emu_state_i64(io, &at);
    emu_state_u64(io, &order);
    emu_state_check(io, !pending || (emu_state_time(at) && order < sched->order));
    if (emu_state_loading(io) && !io->bad)
    {
        emu_sched_cancel(sched, event);
        event->at = at;
        event->order = order;
        if (pending)
        {
            insert(sched, event);
        }
    }
}
