/// \file   navigation.c
/// \brief  ins_navigation_t from what the two kinds of boards say.
/// SPDX-License-Identifier: MIT
#include "ins_nav/navigation.h"
#include <string.h>

void ins_navigation_from_state(const ins_nav_state_t* state, int64_t time_ns, ins_navigation_t* out)
{
    memset(out, 0, sizeof *out);
    out->time_ns = time_ns;
    out->valid = INS_NAVIGATION_ATTITUDE | INS_NAVIGATION_RATE;
    memcpy(out->q_nb, state->q_nb, sizeof out->q_nb);
    memcpy(out->w_ib_b, state->w_ib_b, sizeof out->w_ib_b);
}

void ins_navigation_from_solution(const ins_nav_solution_t* solution, int64_t time_ns, ins_navigation_t* out)
{
    memset(out, 0, sizeof *out);
    out->time_ns = time_ns;
    if ((solution->status & INS_NAV_BLOCK_ALIGNED) != 0)
    {
        out->valid |= INS_NAVIGATION_ATTITUDE;
        memcpy(out->q_nb, solution->q_nb, sizeof out->q_nb);
    }
    if ((solution->status & INS_NAV_BLOCK_POSITION) != 0)
    {
        out->valid |= INS_NAVIGATION_POSITION;
        memcpy(out->llh, solution->lat_lon_rad, sizeof solution->lat_lon_rad);
    }
    if ((out->valid & INS_NAVIGATION_POSITION) != 0 && (out->valid & INS_NAVIGATION_ATTITUDE) != 0)
    {
        out->valid |= INS_NAVIGATION_VELOCITY;
        out->v_n[0] = solution->v_en_m_s[1];
        out->v_n[1] = solution->v_en_m_s[0];
    }
}

void ins_nav_state_from_solution(const ins_nav_solution_t* solution, ins_nav_state_t* out)
{
    memset(out, 0, sizeof *out);
    out->index = solution->index;
    out->t_s = solution->t_s;
    memcpy(out->q_nb, solution->q_nb, sizeof out->q_nb);
    memcpy(out->euler_rad, solution->euler_rad, sizeof out->euler_rad);
    out->seq = solution->seq;
    out->bridged = solution->lost;
    out->counts = solution->counts;
}
