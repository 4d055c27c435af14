/// \file   navigation.cpp
/// \brief  Errors of sculling, strapdown, six accelerometers, alignment, ellipsoid and grid coordinates. Units: SI, rad.
/// SPDX-License-Identifier: MIT
#include "figures.hpp"
#include "strapdown_reference.h"
using namespace core_test;
using figures::point;

namespace
{
const double RAD = PI / 180;
const char* const TYPE = INS_TOL("double", "float");

void strapdown_step()
{
    const strapdown::Start start = {{45 * RAD, 0.1L, 500}, {300, 200, -10}};
    const strapdown::State end = strapdown::reference(start);
    for (const int hz : {10, 20, 25, 50, 100, 200, 400})
    {
        const strapdown::Errors e = strapdown::run(start, end, hz);
        const std::string type = std::string(", ") + TYPE;
        point("strapdown_step", "position [m]" + type, 1.0 / hz, e.position_m);
        point("strapdown_step", "velocity [m/s]" + type, 1.0 / hz, e.velocity);
        point("strapdown_step", "attitude [rad]" + type, 1.0 / hz, e.attitude_rad);
    }
}

/// There and back between heights and ECEF, over all latitudes; the larger of the shift on the ground and the height's.
void ellipsoid()
{
    for (int i = 0; i <= 24; i++)
    {
        const double height = std::pow(10.0, 1 + i * 0.25); // 10 m to 1e7 m
        double worst = 0;
        for (int lat = -90; lat <= 90; lat += 2)
        {
            const auto llh = real(Vec{lat * RAD, 1.1, height});
            ins_real xyz[3];
            ins_real back[3];
            EXPECT_EQ(ins_geodesy_to_ecef(&ins_wgs84, llh.data(), xyz), INS_OK);
            EXPECT_EQ(ins_geodesy_from_ecef(&ins_wgs84, xyz, back), INS_OK);
            worst = larger(worst, std::fabs(static_cast<double>(back[0] - llh[0])) * 6378137);
            worst = larger(worst, std::fabs(static_cast<double>(back[2] - llh[2])));
        }
        point("geodesy_height", TYPE, height, worst);
    }
}

#ifndef INS_REAL_FLOAT
/// Against the closed form of the ellipsoid's field (Moritz, Geodetic Reference System 1980), its magnitude, all latitudes.
void gravity()
{
    using L = long double;
    const L a = 6378137, f = 1 / 298.257223563L, b = a * (1 - f), GM = 3986004.418e8L, omega = 7.292115e-5L;
    const L E = std::sqrt(a * a - b * b), e2 = f * (2 - f);
    const auto q_of = [E](L u) { return ((1 + 3 * u * u / (E * E)) * std::atan(E / u) - 3 * u / E) / 2; };
    for (int i = 0; i <= 16; i++)
    {
        const double height = std::pow(10.0, 1 + i * 0.25);
        double worst[2] = {0, 0};
        for (int degree = -90; degree <= 90; degree += 5)
        {
            const L lat = static_cast<L>(degree) * RAD, s = std::sin(lat), N = a / std::sqrt(1 - e2 * s * s);
            const L p = (N + height) * std::cos(lat), z = (N * (1 - e2) + height) * s;
            const L rest = p * p + z * z - E * E;
            const L u = std::sqrt(rest / 2 * (1 + std::sqrt(1 + 4 * E * E * z * z / (rest * rest))));
            const L v = std::sqrt(u * u + E * E), beta = std::atan2(z * v, u * p), sb = std::sin(beta),
                    cb = std::cos(beta);
            const L w = std::sqrt((u * u + E * E * sb * sb) / (v * v));
            const L slope = 3 * (1 + u * u / (E * E)) * (1 - u / E * std::atan(E / u)) - 1;
            const L rotation = omega * omega * a * a / q_of(b);
            const L along_u = (omega * omega * u * cb * cb - GM / (v * v) -
                               rotation * E / (v * v) * slope * (sb * sb / 2 - 1 / 6.0L)) /
                              w;
            const L along_beta = (rotation / v * q_of(u) - omega * omega * v) * sb * cb / w;
            const L want = std::sqrt(along_u * along_u + along_beta * along_beta);
            const double sin_lat = static_cast<double>(s);
            const double gradient = (ins_earth_gravity(sin_lat, 1) - ins_earth_gravity(sin_lat, -1)) / 2;
            const double got[] = {ins_earth_gravity(sin_lat, height),
                                  ins_earth_gravity(sin_lat, 0) + gradient * height};
            for (int k = 0; k < 2; k++)
            {
                worst[k] = larger(worst[k], static_cast<double>(std::fabs(got[k] - want)));
            }
        }
        point("gravity_height", "library, second order", height, worst[0]);
        point("gravity_height", "gradient alone", height, worst[1]);
    }
}

/// Rotation a sin about x, force B sin along y, in phase at Omega: the mean force along z is B J1(a).
void sculling_drift()
{
    const double a = 2 * RAD, force = 10, hz = 5;
    const std::pair<const char*, int> forms[] = {
        {"rotation only (ONE)", INS_CONING_ONE}, {"HIST1", INS_CONING_HIST1},
        {"HIST2_FIT", INS_CONING_HIST2_FIT},     {"HIST2_OPT", INS_CONING_HIST2_OPT},
        {"HIST3_OPT", INS_CONING_HIST3_OPT},     {"BLOCK3_OPT", INS_CONING_BLOCK3_OPT},
        {"BLOCK4_OPT", INS_CONING_BLOCK4_OPT}};
    for (const int n : {12, 24, 36, 48, 72, 96, 144, 192})
    {
        const double mu = 2 * PI / n, omega = 2 * PI * hz;
        for (const auto& f : forms)
        {
            const int samples = ins_coning_samples(f.second);
            const int stride = ins_coning_is_block(f.second) ? samples : 1;
            double sum = 0;
            for (int k = 0; k < n; k += stride)
            {
                // The interval begins at k; history reaches back from it.
                ins_increment_t x[INS_CONING_SAMPLES_MAX];
                for (int i = 0; i < samples; i++)
                {
                    const double middle = mu * (k + i - (samples - stride) + 0.5);
                    x[i] = {{2 * a * std::sin(mu / 2) * std::cos(middle), 0, 0},
                            {0, 2 * force / omega * std::sin(mu / 2) * std::sin(middle), 0}};
                }
                ins_real dv[3];
                EXPECT_EQ(ins_sculling_dv(f.second, x, dv), INS_OK);
                const double angle = a * std::sin(mu * k);
                sum += std::sin(angle) * dv[1] + std::cos(angle) * dv[2];
            }
            point("sculling_step", f.first, mu, std::fabs(sum * hz - force * std::cyl_bessel_j(1, a)));
        }
    }
}

/// Round trip of Krueger's series, and the thesis's against it, at latitudes 5 to 75 deg.
void grid()
{
    for (const double dlon : {0.1, 0.2, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 9.9})
    {
        ins_tm_t tm;
        EXPECT_EQ(ins_tm_init_twd97(&tm, 121), INS_OK);
        double worst[3] = {0, 0, 0};
        for (int lat = 5; lat <= 75; lat += 5)
        {
            const double phi = lat * RAD, lon = (121 + dlon) * RAD;
            ins_real en[2], same[2], back[2];
            const auto shift = [&] { return 6378137 * std::hypot(back[0] - phi, (back[1] - lon) * std::cos(phi)); };
            EXPECT_EQ(ins_tm_forward(&tm, phi, lon, en, nullptr), INS_OK);
            EXPECT_EQ(ins_tm_inverse(&tm, en, back), INS_OK);
            worst[0] = larger(worst[0], shift());
            EXPECT_EQ(ins_tm_thesis_forward(&tm, phi, lon, same), INS_OK);
            worst[1] = larger(worst[1], std::hypot(same[0] - en[0], same[1] - en[1]));
            EXPECT_EQ(ins_tm_thesis_inverse(&tm, en, back), INS_OK);
            worst[2] = larger(worst[2], shift());
        }
        point("tm_distance", "Krueger, there and back", dlon, worst[0]);
        point("tm_distance", "thesis forward", dlon, worst[1]);
        point("tm_distance", "thesis inverse", dlon, worst[2]);
    }
}

/// Two seconds of rates up to 1 rad/s about every axis, the paper's six at 0.1 m: largest error of the rate, and the angle's at the end.
void six_accelerometers()
{
    const double arm = 0.1;
    const auto rate = [](double t) { return Vec{std::sin(2 * t), 0.8 * std::sin(3 * t), 0.6 * std::sin(2.5 * t)}; };
    const auto rise = [](double t) { return Vec{2 * std::cos(2 * t), 2.4 * std::cos(3 * t), 1.5 * std::cos(2.5 * t)}; };
    for (const int hz : {20, 50, 100, 200, 500, 1000})
    {
        ins_accel_t accels[6];
        ins_sixacc_t s;
        ins_sixacc_paper(arm, accels);
        EXPECT_EQ(ins_sixacc_init(&s, 6, accels, 1.0 / hz), INS_OK);
        double worst = 0;
        Vec turned = {0, 0, 0};
        for (int k = 0; k <= 2 * hz; k++)
        {
            const double t = static_cast<double>(k) / hz;
            const Vec w = rate(t), wd = rise(t);
            ins_real readings[6];
            for (int j = 0; j < 6; j++)
            {
                const ins_real* r = accels[j].r;
                ins_real wr[3], radial[3], tangential[3];
                ins_vec_cross(w.data(), r, wr);
                ins_vec_cross(w.data(), wr, radial);
                ins_vec_cross(wd.data(), r, tangential);
                readings[j] = ins_vec_dot(accels[j].axis, radial) + ins_vec_dot(accels[j].axis, tangential);
            }
            ins_increment_t x;
            EXPECT_EQ(ins_sixacc_step(&s, readings, &x), k ? INS_OK : INS_S_START);
            for (size_t i = 0; i < 3; i++)
            {
                worst = larger(worst, std::fabs(s.w_ib_b[i] - w[i]));
                turned[i] += x.theta_b[i];
            }
        }
        const Vec want = {(1 - std::cos(4.0)) / 2, 0.8 * (1 - std::cos(6.0)) / 3, 0.6 * (1 - std::cos(5.0)) / 2.5};
        const Vec off = {turned[0] - want[0], turned[1] - want[1], turned[2] - want[2]};
        point("sixacc_step", "rate [rad/s]", 1.0 / hz, worst);
        point("sixacc_step", "sum of the increments [rad]", 1.0 / hz, norm(off));
    }
}

/// Null of a 12-bit gyro at 2047.37 with noise of 0.9 code: root mean square over 400 runs, and the standard error claimed.
void null_of_a_gyro()
{
    const double null = 2047.37, sigma = 0.9;
    const int runs = 400;
    for (const unsigned samples : {6u, 12u, 30u, 60u, 120u, 360u, 1080u, 3600u})
    {
        double square = 0, claimed = 0, integer = 0;
        uint64_t state = samples;
        for (int run = 0; run < runs; run++)
        {
            ins_mean_t mean;
            EXPECT_EQ(ins_mean_init(&mean, 1), INS_OK);
            for (unsigned k = 0; k < samples; k++)
            {
                double gauss = -6; // twelve uniform numbers less their mean
                for (int i = 0; i < 12; i++)
                {
                    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
                    gauss += std::ldexp(static_cast<double>(state >> 11), -53);
                }
                const double code = std::floor(null + sigma * gauss + 0.5);
                const ins_real codes[3] = {code, code, code};
                EXPECT_EQ(ins_mean_add(&mean, codes), INS_OK);
            }
            ins_real got[3], error[3];
            EXPECT_EQ(ins_mean_get(&mean, got, error), INS_OK);
            square += (got[0] - null) * (got[0] - null) / runs;
            claimed += error[0] * error[0] / runs;
            const double rounded = std::floor(got[0] + 0.5) - null;
            integer += rounded * rounded / runs;
        }
        point("align_null", "mean, measured", samples, std::sqrt(square));
        point("align_null", "mean, claimed", samples, std::sqrt(claimed));
        point("align_null", "rounded to a code", samples, std::sqrt(integer));
    }
}
#endif
} // namespace

void figures::navigation()
{
    strapdown_step();
    ellipsoid();
#ifndef INS_REAL_FLOAT
    gravity();
    sculling_drift();
    grid();
    six_accelerometers();
    null_of_a_gyro();
#endif
}
