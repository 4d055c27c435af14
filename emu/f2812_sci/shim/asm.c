/// asm() statements: those of TI's headers and examples by name (SPRU430), anything else is reported.
/// SPDX-License-Identifier: MIT
#include "shim_internal.h"
#include <stdlib.h>
#include <string.h>

void f2812_asm(const char* instruction); // declared to firmware in f2812_guest.h

static char upper(char c)
{
    return c >= 'a' && c <= 'z' ? (char)(c - 'a' + 'A') : c;
}

/// Whether text goes on with a word, which is passed; letter case is one, and blanks before it do not count.
static bool word(const char** text, const char* name)
{
    const char* at = *text;
    while (*at == ' ' || *at == '\t')
    {
        at++;
    }
    for (; *name != '\0'; name++, at++)
    {
        if (upper(*at) != *name)
        {
            return false;
        }
    }
    if ((*at >= '0' && *at <= '9') || (upper(*at) >= 'A' && upper(*at) <= 'Z') || *at == '_')
    {
        return false;
    }
    *text = at;
    return true;
}

static bool ends(const char* text)
{
    return text[strspn(text, " \t\r\n")] == '\0' || *text == ';';
}

/// SETC or CLRC with its list of bits. Modes that only the C28x's own instructions feel do nothing here.
static bool status_bits(f2812_shim_t* self, const char* text, bool set)
{
    static const char* const felt_by_code_only[] = {"OBJMODE", "AMODE", "M0M1MAP", "PAGE0", "VMAP", "SXM",
                                                    "OVM",     "TC",    "C",       "PM",    "SPA",  "XF"};
    do
    {
        bool known = false;
        if (word(&text, "INTM"))
        {
            f2812_set_intm(self->device, set);
            known = true;
        }
        else if (word(&text, "DBGM"))
        {
            f2812_set_dbgm(self->device, set);
            known = true;
        }
        for (size_t i = 0; !known && i < sizeof felt_by_code_only / sizeof *felt_by_code_only; i++)
        {
            known = word(&text, felt_by_code_only[i]);
        }
        if (!known)
        {
            return false;
        }
    } while (word(&text, ","));
    return ends(text);
}

/// "RPT #n || NOP": n + 1 times.
static bool repeat(f2812_shim_t* self, const char* text)
{
    text += strspn(text, " \t");
    if (*text != '#')
    {
        return false;
    }
    char* rest;
    const unsigned long times = strtoul(text + 1, &rest, 10);
    const char* at = rest;
    if (times > 255 || !word(&at, "||") || !word(&at, "NOP") || !ends(at))
    {
        return false;
    }
    f2812_shim_wait(self, times + 1);
    return true;
}

static bool execute(f2812_shim_t* self, const char* text)
{
    if (word(&text, "EALLOW"))
    {
        f2812_set_eallow(self->device, true);
    }
    else if (word(&text, "EDIS"))
    {
        f2812_set_eallow(self->device, false);
    }
    else if (word(&text, "CLRC"))
    {
        return status_bits(self, text, false);
    }
    else if (word(&text, "SETC"))
    {
        return status_bits(self, text, true);
    }
    else if (word(&text, "RPT"))
    {
        return repeat(self, text);
    }
    else if (word(&text, "IDLE"))
    {
        f2812_shim_idle(self);
    }
    else if (word(&text, "ESTOP0") || word(&text, "ESTOP1"))
    {
        f2812_shim_finish(self, "ESTOP0");
    }
    else if (!word(&text, "NOP"))
    {
        return ends(text);
    }
    return true;
}

void f2812_asm(const char* instruction)
{
    f2812_shim_t* const self = f2812_shim_current;
    self->midway = false;
    f2812_shim_step(self, F2812_CYCLES_ASM);
    if (!execute(self, instruction))
    {
        f2812_shim_error(self, EMU_NOT_MODELLED, instruction, 0);
    }
    f2812_shim_step(self, 0);
}
