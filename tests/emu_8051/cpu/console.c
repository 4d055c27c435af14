/// \file   console.c
/// \brief  A program that knows nothing of this emulator: large model, 256 octets of RAM, more than 8 KB of code, 64 KB of external RAM,
///         floats, and printf on the serial port in mode UART_MODE. It ends by reading END, with its exit code in RAM at 7Fh.
/// SPDX-License-Identifier: MIT
#include <8052.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ITEMS 12000u
#define END   0xFFFF

__data __at(0x7F) unsigned char exit_code;
__xdata __at(END) volatile unsigned char end;
static __xdata unsigned long item[ITEMS];
static __idata unsigned char upper[100];

int putchar(int c)
{
    SBUF = (unsigned char)c;
    while (!TI)
    {
    }
    TI = 0;
    return c;
}

static unsigned long state = 1;

static unsigned long draw(void)
{
    state = state * 1103515245ul + 12345ul;
    return state;
}

static unsigned crc16(unsigned crc, unsigned char octet) __reentrant
{
    unsigned char i;
    crc ^= (unsigned)octet << 8;
    for (i = 0; i < 8; i++)
    {
        crc = crc & 0x8000u ? crc << 1 ^ 0x1021u : crc << 1;
    }
    return crc;
}

static unsigned memory(void)
{
    unsigned i, crc = 0xFFFFu;
    for (i = 0; i < ITEMS; i++)
    {
        item[i] = draw();
    }
    for (i = 0; i < ITEMS; i++)
    {
        crc = crc16(crc, (unsigned char)(item[i] >> 16));
    }
    return crc;
}

static unsigned char idata_sum(void)
{
    unsigned char i, sum = 0;
    for (i = 0; i < sizeof upper; i++)
    {
        upper[i] = i * 7;
    }
    for (i = 0; i < sizeof upper; i++)
    {
        sum = (unsigned char)(sum * 3 + upper[i]);
    }
    return sum;
}

static unsigned long gcd(unsigned long a, unsigned long b) __reentrant
{
    return b ? gcd(b, a % b) : a;
}

void main(void)
{
    float sum = 0;
    unsigned char i;
    char text[24];
#if UART_MODE == 1
    TMOD = 0x20;
    TH1 = 0xFF;
    TR1 = 1;
    SCON = 0x40;
#endif
    for (i = 1; i <= 50; i++)
    {
        sum += sqrtf((float)i) + sinf((float)i / 10.0f) + powf((float)i, 0.25f);
    }
    printf("crc %04x\n", memory());
    printf("idata %u\n", (unsigned)idata_sum());
    printf("gcd %lu\n", gcd(3ul * 5 * 7 * 11 * 13 * 17, 17ul * 19 * 13));
    printf("float %ld\n", (long)(sum * 1000.0f));
    strcpy(text, "eight ");
    strcat(text, "bits");
    printf("%s %d %c\n", text, -12345, '!');
    exit_code = 42;
    (void)end;
    for (;;)
    {
    }
}
