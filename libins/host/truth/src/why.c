/// \file   why.c
/// \brief  Refusals in words.
/// SPDX-License-Identifier: MIT
#include "why_internal.h"
#include <stdarg.h>
#include <stdio.h>

void ins_why_say(const ins_why_t* why, const char* format, ...)
{
    if (why->text != NULL && why->size > 0)
    {
        va_list args;
        va_start(args, format);
        vsnprintf(why->text, why->size, format, args);
        va_end(args);
    }
}

bool ins_why_range(const ins_why_t* why, const char* where, const char* name, double x, double low, double high)
{
    if (x >= low && x <= high)
    {
        return true;
    }
    ins_why_say(why, "%s%s is %.9g, give %.9g to %.9g", where, name, x, low, high);
    return false;
}
