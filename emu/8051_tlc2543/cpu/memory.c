/// \file   memory.c
/// \brief  The parts, and what memory each has: flash and external code, internal RAM, external RAM. Atmel 2487D, 1919D.
/// SPDX-License-Identifier: MIT
#include "emu/random.h"
#include "engine.h"
#include <stdlib.h>
#include <string.h>

#define BUS_OCTETS 65536u

static const uint8_t sfrs_s51[16] = {0xBF, 0x7F, 0x01, 0x03, 0x45, 0x01, 0x01, 0x01, 0, 0, 0x01, 0, 0x01, 0, 0x01, 0};
static const uint8_t sfrs_s52[16] = {0xBF, 0x7F, 0x01, 0x03, 0x45, 0x01, 0x01, 0x01,
                                     0,    0x3F, 0x01, 0,    0x01, 0,    0x01, 0};

static const mcs51_part_info_t parts[] = {
    [MCS51_AT89S51] =
        {4096, 128, sfrs_s51,
         "no RAM at this address: the AT89S51 has 00h..7Fh (@Ri, stack; SDCC: build with --iram-size 128)",
         "the AT89S51 has no SFR at this address", "code read beyond the 4096 octets of flash"},
    [MCS51_AT89S52] = {8192, 256, sfrs_s52, "no RAM at this address", "the AT89S52 has no SFR at this address",
                       "code read beyond the 8192 octets of flash"},
};

int mcs51_memory_create(mcs51_t* self)
{
    const mcs51_config_t* const config = &self->config;
    if ((unsigned)config->part >= sizeof parts / sizeof parts[0])
    {
        return -1;
    }
    self->part = &parts[config->part];
    self->ram_octets = self->part->ram_octets;
    self->code_octets = config->code_octets ? config->code_octets : self->part->flash_octets;
    self->stack_top = config->stack_limit ? config->stack_limit : self->ram_octets - 1u;
    if (self->code_octets < self->part->flash_octets || self->code_octets > BUS_OCTETS ||
        config->xdata_octets > BUS_OCTETS || self->stack_top >= self->ram_octets)
    {
        return -1;
    }
    memset(self->code, MCS51_ABSENT_CODE, sizeof self->code);
    memset(self->code, 0xFF, self->code_octets); // erased
    memcpy(self->image, self->code, sizeof self->image);
    self->xdata = config->xdata_octets ? malloc(config->xdata_octets) : NULL;
    return config->xdata_octets && !self->xdata ? -1 : 0;
}

void mcs51_memory_clear(mcs51_t* self)
{
    memset(self->mem, 0, 0x80);
    memset(self->mem + 0x100, 0, 0x80);
    if (self->xdata)
    {
        memset(self->xdata, 0, self->config.xdata_octets);
    }
}

void mcs51_memory_randomise(mcs51_t* self, uint64_t seed)
{
    for (unsigned i = 0; seed && i < self->ram_octets; ++i)
    {
        mcs51_set_iram(self, (uint8_t)i, (uint8_t)(emu_random(&seed) >> 56));
    }
}

int mcs51_load(mcs51_t* self, uint16_t address, const uint8_t* octets, size_t count)
{
    if (address > self->code_octets || count > self->code_octets - address)
    {
        return -1;
    }
    for (unsigned i = 0; i < count; ++i)
    {
        const unsigned at = address + i;
        self->image_sum += mcs51_image_term(at, octets[i]) - mcs51_image_term(at, self->image[at]);
        self->image[at] = self->code[at] = octets[i];
    }
    mcs51_forget(self);
    return 0;
}

uint8_t mcs51_absent_ram(mcs51_t* self, unsigned address)
{
    mcs51_report(self, EMU_GUEST_ERROR, ONCE_RAM, self->part->no_ram, address);
    return MCS51_ABSENT_RAM;
}

uint8_t mcs51_absent_code(mcs51_t* self, unsigned address)
{
    const bool external = self->code_octets > self->part->flash_octets;
    mcs51_report(self, EMU_GUEST_ERROR, ONCE_CODE,
                 external ? "code read beyond the external code memory" : self->part->no_code, address);
    return MCS51_ABSENT_CODE;
}

void mcs51_reserved_opcode(mcs51_t* self)
{
    const uint16_t address = (uint16_t)(self->pc - 1u);
    if (address >= self->code_octets)
    {
        mcs51_absent_code(self, address);
    }
    else
    {
        mcs51_report(self, EMU_GUEST_ERROR, ONCE_A5, "opcode A5h is reserved (run as a NOP), at this address", address);
    }
}

/// A push beyond the limit is kept where there is RAM, and lost where there is none.
void mcs51_push_beyond(mcs51_t* self, unsigned address, uint8_t value)
{
    mcs51_report(self, EMU_GUEST_ERROR, ONCE_STACK, "stack overflow: SP went past the last address of the stack, to",
                 address);
    mcs51_set_iram(self, (uint8_t)address, value);
}

/// \return whether there is RAM; every access through the bus leaves FFh in P0's latch (MCS-51 hardware description).
static bool bus(mcs51_t* self, unsigned address)
{
    if (!self->xdata)
    {
        mcs51_report(self, EMU_NOT_MODELLED, ONCE_XRAM,
                     "MOVX: there is no external RAM on this board (reads FFh, writes are lost; give xdata_octets)",
                     address);
        return false;
    }
    if (self->mem[P0] != 0xFFu)
    {
        mcs51_report(self, EMU_GUEST_ERROR, ONCE_BUS, "MOVX: P0 is the bus, and its latch loses this value",
                     self->mem[P0]);
        mcs51_write(self, P0, 0xFF);
    }
    if (address >= self->config.xdata_octets)
    {
        mcs51_report(self, EMU_GUEST_ERROR, ONCE_XRAM, "MOVX beyond the external RAM, at", address);
        return false;
    }
    return true;
}

uint8_t mcs51_xread(mcs51_t* self, unsigned address)
{
    return bus(self, address) ? self->xdata[address] : MCS51_ABSENT_XRAM;
}

void mcs51_xwrite(mcs51_t* self, unsigned address, uint8_t value)
{
    if (bus(self, address))
    {
        self->xdata[address] = value;
    }
}

uint8_t mcs51_iram(const mcs51_t* self, uint8_t address)
{
    return address < self->ram_octets ? self->mem[address + (address & 0x80u)] : MCS51_ABSENT_RAM;
}

void mcs51_set_iram(mcs51_t* self, uint8_t address, uint8_t value)
{
    if (address < self->ram_octets)
    {
        self->mem[address + (address & 0x80u)] = value;
    }
}

uint8_t mcs51_code(const mcs51_t* self, uint16_t address)
{
    return self->code[address];
}

void mcs51_set_code(mcs51_t* self, uint16_t address, uint8_t value)
{
    if (address < self->code_octets)
    {
        self->code[address] = value;
        self->code_changed = true;
        mcs51_forget(self);
    }
}

uint8_t mcs51_xdata(const mcs51_t* self, uint16_t address)
{
    return address < self->config.xdata_octets ? self->xdata[address] : MCS51_ABSENT_XRAM;
}

void mcs51_set_xdata(mcs51_t* self, uint16_t address, uint8_t value)
{
    if (address < self->config.xdata_octets)
    {
        self->xdata[address] = value;
    }
}
