/// \file   geodesy.c
/// \brief  Geodetic and Cartesian coordinates on an ellipsoid, local tangent frames. Units: rad, m.
/// SPDX-License-Identifier: MIT
#include "ins/geodesy.h"
#include "ins/ins_math.h"
#include "ins/vec.h"

#define QUARTER_TURN INS_C(1.57079632679489662)
#define ITERATIONS   2

const ins_ellipsoid_t ins_wgs84 = {6378137, INS_C(3.35281066474748072e-3), INS_C(6.69437999014131699e-3)};
const ins_ellipsoid_t ins_grs80 = {6378137, INS_C(3.35281068118231894e-3), INS_C(6.69438002290078763e-3)};

static int is_llh(const ins_real llh[3])
{
    return ins_vec_is_finite(llh) && ins_fabs(llh[0]) <= QUARTER_TURN && ins_fabs(llh[1]) <= 4 * QUARTER_TURN;
}

ins_status_t ins_geodesy_to_ecef(const ins_ellipsoid_t* ellipsoid, const ins_real llh[3], ins_real xyz_e[3])
{
    if (!is_llh(llh))
    {
        return INS_E_RANGE;
    }
    const ins_real s = ins_sin(llh[0]);
    const ins_real c = ins_cos(llh[0]);
    const ins_real sl = ins_sin(llh[1]);
    const ins_real cl = ins_cos(llh[1]);
    const ins_real normal = ellipsoid->a / ins_sqrt(1 - ellipsoid->e2 * s * s); // prime-vertical radius
    const ins_real p = (normal + llh[2]) * c;
    const ins_real z = ((1 - ellipsoid->e2) * normal + llh[2]) * s;
    xyz_e[0] = p * cl;
    xyz_e[1] = p * sl;
    xyz_e[2] = z;
    return INS_OK;
}

ins_status_t ins_geodesy_from_ecef(const ins_ellipsoid_t* ellipsoid, const ins_real xyz_e[3], ins_real llh[3])
{
    const ins_real a = ellipsoid->a;
    const ins_real e2 = ellipsoid->e2;
    const ins_real z = xyz_e[2];
    const ins_real p2 = xyz_e[0] * xyz_e[0] + xyz_e[1] * xyz_e[1];
    const ins_real r2 = p2 + z * z;
    const ins_real nearest = INS_GEODESY_RADIUS_MIN * a;
    if (!(r2 >= nearest * nearest) || !(r2 - r2 == 0))
    {
        return INS_E_RANGE;
    }
    // {c, s} is along {cos, sin} of the latitude phi, and theta the reduced latitude, tan theta = (b/a) tan phi:
    // tan phi = (z + e'^2 b sin^3 theta) / (p - e^2 a cos^3 theta). Kept as pairs, so the poles are no case of their own.
    const ins_real p = ins_sqrt(p2);
    const ins_real b_a = 1 - ellipsoid->f;
    const ins_real ee2_b = e2 / b_a * a;
    ins_real c = b_a * b_a * p; // exact for a point on the ellipsoid
    ins_real s = z;
    for (int i = 0; i < ITERATIONS; i++)
    {
        const ins_real k = 1 / ins_sqrt(c * c + b_a * b_a * s * s);
        const ins_real cos_theta = k * c;
        const ins_real sin_theta = k * b_a * s;
        c = p - e2 * a * cos_theta * cos_theta * cos_theta;
        s = z + ee2_b * sin_theta * sin_theta * sin_theta;
    }
    const ins_real k = 1 / ins_sqrt(c * c + s * s);
    const ins_real cos_lat = k * c;
    const ins_real sin_lat = k * s;
    llh[0] = ins_atan2(s, c);
    llh[1] = p > 0 ? ins_atan2(xyz_e[1], xyz_e[0]) : 0;
    llh[2] = p * cos_lat + z * sin_lat - a * ins_sqrt(1 - e2 * sin_lat * sin_lat);
    return INS_OK;
}

ins_status_t ins_local_init(ins_local_t* self, const ins_ellipsoid_t* ellipsoid, const ins_real llh[3])
{
    ins_real origin[3];
    if (ins_geodesy_to_ecef(ellipsoid, llh, origin) != INS_OK)
    {
        return INS_E_RANGE;
    }
    const ins_real s = ins_sin(llh[0]);
    const ins_real c = ins_cos(llh[0]);
    const ins_real sl = ins_sin(llh[1]);
    const ins_real cl = ins_cos(llh[1]);
    const ins_local_t frame = {{origin[0], origin[1], origin[2]},
                               {-s * cl, -s * sl, c, -sl, cl, 0, -c * cl, -c * sl, -s}};
    *self = frame;
    return INS_OK;
}

void ins_local_from_ecef(const ins_local_t* self, const ins_real xyz_e[3], ins_real ned[3])
{
    const ins_real d[3] = {xyz_e[0] - self->origin_e[0], xyz_e[1] - self->origin_e[1], xyz_e[2] - self->origin_e[2]};
    for (int i = 0; i < 3; i++)
    {
        ned[i] = ins_vec_dot(self->C_ne + 3 * i, d);
    }
}

void ins_local_to_ecef(const ins_local_t* self, const ins_real ned[3], ins_real xyz_e[3])
{
    const ins_real d[3] = {ned[0], ned[1], ned[2]};
    ins_vec_copy(self->origin_e, xyz_e);
    for (int i = 0; i < 3; i++)
    {
        ins_vec_add_scaled(xyz_e, d[i], self->C_ne + 3 * i);
    }
}

void ins_local_swap(const ins_real in[3], ins_real out[3])
{
    const ins_real north = in[0];
    out[0] = in[1];
    out[1] = north;
    out[2] = -in[2];
}
