/// \file   stdint.h
/// \brief  Where int has 16 bits and an octet is a 16-bit object: for ESBMC --16, whose long has 32 bits.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_INT16_STDINT_H
#define INS_TESTS_INT16_STDINT_H

typedef signed int int16_t;
typedef unsigned int uint16_t;
typedef signed long int32_t;
typedef unsigned long uint32_t;
typedef signed long long int64_t;
typedef unsigned long long uint64_t;
typedef uint16_t uint_least8_t;

#define INT32_C(x) x##L
#define INT64_C(x) x##LL

#endif // INS_TESTS_INT16_STDINT_H
