/// \file   bus.c
/// \brief  The program's accesses. What is memory is done here, anything else in access.c: most registers that are polled are memory, the
///         SCI's among them.
/// SPDX-License-Identifier: MIT
#include "device.h"

uint16_t f2812_read(f2812_t* self, uint16_t address)
{
    if (address < self->unobserved)
    {
        const uint16_t* const value = self->map[address].value;
        if (value != NULL)
        {
            return *value;
        }
    }
    return f2812_access_read(self, address);
}

void f2812_write(f2812_t* self, uint16_t address, uint16_t value)
{
    if (address < self->unobserved)
    {
        const f2812_slot_t* const slot = &self->map[address];
        if ((slot->flags & F2812_REPEATS) != 0 && ((value ^ *slot->value) & slot->writable) == 0)
        {
            return;
        }
        if ((slot->flags & F2812_FINE) != 0 && (self->cpu.eallow || (slot->flags & F2812_EALLOW) == 0))
        {
            f2812_units[slot->writer].write(self, address, value);
            return;
        }
    }
    f2812_access_write(self, address, value);
}

uint16_t f2812_peek(const f2812_t* self, uint16_t address)
{
    return f2812_access_peek(self, address);
}

void f2812_observe(f2812_t* self, const f2812_observer_t* observer)
{
    self->observer = observer != NULL ? *observer : (f2812_observer_t){0};
    self->unobserved = self->observer.access != NULL ? 0 : F2812_WORDS;
}
