/// \file   summary.h
/// \brief  Reports of a run, equal ones counted, and its summary as JSON. Not installed.
/// SPDX-License-Identifier: MIT
#ifndef F2812_SUMMARY_H_INCLUDED
#define F2812_SUMMARY_H_INCLUDED
#include "shim.h"
#include <stdio.h>

#define F2812_NOTES_MAX 64u
#define F2812_NOTE_MAX  160u ///< octets of a text

typedef struct f2812_note_t
{
    emu_report_kind_t kind;
    char text[F2812_NOTE_MAX];
    uint32_t detail;
    emu_time_t first;
    uint64_t count;
} f2812_note_t;

typedef struct f2812_notes_t
{
    f2812_note_t note[F2812_NOTES_MAX];
    unsigned count;
    uint64_t wrong; ///< guest errors
} f2812_notes_t;

/// An emu_report_fn; ctx is f2812_notes_t.
void f2812_take_note(void* ctx, emu_report_kind_t kind, const char* text, uint32_t detail, emu_time_t at);
void f2812_print_summary(FILE* to, const char* program, f2812_t* device, const f2812_shim_t* shim,
                         const f2812_notes_t* notes);

#endif // F2812_SUMMARY_H_INCLUDED
