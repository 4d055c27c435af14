/// \file   gpio.c
/// \brief  GPIO ports A, B, D, E, F, G: MUX, DIR, DAT, SET, CLEAR, TOGGLE (TI SPRS174, SPRU078).
///
/// A pin that MUX leaves to GPIO and DIR makes an output is driven with its latch; any other has its pull-up only, as if all pins had one.
/// DAT reads the pins' levels, whoever drives them. The qualifier (GPxQUAL) reads back and does nothing.
/// SPDX-License-Identifier: MIT
#include "../cpu/device.h"
#include <stdio.h>

enum
{
    MUX,
    DIR
};
enum
{
    DAT,
    SET,
    CLEAR,
    TOGGLE
};
#define PORT_WORDS 4u

/// Distance of a port's registers from those of port A, 0FFh for none; letter by port.
static const uint8_t offset_of[F2812_PORTS] = {0x00, 0x04, 0x0C, 0x10, 0x14, 0x18};
static const char letter_of[F2812_PORTS + 1] = "ABDEFG";

static unsigned port_at(unsigned offset)
{
    unsigned port = 0;
    while (offset_of[port] != (offset & ~(PORT_WORDS - 1u)))
    {
        port++;
    }
    return port;
}

static uint16_t mux_register(const f2812_t* self, unsigned port, unsigned which)
{
    return self->mem[GPIO_MUX + offset_of[port] + which];
}

static void drive(f2812_t* self, unsigned port)
{
    const unsigned outputs = mux_register(self, port, DIR) & (unsigned)~mux_register(self, port, MUX);
    for (unsigned bit = 0; bit < F2812_PORT_PINS; bit++)
    {
        f2812_pin_t* const pin = &self->pin[port][bit];
        if (pin->name[0] == '\0')
        {
            continue;
        }
        const bool high = (self->latch[port] >> bit & 1u) != 0;
        const emu_drive_t drive = (outputs >> bit & 1u) == 0 ? EMU_WEAK1 : high ? EMU_STRONG1 : EMU_STRONG0;
        emu_wire_drive(&pin->wire, pin->driver, drive, self->sched->now);
    }
}

void f2812_gpio_init(f2812_t* self)
{
    f2812_map_reset(self);
    for (unsigned port = 0; port < F2812_PORTS; port++)
    {
        const unsigned pins = self->map[GPIO_DATA + offset_of[port]].writable;
        for (unsigned bit = 0; bit < F2812_PORT_PINS; bit++)
        {
            f2812_pin_t* const pin = &self->pin[port][bit];
            if ((pins >> bit & 1u) != 0)
            {
                (void)snprintf(pin->name, sizeof pin->name, "GPIO%c%u", letter_of[port], bit & 15u);
                emu_wire_init(&pin->wire, pin->name, true);
                pin->driver = emu_wire_add_driver(&pin->wire);
            }
        }
    }
}

void f2812_gpio_reset(f2812_t* self)
{
    for (unsigned port = 0; port < F2812_PORTS; port++)
    {
        self->latch[port] = 0;
        drive(self, port);
    }
}

uint16_t f2812_gpio_peek(const f2812_t* self, uint16_t address)
{
    const unsigned offset = (unsigned)address - GPIO_DATA, port = port_at(offset);
    unsigned levels = 0;
    for (unsigned bit = 0; bit < F2812_PORT_PINS && offset % PORT_WORDS == DAT; bit++)
    {
        levels |= (self->pin[port][bit].wire.level ? 1u : 0u) << bit; // no level where there is no pin
    }
    return (uint16_t)levels;
}

void f2812_gpio_write(f2812_t* self, uint16_t address, uint16_t value)
{
    value &= self->map[address].writable;
    if (address < GPIO_DATA)
    {
        self->mem[address] = value;
        drive(self, port_at((unsigned)address - GPIO_MUX));
        f2812_serial_pins(self);
        return;
    }
    const unsigned offset = (unsigned)address - GPIO_DATA, port = port_at(offset);
    const uint16_t latch = self->latch[port];
    switch (offset % PORT_WORDS)
    {
    case DAT:
        self->latch[port] = value;
        break;
    case SET:
        self->latch[port] = latch | value;
        break;
    case CLEAR:
        self->latch[port] = latch & (uint16_t)~value;
        break;
    default: // TOGGLE
        self->latch[port] = latch ^ value;
        break;
    }
    drive(self, port);
}
