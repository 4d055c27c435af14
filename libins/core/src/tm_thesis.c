/// \file   tm_thesis.c
/// \brief  TM2 by the series of the thesis's section 5.1.3, its misprints corrected. Units: rad, m.
///
/// Equations 5.6, 5.7 (forward, in t = tan, eta and L) and 5.8, 5.9 (inverse; J. P. Snyder, USGS PP 1395, 1987, equations 3-26,
/// 8-17, 8-18). Corrected: k0 in 5.6 and 5.7; 3111 t^2; R1 with the power 3/2; C1 with e'^2 = e^2/(1 - e^2); one more term each in
/// the meridian arc's inverse series and in mu, which the thesis cuts short.
/// SPDX-License-Identifier: MIT
#include "tm_internal.h"

/// B(phi), length of the meridian from the equator [m].
static ins_real meridian_arc(const ins_ellipsoid_t* ellipsoid, ins_real phi)
{
    const ins_real n = ellipsoid->f / (2 - ellipsoid->f);
    const ins_real n2 = n * n;
    const ins_real alpha = ellipsoid->a / (1 + n) * (1 + n2 / 4 + n2 * n2 / 64);
    const ins_real beta = n * (INS_C(-1.5) + n2 * (INS_C(9.) / 16 - n2 * 3 / 32));
    const ins_real gamma = n2 * (INS_C(15.) / 16 - n2 * 15 / 32);
    const ins_real delta = n * n2 * (INS_C(-35.) / 48 + n2 * 105 / 256);
    const ins_real epsilon = n2 * n2 * 315 / 512;
    return alpha * (phi + beta * ins_sin(2 * phi) + gamma * ins_sin(4 * phi) + delta * ins_sin(6 * phi) +
                    epsilon * ins_sin(8 * phi));
}

ins_status_t ins_tm_thesis_forward(const ins_tm_t* self, ins_real lat, ins_real lon, ins_real en[2])
{
    ins_real dlon;
    if (!tm_in_reach(self, lat, lon, &dlon))
    {
        return INS_E_RANGE;
    }
    // Powers of t come with as many of cos phi, so T, below, is sin phi: no division by zero at a pole.
    const ins_real e2 = self->ellipsoid.e2;
    const ins_real s = ins_sin(lat);
    const ins_real c = ins_cos(lat);
    const ins_real c2 = c * c;
    const ins_real s2 = s * s;
    const ins_real eta2 = e2 / (1 - e2) * c2;
    const ins_real N = self->ellipsoid.a / ins_sqrt(1 - e2 * s2);
    const ins_real L = dlon;
    const ins_real L2 = L * L;
    const ins_real n4 = c2 * (5 + 9 * eta2 + 4 * eta2 * eta2) - s2;
    const ins_real n6 = c2 * (c2 * (61 + 270 * eta2) - s2 * (58 + 330 * eta2)) + s2 * s2;
    const ins_real n8 = c2 * (c2 * (1385 * c2 - 3111 * s2) + 543 * s2 * s2) - s2 * s2 * s2;
    const ins_real e3 = c2 * (1 + eta2) - s2;
    const ins_real e5 = c2 * (c2 * (5 + 14 * eta2) - s2 * (18 + 58 * eta2)) + s2 * s2;
    const ins_real e7 = c2 * (c2 * (61 * c2 - 479 * s2) + 179 * s2 * s2) - s2 * s2 * s2;
    en[0] = self->false_e + self->k0 * N * c * L * (1 + L2 * (e3 / 6 + L2 * (e5 / 120 + L2 * e7 / 5040)));
    en[1] =
        self->false_n + self->k0 * (meridian_arc(&self->ellipsoid, lat) +
                                    N * s * c * L2 * (INS_C(0.5) + L2 * (n4 / 24 + L2 * (n6 / 720 + L2 * n8 / 40320))));
    return INS_OK;
}

ins_status_t ins_tm_thesis_inverse(const ins_tm_t* self, const ins_real en[2], ins_real lat_lon[2])
{
    const ins_real a = self->ellipsoid.a;
    const ins_real e2 = self->ellipsoid.e2;
    const ins_real root = 1 - self->ellipsoid.f; // sqrt(1 - e^2)
    const ins_real e1 = (1 - root) / (1 + root);
    const ins_real e12 = e1 * e1;
    const ins_real per_rad =
        a * (1 - e2 * (INS_C(0.25) + e2 * (INS_C(3.) / 64 + e2 * (INS_C(5.) / 256 + e2 * 175 / 16384))));
    const ins_real mu = (en[1] - self->false_n) / self->k0 / per_rad;
    const ins_real D_N1 = (en[0] - self->false_e) / self->k0; // D times N1
    if (!(ins_fabs(mu) < TM_PI / 2) || !(ins_fabs(D_N1) <= INS_TM_DLON_MAX * a))
    {
        return INS_E_RANGE;
    }
    const ins_real phi1 = mu + e1 * (INS_C(1.5) - e12 * 27 / 32) * ins_sin(2 * mu) +
                          e12 * (INS_C(21.) / 16 - e12 * 55 / 32) * ins_sin(4 * mu) +
                          e1 * e12 * 151 / 96 * ins_sin(6 * mu) + e12 * e12 * 1097 / 512 * ins_sin(8 * mu);
    const ins_real s = ins_sin(phi1);
    const ins_real c = ins_cos(phi1);
    const ins_real W2 = 1 - e2 * s * s;
    const ins_real W = ins_sqrt(W2);
    const ins_real ee2 = e2 / (1 - e2);
    const ins_real C1 = ee2 * c * c;
    const ins_real T1 = s * s / (c * c);
    const ins_real N1_R1 = W2 / (1 - e2);
    const ins_real D = D_N1 * W / a;
    const ins_real D2 = D * D;
    const ins_real p4 = 5 + 3 * T1 + 10 * C1 - 4 * C1 * C1 - 9 * ee2;
    const ins_real p6 = 61 + 90 * T1 + 298 * C1 + 45 * T1 * T1 - 252 * ee2 - 3 * C1 * C1;
    const ins_real l3 = 1 + 2 * T1 + C1;
    const ins_real l5 = 5 - 2 * C1 + 28 * T1 - 3 * C1 * C1 + 8 * ee2 + 24 * T1 * T1;
    lat_lon[0] = phi1 - N1_R1 * (s / c) * D2 * (INS_C(0.5) - D2 * (p4 / 24 - D2 * p6 / 720));
    lat_lon[1] = tm_wrap(self->lon0 + D / c * (1 - D2 * (l3 / 6 - D2 * l5 / 120)));
    return INS_OK;
}
