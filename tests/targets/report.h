/// \file   report.h
/// \brief  What the target programs share: random input and printed results that are the same on every machine, however its octets lie.
///
///     same NAME COUNT DIGEST LAST...     digest of COUNT numbers' bit patterns, and the last of them: must agree on all machines
///     near NAME WORD...                  bit patterns of one result that libm had a part in
///     exit CODE                          the last line: 0, or how many checks failed
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_TARGETS_REPORT_H
#define INS_TESTS_TARGETS_REPORT_H
#include "ins/ins.h"

#define STEPS 48 ///< of most runs

/// One character to whoever runs the program.
void port_put(char c);
/// Ends the program with this exit code, where there is one.
int port_exit(int code);

void report_text(const char* text);
void report_number(uint32_t n);
/// A space and the bit pattern of each.
void report_reals(const ins_real* x, unsigned n);
/// \return what main returns.
int report_exit(unsigned failed);

/// A digest starts, and so does the sequence of random numbers.
void same_begin(const char* name);
void same_integer(uint32_t x);
void same_real(ins_real x);
void same_reals(const ins_real* x, unsigned n);
void same_end(void);
void near_reals(const char* name, const ins_real* x, unsigned n);

uint32_t random_bits(void);
/// In [-scale, scale), scale times a number of 24 bits.
ins_real random_real(ins_real scale);
void random_reals(ins_real scale, ins_real* out, unsigned n);

void run_attitude(void);
void run_attitude_other(void);
void run_navigation(void);
void run_filters(void);
void run_vehicle(void);
void run_octets(void);
void run_libm(void);

#endif // INS_TESTS_TARGETS_REPORT_H
