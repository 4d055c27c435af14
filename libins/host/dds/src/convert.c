/// \file   convert.c
/// \brief  ins_nav_state_t <-> libins::NavState.
/// SPDX-License-Identifier: MIT
#include "dds_internal.h"
#include <string.h>

// FIELD copies a member, ARRAY an array; both are of the same type on both sides.
// clang-format off
#define SAME_FIELDS(FIELD, ARRAY) \
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
    FIELD(counts.accepted)        \
    FIELD(counts.lost)            \
    FIELD(counts.invalid)         \
    FIELD(counts.duplicates)      \
    FIELD(counts.corrupt)         \
    FIELD(counts.timeouts)        \
    FIELD(counts.stray)
// clang-format on

void dds_from_state(const ins_nav_state_t* state, libins_NavState* message)
{
#define FIELD(name) message->name = state->name;
#define ARRAY(name) memcpy(message->name, state->name, sizeof message->name);
    SAME_FIELDS(FIELD, ARRAY)
#undef FIELD
#undef ARRAY
}

void dds_to_state(const libins_NavState* message, ins_nav_state_t* state)
{
#define FIELD(name) state->name = message->name;
#define ARRAY(name) memcpy(state->name, message->name, sizeof state->name);
    SAME_FIELDS(FIELD, ARRAY)
#undef FIELD
#undef ARRAY
}
