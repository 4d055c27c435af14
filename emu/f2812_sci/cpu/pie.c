/// \file   pie.c
/// \brief  Peripheral interrupt expansion: 12 groups of 8 (TI SPRUHE8E p. 104, SPRUI07 section 1.6).
///
/// A pulse of a peripheral sets PIEIFRx.y. Where PIEIERx.y is set and PIEACKx is not, the PIE sets PIEACKx and sends INTx to the CPU; what
/// comes meanwhile waits in PIEIFRx until the program writes 1 to PIEACKx. The vector is found when the CPU fetches it: the lowest y that is
/// flagged and enabled then, whose flag is cleared; if there is none any more, INTx.1, and no flag is.
/// The groups work the same while ENPIE = 0: no source says otherwise.
/// SPDX-License-Identifier: MIT
#include "device.h"

#define ENPIE 0x0001u

static uint16_t* ier(f2812_t* self, unsigned group)
{
    return &self->mem[PIEIER1 + 2u * group];
}

static uint16_t* ifr(f2812_t* self, unsigned group)
{
    return &self->mem[PIEIER1 + 2u * group + 1u];
}

static void send(f2812_t* self, unsigned group)
{
    const unsigned bit = 1u << group;
    if ((*ifr(self, group) & *ier(self, group)) != 0 && (self->mem[PIEACK] & bit) == 0)
    {
        self->mem[PIEACK] |= (uint16_t)bit;
        f2812_cpu_request(self, group);
    }
}

void f2812_pie_request(f2812_t* self, unsigned vector)
{
    const unsigned entry = vector - F2812_VECTOR_PIE;
    *ifr(self, entry / 8u) |= (uint16_t)(1u << entry % 8u);
    send(self, entry / 8u);
}

unsigned f2812_pie_fetch(f2812_t* self, unsigned group)
{
    const unsigned set = *ifr(self, group) & *ier(self, group);
    unsigned y = 0;
    while (set != 0 && (set >> y & 1u) == 0)
    {
        y++;
    }
    if (set != 0)
    {
        *ifr(self, group) &= (uint16_t) ~(1u << y);
    }
    return F2812_VECTOR_PIE + 8u * group + y;
}

/// A group whose bit was clear has nothing to send.
void f2812_pie_acknowledge(f2812_t* self, uint16_t address, uint16_t value)
{
    const unsigned acknowledged = self->mem[PIEACK] & value;
    (void)address;
    if (acknowledged == 0)
    {
        return;
    }
    (void)f2812_sync(self);
    self->mem[PIEACK] &= (uint16_t)~value;
    for (unsigned group = 0; acknowledged >> group != 0; group++)
    {
        if ((acknowledged >> group & 1u) != 0)
        {
            send(self, group);
        }
    }
}

void f2812_pie_write(f2812_t* self, uint16_t address, uint16_t value)
{
    const uint16_t writable = self->map[address].writable;
    (void)f2812_sync(self);
    if (address == PIECTRL)
    {
        self->mem[PIECTRL] = (uint16_t)((self->mem[PIECTRL] & ~ENPIE) | (value & ENPIE));
        f2812_update_pending(self);
    }
    else
    {
        self->mem[address] = value & writable;
        send(self, (address - PIEIER1) / 2u);
    }
}
