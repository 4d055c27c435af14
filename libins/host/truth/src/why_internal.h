/// \file   why_internal.h
/// \brief  Refusals in words: place, value found, what would be right.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_WHY_INTERNAL_H_INCLUDED
#define INS_TRUTH_WHY_INTERNAL_H_INCLUDED
#include <stdbool.h>
#include <stddef.h>

/// Where a refusal is written: size characters, or text = NULL for nowhere.
typedef struct ins_why_t
{
    char* text;
    size_t size;
} ins_why_t;

/// printf into why.
void ins_why_say(const ins_why_t* why, const char* format, ...);
/// \return true when low <= x <= high; otherwise (NaN too) false, and why says so: "<where><name> is ..., give ... to
/// ...".
bool ins_why_range(const ins_why_t* why, const char* where, const char* name, double x, double low, double high);

#endif // INS_TRUTH_WHY_INTERNAL_H_INCLUDED
