/// \file   access.c
/// \brief  Accesses that are more than memory: EALLOW, peripherals without clock, what is not there, access log. TI SPRS174, SPRU078.
/// SPDX-License-Identifier: MIT
#include "device.h"
#include "emu_f2812/registers.h"
#include <stdio.h>
#include <string.h>

#define REPORT_MAX 160

static uint16_t memory_peek(const f2812_t* self, uint16_t address)
{
    return self->mem[address];
}

static void memory_write(f2812_t* self, uint16_t address, uint16_t value)
{
    self->mem[address] = value & self->map[address].writable;
}

static uint16_t serial_peek(const f2812_t* self, uint16_t address)
{
    return *f2812_serial_value(self, address, false);
}

static uint16_t nobody_peek(const f2812_t* self, uint16_t address)
{
    (void)self;
    (void)address;
    return 0;
}

static void nobody_write(f2812_t* self, uint16_t address, uint16_t value)
{
    (void)self;
    (void)address;
    (void)value;
}

const f2812_unit_access_t f2812_units[F2812_UNITS] = {
    [F2812_NOBODY] = {nobody_peek, nobody_write},
    [F2812_MEMORY] = {memory_peek, memory_write},
    [F2812_NOT_MODELLED] = {memory_peek, memory_write},
    [F2812_PIE] = {memory_peek, f2812_pie_write},
    [F2812_PIE_ACK] = {memory_peek, f2812_pie_acknowledge},
    [F2812_TIMER] = {f2812_timer_peek, f2812_timer_write},
    [F2812_SYSCTL] = {memory_peek, f2812_sysctl_write},
    [F2812_WATCHDOG] = {f2812_watchdog_peek, f2812_watchdog_write},
    [F2812_XINT] = {f2812_xint_peek, memory_write},
    [F2812_GPIO] = {memory_peek, f2812_gpio_write},
    [F2812_SCI] = {serial_peek, f2812_serial_write},
};

static bool clocked(const f2812_t* self, const f2812_slot_t* slot)
{
    return slot->clock == 0 || (self->clocks >> (slot->clock - 1u) & 1u) != 0;
}

void f2812_map_clocks(f2812_t* self)
{
    for (size_t i = 0; i < f2812_register_count; i++)
    {
        const uint16_t address = f2812_registers[i].address;
        f2812_slot_t* const slot = &self->map[address];
        const bool on = clocked(self, slot);
        const unsigned fine = F2812_FINE | (f2812_registers[i].flags & F2812_REPEATS);
        slot->flags = (uint16_t)((slot->flags & ~fine) | (on ? fine : 0));
        slot->value = !on                            ? NULL
                      : slot->reader == F2812_MEMORY ? &self->mem[address]
                      : slot->reader == F2812_SCI    ? f2812_serial_value(self, address, true)
                                                     : NULL;
    }
}

void f2812_map_reset(f2812_t* self)
{
    memset(self->map, 0, sizeof self->map);
    for (size_t i = 0; i < f2812_register_count; i++)
    {
        const f2812_register_t* const r = &f2812_registers[i];
        self->mem[r->address] = r->reset;
        self->map[r->address] = (f2812_slot_t){.reader = r->flags & F2812_READS_MEMORY ? F2812_MEMORY : r->unit,
                                               .writer = r->flags & F2812_WRITES_MEMORY ? F2812_MEMORY : r->unit,
                                               .clock = r->clock,
                                               .flags = r->flags,
                                               .writable = r->writable};
    }
    for (size_t i = 0; i < f2812_block_count; i++)
    {
        const f2812_block_t* const block = &f2812_blocks[i];
        const bool memory = block->peripheral == NULL;
        const uint8_t unit = memory ? F2812_MEMORY : F2812_NOT_MODELLED;
        for (unsigned address = block->first; address < (unsigned)block->first + block->words; address++)
        {
            self->mem[address] = memory ? self->mem[address] : 0;
            self->map[address] = (f2812_slot_t){.value = memory ? &self->mem[address] : NULL,
                                                .reader = unit,
                                                .writer = unit,
                                                .clock = block->clock,
                                                .flags = (uint8_t)(block->flags | (memory ? F2812_FINE : 0)),
                                                .writable = 0xFFFF};
        }
    }
}

void f2812_report(f2812_t* self, emu_report_kind_t kind, uint16_t address, const char* text)
{
    if (self->config.report.put != NULL)
    {
        const char* const name = f2812_register_name(address);
        char line[REPORT_MAX];
        (void)snprintf(line, sizeof line, "%s: %s", name != NULL ? name : "register", text);
        self->config.report.put(self->config.report.ctx, kind, line, address, f2812_sync(self));
    }
}

void f2812_report_once(f2812_t* self, emu_report_kind_t kind, uint32_t once, uint16_t address, const char* text)
{
    if ((self->told & once) == 0)
    {
        self->told |= once;
        f2812_report(self, kind, address, text);
    }
}

static void tell(f2812_t* self, emu_report_kind_t kind, uint8_t told, uint16_t address, const char* text)
{
    f2812_slot_t* const slot = &self->map[address];
    if ((slot->flags & told) == 0)
    {
        slot->flags |= told;
        f2812_report(self, kind, address, text);
    }
}

static const char* peripheral(uint16_t address)
{
    for (size_t i = 0; i < f2812_block_count; i++)
    {
        if (address >= f2812_blocks[i].first && address - f2812_blocks[i].first < f2812_blocks[i].words)
        {
            return f2812_blocks[i].peripheral;
        }
    }
    return NULL;
}

/// Tell what is wrong with an access. \return whether it takes place.
static bool admit(f2812_t* self, uint16_t address, bool write)
{
    const f2812_slot_t* const slot = &self->map[address];
    const unsigned unit = write ? slot->writer : slot->reader;
    if (unit == F2812_NOBODY)
    {
        tell(self, EMU_GUEST_ERROR, F2812_TOLD_NOBODY, address, "there is no register at this address; it reads 0");
    }
    else if (unit == F2812_NOT_MODELLED && (slot->flags & F2812_TOLD_NOT_MODELLED) == 0)
    {
        char text[REPORT_MAX];
        (void)snprintf(text, sizeof text, "not modelled: registers of the %s read back what was written",
                       peripheral(address));
        tell(self, EMU_NOT_MODELLED, F2812_TOLD_NOT_MODELLED, address, text);
    }
    if (write && (slot->flags & F2812_EALLOW) != 0 && !self->cpu.eallow)
    {
        tell(self, EMU_GUEST_ERROR, F2812_TOLD_EALLOW, address, "written without EALLOW; the write is lost");
        return false;
    }
    if (!clocked(self, slot))
    {
        tell(self, EMU_GUEST_ERROR, F2812_TOLD_CLOCK, address, "its peripheral has no clock (PCLKCR)");
        return self->config.switches.clock_off == F2812_CLOCK_OFF_TAKE;
    }
    return true;
}

static bool fine(const f2812_t* self, uint16_t address, bool write)
{
    const unsigned flags = self->map[address].flags;
    return (flags & F2812_FINE) != 0 && (!write || self->cpu.eallow || (flags & F2812_EALLOW) == 0);
}

/// Beyond the frames that have registers.
static bool outside(f2812_t* self, uint16_t address)
{
    if (address < F2812_WORDS)
    {
        return false;
    }
    f2812_report_once(self, EMU_GUEST_ERROR, F2812_ONCE_OUTSIDE, address,
                      "there is no register at this address; it reads 0");
    return true;
}

uint16_t f2812_access_read(f2812_t* self, uint16_t address)
{
    const emu_time_t now = f2812_sync(self);
    uint16_t value = 0;
    if (!outside(self, address) && (fine(self, address, false) || admit(self, address, false)))
    {
        const unsigned unit = self->map[address].reader;
        value = unit == F2812_SCI ? f2812_serial_read(self, address) : f2812_units[unit].peek(self, address);
    }
    if (self->observer.access != NULL)
    {
        self->observer.access(self->observer.ctx, address, value, false, now);
    }
    return value;
}

void f2812_access_write(f2812_t* self, uint16_t address, uint16_t value)
{
    const emu_time_t now = f2812_sync(self);
    if (self->observer.access != NULL)
    {
        self->observer.access(self->observer.ctx, address, value, true, now);
    }
    if (!outside(self, address) && (fine(self, address, true) || admit(self, address, true)))
    {
        f2812_units[self->map[address].writer].write(self, address, value);
    }
}

uint16_t f2812_access_peek(const f2812_t* self, uint16_t address)
{
    if (address >= F2812_WORDS)
    {
        return 0;
    }
    const f2812_slot_t* const slot = &self->map[address];
    const bool taken = clocked(self, slot) || self->config.switches.clock_off == F2812_CLOCK_OFF_TAKE;
    return taken ? f2812_units[slot->reader].peek(self, address) : 0;
}
