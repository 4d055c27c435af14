/// \file   gnss.c
/// \brief  Times of week made continuous, positions from a receiver's integers.
/// SPDX-License-Identifier: MIT
#include "ins/gnss.h"

#define RAD_E7     INT64_C(4024455254)            ///< 1e-7 deg in units of 2^-61 rad
#define RAD_REST   INS_C(2.11328553611054889e-19) ///< what that leaves [rad]
#define COARSE     49                   ///< an anchor is a multiple of 2^(49 - 61) rad, 1.6 km: exact in float
#define PER_COARSE INS_C(2.44140625e-4) ///< 2^(COARSE - 61)
#define PER_FINE   INS_C(4.33680868994201774e-19) ///< 2^-61

int64_t ins_gnss_time_near(int64_t t_ns, int64_t period_ns, int64_t near_ns)
{
    int64_t ahead = (t_ns - near_ns) % period_ns;
    if (2 * ahead > period_ns)
    {
        ahead -= period_ns;
    }
    else if (2 * ahead < -period_ns)
    {
        ahead += period_ns;
    }
    return near_ns + ahead;
}

static void angle(int32_t e7, ins_real* anchor, ins_real* offset)
{
    const int64_t fine = e7 * RAD_E7;
    const int64_t coarse = fine / (INT64_C(1) << COARSE);
    *anchor = (ins_real)coarse * PER_COARSE;
    *offset = (ins_real)(fine - coarse * (INT64_C(1) << COARSE)) * PER_FINE + (ins_real)e7 * RAD_REST;
}

void ins_gnss_position(int32_t lat_e7, int32_t lon_e7, int32_t height_mm, ins_position_t* position)
{
    angle(lat_e7, &position->anchor[0], &position->offset[0]);
    angle(lon_e7, &position->anchor[1], &position->offset[1]);
    const int32_t rest = height_mm % 1000;
    position->anchor[2] = (ins_real)(height_mm / 1000);
    position->offset[2] = (ins_real)rest * INS_C(1e-3);
}
