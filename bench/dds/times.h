/// \file   times.h
/// \brief  Quantiles of times, as a line of JSON.
/// SPDX-License-Identifier: MIT
#ifndef BENCH_DDS_TIMES_H_INCLUDED
#define BENCH_DDS_TIMES_H_INCLUDED
#include <stddef.h>
#include <stdint.h>
#include <time.h>

int64_t times_now_ns(clockid_t clock);
/// {"name": NAME, "count", "p50_us", "p99_us", "max_us"} on standard output; sorts the times.
void times_print(const char* name, int64_t* time_ns, size_t count);

#endif // BENCH_DDS_TIMES_H_INCLUDED
