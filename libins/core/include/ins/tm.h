/// \file   ins/tm.h
/// \brief  Transverse Mercator, and TM2 of TWD97 in its zones 121 and 119. Units: rad, m.
///
///     ins_tm_t tm;
///     ins_tm_init_twd97(&tm, ins_twd97_zone(lon));         // EPSG:3826 (121) or EPSG:3825 (119)
///     ins_tm_forward(&tm, lat, lon, en, NULL);            // en = {easting, northing}
///
/// Krueger's series to the sixth order in n: 1e-8 m within 10 degrees of the central meridian (double). In float a northing of
/// 2.7e6 m has steps of 0.25 m and a longitude of 2.1 rad steps of 1.5 m on the ground: 2 m.
/// Uses libm's sin, cos and atan2.
/// Source: L. Krueger, Konforme Abbildung des Erdellipsoids in der Ebene, 1912; C. F. F. Karney, J. Geodesy 85, 2011, 475-485,
/// equations 7-9, 11, 13, 23-25, 35, 36. Zone parameters: EPSG:3825, EPSG:3826.
/// SPDX-License-Identifier: MIT
#ifndef INS_TM_H_INCLUDED
#define INS_TM_H_INCLUDED
#include "ins/config.h"
#include "ins/geodesy.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_TM_ORDER 6
/// Farthest from the central meridian that is taken [rad]: 10 degrees.
#define INS_TM_DLON_MAX INS_C(0.17453292519943296)

/// One projection. Owned by the caller; read-only after init.
typedef struct ins_tm_t
{
    ins_ellipsoid_t ellipsoid;
    ins_real lon0;    ///< central meridian [rad]
    ins_real k0;      ///< scale on it
    ins_real false_e; ///< [m]
    ins_real false_n; ///< [m]
    ins_real e;       ///< first eccentricity
    ins_real unit;    ///< k0 times the rectifying radius [m]
    ins_real alpha[INS_TM_ORDER];
    ins_real beta[INS_TM_ORDER];
    ins_real delta[INS_TM_ORDER];
} ins_tm_t;

/// \return INS_OK; INS_E_RANGE unless 0 < f <= 1/150, |lon0| <= pi, k0 in [0.5, 2] and the false origin is finite.
INS_API ins_status_t ins_tm_init(ins_tm_t* self, const ins_ellipsoid_t* ellipsoid, ins_real lon0, ins_real k0,
                                 ins_real false_easting, ins_real false_northing);
/// \param[in] zone  121 (Taiwan) or 119 (Penghu, Kinmen, Matsu). \return INS_OK or INS_E_RANGE.
INS_API ins_status_t ins_tm_init_twd97(ins_tm_t* self, int zone);
/// The TWD97 zone of a longitude: 119 for 118 <= lon < 120 degrees, 121 for 120 <= lon < 123, otherwise 0.
INS_API int ins_twd97_zone(ins_real lon);

/// \param[out] en  [2] easting, northing [m]. \param[out] convergence  bearing of grid north from true north, clockwise [rad]; or NULL.
/// \return INS_OK; INS_E_RANGE for NaN, |latitude| > pi/2 or farther than INS_TM_DLON_MAX from the central meridian.
INS_API ins_status_t ins_tm_forward(const ins_tm_t* self, ins_real lat, ins_real lon, ins_real en[2],
                                    ins_real* convergence);
/// \param[out] lat_lon  [2] [rad], longitude in [-pi, pi].
/// \return INS_OK; INS_E_RANGE for NaN or a point outside of what forward gives.
INS_API ins_status_t ins_tm_inverse(const ins_tm_t* self, const ins_real en[2], ins_real lat_lon[2]);

/// The series of a 2009 thesis on a GPS-enabled IMU, equations 5.6 and 5.7, corrected (docs/geodesy.md), for comparison with its results.
/// Forward within 1.3 degrees of the central meridian: 1e-7 m; inverse 1e-4 m. \return as ins_tm_forward().
INS_API ins_status_t ins_tm_thesis_forward(const ins_tm_t* self, ins_real lat, ins_real lon, ins_real en[2]);
/// As ins_tm_inverse(), by equations 5.8 and 5.9.
INS_API ins_status_t ins_tm_thesis_inverse(const ins_tm_t* self, const ins_real en[2], ins_real lat_lon[2]);

#ifdef __cplusplus
}
#endif
#endif // INS_TM_H_INCLUDED
