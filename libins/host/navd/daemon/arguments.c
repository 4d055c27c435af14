/// \file   arguments.c
/// \brief  See arguments.h.
/// SPDX-License-Identifier: MIT
#include "arguments.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

int argument_reals(const char* name, const char* text, int want, int one_for_all, double scale, double* out)
{
    const char* at = text;
    int count = 0;
    for (;;)
    {
        char* end;
        const double value = strtod(at, &end);
        if (end == at || count >= want || (*end != ',' && *end != '\0') ||
            !(value - value == 0.0)) // not a number, infinite
        {
            count = 0;
            break;
        }
        out[count++] = value * scale;
        if (*end == '\0')
        {
            break;
        }
        at = end + 1;
    }
    if (count == 1 && one_for_all)
    {
        for (; count < want; count++)
        {
            out[count] = out[0];
        }
    }
    if (count != want)
    {
        static const char* const counts[ARGUMENT_REALS_MAX + 1] = {"",
                                                                   "a number",
                                                                   "two numbers with commas between",
                                                                   "three numbers with commas between",
                                                                   "four numbers with commas between",
                                                                   "five numbers with commas between",
                                                                   "six numbers with commas between",
                                                                   "seven numbers with commas between",
                                                                   "eight numbers with commas between"};
        fprintf(stderr, "ins-navd: --%s: '%s' is not %s%s\n", name, text, counts[want],
                one_for_all ? ", nor one for all three" : "");
        return 0;
    }
    return 1;
}

int argument_above_zero(const char* name, const char* text, double* out)
{
    if (!argument_reals(name, text, 1, 0, 1.0, out))
    {
        return 0;
    }
    if (!(*out > 0.0))
    {
        fprintf(stderr, "ins-navd: --%s: '%s' is not above 0\n", name, text);
        return 0;
    }
    return 1;
}

int argument_whole(const char* name, const char* text, uint64_t least, uint64_t most, uint64_t* out)
{
    char* end;
    errno = 0;
    const unsigned long long value = strtoull(text, &end, 10);
    if (text[0] < '0' || text[0] > '9' || *end != '\0' || errno != 0 || value < least || value > most)
    {
        fprintf(stderr, "ins-navd: --%s: '%s' is not a whole number from %llu to %llu\n", name, text,
                (unsigned long long)least, (unsigned long long)most);
        return 0;
    }
    *out = value;
    return 1;
}
