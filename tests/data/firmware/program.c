/// A program as SDCC's own regression tests are: it knows no board, writes to SBUF in mode 0, and ends by reading XDATA FFF0h with its
/// exit code in internal RAM 00h. It needs --model-large, 256 octets of RAM, 64 KB of XDATA and more code than 8 KB of flash.
/// SPDX-License-Identifier: MIT
#include <8051.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define SIEVE 50000U

static uint8_t composite[SIEVE];
static __idata uint8_t upper[100]; ///< reaches beyond 7Fh
__code __at(0xF000) const char high[] = "code at F000h";
__code __at(0x4000) const uint8_t ballast[0x4000] = {1};
__xdata __at(0xFFF0) volatile uint8_t end_of_program;
static uint8_t failures;

int putchar(int c)
{
    SBUF = (uint8_t)c;
    while (!TI)
    {
    }
    TI = 0;
    return c;
}

static void check(const char* what, uint8_t good)
{
    printf("%s: %s\n", what, good ? "good" : "BAD");
    failures += !good;
}

static uint16_t primes(void)
{
    uint16_t count = 0;
    memset(composite, 0, sizeof composite);
    for (uint16_t n = 2; n < SIEVE; n++)
    {
        if (!composite[n])
        {
            count++;
            for (uint32_t m = (uint32_t)n * n; m < SIEVE; m += n)
            {
                composite[(uint16_t)m] = 1;
            }
        }
    }
    return count;
}

void main(void)
{
    uint16_t sum = 0;
    SCON = 0; // mode 0
    failures = 0;
    for (uint8_t i = 0; i < sizeof upper; i++)
    {
        upper[i] = i;
    }
    check("5133 primes below 50000", primes() == 5133);
    check("sine", fabsf(sinf(0.5f) - 0.479425539f) < 1e-6f);
    check("high code", strcmp(high, "code at F000h") == 0 && ballast[0] == 1);
    for (uint8_t i = 0; i < sizeof upper; i++)
    {
        sum += upper[i];
    }
    check("upper RAM", sum == 4950);
    *(__idata uint8_t*)0 = failures + EXTRA_FAILURES; // R0
    (void)end_of_program;
    for (;;)
    {
    }
}
