/// \file   navigation.c
/// \brief  ins_navigation_t from what the two kinds of boards say.
/// SPDX-License-Identifier: MIT
#include "ins_nav/navigation.h"
#include "ins_nav/vehicle.h"
#include <math.h>
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

void ins_vehicle_navigation(const ins_vehicle_t* self, const ins_nav_solution_t* solution, int64_t time_ns,
                            ins_navigation_t* out)
{
    enum
    {
        FROM = 6, // INS_UNICYCLE_EAST, _NORTH, _HEADING, _SPEED, ...
        N = INS_NAVIGATION_P
    };
    ins_real x[FROM];
    ins_real P[FROM * FROM];
    ins_navigation_from_solution(solution, time_ns, out);
    if (self->cfg.filter != INS_VEHICLE_OURS || (out->valid & INS_NAVIGATION_VELOCITY) == 0 ||
        ins_gps_dr_state(&self->ours, x, P) != INS_OK)
    {
        return;
    }
    const double s = sin((double)x[2]);
    const double c = cos((double)x[2]);
    const double v = (double)x[3];
    // Rows of what is known of phi, v and p by the filter's four: heading turns about down; v = speed (cos, sin) of the heading.
    const double J[N][4] = {
        [2] = {0, 0, 1, 0}, [3] = {0, 0, -v * s, c}, [4] = {0, 0, v * c, s}, [6] = {0, 1, 0, 0}, [7] = {1, 0, 0, 0}};
    for (int i = 0; i < N; i++)
    {
        for (int j = 0; j < N; j++)
        {
            for (int k = 0; k < 16; k++)
            {
                out->P[N * i + j] += J[i][k / 4] * (double)P[FROM * (k / 4) + k % 4] * J[j][k % 4];
            }
        }
    }
    out->P[0] = out->P[N + 1] = INS_VEHICLE_SLOPE * INS_VEHICLE_SLOPE;
    out->valid |= INS_NAVIGATION_COVARIANCE;
}
