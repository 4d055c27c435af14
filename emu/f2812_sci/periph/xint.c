/// \file   xint.c
/// \brief  External interrupts XINT1 (GPIOE0) and XINT2 (GPIOE1) with their counters (TI SPRU078, SPRS174). XNMI is not modelled.
///
/// A pin that GPEMUX gives to XINTn interrupts at the edge that POLARITY says, while ENABLE is 1: INT1.4, INT1.5. XINTnCTR counts
/// SYSCLKOUT from the last such edge, 16 bits.
/// SPDX-License-Identifier: MIT
#include "../cpu/device.h"

#define PORT_E   3u
#define ENABLE   0x0001u
#define POLARITY 0x0004u                 ///< 1: rising
#define XINT1    (F2812_VECTOR_PIE + 3u) ///< XINT2 behind it

static void moved(f2812_t* self, unsigned n, bool level)
{
    const unsigned control = self->mem[XINT1CR + n];
    if ((control & ENABLE) != 0 && ((control & POLARITY) != 0) == level && ((unsigned)self->mem[GPEMUX] >> n & 1u) != 0)
    {
        self->xint_edge[n] = self->cycle;
        f2812_pie_request(self, XINT1 + n);
    }
}

static void xint1_moved(void* ctx, bool level, emu_time_t at)
{
    (void)at;
    moved(ctx, 0, level);
}

static void xint2_moved(void* ctx, bool level, emu_time_t at)
{
    (void)at;
    moved(ctx, 1, level);
}

void f2812_xint_init(f2812_t* self)
{
    (void)emu_wire_watch(&self->pin[PORT_E][0].wire, xint1_moved, self);
    (void)emu_wire_watch(&self->pin[PORT_E][1].wire, xint2_moved, self);
}

uint16_t f2812_xint_peek(const f2812_t* self, uint16_t address)
{
    return (uint16_t)(self->cycle - self->xint_edge[address - XINT1CTR]);
}
