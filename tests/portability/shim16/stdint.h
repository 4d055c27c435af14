/// \file   stdint.h
/// \brief  What a machine of 16-bit octets offers: no 8-bit type, and a least 8-bit type of 16 bits. For compile checks on a PC.
///
/// Int and pointers stay the PC's. INT64_C and the rest are as in C11 7.20.4.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_SHIM16_STDINT_H
#define INS_TESTS_SHIM16_STDINT_H

typedef signed short int16_t;
typedef unsigned short uint16_t;
typedef signed int int32_t;
typedef unsigned int uint32_t;
typedef signed long long int64_t;
typedef unsigned long long uint64_t;
typedef int16_t int_least8_t;
typedef uint16_t uint_least8_t;
typedef int16_t int_least16_t;
typedef uint16_t uint_least16_t;
typedef int32_t int_least32_t;
typedef uint32_t uint_least32_t;
typedef int64_t int_least64_t;
typedef uint64_t uint_least64_t;

#define INT32_C(x)  x
#define UINT32_C(x) x##U
#define INT64_C(x)  x##LL
#define UINT64_C(x) x##ULL

#endif // INS_TESTS_SHIM16_STDINT_H
