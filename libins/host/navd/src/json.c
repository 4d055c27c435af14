/// \file   json.c
/// \brief  A navigation state, or a board's solution, as one line of JSON. Reals as %.17g: the same bits when read back.
/// SPDX-License-Identifier: MIT
#include "ins_nav/nav.h"
#include "ins_nav/nav_input.h"
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

static const char* put_bit(writer_t* self, uint32_t status, uint32_t bit, const char* comma, const char* text)
{
    if ((status & bit) == 0)
    {
        return comma;
    }
    put(self, "%s\"%s\"", comma, text);
    return ",";
}
#define PUT(name, value, text) comma = put_bit(&w, status, (uint32_t)(value), comma, text);

static size_t put_link(writer_t* self, const ins_nav_counts_t* c, const char* buffer)
{
    put(self,
        ",\"link\":{\"accepted\":%" PRIu64 ",\"lost\":%" PRIu64 ",\"invalid\":%" PRIu64 ",\"duplicates\":%" PRIu64,
        c->accepted, c->lost, c->invalid, c->duplicates);
    put(self, ",\"corrupt\":%" PRIu64 ",\"timeouts\":%" PRIu64 ",\"stray\":%" PRIu64 "}}\n", c->corrupt, c->timeouts,
        c->stray);
    return self->room > 0 ? (size_t)(self->at - buffer) : 0u;
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
    const uint32_t status = state->status;
    const char* comma = "";
    put(&w, ",\"status\":[");
    INS_NAV_STATUS_LIST(PUT)
    put(&w, "]");
    put(&w, ",\"used\":%" PRIu64 ",\"missed\":%" PRIu64, state->used, state->missed);
    return put_link(&w, &state->counts, buffer);
}

size_t ins_nav_solution_json(const ins_nav_solution_t* solution, char* buffer, size_t size)
{
    writer_t w = {buffer, size};
    put(&w, "{\"index\":%" PRIu64 ",\"t_s\":", solution->index);
    put_real(&w, solution->t_s);
    put(&w, ",\"seq\":%" PRIu32, solution->seq);
    put_reals(&w, "q_nb", solution->q_nb, 4);
    put_reals(&w, "euler_rad", solution->euler_rad, 3);
    put(&w, ",\"zone\":%" PRIu32, solution->zone);
    put_reals(&w, "en_m", solution->en_m, 2);
    put_reals(&w, "lat_lon_rad", solution->lat_lon_rad, 2);
    put_reals(&w, "v_en_m_s", solution->v_en_m_s, 2);
    put(&w, ",\"sats\":%" PRIu32 ",\"fix_age_s\":", solution->sats);
    put_real(&w, solution->fix_age_s);
    put(&w, ",\"lost\":%" PRIu32, solution->lost);
    const uint32_t status = solution->status;
    const char* comma = "";
    put(&w, ",\"status\":[");
    INS_NAV_BLOCK_STATUS_LIST(PUT)
    PUT(0, INS_NAV_RESTARTED, "restarted")
    put(&w, "]");
    return put_link(&w, &solution->counts, buffer);
}
