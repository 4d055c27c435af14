/// \file   place_internal.h
/// \brief  A point near the WGS-84 ellipsoid and the directions north, east, down there. Frames e (ECEF) and n (NED). rad, m.
///
/// The core has the same formulas in ins/geodesy.h and ins/earth.h, with libm and in its number type; these have own
/// elementary functions, so that a truth has the same bits on every machine. Tests compare the two.
/// SPDX-License-Identifier: MIT
#ifndef INS_TRUTH_PLACE_INTERNAL_H_INCLUDED
#define INS_TRUTH_PLACE_INTERNAL_H_INCLUDED

#define INS_PLACE_EARTH_RATE 7.292115e-5 ///< NIMA TR8350.2, table 3.1 [rad/s]

typedef struct ins_place_t
{
    double xyz_e[3];
    double llh[3];  ///< latitude, longitude, height above the ellipsoid
    double C_ne[9]; ///< rows: north, east, down in e
} ins_place_t;

void ins_place_of_llh(const double llh[3], ins_place_t* out);
/// Two Bowring iterations: 1e-8 m up to 2e7 m of height. Not for points deep inside the Earth.
void ins_place_of_xyz(const double xyz_e[3], ins_place_t* out);
void ins_place_into_e(const ins_place_t* self, const double v_n[3], double v_e[3]); ///< v_e is not v_n
void ins_place_into_n(const ins_place_t* self, const double v_e[3], double v_n[3]); ///< v_n is not v_e
/// q_en: turns vectors in n into e.
void ins_place_rotation(const ins_place_t* self, double q_en[4]);
/// Normal gravity along down [m/s^2].
double ins_place_gravity(const ins_place_t* self);

#endif // INS_TRUTH_PLACE_INTERNAL_H_INCLUDED
