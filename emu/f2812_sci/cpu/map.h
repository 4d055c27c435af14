/// \file   cpu/map.h
/// \brief  Which registers there are, and who has them. Not installed.
/// SPDX-License-Identifier: MIT
#ifndef F2812_MAP_H_INCLUDED
#define F2812_MAP_H_INCLUDED
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define F2812_WORDS      0x8000u                ///< of the address space that has registers
#define F2812_GROUPS     12u                    ///< of the PIE
#define F2812_CLOCK(bit) ((uint8_t)((bit) + 1)) ///< a register lives on this bit of PCLKCR

enum
{
    TIMER0TIM = 0x0C00,
    PIECTRL = 0x0CE0,
    PIEACK = 0x0CE1,
    PIEIER1 = 0x0CE2, ///< PIEIFR1 behind it, and so on to PIEIFR12
    PIEVECT = 0x0D00, ///< table of vectors
    HISPCP = 0x701A,
    LOSPCP = 0x701B,
    PCLKCR = 0x701C,
    LPMCR0 = 0x701E,
    LPMCR1 = 0x701F,
    PLLCR = 0x7021,
    SCSR = 0x7022,
    WDCNTR = 0x7023,
    WDKEY = 0x7025,
    WDCR = 0x7029,
    SCIA = 0x7050,
    XINT1CR = 0x7070,
    XINT1CTR = 0x7078,
    GPIO_MUX = 0x70C0,
    GPEMUX = 0x70D0,
    GPFMUX = 0x70D4,
    GPGMUX = 0x70D8,
    GPIO_DATA = 0x70E0,
    SCIB = 0x7750,
    SCI_WORDS = 0x10
};

/// Who has a register.
typedef enum f2812_unit_t
{
    F2812_NOBODY = 0,
    F2812_MEMORY,       ///< reads back what was written
    F2812_NOT_MODELLED, ///< the same, and says so
    F2812_PIE,
    F2812_PIE_ACK,
    F2812_TIMER,
    F2812_SYSCTL,
    F2812_WATCHDOG,
    F2812_XINT,
    F2812_GPIO,
    F2812_SCI,
    F2812_UNITS
} f2812_unit_t;

enum
{
    F2812_EALLOW = 1,
    F2812_READS_MEMORY = 2,  ///< reading is not its owner's matter
    F2812_WRITES_MEMORY = 4, ///< nor is writing
    F2812_FINE = 8,          ///< there is nothing to say about an access, but for EALLOW
    F2812_TOLD_NOBODY = 16,  ///< from here on: what was reported of it since the last reset
    F2812_TOLD_EALLOW = 32,
    F2812_TOLD_CLOCK = 64,
    F2812_TOLD_NOT_MODELLED = 128,
    F2812_REPEATS = 256 ///< a write that leaves `writable` as it is does nothing; in the map while there is a clock
};

typedef struct f2812_register_t
{
    uint16_t address;
    const char* name;
    uint8_t unit, clock; ///< F2812_CLOCK(bit of PCLKCR); 0: always
    uint16_t flags;
    uint16_t reset, writable; ///< value, bits
} f2812_register_t;

/// Registers in a row that only read back; one without a name is no register.
typedef struct f2812_block_t
{
    uint16_t first, words; ///< more words than names: the rest has none
    const char* peripheral;
    uint8_t clock, flags;
    const char* names; ///< one behind the other, each with its NUL
    size_t length;     ///< of them all
} f2812_block_t;

extern const f2812_register_t f2812_registers[];
extern const size_t f2812_register_count;
extern const f2812_block_t f2812_blocks[];
extern const size_t f2812_block_count;

/// The map's row of an address: what the table above says, as it is looked up.
typedef struct f2812_slot_t
{
    const uint16_t* value;  ///< what a read gives, if that is all there is to it; NULL: ask the reader
    uint8_t reader, writer; ///< f2812_unit_t; F2812_MEMORY: mem[] is all there is to it
    uint8_t clock;
    uint16_t flags, writable;
} f2812_slot_t;

#endif // F2812_MAP_H_INCLUDED
