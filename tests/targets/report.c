/// \file   report.c
/// \brief  Random numbers, digests of bit patterns, hexadecimal output.
/// SPDX-License-Identifier: MIT
#include "report.h"
#include <string.h>

#define FNV_START UINT64_C(14695981039346656037)
#define FNV_PRIME UINT64_C(1099511628211)
#define LAST      4 // bit patterns shown beside the digest
#define SEED      UINT32_C(2463534242)

#ifdef INS_REAL_FLOAT
typedef uint32_t bits_t;
#else
typedef uint64_t bits_t;
#endif

static uint32_t seed = SEED;
static const char* running;
static uint64_t digest;
static uint32_t count;
static uint64_t last[LAST];

void report_text(const char* text)
{
    while (*text != 0)
    {
        port_put(*text++);
    }
}

void report_number(uint32_t n)
{
    if (n >= 10)
    {
        report_number(n / 10);
    }
    port_put((char)('0' + n % 10));
}

static void hexadecimal(uint64_t x, unsigned digits)
{
    for (unsigned i = digits; i-- > 0;)
    {
        port_put("0123456789abcdef"[(unsigned)(x >> (4 * i)) & 15u]);
    }
}

int report_exit(unsigned failed)
{
    report_text("exit ");
    report_number(failed);
    report_text("\n");
    return port_exit(failed == 0 ? 0 : 1);
}

static bits_t pattern(ins_real x)
{
    bits_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static void take(uint64_t word)
{
    digest = (digest ^ word) * FNV_PRIME;
    last[count % LAST] = word;
    count++;
}

void same_begin(const char* name)
{
    running = name;
    seed = SEED;
    digest = FNV_START;
    count = 0;
}

void same_integer(uint32_t x)
{
    take(x);
}

void same_real(ins_real x)
{
    take(pattern(x));
}

void same_reals(const ins_real* x, unsigned n)
{
    for (unsigned i = 0; i < n; i++)
    {
        same_real(x[i]);
    }
}

void same_end(void)
{
    report_text("same ");
    report_text(running);
    report_text(" ");
    report_number(count);
    report_text(" ");
    hexadecimal(digest, 16);
    for (uint32_t i = count < LAST ? 0 : count - LAST; i < count; i++)
    {
        report_text(" ");
        hexadecimal(last[i % LAST], 2 * sizeof(bits_t));
    }
    report_text("\n");
}

void report_reals(const ins_real* x, unsigned n)
{
    for (unsigned i = 0; i < n; i++)
    {
        report_text(" ");
        hexadecimal(pattern(x[i]), 2 * sizeof(bits_t));
    }
}

void near_reals(const char* name, const ins_real* x, unsigned n)
{
    report_text("near ");
    report_text(name);
    report_reals(x, n);
    report_text("\n");
}

/// Marsaglia's xorshift, 32 bits.
uint32_t random_bits(void)
{
    seed ^= seed << 13;
    seed ^= seed >> 17;
    seed ^= seed << 5;
    return seed;
}

ins_real random_real(ins_real scale)
{
    const int32_t n = (int32_t)(random_bits() >> 8) - (INT32_C(1) << 23);
    return scale * ((ins_real)n / (ins_real)(INT32_C(1) << 23));
}

void random_reals(ins_real scale, ins_real* out, unsigned n)
{
    for (unsigned i = 0; i < n; i++)
    {
        out[i] = random_real(scale);
    }
}
