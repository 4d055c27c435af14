/// The event queue: a sorted list threaded through its owners' events. A board has some ten events, so a list beats a heap.
/// SPDX-License-Identifier: MIT
#include "emu/sched.h"
#include <stddef.h>

void emu_sched_init(emu_sched_t* self)
{
    *self = (emu_sched_t){0};
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

void emu_sched_at(emu_sched_t* self, emu_event_t* event, emu_time_t at)
{
    emu_sched_cancel(self, event);
    event->at = at < self->now ? self->now : at;
    event->pending = true;
    emu_event_t** link = &self->head;
    while (*link != NULL && (*link)->at <= event->at)
    {
        link = &(*link)->next;
    }
    event->next = *link;
    *link = event;
    if (self->head == event && self->earlier != NULL)
    {
        self->earlier(self->earlier_ctx, event->at);
    }
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
        self->now = event->at;
        event->fire(event->ctx, event->at);
    }
    if (self->now < t)
    {
        self->now = t;
    }
}
