/// \file   json.c
/// \brief  A navigation state as one line of JSON. Reals as %.17g: the same bits when read back.
/// SPDX-License-Identifier: MIT
#include "ins_nav/nav.h"
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>

typedef struct writer_t
{
    char* at;
    size_t room; ///< 0 once something did not fit
} writer_t;

static void put(writer_t* self, const char* format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(self->at, self->room, format, arguments);
    va_end(arguments);
    if (length < 0 || (size_t)length >= self->room)
    {
        self->room = 0;
        return;
    }
    self->at += length;
    self->room -= (size_t)length;
}

/// A decimal comma of the caller's locale becomes the point that JSON wants; a whole number gets one, or -0 would be read as 0.
static void put_real(writer_t* self, double value)
{
    char* const begin = self->at;
    put(self, "%.17g", value);
    int whole = self->at > begin;
    for (char* c = begin; c < self->at; c++)
    {
        *c = *c == ',' ? '.' : *c;
        whole = whole && *c != '.' && *c != 'e';
    }
    if (whole)
    {
        put(self, ".0");
    }
}

static void put_reals(writer_t* self, const char* name, const double* value, int count)
{
    put(self, ",\"%s\":[", name);
    for (int i = 0; i < count; i++)
    {
        put(self, "%s", i > 0 ? "," : "");
        put_real(self, value[i]);
    }
    put(self, "]");
}

static void put_status(writer_t* self, uint32_t status)
{
    const char* comma = "";
    put(self, ",\"status\":[");
#define PUT(name, value, text)                                                                                         \
    if ((status & (uint32_t)(value)) != 0)                                                                             \
    {                                                                                                                  \
        put(self, "%s\"%s\"", comma, text);                                                                            \
        comma = ",";                                                                                                   \
    }
    INS_NAV_STATUS_LIST(PUT)
#undef PUT
    put(self, "]");
}

size_t ins_nav_state_json(const ins_nav_state_t* state, char* buffer, size_t size)
{
    writer_t w = {buffer, size};
    put(&w, "{\"index\":%" PRIu64 ",\"t_s\":", state->index);
    put_real(&w, state->t_s);
    put(&w, ",\"seq\":%" PRIu32, state->seq);
    put_reals(&w, "q_nb", state->q_nb, 4);
    put_reals(&w, "euler_rad", state->euler_rad, 3);
    put_reals(&w, "w_ib_b", state->w_ib_b, 3);
    put_reals(&w, "dtheta_b", state->dtheta_b, 3);
    put(&w, ",\"bridged\":%" PRIu32, state->bridged);
    put_status(&w, state->status);
    put(&w, ",\"used\":%" PRIu64 ",\"missed\":%" PRIu64, state->used, state->missed);
    const ins_nav_counts_t* c = &state->counts;
    put(&w, ",\"link\":{\"accepted\":%" PRIu64 ",\"lost\":%" PRIu64 ",\"invalid\":%" PRIu64 ",\"duplicates\":%" PRIu64,
        c->accepted, c->lost, c->invalid, c->duplicates);
    put(&w, ",\"corrupt\":%" PRIu64 ",\"timeouts\":%" PRIu64 ",\"stray\":%" PRIu64 "}}\n", c->corrupt, c->timeouts,
        c->stray);
    return w.room > 0 ? (size_t)(w.at - buffer) : 0u;
}
