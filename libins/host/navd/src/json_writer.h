/// \file   json_writer.h
/// \brief  JSON into a buffer, piece by piece: shared by the sources that write lines of it.
/// SPDX-License-Identifier: MIT
#ifndef INS_NAV_JSON_WRITER_H_INCLUDED
#define INS_NAV_JSON_WRITER_H_INCLUDED
#include "ins_nav/nav.h"
#include "ins_nav/nav_input.h"

typedef struct json_writer_t
{
    char* at;
    size_t room; ///< 0 once something did not fit
} json_writer_t;

void json_put(json_writer_t* self, const char* format, ...);
/// As %.17g; what is not finite as null.
void json_real(json_writer_t* self, double value);
/// A comma before the name.
void json_reals(json_writer_t* self, const char* name, const double* value, int count);
/// The text of a bit that is set, after a comma if there was one before. \return the comma for the next.
const char* json_bit(json_writer_t* self, uint32_t bits, uint32_t bit, const char* comma, const char* text);
/// A comma before it.
void json_link(json_writer_t* self, const ins_nav_counts_t* counts);
// The members without braces.
void json_state(json_writer_t* self, const ins_nav_state_t* state);
void json_solution(json_writer_t* self, const ins_nav_solution_t* solution);
/// The closing brace and a newline. \return the length from buffer on; 0 when something did not fit.
size_t json_end(json_writer_t* self, const char* buffer);

#endif // INS_NAV_JSON_WRITER_H_INCLUDED
