/// Which word of the device each half-word of the firmware's register objects is.
/// SPDX-License-Identifier: MIT
#include "shim_internal.h"
#include <stdlib.h>

#define WORD_OCTETS     2u
#define SPAN_OCTETS_MAX ((size_t)1 << 24) ///< register objects lie together, or at least not further apart

/// Registers that count by themselves, or whose reading changes something.
static const struct
{
    uint16_t first, last;
} restless[] = {
    {0x0C00, 0x0C17}, // CPU timers
    {0x7023, 0x7023}, // WDCNTR
    {0x7057, 0x7057}, // SCIRXBUF of SCI-A
    {0x7070, 0x707F}, // XINTnCTR
    {0x7100, 0x7605}, // ADC, EV-A, EV-B
    {0x7757, 0x7757}, // SCIRXBUF of SCI-B
};

static uint16_t entry_of(uint16_t address)
{
    for (size_t i = 0; i < sizeof restless / sizeof restless[0]; i++)
    {
        if (address >= restless[i].first && address <= restless[i].last)
        {
            return (uint16_t)(address | F2812_MAP_RESTLESS);
        }
    }
    return address;
}

bool f2812_shim_make_map(f2812_shim_t* self)
{
    const f2812_program_t* const p = self->program;
    uintptr_t first = UINTPTR_MAX;
    uintptr_t last = 0;
    for (size_t i = 0; i < p->object_count; i++)
    {
        const uintptr_t at = (uintptr_t)p->objects[i].at;
        if (at != 0)
        {
            first = at < first ? at : first;
            last = at + p->objects[i].words * WORD_OCTETS > last ? at + p->objects[i].words * WORD_OCTETS : last;
        }
    }
    const uintptr_t table = (uintptr_t)p->vectors;
    const size_t table_octets = F2812_VECTORS * sizeof(void*);
    if (table != 0)
    {
        first = table < first ? table : first;
        last = table + table_octets > last ? table + table_octets : last;
    }
    if (first > last || last - first > SPAN_OCTETS_MAX)
    {
        return first > last;
    }
    self->base = first & ~(uintptr_t)1;
    self->span = last - self->base;
    self->map = calloc(self->span / WORD_OCTETS + 1, sizeof *self->map);
    if (self->map == NULL)
    {
        return false;
    }
    for (size_t i = 0; i < p->object_count; i++)
    {
        const f2812_object_t* const object = &p->objects[i];
        for (unsigned word = 0; object->at != NULL && word < object->words; word++)
        {
            self->map[((uintptr_t)object->at - self->base) / WORD_OCTETS + word] =
                object->address > F2812_MAP_VECTOR ? entry_of((uint16_t)(object->address + word))
                : word == 0                        ? object->address
                                                   : (uint16_t)F2812_MAP_ZERO;
        }
    }
    for (size_t i = 0; table != 0 && i < table_octets / WORD_OCTETS; i++)
    {
        self->map[(table - self->base) / WORD_OCTETS + i] = F2812_MAP_VECTOR;
    }
    return true;
}
