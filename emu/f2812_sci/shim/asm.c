/// asm() statements: those of TI's headers and examples by name (SPRU430), anything else is reported.
/// SPDX-License-Identifier: MIT
#include "shim_internal.h"
#include <stdlib.h>
#include <string.h>

#define REPEAT_MAX 255u // RPT #8bit
#define KNOWN      64u  ///< instructions that need no decoding again

void f2812_asm(const char* instruction); // declared to firmware in f2812_guest.h

static char upper(char c)
{
    return c >= 'a' && c <= 'z' ? (char)(c - 'a' + 'A') : c;
}

/// Whether text goes on with a word, which is passed; letter case is one, and blanks before it do not count.
static bool word(const char** text, const char* name)
{
    const bool letters = upper(*name) >= 'A' && upper(*name) <= 'Z';
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
    if (letters && ((*at >= '0' && *at <= '9') || (upper(*at) >= 'A' && upper(*at) <= 'Z') || *at == '_'))
    {
        return false;
    }
    *text = at;
    return true;
}

static bool ends(const char* text)
{
    text += strspn(text, " \t\r\n");
    return *text == '\0' || *text == ';';
}

/// What an instruction does here.
typedef struct operation_t
{
    const char* text;
    enum
    {
        UNKNOWN,
        NOTHING,
        STATUS,
        REPEAT,
        EALLOW,
        EDIS,
        IDLE,
        ESTOP
    } what;
    bool set, intm, dbgm; ///< STATUS: bits of ST1
    unsigned times;       ///< REPEAT
} operation_t;

/// The list of bits of SETC and CLRC. Modes that only the C28x's own instructions feel do nothing here.
static operation_t status_bits(const char* text, bool set)
{
    static const char* const felt_by_code_only[] = {"OBJMODE", "AMODE", "M0M1MAP", "PAGE0", "VMAP", "SXM",
                                                    "OVM",     "TC",    "C",       "PM",    "SPA",  "XF"};
    operation_t op = {.what = STATUS, .set = set};
    do
    {
        const bool intm = word(&text, "INTM");
        const bool dbgm = !intm && word(&text, "DBGM");
        bool known = intm || dbgm;
        for (size_t i = 0; !known && i < sizeof felt_by_code_only / sizeof *felt_by_code_only; i++)
        {
            known = word(&text, felt_by_code_only[i]);
        }
        if (!known)
        {
            return (operation_t){.what = UNKNOWN};
        }
        op.intm = op.intm || intm;
        op.dbgm = op.dbgm || dbgm;
    } while (word(&text, ","));
    return ends(text) ? op : (operation_t){.what = UNKNOWN};
}

/// "RPT #n || NOP": n + 1 times.
static operation_t repeat(const char* text)
{
    text += strspn(text, " \t");
    if (*text != '#')
    {
        return (operation_t){.what = UNKNOWN};
    }
    char* rest;
    const unsigned long times = strtoul(text + 1, &rest, 10);
    const char* at = rest;
    const bool known = times <= REPEAT_MAX && word(&at, "||") && word(&at, "NOP") && ends(at);
    return (operation_t){.what = known ? REPEAT : UNKNOWN, .times = (unsigned)times + 1u};
}

static operation_t decode(const char* text)
{
    static const struct
    {
        const char* name;
        operation_t op;
    } plain[] = {{"EALLOW", {.what = EALLOW}}, {"EDIS", {.what = EDIS}},    {"IDLE", {.what = IDLE}},
                 {"ESTOP0", {.what = ESTOP}},  {"ESTOP1", {.what = ESTOP}}, {"NOP", {.what = NOTHING}}};
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++)
    {
        if (word(&text, plain[i].name))
        {
            return plain[i].op;
        }
    }
    if (word(&text, "SETC"))
    {
        return status_bits(text, true);
    }
    if (word(&text, "CLRC"))
    {
        return status_bits(text, false);
    }
    if (word(&text, "RPT"))
    {
        return repeat(text);
    }
    return (operation_t){.what = ends(text) ? NOTHING : UNKNOWN};
}

static void execute(f2812_shim_t* self, const operation_t* op)
{
    switch (op->what)
    {
    case EALLOW:
    case EDIS:
        f2812_set_eallow(self->device, op->what == EALLOW);
        break;
    case STATUS:
        if (op->intm)
        {
            f2812_set_intm(self->device, op->set);
        }
        if (op->dbgm)
        {
            f2812_set_dbgm(self->device, op->set);
        }
        break;
    case REPEAT:
        f2812_shim_wait(self, op->times);
        break;
    case IDLE:
        f2812_shim_idle(self);
        break;
    case ESTOP:
        f2812_shim_finish(self, "ESTOP0");
        break;
    case UNKNOWN:
        f2812_shim_error(self, EMU_NOT_MODELLED, op->text, 0);
        break;
    case NOTHING:
        break;
    }
}

void f2812_asm(const char* instruction)
{
    static operation_t known[KNOWN];
    f2812_shim_t* const self = f2812_shim_current;
    operation_t* const op = &known[(uintptr_t)instruction / 8 % KNOWN];
    self->midway = false;
    f2812_shim_step(self, F2812_CYCLES_ASM);
    if (op->text != instruction)
    {
        *op = decode(instruction);
        op->text = instruction;
    }
    execute(self, op);
    f2812_shim_step(self, 0);
}
