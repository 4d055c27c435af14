/// \file   earth.c
/// \brief  Radii, gravity and rates of the WGS-84 Earth. Frame: n (NED). SI.
/// SPDX-License-Identifier: MIT
#include "ins/earth.h"
#include "earth_internal.h"

void ins_earth_radii(ins_real sin_lat, ins_real radii[2])
{
    earth_t earth;
    earth_at(sin_lat, 0, &earth);
    radii[0] = earth.meridian;
    radii[1] = earth.normal;
}

ins_real ins_earth_gravity(ins_real sin_lat, ins_real height)
{
    earth_t earth;
    earth_at(sin_lat, height, &earth);
    return earth.gravity;
}

void ins_earth_rate(ins_real sin_lat, ins_real cos_lat, ins_real w_ie_n[3])
{
    w_ie_n[0] = INS_EARTH_RATE * cos_lat;
    w_ie_n[1] = 0;
    w_ie_n[2] = -INS_EARTH_RATE * sin_lat;
}

void ins_earth_transport_rate(ins_real sin_lat, ins_real cos_lat, ins_real height, const ins_real v_n[3],
                              ins_real w_en_n[3])
{
    earth_t earth;
    earth_at(sin_lat, height, &earth);
    const ins_real north = v_n[0];
    w_en_n[0] = v_n[1] / earth.normal;
    w_en_n[1] = -north / earth.meridian;
    w_en_n[2] = -w_en_n[0] * sin_lat / cos_lat;
}
