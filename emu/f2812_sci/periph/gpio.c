/// \file   gpio.c
/// \brief  GPIO ports A, B, D, E, F, G: MUX, DIR, DAT, SET, CLEAR, TOGGLE (TI SPRS174, SPRU078).
///
/// A pin that MUX leaves to GPIO and DIR makes an output is driven with its latch; any other has its pull-up only, as if all pins had one.
/// DAT holds the pins' levels, whoever drives them. The qualifier (GPxQUAL) reads back and does nothing.
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

/// Distance of a port's registers from those of port A; letter by port.
static const uint8_t offset_of[F2812_PORTS] = {0x00, 0x04, 0x0C, 0x10, 0x14, 0x18};
static const char letter_of[F2812_PORTS + 1] = "ABDEFG";

/// There is no port C.
static unsigned port_at(unsigned offset)
{
    static const uint8_t port[] = {0, 1, F2812_PORTS, 2, 3, 4, 5};
    return port[offset / PORT_WORDS];
}

static uint16_t mux_register(const f2812_t* self, unsigned port, unsigned which)
{
    return self->mem[GPIO_MUX + offset_of[port] + which];
}

/// Pins of a port that have to be driven anew. sched->now is the present from here on.
static void drive(f2812_t* self, unsigned port, unsigned pins)
{
    const emu_time_t now = f2812_sync(self);
    for (unsigned bit = 0; pins >> bit != 0; bit++)
    {
        f2812_pin_t* const pin = &self->pin[port][bit];
        if ((pins >> bit & 1u) != 0 && pin->dat != NULL)
        {
            const bool high = (self->latch[port] & pin->bit) != 0, output = (self->outputs[port] & pin->bit) != 0;
            const emu_drive_t drive = !output ? EMU_WEAK1 : high ? EMU_STRONG1 : EMU_STRONG0;
            emu_wire_drive(&pin->wire, pin->driver, drive, now);
        }
    }
}

static void set_outputs(f2812_t* self, unsigned port)
{
    const uint16_t outputs = mux_register(self, port, DIR) & (uint16_t)~mux_register(self, port, MUX);
    const unsigned changed = outputs ^ self->outputs[port];
    self->outputs[port] = outputs;
    drive(self, port, changed);
}

static void set_latch(f2812_t* self, unsigned port, uint16_t latch)
{
    const unsigned changed = (latch ^ self->latch[port]) & self->outputs[port];
    self->latch[port] = latch;
    if (changed != 0)
    {
        drive(self, port, changed);
    }
}

static void pin_moved(void* ctx, bool level, emu_time_t at)
{
    (void)at;
    const f2812_pin_t* const pin = ctx;
    *pin->dat = (uint16_t)(level ? *pin->dat | pin->bit : *pin->dat & ~pin->bit);
}

void f2812_gpio_init(f2812_t* self)
{
    f2812_map_reset(self);
    for (unsigned port = 0; port < F2812_PORTS; port++)
    {
        const unsigned dat = GPIO_DATA + offset_of[port], pins = self->map[dat].writable;
        for (unsigned bit = 0; bit < F2812_PORT_PINS; bit++)
        {
            f2812_pin_t* const pin = &self->pin[port][bit];
            if ((pins >> bit & 1u) != 0)
            {
                (void)snprintf(pin->name, sizeof pin->name, "GPIO%c%u", letter_of[port], bit & 15u);
                pin->dat = &self->mem[dat];
                pin->bit = (uint16_t)(1u << bit);
                emu_wire_init(&pin->wire, pin->name, true);
                pin->driver = emu_wire_add_driver(&pin->wire);
                (void)emu_wire_watch(&pin->wire, pin_moved, pin); // the first on it
            }
        }
    }
}

void f2812_gpio_reset(f2812_t* self)
{
    for (unsigned port = 0; port < F2812_PORTS; port++)
    {
        self->latch[port] = self->outputs[port] = 0;
        for (unsigned bit = 0; bit < F2812_PORT_PINS; bit++)
        {
            const f2812_pin_t* const pin = &self->pin[port][bit];
            if (pin->dat != NULL && pin->wire.level)
            {
                *pin->dat |= pin->bit;
            }
        }
        drive(self, port, self->map[GPIO_DATA + offset_of[port]].writable);
    }
}

void f2812_gpio_write(f2812_t* self, uint16_t address, uint16_t value)
{
    value &= self->map[address].writable;
    if (address < GPIO_DATA)
    {
        self->mem[address] = value;
        set_outputs(self, port_at((unsigned)address - GPIO_MUX));
        f2812_serial_pins(self);
        return;
    }
    const unsigned offset = (unsigned)address - GPIO_DATA, port = port_at(offset);
    const uint16_t latch = self->latch[port];
    switch (offset % PORT_WORDS)
    {
    case DAT:
        set_latch(self, port, value);
        break;
    case SET:
        set_latch(self, port, latch | value);
        break;
    case CLEAR:
        set_latch(self, port, latch & (uint16_t)~value);
        break;
    default: // TOGGLE
        set_latch(self, port, latch ^ value);
        break;
    }
}
