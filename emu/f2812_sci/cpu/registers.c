/// \file   registers.c
/// \brief  Registers that are modelled: address, name, owner, clock, protection, reset value, bits that can be written.
///         TI SPRS174 (memory map, EALLOW), SPRU078 (system control and interrupts), SPRU051 (SCI).
/// SPDX-License-Identifier: MIT
#include "map.h"

#define EALLOW  F2812_EALLOW
#define READS   F2812_READS_MEMORY
#define WRITES  F2812_WRITES_MEMORY
#define REPEATS F2812_REPEATS

/// PRD and TIM after reset: no source at hand for the F2812; older CPUs of the family hold FFFFh.
#define TIMER(base, n)                                                                                                 \
    {(base), "TIMER" n "TIM", F2812_TIMER, 0, 0, 0xFFFF, 0xFFFF},                                                      \
        {(base) + 1, "TIMER" n "TIMH", F2812_TIMER, 0, 0, 0, 0xFFFF},                                                  \
        {(base) + 2, "TIMER" n "PRD", F2812_TIMER, 0, READS, 0xFFFF, 0xFFFF},                                          \
        {(base) + 3, "TIMER" n "PRDH", F2812_TIMER, 0, READS, 0, 0xFFFF},                                              \
        {(base) + 4, "TIMER" n "TCR", F2812_TIMER, 0, 0, 0, 0xFC30},                                                   \
        {(base) + 6, "TIMER" n "TPR", F2812_TIMER, 0, 0, 0, 0x00FF},                                                   \
    {                                                                                                                  \
        (base) + 7, "TIMER" n "TPRH", F2812_TIMER, 0, 0, 0, 0x00FF                                                     \
    }
#define GROUP(n)                                                                                                       \
    {PIEIER1 + 2 * ((n)-1), "PIEIER" #n, F2812_PIE, 0, READS, 0, 0x00FF},                                              \
    {                                                                                                                  \
        PIEIER1 + 2 * ((n)-1) + 1, "PIEIFR" #n, F2812_PIE, 0, READS, 0, 0x00FF                                         \
    }
#define PORT(offset, p, pins)                                                                                          \
    {GPIO_MUX + (offset), "GP" p "MUX", F2812_GPIO, 0, EALLOW | READS, 0, (pins)},                                     \
        {GPIO_MUX + (offset) + 1, "GP" p "DIR", F2812_GPIO, 0, EALLOW | READS, 0, (pins)},                             \
        {GPIO_DATA + (offset), "GP" p "DAT", F2812_GPIO, 0, READS, 0, (pins)},                                         \
        {GPIO_DATA + (offset) + 1, "GP" p "SET", F2812_GPIO, 0, READS, 0, (pins)},                                     \
        {GPIO_DATA + (offset) + 2, "GP" p "CLEAR", F2812_GPIO, 0, READS, 0, (pins)},                                   \
    {                                                                                                                  \
        GPIO_DATA + (offset) + 3, "GP" p "TOGGLE", F2812_GPIO, 0, READS, 0, (pins)                                     \
    }
#define QUAL(offset, p)                                                                                                \
    {                                                                                                                  \
        GPIO_MUX + (offset) + 2, "GP" p "QUAL", F2812_MEMORY, 0, EALLOW, 0, 0x00FF                                     \
    }
#define SCI_OF(base, bit, p)                                                                                           \
    {(base), "SCICCR" p, F2812_SCI, F2812_CLOCK(bit), REPEATS, 0, 0x00FF},                                             \
        {(base) + 1, "SCICTL1" p, F2812_SCI, F2812_CLOCK(bit), REPEATS, 0, 0x006F},                                    \
        {(base) + 2, "SCIHBAUD" p, F2812_SCI, F2812_CLOCK(bit), REPEATS, 0, 0x00FF},                                   \
        {(base) + 3, "SCILBAUD" p, F2812_SCI, F2812_CLOCK(bit), REPEATS, 0, 0x00FF},                                   \
        {(base) + 4, "SCICTL2" p, F2812_SCI, F2812_CLOCK(bit), REPEATS, 0, 0x0003},                                    \
        {(base) + 5, "SCIRXST" p, F2812_SCI, F2812_CLOCK(bit), 0, 0, 0},                                               \
        {(base) + 6, "SCIRXEMU" p, F2812_SCI, F2812_CLOCK(bit), 0, 0, 0},                                              \
        {(base) + 7, "SCIRXBUF" p, F2812_SCI, F2812_CLOCK(bit), 0, 0, 0},                                              \
        {(base) + 9, "SCITXBUF" p, F2812_SCI, F2812_CLOCK(bit), 0, 0, 0x00FF},                                         \
        {(base) + 10, "SCIFFTX" p, F2812_SCI, F2812_CLOCK(bit), 0, 0, 0xE07F},                                         \
        {(base) + 11, "SCIFFRX" p, F2812_SCI, F2812_CLOCK(bit), 0, 0, 0x607F},                                         \
        {(base) + 12, "SCIFFCT" p, F2812_SCI, F2812_CLOCK(bit), 0, 0, 0x60FF},                                         \
    {                                                                                                                  \
        (base) + 15, "SCIPRI" p, F2812_SCI, F2812_CLOCK(bit), REPEATS, 0, 0x0018                                       \
    }

const f2812_register_t f2812_registers[] = {
    TIMER(TIMER0TIM, "0"),
    TIMER(TIMER0TIM + 8, "1"),
    TIMER(TIMER0TIM + 16, "2"),
    {PIECTRL, "PIECTRL", F2812_PIE, 0, READS, 0, 0x0001},
    {PIEACK, "PIEACK", F2812_PIE_ACK, 0, READS, 0, 0x0FFF},
    GROUP(1),
    GROUP(2),
    GROUP(3),
    GROUP(4),
    GROUP(5),
    GROUP(6),
    GROUP(7),
    GROUP(8),
    GROUP(9),
    GROUP(10),
    GROUP(11),
    GROUP(12),
    {HISPCP, "HISPCP", F2812_MEMORY, 0, EALLOW, 1, 0x0007},
    {LOSPCP, "LOSPCP", F2812_SYSCTL, 0, EALLOW | READS, 2, 0x0007},
    {PCLKCR, "PCLKCR", F2812_SYSCTL, 0, EALLOW | READS, 0, 0x5D0B},
    {LPMCR0, "LPMCR0", F2812_MEMORY, 0, EALLOW, 0x00FC, 0x00FF},
    {LPMCR1, "LPMCR1", F2812_MEMORY, 0, EALLOW, 0, 0xFFFF},
    {PLLCR, "PLLCR", F2812_SYSCTL, 0, EALLOW | READS, 0, 0x000F},
    {SCSR, "SCSR", F2812_WATCHDOG, 0, EALLOW | READS, 0x0005, 0x0003},
    {WDCNTR, "WDCNTR", F2812_WATCHDOG, 0, 0, 0, 0},
    {WDKEY, "WDKEY", F2812_WATCHDOG, 0, EALLOW, 0, 0x00FF},
    {WDCR, "WDCR", F2812_WATCHDOG, 0, EALLOW | READS, 0, 0x00FF},
    SCI_OF(SCIA, 10, "A"),
    {XINT1CR, "XINT1CR", F2812_MEMORY, 0, 0, 0, 0x0005},
    {XINT1CR + 1, "XINT2CR", F2812_MEMORY, 0, 0, 0, 0x0005},
    {XINT1CTR, "XINT1CTR", F2812_XINT, 0, WRITES, 0, 0},
    {XINT1CTR + 1, "XINT2CTR", F2812_XINT, 0, WRITES, 0, 0},
    PORT(0x00, "A", 0xFFFF),
    QUAL(0x00, "A"),
    PORT(0x04, "B", 0xFFFF),
    QUAL(0x04, "B"),
    PORT(0x0C, "D", 0x0063),
    QUAL(0x0C, "D"),
    PORT(0x10, "E", 0x0007),
    QUAL(0x10, "E"),
    PORT(0x14, "F", 0x7FFF),
    PORT(0x18, "G", 0x0030),
    SCI_OF(SCIB, 11, "B"),
};
const size_t f2812_register_count = sizeof f2812_registers / sizeof f2812_registers[0];
