/// \file   arguments.h
/// \brief  Numbers of the command line of ins-navd. Each: 1; 0 after a message that names the option.
/// SPDX-License-Identifier: MIT
#ifndef NAVD_ARGUMENTS_H_INCLUDED
#define NAVD_ARGUMENTS_H_INCLUDED
#include <stdint.h>

#define ARGUMENT_REALS_MAX 8

/// `want` reals with commas between; with one_for_all one alone stands for all.
int argument_reals(const char* name, const char* text, int want, int one_for_all, double scale, double* out);
int argument_above_zero(const char* name, const char* text, double* out);
int argument_whole(const char* name, const char* text, uint64_t least, uint64_t most, uint64_t* out);

#endif // NAVD_ARGUMENTS_H_INCLUDED
