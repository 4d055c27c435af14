/// \file   json.c
/// \brief  A navigation state, or a board's solution, as one line of JSON. Reals as %.17g: the same bits when read back.
/// SPDX-License-Identifier: MIT
#include "json_writer.h"
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>

void json_put(json_writer_t* self, const char* format, ...)
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
void json_real(json_writer_t* self, double value)
{
    if (!(value - value == 0.0)) // not a number, infinite
    {
        json_put(self, "null");
        return;
    }
    char* const begin = self->at;
    json_put(self, "%.17g", value);
    int whole = self->at > begin;
    for (char* c = begin; c < self->at; c++)
    {
        *c = *c == ',' ? '.' : *c;
        whole = whole && *c != '.' && *c != 'e';
    }
    if (whole)
    {
        json_put(self, ".0");
    }
}

void json_reals(json_writer_t* self, const char* name, const double* value, int count)
{
    json_put(self, ",\"%s\":[", name);
    for (int i = 0; i < count; i++)
    {
        json_put(self, "%s", i > 0 ? "," : "");
        json_real(self, value[i]);
    }
    json_put(self, "]");
}

const char* json_bit(json_writer_t* self, uint32_t bits, uint32_t bit, const char* comma, const char* text)
{
    if ((bits & bit) == 0)
    {
        return comma;
    }
    json_put(self, "%s\"%s\"", comma, text);
    return ",";
}
#define PUT(name, value, text) comma = json_bit(w, status, (uint32_t)(value), comma, text);

void json_link(json_writer_t* self, const ins_nav_counts_t* c)
{
    json_put(self,
             ",\"link\":{\"accepted\":%" PRIu64 ",\"lost\":%" PRIu64 ",\"invalid\":%" PRIu64 ",\"duplicates\":%" PRIu64,
             c->accepted, c->lost, c->invalid, c->duplicates);
    json_put(self, ",\"corrupt\":%" PRIu64 ",\"timeouts\":%" PRIu64 ",\"stray\":%" PRIu64 "}", c->corrupt, c->timeouts,
             c->stray);
}

size_t json_end(json_writer_t* self, const char* buffer)
{
    json_put(self, "}\n");
    return self->room > 0 ? (size_t)(self->at - buffer) : 0u;
}

void json_state(json_writer_t* w, const ins_nav_state_t* state)
{
    json_put(w, "\"index\":%" PRIu64 ",\"t_s\":", state->index);
    json_real(w, state->t_s);
    json_put(w, ",\"seq\":%" PRIu32, state->seq);
    json_reals(w, "q_nb", state->q_nb, 4);
    json_reals(w, "euler_rad", state->euler_rad, 3);
    json_reals(w, "w_ib_b", state->w_ib_b, 3);
    json_reals(w, "dtheta_b", state->dtheta_b, 3);
    json_put(w, ",\"bridged\":%" PRIu32, state->bridged);
    const uint32_t status = state->status;
    const char* comma = "";
    json_put(w, ",\"status\":[");
    INS_NAV_STATUS_LIST(PUT)
    json_put(w, "]");
    json_put(w, ",\"used\":%" PRIu64 ",\"missed\":%" PRIu64, state->used, state->missed);
    json_link(w, &state->counts);
}

void json_solution(json_writer_t* w, const ins_nav_solution_t* solution)
{
    json_put(w, "\"index\":%" PRIu64 ",\"t_s\":", solution->index);
    json_real(w, solution->t_s);
    json_put(w, ",\"seq\":%" PRIu32, solution->seq);
    json_reals(w, "q_nb", solution->q_nb, 4);
    json_reals(w, "euler_rad", solution->euler_rad, 3);
    json_put(w, ",\"zone\":%" PRIu32, solution->zone);
    json_reals(w, "en_m", solution->en_m, 2);
    json_reals(w, "lat_lon_rad", solution->lat_lon_rad, 2);
    json_reals(w, "v_en_m_s", solution->v_en_m_s, 2);
    json_put(w, ",\"sats\":%" PRIu32 ",\"fix_age_s\":", solution->sats);
    json_real(w, solution->fix_age_s);
    json_put(w, ",\"lost\":%" PRIu32, solution->lost);
    const uint32_t status = solution->status;
    const char* comma = "";
    json_put(w, ",\"status\":[");
    INS_NAV_BLOCK_STATUS_LIST(PUT)
    PUT(0, INS_NAV_RESTARTED, "restarted")
    json_put(w, "]");
    json_link(w, &solution->counts);
}

size_t ins_nav_state_json(const ins_nav_state_t* state, char* buffer, size_t size)
{
    json_writer_t w = {buffer, size};
    json_put(&w, "{");
    json_state(&w, state);
    return json_end(&w, buffer);
}

size_t ins_nav_solution_json(const ins_nav_solution_t* solution, char* buffer, size_t size)
{
    json_writer_t w = {buffer, size};
    json_put(&w, "{");
    json_solution(&w, solution);
    return json_end(&w, buffer);
}
