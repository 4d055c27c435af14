/// \file   libm.c
/// \brief  What ends in the machine's own sin, cos and atan2: Euler angles, ECEF, transverse Mercator. Compared in units in the last place.
/// SPDX-License-Identifier: MIT
#include "report.h"

#define POINTS 24

static void angles(void)
{
    for (int k = 0; k < POINTS; k++)
    {
        ins_real euler[3];
        ins_real q[4];
        ins_real R[9];
        random_reals(INS_C(3.1), euler, 3);
        euler[1] /= 2;
        ins_quat_from_euler(euler, q);
        near_reals("quat_from_euler", q, 4);
        ins_thesis_zxz(euler, R);
        near_reals("thesis_zxz", R, 9);
        random_reals(1, q, 4);
        if (ins_quat_normalise(q) == INS_OK)
        {
            ins_quat_to_euler(q, euler);
            near_reals("quat_to_euler", euler, 3);
        }
    }
}

static void ecef(void)
{
    for (int k = 0; k < POINTS; k++)
    {
        const ins_real llh[3] = {random_real(INS_C(1.5)), random_real(INS_C(3.1)), random_real(9000)};
        ins_real xyz[3];
        ins_real back[3];
        ins_local_t local;
        if (ins_geodesy_to_ecef(&ins_wgs84, llh, xyz) == INS_OK)
        {
            near_reals("geodesy_to_ecef", xyz, 3);
        }
        // Its input is the same everywhere, as the others' are: no error of another function is counted.
        random_reals(INS_C(6e6), xyz, 3);
        if (ins_geodesy_from_ecef(&ins_wgs84, xyz, back) == INS_OK)
        {
            near_reals("geodesy_from_ecef.lat_lon", back, 2);
            near_reals("geodesy_from_ecef.height", back + 2, 1);
        }
        if (ins_local_init(&local, &ins_wgs84, llh) == INS_OK)
        {
            near_reals("local_init", local.C_ne, 9);
        }
    }
}

static void projections(void)
{
    ins_tm_t tm;
    if (ins_tm_init_twd97(&tm, 121) != INS_OK)
    {
        return;
    }
    for (int k = 0; k < POINTS; k++)
    {
        const ins_real lat = INS_C(0.42) + random_real(INS_C(0.03));
        const ins_real lon = tm.lon0 + random_real(INS_C(0.02));
        const ins_real grid[2] = {INS_C(250e3) + random_real(INS_C(1e5)), INS_C(2.65e6) + random_real(INS_C(2e5))};
        ins_real out[2];
        ins_real convergence;
        if (ins_tm_forward(&tm, lat, lon, out, &convergence) == INS_OK)
        {
            near_reals("tm_forward", out, 2);
            near_reals("tm_forward.convergence", &convergence, 1);
        }
        if (ins_tm_inverse(&tm, grid, out) == INS_OK)
        {
            near_reals("tm_inverse", out, 2);
        }
        if (ins_tm_thesis_forward(&tm, lat, lon, out) == INS_OK)
        {
            near_reals("tm_thesis_forward", out, 2);
        }
        if (ins_tm_thesis_inverse(&tm, grid, out) == INS_OK)
        {
            near_reals("tm_thesis_inverse", out, 2);
        }
    }
}

void run_libm(void)
{
    same_begin("libm_input"); // also starts the random numbers
    same_integer(random_bits());
    same_end();
    angles();
    ecef();
    projections();
}
