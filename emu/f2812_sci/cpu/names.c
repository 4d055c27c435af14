/// Names of registers and of entries of the vector table (TI SPRS174, SPRU078; entries as in the PIE vector table of TI's headers).
/// SPDX-License-Identifier: MIT
#include "emu_f2812/f2812.h"
#include "emu_f2812/registers.h"
#include "map.h"
#include <string.h>

/// Name of a register of a block; "" where there is none.
static const char* name_in(const f2812_block_t* block, unsigned index)
{
    const char* name = block->names;
    const char* const end = name + block->length;
    while (name < end && index > 0)
    {
        name += strlen(name) + 1;
        index--;
    }
    return name < end ? name : "";
}

const char* f2812_register_name(uint16_t address)
{
    for (size_t i = 0; i < f2812_register_count; i++)
    {
        if (f2812_registers[i].address == address)
        {
            return f2812_registers[i].name;
        }
    }
    for (size_t i = 0; i < f2812_block_count; i++)
    {
        const f2812_block_t* const block = &f2812_blocks[i];
        if (address >= block->first && address - block->first < block->words)
        {
            const char* const name = name_in(block, (unsigned)address - block->first);
            return *name != '\0' ? name : NULL;
        }
    }
    return NULL;
}

int f2812_register_address(const char* name)
{
    for (size_t i = 0; i < f2812_register_count; i++)
    {
        if (strcmp(f2812_registers[i].name, name) == 0)
        {
            return f2812_registers[i].address;
        }
    }
    for (size_t i = 0; i < f2812_block_count && *name != '\0'; i++)
    {
        for (unsigned k = 0; k < f2812_blocks[i].words; k++)
        {
            if (strcmp(name_in(&f2812_blocks[i], k), name) == 0)
            {
                return f2812_blocks[i].first + (int)k;
            }
        }
    }
    return -1;
}

const char* f2812_vector_name(unsigned vector)
{
    static const char* const cpu[F2812_VECTOR_PIE] = {
        "RESET", "INT1",  "INT2",  "INT3",  "INT4",    "INT5",    "INT6",   "INT7",   "INT8",    "INT9",  "INT10",
        "INT11", "INT12", "INT13", "INT14", "DATALOG", "RTOSINT", "EMUINT", "NMI",    "ILLEGAL", "USER1", "USER2",
        "USER3", "USER4", "USER5", "USER6", "USER7",   "USER8",   "USER9",  "USER10", "USER11",  "USER12"};
    static const char* const pie[F2812_GROUPS][8] = {
        {"PDPINTA", "PDPINTB", NULL, "XINT1", "XINT2", "ADCINT", "TINT0", "WAKEINT"},
        {"CMP1INT", "CMP2INT", "CMP3INT", "T1PINT", "T1CINT", "T1UFINT", "T1OFINT", NULL},
        {"T2PINT", "T2CINT", "T2UFINT", "T2OFINT", "CAPINT1", "CAPINT2", "CAPINT3", NULL},
        {"CMP4INT", "CMP5INT", "CMP6INT", "T3PINT", "T3CINT", "T3UFINT", "T3OFINT", NULL},
        {"T4PINT", "T4CINT", "T4UFINT", "T4OFINT", "CAPINT4", "CAPINT5", "CAPINT6", NULL},
        {"SPIRXINTA", "SPITXINTA", NULL, NULL, "MRINTA", "MXINTA", NULL, NULL},
        {NULL},
        {NULL},
        {"SCIRXINTA", "SCITXINTA", "SCIRXINTB", "SCITXINTB", "ECAN0INTA", "ECAN1INTA", NULL, NULL},
        {NULL},
        {NULL},
        {NULL},
    };
    if (vector < F2812_VECTOR_PIE)
    {
        return cpu[vector];
    }
    const unsigned entry = vector - F2812_VECTOR_PIE;
    return entry / 8u < F2812_GROUPS ? pie[entry / 8u][entry % 8u] : NULL;
}
