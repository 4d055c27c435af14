/// \file   tm.c
/// \brief  Transverse Mercator by Krueger's series, TM2 of TWD97. Units: rad, m.
/// SPDX-License-Identifier: MIT
#include "ins/tm.h"
#include "ins/ins_math.h"
#include "tm_internal.h"

#define RADIAN    INS_C(0.017453292519943296) ///< of a degree
#define F_MAX     (INS_C(1.) / 150)
#define ODD_TERMS 11            ///< of the series below: 2e-19 at the largest argument
#define ETA_MAX   INS_C(0.1763) ///< a little over eta at INS_TM_DLON_MAX on the equator
#define XI_MAX    INS_C(1.5708) ///< a little over pi/2

#define RATIO(numerator, denominator) ((ins_real)(numerator) / (ins_real)(denominator))
/// Row j: coefficients of n^(j+1) .. n^6 in alpha, beta (Karney 2011, equations 35, 36) and delta (conformal to geodetic latitude).
static const ins_real alpha_n[INS_TM_ORDER][INS_TM_ORDER] = {
    {RATIO(1, 2), RATIO(-2, 3), RATIO(5, 16), RATIO(41, 180), RATIO(-127, 288), RATIO(7891, 37800)},
    {RATIO(13, 48), RATIO(-3, 5), RATIO(557, 1440), RATIO(281, 630), RATIO(-1983433, 1935360)},
    {RATIO(61, 240), RATIO(-103, 140), RATIO(15061, 26880), RATIO(167603, 181440)},
    {RATIO(49561, 161280), RATIO(-179, 168), RATIO(6601661, 7257600)},
    {RATIO(34729, 80640), RATIO(-3418889, 1995840)},
    {RATIO(212378941, 319334400)}};
static const ins_real beta_n[INS_TM_ORDER][INS_TM_ORDER] = {
    {RATIO(1, 2), RATIO(-2, 3), RATIO(37, 96), RATIO(-1, 360), RATIO(-81, 512), RATIO(96199, 604800)},
    {RATIO(1, 48), RATIO(1, 15), RATIO(-437, 1440), RATIO(46, 105), RATIO(-1118711, 3870720)},
    {RATIO(17, 480), RATIO(-37, 840), RATIO(-209, 4480), RATIO(5569, 90720)},
    {RATIO(4397, 161280), RATIO(-11, 504), RATIO(-830251, 7257600)},
    {RATIO(4583, 161280), RATIO(-108847, 3991680)},
    {RATIO(20648693, 638668800)}};
static const ins_real delta_n[INS_TM_ORDER][INS_TM_ORDER] = {
    {2, RATIO(-2, 3), -2, RATIO(116, 45), RATIO(26, 45), RATIO(-2854, 675)},
    {RATIO(7, 3), RATIO(-8, 5), RATIO(-227, 45), RATIO(2704, 315), RATIO(2323, 945)},
    {RATIO(56, 15), RATIO(-136, 35), RATIO(-1262, 105), RATIO(73814, 2835)},
    {RATIO(4279, 630), RATIO(-332, 35), RATIO(-399572, 14175)},
    {RATIO(4174, 315), RATIO(-144838, 6237)},
    {RATIO(601676, 22275)}};

static void evaluate(const ins_real rows[INS_TM_ORDER][INS_TM_ORDER], ins_real n, ins_real out[INS_TM_ORDER])
{
    ins_real power = 1;
    for (int j = 0; j < INS_TM_ORDER; j++)
    {
        ins_real sum = 0;
        for (int k = INS_TM_ORDER - 1 - j; k >= 0; k--)
        {
            sum = rows[j][k] + n * sum;
        }
        power *= n;
        out[j] = power * sum;
    }
}

/// x + x^3/3 + x^5/5 ..., for |x| <= sin(INS_TM_DLON_MAX)
static ins_real atanh_small(ins_real x)
{
    ins_real sum = 0;
    for (int k = ODD_TERMS - 1; k >= 0; k--)
    {
        sum = 1 / (ins_real)(2 * k + 1) + x * x * sum;
    }
    return x * sum;
}

/// x + x^3/6 + x^5/120 ..., for |x| <= ETA_MAX
static ins_real sinh_small(ins_real x)
{
    ins_real sum = 0;
    for (int k = ODD_TERMS - 1; k >= 1; k--)
    {
        sum = x * x * (1 + sum) / (ins_real)(2 * k * (2 * k + 1));
    }
    return x * (1 + sum);
}

/// Sums over j of a_j sin(2 j zeta) and 2 j a_j cos(2 j zeta) for complex zeta, {real, imaginary}, by Clenshaw's recurrence.
/// \param[in] sin2, cos2  of 2 Re zeta. \param[in] sinh2, cosh2  of 2 Im zeta. \param[out] slope  [2] or NULL.
static void fourier(const ins_real a[INS_TM_ORDER], ins_real sin2, ins_real cos2, ins_real sinh2, ins_real cosh2,
                    ins_real sum[2], ins_real* slope)
{
    const ins_real cr = cos2 * cosh2;
    const ins_real ci = -sin2 * sinh2;
    const ins_real sr = sin2 * cosh2;
    const ins_real si = cos2 * sinh2;
    ins_real y[2][2] = {{0}}; // y_(j+1), y_(j+2) of the sines
    ins_real d[2][2] = {{0}}; // of the cosines
    for (int j = INS_TM_ORDER - 1; j >= 0; j--)
    {
        for (int part = 0; part < 2; part++)
        {
            ins_real(*const v)[2] = part == 0 ? y : d;
            const ins_real constant = part == 0 ? a[j] : 2 * (ins_real)(j + 1) * a[j];
            const ins_real re = constant + 2 * (cr * v[0][0] - ci * v[0][1]) - v[1][0];
            const ins_real im = 2 * (cr * v[0][1] + ci * v[0][0]) - v[1][1];
            v[1][0] = v[0][0];
            v[1][1] = v[0][1];
            v[0][0] = re;
            v[0][1] = im;
        }
    }
    sum[0] = sr * y[0][0] - si * y[0][1];
    sum[1] = sr * y[0][1] + si * y[0][0];
    if (slope != 0)
    {
        slope[0] = cr * d[0][0] - ci * d[0][1] - d[1][0];
        slope[1] = cr * d[0][1] + ci * d[0][0] - d[1][1];
    }
}

ins_status_t ins_tm_init(ins_tm_t* self, const ins_ellipsoid_t* ellipsoid, ins_real lon0, ins_real k0,
                         ins_real false_easting, ins_real false_northing)
{
    const ins_real sum = ellipsoid->a + false_easting + false_northing;
    if (!(ellipsoid->f > 0 && ellipsoid->f <= F_MAX) || !(ins_fabs(lon0) <= TM_PI) || !(k0 >= INS_C(0.5) && k0 <= 2) ||
        !(sum - sum == 0))
    {
        return INS_E_RANGE;
    }
    const ins_real n = ellipsoid->f / (2 - ellipsoid->f);
    const ins_real n2 = n * n;
    self->ellipsoid = *ellipsoid;
    self->lon0 = lon0;
    self->k0 = k0;
    self->false_e = false_easting;
    self->false_n = false_northing;
    self->e = ins_sqrt(ellipsoid->e2);
    self->unit = k0 * ellipsoid->a / (1 + n) * (1 + n2 * (RATIO(1, 4) + n2 * (RATIO(1, 64) + n2 * RATIO(1, 256))));
    evaluate(alpha_n, n, self->alpha);
    evaluate(beta_n, n, self->beta);
    evaluate(delta_n, n, self->delta);
    return INS_OK;
}

ins_status_t ins_tm_init_twd97(ins_tm_t* self, int zone)
{
    if (zone != 121 && zone != 119)
    {
        return INS_E_RANGE;
    }
    return ins_tm_init(self, &ins_grs80, (ins_real)zone * RADIAN, INS_C(0.9999), 250000, 0);
}

int ins_twd97_zone(ins_real lon)
{
    if (!(lon >= 118 * RADIAN && lon < 123 * RADIAN))
    {
        return 0;
    }
    return lon < 120 * RADIAN ? 119 : 121;
}

ins_status_t ins_tm_forward(const ins_tm_t* self, ins_real lat, ins_real lon, ins_real en[2], ins_real* convergence)
{
    ins_real dlon;
    if (!tm_in_reach(self, lat, lon, &dlon))
    {
        return INS_E_RANGE;
    }
    // Conformal latitude chi: tan chi = tan lat sqrt(1 + sigma^2) - sigma sec lat (Karney 7-9), over cos lat.
    const ins_real s = ins_sin(lat);
    const ins_real c = ins_cos(lat);
    const ins_real sigma = sinh_small(self->e * atanh_small(self->e * s));
    const ins_real root = ins_sqrt(1 + sigma * sigma);
    const ins_real k = 1 / (root - sigma * s);
    const ins_real sin_chi = k * (s * root - sigma);
    const ins_real cos_chi = k * c;

    const ins_real sin_dlon = ins_sin(dlon);
    const ins_real cos_dlon = ins_cos(dlon);
    const ins_real along = cos_chi * cos_dlon;
    const ins_real t = cos_chi * sin_dlon; // tanh(eta')
    const ins_real rest = 1 - t * t;       // sin_chi^2 + along^2
    ins_real sum[2];
    ins_real slope[2];
    fourier(self->alpha, 2 * sin_chi * along / rest, (along * along - sin_chi * sin_chi) / rest, 2 * t / rest,
            (1 + t * t) / rest, sum, slope);
    en[0] = self->false_e + self->unit * (atanh_small(t) + sum[1]);
    en[1] = self->false_n + self->unit * (ins_atan2(sin_chi, along) + sum[0]);
    if (convergence != 0)
    {
        *convergence = ins_atan2(sin_chi * sin_dlon, cos_dlon) - ins_atan2(slope[1], 1 + slope[0]);
    }
    return INS_OK;
}

ins_status_t ins_tm_inverse(const ins_tm_t* self, const ins_real en[2], ins_real lat_lon[2])
{
    const ins_real eta = (en[0] - self->false_e) / self->unit;
    const ins_real xi = (en[1] - self->false_n) / self->unit;
    if (!(ins_fabs(eta) <= ETA_MAX) || !(ins_fabs(xi) <= XI_MAX))
    {
        return INS_E_RANGE;
    }
    ins_real sum[2];
    const ins_real sinh = sinh_small(eta);
    const ins_real cosh = ins_sqrt(1 + sinh * sinh);
    fourier(self->beta, ins_sin(2 * xi), ins_cos(2 * xi), 2 * sinh * cosh, 1 + 2 * sinh * sinh, sum, 0);
    const ins_real s = ins_sin(xi - sum[0]);
    const ins_real c = ins_cos(xi - sum[0]);
    const ins_real across = sinh_small(eta - sum[1]);
    const ins_real along = ins_sqrt(across * across + c * c);
    const ins_real r2 = s * s + along * along;
    fourier(self->delta, 2 * s * along / r2, (along * along - s * s) / r2, 0, 1, sum, 0);
    lat_lon[0] = ins_atan2(s, along) + sum[0];
    lat_lon[1] = tm_wrap(self->lon0 + ins_atan2(across, c));
    return INS_OK;
}
