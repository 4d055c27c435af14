/// \file   stdint.h
/// \brief  Exact-width types as the C28x has them: from 16 bits up, for a char has 16 bits there. Sources that define a uint8_t of their own compile.
/// SPDX-License-Identifier: MIT
#ifndef F2812_STDINT_H_INCLUDED
#define F2812_STDINT_H_INCLUDED

typedef short int16_t;
typedef unsigned short uint16_t;
typedef int int32_t;
typedef unsigned int uint32_t;
typedef long long int64_t;
typedef unsigned long long uint64_t;

typedef short int_least8_t, int_least16_t, int_fast8_t, int_fast16_t;
typedef unsigned short uint_least8_t, uint_least16_t, uint_fast8_t, uint_fast16_t;
typedef int int_least32_t, int_fast32_t;
typedef unsigned int uint_least32_t, uint_fast32_t;
typedef long long int_least64_t, int_fast64_t, intmax_t;
typedef unsigned long long uint_least64_t, uint_fast64_t, uintmax_t;
typedef long intptr_t;
typedef unsigned long uintptr_t;

#define INT16_MIN  (-32767 - 1)
#define INT16_MAX  32767
#define UINT16_MAX 65535U
#define INT32_MIN  (-2147483647 - 1)
#define INT32_MAX  2147483647
#define UINT32_MAX 4294967295U
#define INT64_MIN  (-9223372036854775807LL - 1)
#define INT64_MAX  9223372036854775807LL
#define UINT64_MAX 18446744073709551615ULL

#define INT16_C(x)  x
#define UINT16_C(x) x
#define INT32_C(x)  x
#define UINT32_C(x) x##U
#define INT64_C(x)  x##LL
#define UINT64_C(x) x##ULL

#endif // F2812_STDINT_H_INCLUDED
