/// Scans six channels for ever: AIN0..5 of one TLC2543, or with TWO AIN0..2 of two in step. For SDCC.
/// Codes of the last whole scan in `codes`, number of scans in `scans`.
/// SPDX-License-Identifier: MIT
#include <8051.h>
#include <stdint.h>

#define EOC      P1_0
#define IO_CLOCK P1_1
#define DATA_IN  P1_2
#define DATA_OUT P1_3
#define CS_N     P1_4
#define EOC_2    P1_5
#define OUT_2    P1_6
#define BITS     12

volatile uint16_t codes[6];
volatile uint8_t scans;
static uint16_t first, second;

static void transfer(uint8_t channel)
{
    uint8_t command = channel << 4, bit;
    while (!EOC || !EOC_2)
    {
    }
    first = 0;
    second = 0;
    CS_N = 0;
    for (bit = 0; bit < BITS; bit++)
    {
        DATA_IN = command >> 7;
        command <<= 1;
        first <<= 1;
        second <<= 1;
        if (DATA_OUT)
        {
            first |= 1;
        }
        if (OUT_2)
        {
            second |= 1;
        }
        IO_CLOCK = 1;
        IO_CLOCK = 0;
    }
    CS_N = 1;
}

void main(void)
{
    uint8_t channel;
    IO_CLOCK = 0;
    for (;;)
    {
        transfer(0);
#ifdef TWO
        for (channel = 0; channel < 3; channel++)
        {
            transfer(channel < 2 ? channel + 1 : 0);
            codes[channel] = first;
            codes[channel + 3] = second;
        }
#else
        for (channel = 0; channel < 6; channel++)
        {
            transfer(channel < 5 ? channel + 1 : 0);
            codes[channel] = first;
        }
#endif
        scans++;
    }
}
