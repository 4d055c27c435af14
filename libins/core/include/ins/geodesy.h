/// \file   ins/geodesy.h
/// \brief  Geodetic coordinates, Earth-fixed Cartesian coordinates, local NED and ENU. Frame: e (ECEF), n. Units: rad, m.
///
/// llh[3] = {latitude, longitude, height above the ellipsoid} [rad, rad, m]; xyz_e[3] = ECEF [m].
/// Uses libm's sin, cos and atan2 and is no part of the strapdown's state. In double the round trip is good to 1e-8 m and 1e-14 rad;
/// in float a coordinate of 6e6 m has steps of 0.5 m and an angle of 1 rad steps of 0.4 m, and that is the accuracy there.
/// Source: B. R. Bowring, Survey Review 23(181), 1976, 323-327 (inverse, from the reduced latitude);
/// B. R. Bowring, Survey Review 28(218), 1985, 202-206 (height, good at the poles); NIMA TR8350.2, 3rd ed.; H. Moritz, GRS 1980.
/// SPDX-License-Identifier: MIT
#ifndef INS_GEODESY_H_INCLUDED
#define INS_GEODESY_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef struct ins_ellipsoid_t
{
    ins_real a;  ///< semi-major axis [m]
    ins_real f;  ///< flattening
    ins_real e2; ///< first eccentricity squared, f (2 - f)
} ins_ellipsoid_t;

INS_API extern const ins_ellipsoid_t ins_wgs84;
INS_API extern const ins_ellipsoid_t ins_grs80; ///< of TWD97

/// Nearest point to the Earth's centre that ins_geodesy_from_ecef takes, as a fraction of a: 3,189 km; h >= -3,167 km.
#define INS_GEODESY_RADIUS_MIN INS_C(0.5)

/// \return INS_OK; INS_E_RANGE for NaN, infinity, |latitude| > pi/2, |longitude| > 2 pi.
INS_API ins_status_t ins_geodesy_to_ecef(const ins_ellipsoid_t* ellipsoid, const ins_real llh[3], ins_real xyz_e[3]);
/// Longitude in [-pi, pi]; on the axis it is 0. Two iterations: 1e-8 m up to 2e7 m of height.
/// \return INS_OK; INS_E_RANGE for NaN, infinity, or a point nearer to the centre than INS_GEODESY_RADIUS_MIN.
INS_API ins_status_t ins_geodesy_from_ecef(const ins_ellipsoid_t* ellipsoid, const ins_real xyz_e[3], ins_real llh[3]);

/// A tangent frame fixed to the Earth. Owned by the caller.
typedef struct ins_local_t
{
    ins_real origin_e[3]; ///< [m]
    ins_real C_ne[9];     ///< rows: north, east, down in e
} ins_local_t;

/// \param[in] llh  [3] of the origin. \return as ins_geodesy_to_ecef.
INS_API ins_status_t ins_local_init(ins_local_t* self, const ins_ellipsoid_t* ellipsoid, const ins_real llh[3]);
/// \param[out] ned  [3] from the origin [m]; may be xyz_e.
INS_API void ins_local_from_ecef(const ins_local_t* self, const ins_real xyz_e[3], ins_real ned[3]);
/// \param[out] xyz_e  [3] [m]; may be ned.
INS_API void ins_local_to_ecef(const ins_local_t* self, const ins_real ned[3], ins_real xyz_e[3]);
/// NED to ENU, and ENU to NED: it is its own inverse. \param[out] out  [3]; may be in.
INS_API void ins_local_swap(const ins_real in[3], ins_real out[3]);

#ifdef __cplusplus
}
#endif
#endif // INS_GEODESY_H_INCLUDED
