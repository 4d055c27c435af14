/// \file   convert.c
/// \brief  ins_nav_state_t <-> libins::NavState, ins_nav_solution_t <-> libins::NavSolution.
/// SPDX-License-Identifier: MIT
#include "dds_internal.h"
#include <string.h>

// FIELD copies a member, ARRAY an array; both are of the same type on both sides.
// clang-format off
#define COUNT_FIELDS(FIELD)       \
    FIELD(counts.accepted)        \
    FIELD(counts.lost)            \
    FIELD(counts.invalid)         \
    FIELD(counts.duplicates)      \
    FIELD(counts.corrupt)         \
    FIELD(counts.timeouts)        \
    FIELD(counts.stray)

#define STATE_FIELDS(FIELD, ARRAY) \
    FIELD(index)                  \
    FIELD(t_s)                    \
    ARRAY(q_nb)                   \
    ARRAY(euler_rad)              \
    ARRAY(w_ib_b)                 \
    ARRAY(dtheta_b)               \
    FIELD(seq)                    \
    FIELD(bridged)                \
    FIELD(status)                 \
    FIELD(used)                   \
    FIELD(missed)                 \
    COUNT_FIELDS(FIELD)

#define SOLUTION_FIELDS(FIELD, ARRAY) \
    FIELD(index)                  \
    FIELD(t_s)                    \
    ARRAY(q_nb)                   \
    ARRAY(euler_rad)              \
    ARRAY(en_m)                   \
    ARRAY(lat_lon_rad)            \
    ARRAY(v_en_m_s)               \
    FIELD(fix_age_s)              \
    FIELD(sats)                   \
    FIELD(zone)                   \
    FIELD(seq)                    \
    FIELD(lost)                   \
    FIELD(status)                 \
    COUNT_FIELDS(FIELD)
// clang-format on

#define FIELD(name) message->name = from->name;
#define ARRAY(name) memcpy(message->name, from->name, sizeof message->name);
void dds_from_state(const ins_nav_state_t* from, libins_NavState* message)
{
    STATE_FIELDS(FIELD, ARRAY)
}

void dds_from_solution(const ins_nav_solution_t* from, libins_NavSolution* message)
{
    SOLUTION_FIELDS(FIELD, ARRAY)
}
#undef FIELD
#undef ARRAY

#define FIELD(name) to->name = message->name;
#define ARRAY(name) memcpy(to->name, message->name, sizeof to->name);
static void to_state(const libins_NavState* message, ins_nav_state_t* to)
{
    STATE_FIELDS(FIELD, ARRAY)
}

static void to_solution(const libins_NavSolution* message, ins_nav_solution_t* to)
{
    SOLUTION_FIELDS(FIELD, ARRAY)
}
#undef FIELD
#undef ARRAY

void dds_to_sample(const ins_dds_t* self, int at, ins_dds_sample_t* sample)
{
    const int is_state = self->kind == INS_DDS_STATE;
    const libins_NavState* const state = &self->taken.state[is_state ? at : 0];
    const libins_NavSolution* const solution = &self->taken.solution[is_state ? 0 : at];
    memcpy(sample->source, is_state ? state->source : solution->source, sizeof sample->source);
    if (!sample->valid)
    {
        return;
    }
    sample->published_ns = is_state ? state->published_ns : solution->published_ns;
    if (is_state)
    {
        to_state(state, &sample->state);
    }
    else
    {
        to_solution(solution, &sample->solution);
    }
}
