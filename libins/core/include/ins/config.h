/// \file   ins/config.h
/// \brief  The number type, status codes and export macro. The only core header with conditional compilation beside ins_math.h.
///
/// Build with -DINS_REAL_FLOAT for the float library (libinsf); without it the type is double (libins).
/// SPDX-License-Identifier: MIT
#ifndef INS_CONFIG_H_INCLUDED
#define INS_CONFIG_H_INCLUDED
#include <float.h>
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

#ifdef INS_REAL_FLOAT
typedef float ins_real;
#define INS_C(x)      x##f
#define INS_TOL(d, f) (f)
#define INS_EPSILON   FLT_EPSILON
#define INS_REAL_MAX  FLT_MAX
#else
#if DBL_MANT_DIG < 53
#error "double has fewer than 53 bits here (AVR, SDCC, C28x COFF): build with -DINS_REAL_FLOAT"
#endif
typedef double ins_real;
#define INS_C(x)      x
#define INS_TOL(d, f) (d)
#define INS_EPSILON   DBL_EPSILON
#define INS_REAL_MAX  DBL_MAX
#endif

#if defined(__GNUC__) && !defined(__SDCC)
#define INS_API __attribute__((visibility("default")))
#else
#define INS_API
#endif

/// 1 where compilers take two or four reals at once without being asked: whole rows of a symmetric matrix then cost less than half of
/// them and a copy. The bits are the same.
#if defined(__SSE2__) || defined(__ARM_NEON)
#define INS_VECTORS 1
#else
#define INS_VECTORS 0
#endif

/// One octet on a wire, 0..255, in whatever the machine's smallest integer is (16 bits on a C28x): mask on every store.
typedef uint_least8_t ins_octet_t;

/// 0 = done; negative = refused and nothing changed; positive = done, with a remark.
typedef int ins_status_t;

#define INS_STATUS_LIST(X)                                                                                             \
    X(INS_OK, 0, "done")                                                                                               \
    X(INS_E_RANGE, -1, "an argument is out of range or not a number")                                                  \
    X(INS_E_STATE, -2, "not in this state (a transfer is in progress)")                                                \
    X(INS_E_ABI, -3, "headers and library differ in version or in the size of ins_real")                               \
    X(INS_E_GATE, -4, "measurement refused: its innovation is outside the gate")                                       \
    X(INS_S_START, 1, "done with fewer previous samples than the formula wants (start-up)")

#define INS_STATUS_ENUM(name, value, text) name = (value),
enum
{
    INS_STATUS_LIST(INS_STATUS_ENUM) INS_STATUS_COUNT_ = 6
};
#undef INS_STATUS_ENUM

#ifdef __cplusplus
}
#endif
#endif // INS_CONFIG_H_INCLUDED
