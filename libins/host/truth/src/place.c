/// \file   place.c
/// \brief  Geodetic coordinates (B. R. Bowring, Survey Review 23(181), 1976, 323-327; 28(218), 1985, 202-206) and normal gravity
///         (NIMA TR8350.2, 3rd ed., eq. 4-1, 4-3) on WGS-84.
/// SPDX-License-Identifier: MIT
#include "ins_truth/elementary.h"
#include "place_internal.h"
#include "rotation_internal.h"
#include <math.h>

#define A          6378137.0
#define F          3.35281066474748072e-3
#define E2         6.69437999014131699e-3
#define GAMMA_E    9.7803253359        ///< on the equator [m/s^2]
#define K          1.93185265241e-3    ///< Somigliana's
#define M          3.44978650684084e-3 ///< w^2 a^2 b / GM
#define ITERATIONS 2

static void set_axes(ins_place_t* self, double s, double c, double sl, double cl)
{
    const double rows[9] = {-s * cl, -s * sl, c, -sl, cl, 0.0, -c * cl, -c * sl, -s};
    for (int i = 0; i < 9; i++)
    {
        self->C_ne[i] = rows[i];
    }
}

void ins_place_of_llh(const double llh[3], ins_place_t* out)
{
    double s;
    double c;
    double sl;
    double cl;
    ins_truth_sincos(llh[0], &s, &c);
    ins_truth_sincos(llh[1], &sl, &cl);
    const double normal = A / sqrt(1.0 - E2 * s * s);
    const double p = (normal + llh[2]) * c;
    out->xyz_e[0] = p * cl;
    out->xyz_e[1] = p * sl;
    out->xyz_e[2] = ((1.0 - E2) * normal + llh[2]) * s;
    for (int i = 0; i < 3; i++)
    {
        out->llh[i] = llh[i];
    }
    set_axes(out, s, c, sl, cl);
}

void ins_place_of_xyz(const double xyz_e[3], ins_place_t* out)
{
    const double z = xyz_e[2];
    const double p = sqrt(xyz_e[0] * xyz_e[0] + xyz_e[1] * xyz_e[1]);
    double c = (1.0 - F) * (1.0 - F) * p; // {c, s} along {cos, sin} of the latitude
    double s = z;
    for (int i = 0; i < ITERATIONS; i++)
    {
        const double k = 1.0 / sqrt(c * c + (1.0 - F) * (1.0 - F) * s * s); // to the reduced latitude
        const double cr = k * c;
        const double sr = k * (1.0 - F) * s;
        c = p - E2 * A * cr * cr * cr;
        s = z + E2 / (1.0 - F) * A * sr * sr * sr;
    }
    const double k = 1.0 / sqrt(c * c + s * s);
    const double per_p = p > 0.0 ? 1.0 / p : 0.0;
    const double cl = p > 0.0 ? xyz_e[0] * per_p : 1.0;
    c *= k;
    s *= k;
    for (int i = 0; i < 3; i++)
    {
        out->xyz_e[i] = xyz_e[i];
    }
    out->llh[0] = ins_truth_atan2(s, c);
    out->llh[1] = ins_truth_atan2(xyz_e[1], xyz_e[0]);
    out->llh[2] = p * c + z * s - A * sqrt(1.0 - E2 * s * s);
    set_axes(out, s, c, xyz_e[1] * per_p, cl);
}

void ins_place_into_e(const ins_place_t* self, const double v_n[3], double v_e[3])
{
    for (int i = 0; i < 3; i++)
    {
        v_e[i] = self->C_ne[i] * v_n[0] + self->C_ne[3 + i] * v_n[1] + self->C_ne[6 + i] * v_n[2];
    }
}

void ins_place_into_n(const ins_place_t* self, const double v_e[3], double v_n[3])
{
    for (int i = 0; i < 3; i++)
    {
        v_n[i] = self->C_ne[3 * i] * v_e[0] + self->C_ne[3 * i + 1] * v_e[1] + self->C_ne[3 * i + 2] * v_e[2];
    }
}

void ins_place_rotation(const ins_place_t* self, double q_en[4])
{
    const double longitude_then_tilt[3] = {self->llh[1], -(self->llh[0] + 0.5 * INS_TRUTH_PI), 0.0};
    ins_rotation_of_angles(longitude_then_tilt, q_en);
}

double ins_place_gravity(const ins_place_t* self)
{
    const double s2 = self->C_ne[8] * self->C_ne[8];
    const double h = self->llh[2];
    const double gamma = GAMMA_E * (1.0 + K * s2) / sqrt(1.0 - E2 * s2);
    return gamma * (1.0 - 2.0 / A * (1.0 + F + M - 2.0 * F * s2) * h + 3.0 * h * h / (A * A));
}
