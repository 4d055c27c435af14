/// \file   watch.c
/// \brief  What a user watches: observers, breakpoints, coverage.
/// SPDX-License-Identifier: MIT
#include "engine.h"

static void set_watched(mcs51_t* self)
{
    const mcs51_observer_t* const o = &self->observer;
    self->observed = o->step || o->access;
    self->watched = self->observed || self->breaks || self->covering;
    mcs51_look_at(self, mcs51_cycle(self)); // the other engine goes on
}

void mcs51_observe(mcs51_t* self, const mcs51_observer_t* observer)
{
    self->observer = observer ? *observer : (mcs51_observer_t){0};
    set_watched(self);
}

void mcs51_stop(mcs51_t* self)
{
    self->stop = true;
    self->attend_at = 0;
    mcs51_look_at(self, mcs51_cycle(self));
}

int mcs51_set_break(mcs51_t* self, uint16_t pc, bool on)
{
    if (pc >= self->code_octets)
    {
        return -1;
    }
    uint8_t* const mark = &self->marks[pc];
    if (on != ((*mark & MARK_BREAK) != 0))
    {
        *mark ^= MARK_BREAK;
        self->breaks += on ? 1u : UINT32_MAX;
        mcs51_choose(self, pc);
        set_watched(self);
    }
    return 0;
}

void mcs51_cover(mcs51_t* self, bool on)
{
    if (on)
    {
        for (size_t pc = 0; pc < sizeof self->marks; ++pc)
        {
            self->marks[pc] &= MARK_BREAK;
        }
    }
    self->covering = on;
    mcs51_forget(self);
    set_watched(self);
}

bool mcs51_covered(const mcs51_t* self, uint16_t pc)
{
    return self->marks[pc] & MARK_COVERED;
}

unsigned mcs51_branches(const mcs51_t* self, uint16_t pc)
{
    return (self->marks[pc] & (unsigned)(MARK_NOT_TAKEN | MARK_TAKEN)) / MARK_NOT_TAKEN;
}

void mcs51_spin(mcs51_t* self, bool on)
{
    self->no_spin = !on;
    mcs51_forget(self);
}

bool mcs51_enter(mcs51_t* self)
{
    const uint16_t pc = (uint16_t)self->pc;
    if ((self->marks[pc] & MARK_BREAK) && self->passed_pc != pc)
    {
        self->passed_pc = pc;
        self->stop = true;
        self->attend_at = 0;
        return false;
    }
    if (self->observer.step && !self->observer.step(self->observer.ctx, pc, mcs51_cycle(self)))
    {
        self->stop = true;
        self->attend_at = 0;
        return false;
    }
    self->passed_pc = NO_PC;
    if (self->covering)
    {
        self->marks[pc] |= MARK_COVERED;
    }
    return true;
}
