/// \file   tape.h
/// \brief  The reference vectors as one sequence of numbers that vectors_table.py writes and the target reads in the same order.
///
///     vector NAME COUNT WORST LIMIT      largest error of COUNT values and its limit, as bit patterns
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_TARGETS_TAPE_H
#define INS_TESTS_TARGETS_TAPE_H
#include "report.h"

#ifdef __AVR__
#include <avr/pgmspace.h>
#define TAPE_FLASH   PROGMEM // else it would be copied to the RAM
#define TAPE_READ(p) pgm_read_float(p)
#else
#define TAPE_FLASH
#define TAPE_READ(p) (*(p))
#endif
#define TAPE_PIECE 4096 ///< numbers in all pieces but the last: an array on AVR has less than 32768 octets

extern const ins_real* const tape_pieces[];
extern const uint16_t tape_length;

ins_real tape_real(void);
void tape_reals(ins_real* out, unsigned n);
/// 0 .. 2^24 - 1
uint32_t tape_integer(void);
/// Numbers left; 0 too if one was asked for beyond the end.
uint16_t tape_left(void);
/// A section starts: its name and the limit of its errors. \return records in it.
unsigned tape_section(const char* name, ins_real limit);
void check(ins_real got, ins_real want, ins_real scale);
/// The next n of the tape are wanted; errors over 1 or the number's own size.
void check_reals(const ins_real* got, unsigned n);
/// Of the largest of them, at least `least`.
void check_together(const ins_real* got, unsigned n, ins_real least);
/// q and -q are the same attitude.
void check_quat(const ins_real q[4]);
void check_true(int condition);
void check_end(void);
/// Sections that failed.
unsigned checks_failed(void);

void check_attitude(void);
void check_navigation(void);
void check_filters(void);
void check_vehicle(void);
void check_octets(void);

#endif // INS_TESTS_TARGETS_TAPE_H
