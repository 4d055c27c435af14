/// \file   tape.c
/// \brief  Reads the reference vectors, keeps the largest error of a section.
/// SPDX-License-Identifier: MIT
#include "tape.h"

#define QUAT_N 4
#define MOST   18 // values compared together

static uint16_t at;
static uint16_t beyond;
static const char* section;
static ins_real limit_of;
static ins_real worst;
static uint32_t checked;
static unsigned failed;

ins_real tape_real(void)
{
    if (at == tape_length)
    {
        beyond = 1;
        return 0;
    }
    const ins_real* place = &tape_pieces[at / TAPE_PIECE][at % TAPE_PIECE];
    at++;
    return TAPE_READ(place);
}

void tape_reals(ins_real* out, unsigned n)
{
    for (unsigned i = 0; i < n; i++)
    {
        out[i] = tape_real();
    }
}

uint32_t tape_integer(void)
{
    return (uint32_t)tape_real();
}

uint16_t tape_left(void)
{
    return (uint16_t)(tape_length - at);
}

unsigned tape_section(const char* name, ins_real limit)
{
    section = name;
    limit_of = limit;
    worst = 0;
    checked = 0;
    return (unsigned)tape_integer();
}

void check(ins_real got, ins_real want, ins_real scale)
{
    const ins_real error = ins_fabs(got - want) / scale;
    checked++;
    if (!(error <= worst))
    {
        worst = error;
    }
}

void check_reals(const ins_real* got, unsigned n)
{
    for (unsigned i = 0; i < n; i++)
    {
        const ins_real want = tape_real();
        check(got[i], want, ins_fabs(want) > 1 ? ins_fabs(want) : 1);
    }
}

void check_together(const ins_real* got, unsigned n, ins_real least)
{
    ins_real want[MOST];
    ins_real largest = least;
    check_true(n <= MOST);
    for (unsigned i = 0; i < n && i < MOST; i++)
    {
        want[i] = tape_real();
        largest = ins_fabs(want[i]) > largest ? ins_fabs(want[i]) : largest;
    }
    for (unsigned i = 0; i < n && i < MOST; i++)
    {
        check(got[i], want[i], largest);
    }
}

void check_quat(const ins_real q[QUAT_N])
{
    ins_real want[QUAT_N];
    ins_real dot = 0;
    tape_reals(want, QUAT_N);
    for (int i = 0; i < QUAT_N; i++)
    {
        dot += q[i] * want[i];
    }
    for (int i = 0; i < QUAT_N; i++)
    {
        check(dot < 0 ? -q[i] : q[i], want[i], 1);
    }
}

void check_true(int condition)
{
    check(condition ? 0 : INS_REAL_MAX, 0, 1);
}

void check_end(void)
{
    const ins_real figures[2] = {worst, limit_of};
    report_text("vector ");
    report_text(section);
    report_text(" ");
    report_number(checked);
    report_reals(figures, 2);
    report_text("\n");
    if (checked == 0 || beyond || !(worst <= limit_of))
    {
        failed++;
    }
}

unsigned checks_failed(void)
{
    return failed;
}
