/// \file   serial.c
/// \brief  The two SCIs in the device: addresses 7050 and 7750, pins GPIOF4, F5 and GPIOG4, G5, INT9.1 to INT9.4 (TI SPRS174).
/// SPDX-License-Identifier: MIT
#include "../cpu/device.h"

#define PORT_F      4u
#define PORT_G      5u
#define TX_PIN      4u
#define RX_PIN      5u
#define TX_MUX      0x0010u
#define RX_MUX      0x0020u
#define SCIRXINTA   (F2812_VECTOR_PIE + 64u) ///< SCITXINTA, SCIRXINTB, SCITXINTB behind it
#define SCIAENCLK   10u
#define OFFSET_MASK 0x000Fu
#define SCIRXBUF    7u ///< the one whose reading does something

static void present(void* ctx)
{
    const f2812_serial_t* const port = ctx;
    (void)f2812_sync(port->device);
}

static void requested(void* ctx, bool tx)
{
    f2812_serial_t* const port = ctx;
    present(ctx);
    f2812_pie_request(port->device, SCIRXINTA + 2u * port->number + (tx ? 1u : 0u));
}

int f2812_serial_init(f2812_t* self)
{
    static const char* const name[F2812_SCIS] = {"SCI-A", "SCI-B"};
    int full = 0;
    for (unsigned n = 0; n < F2812_SCIS; n++)
    {
        f2812_serial_t* const port = &self->serial[n];
        f2812_pin_t* const pins = self->pin[n == 0 ? PORT_F : PORT_G];
        port->device = self;
        port->number = n;
        const sci_env_t env = {.sched = self->sched,
                               .lspclk = &self->lspclk,
                               .switches = &self->config.switches,
                               .txd = &pins[TX_PIN].wire,
                               .rxd = &pins[RX_PIN].wire,
                               .present = present,
                               .interrupt = requested,
                               .ctx = port,
                               .report = self->config.report,
                               .name = name[n]};
        full |= sci_init(&port->sci, &env);
    }
    return full;
}

void f2812_serial_reset(f2812_t* self)
{
    for (unsigned n = 0; n < F2812_SCIS; n++)
    {
        sci_reset(&self->serial[n].sci);
    }
    f2812_serial_clocks(self);
    f2812_serial_pins(self);
}

void f2812_serial_clocks(f2812_t* self)
{
    for (unsigned n = 0; n < F2812_SCIS; n++)
    {
        sci_clock(&self->serial[n].sci, ((unsigned)self->clocks >> (SCIAENCLK + n) & 1u) != 0);
    }
}

void f2812_serial_clock_changed(f2812_t* self)
{
    for (unsigned n = 0; n < F2812_SCIS; n++)
    {
        sci_clock_changed(&self->serial[n].sci);
    }
}

void f2812_serial_pins(f2812_t* self)
{
    static const uint16_t mux[F2812_SCIS] = {GPFMUX, GPGMUX};
    for (unsigned n = 0; n < F2812_SCIS; n++)
    {
        const unsigned bits = self->mem[mux[n]];
        sci_pins(&self->serial[n].sci, (bits & TX_MUX) != 0, (bits & RX_MUX) != 0);
    }
}

static unsigned number(uint16_t address)
{
    return address < SCIB ? 0 : 1;
}

uint16_t f2812_serial_read(f2812_t* self, uint16_t address)
{
    return sci_read(&self->serial[number(address)].sci, address & OFFSET_MASK);
}

const uint16_t* f2812_serial_value(const f2812_t* self, uint16_t address, bool plain)
{
    const unsigned offset = address & OFFSET_MASK;
    return plain && offset == SCIRXBUF ? NULL : &self->serial[number(address)].sci.reg[offset];
}

void f2812_serial_write(f2812_t* self, uint16_t address, uint16_t value)
{
    sci_write(&self->serial[number(address)].sci, address & OFFSET_MASK, value);
}
