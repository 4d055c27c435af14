/// \file   wide_octets.h
/// \brief  Put before every source with -include: an octet is a 16-bit object, as where CHAR_BIT is 16.
///
/// The system's headers come first and keep their own type; all that is compiled after them gets the wide one.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_WIDE_OCTETS_H
#define INS_TESTS_WIDE_OCTETS_H
#include <stdint.h>
#define uint_least8_t uint16_t
#endif // INS_TESTS_WIDE_OCTETS_H
