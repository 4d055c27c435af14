/// \file   times.c
/// \brief  times.h.
/// SPDX-License-Identifier: MIT
#include "times.h"
#include <stdio.h>
#include <stdlib.h>

int64_t times_now_ns(clockid_t clock)
{
    struct timespec now;
    (void)clock_gettime(clock, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static int ascending(const void* a, const void* b)
{
    const int64_t x = *(const int64_t*)a;
    const int64_t y = *(const int64_t*)b;
    return (x > y) - (x < y);
}

void times_print(const char* name, int64_t* time_ns, size_t count)
{
    qsort(time_ns, count, sizeof *time_ns, ascending);
    printf("{\"name\":\"%s\",\"count\":%zu,\"p50_us\":%.2f,\"p99_us\":%.2f,\"max_us\":%.2f}\n", name, count,
           (double)time_ns[count / 2] * 1e-3, (double)time_ns[count * 99 / 100] * 1e-3,
           (double)time_ns[count - 1] * 1e-3);
}
