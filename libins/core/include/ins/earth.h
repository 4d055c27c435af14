/// \file   ins/earth.h
/// \brief  The WGS-84 Earth under a navigator: radii of curvature, normal gravity, Earth rate, transport rate. Frame: n (NED). SI.
///
/// Latitude comes as its sine and cosine, so that no libm is needed and the strapdown's state is the same bits everywhere.
/// Source: NIMA TR8350.2, 3rd ed., 2000, tables 3.1, 3.3, 3.4, equations 4-1 (Somigliana) and 4-3 (free air, second order in h).
/// Against the exact field of the ellipsoid equation 4-3 is good to 1.1e-6 m/s^2 up to 17 km, 1.6e-4 at 100 km.
/// SPDX-License-Identifier: MIT
#ifndef INS_EARTH_H_INCLUDED
#define INS_EARTH_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_EARTH_RATE INS_C(7.292115e-5) ///< [rad/s]

/// \param[out] radii  [2] of the meridian and of the prime vertical [m].
INS_API void ins_earth_radii(ins_real sin_lat, ins_real radii[2]);
/// Normal gravity, positive down, centrifugal acceleration included [m/s^2].
INS_API ins_real ins_earth_gravity(ins_real sin_lat, ins_real height);
/// \param[out] w_ie_n  [3] Earth against inertial space [rad/s].
INS_API void ins_earth_rate(ins_real sin_lat, ins_real cos_lat, ins_real w_ie_n[3]);
/// \param[in] cos_lat  not 0. \param[out] w_en_n  [3] navigation frame against Earth [rad/s].
INS_API void ins_earth_transport_rate(ins_real sin_lat, ins_real cos_lat, ins_real height, const ins_real v_n[3],
                                      ins_real w_en_n[3]);

#ifdef __cplusplus
}
#endif
#endif // INS_EARTH_H_INCLUDED
