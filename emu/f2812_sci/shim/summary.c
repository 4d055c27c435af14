/// What a board program has to say at its end.
/// SPDX-License-Identifier: MIT
#include "summary.h"
#include <inttypes.h>
#include <string.h>

void f2812_take_note(void* ctx, emu_report_kind_t kind, const char* text, uint32_t detail, emu_time_t at)
{
    f2812_notes_t* const self = ctx;
    self->wrong += kind == EMU_GUEST_ERROR;
    for (unsigned i = 0; i < self->count; i++)
    {
        f2812_note_t* const known = &self->note[i];
        if (known->kind == kind && known->detail == detail && strncmp(known->text, text, F2812_NOTE_MAX - 1) == 0)
        {
            known->count++;
            return;
        }
    }
    if (self->count < F2812_NOTES_MAX)
    {
        f2812_note_t* const note = &self->note[self->count++];
        *note = (f2812_note_t){.kind = kind, .detail = detail, .first = at, .count = 1};
        (void)snprintf(note->text, sizeof note->text, "%s", text);
    }
}

static void print_text(FILE* to, const char* text)
{
    (void)fputc('"', to);
    for (; *text != '\0'; text++)
    {
        if (*text == '"' || *text == '\\')
        {
            (void)fputc('\\', to);
        }
        if ((unsigned char)*text >= ' ')
        {
            (void)fputc(*text, to);
        }
    }
    (void)fputc('"', to);
}

void f2812_print_summary(FILE* to, const char* program, f2812_t* device, const f2812_shim_t* shim,
                         const f2812_notes_t* notes)
{
    const f2812_shim_stats_t* const s = f2812_shim_stats(shim);
    fprintf(to, "{\"program\": ");
    print_text(to, program);
    fprintf(to, ", \"sim_s\": %.12f, \"ended\": ", (double)f2812_now(device) / (double)EMU_PS_PER_S);
    if (f2812_shim_end(shim) != NULL)
    {
        print_text(to, f2812_shim_end(shim));
    }
    else
    {
        fprintf(to, "null");
    }
    fprintf(to,
            ", \"cycles\": %" PRIu64 ", \"accesses\": %" PRIu64 ", \"blocks\": %" PRIu64 ", \"turns\": %" PRIu64
            ", \"interrupts\": %" PRIu64 ", \"starts\": %" PRIu64 ", \"guest_errors\": %" PRIu64 ",\n \"reports\": [",
            f2812_cycle(device), s->accesses, s->blocks, s->turns, s->interrupts, s->starts, notes->wrong);
    for (unsigned i = 0; i < notes->count; i++)
    {
        const f2812_note_t* const note = &notes->note[i];
        fprintf(to, "%s\n  {\"kind\": \"%s\", \"text\": ", i > 0 ? "," : "",
                note->kind == EMU_GUEST_ERROR ? "guest_error" : "not_modelled");
        print_text(to, note->text);
        fprintf(to, ", \"detail\": %" PRIu32 ", \"first_s\": %.12f, \"count\": %" PRIu64 "}", note->detail,
                (double)note->first / (double)EMU_PS_PER_S, note->count);
    }
    fprintf(to, "]}\n");
}
