/// \file   coning.cpp
/// \brief  Drift of every coning form on a cone, and the error of the rotation vector's polynomial. Units: rad, s.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
#include "figures.hpp"
using namespace core_test;
using figures::point;

namespace
{
const double DEG = PI / 180;
const double DEG_PER_HOUR = DEG / 3600;
const int CYCLES =
    120; // a multiple of all block lengths, and enough for the smallest drift to stand out of the rounding
const double PERIOD_S = 0.01;

struct Named
{
    const char* name;
    int form;
};
const Named FORMS[] = {{"ONE", INS_CONING_ONE},
                       {"BLOCK2", INS_CONING_BLOCK2},
                       {"BLOCK3_FIT", INS_CONING_BLOCK3_FIT},
                       {"BLOCK3_OPT", INS_CONING_BLOCK3_OPT},
                       {"BLOCK4_FIT", INS_CONING_BLOCK4_FIT},
                       {"BLOCK4_OPT", INS_CONING_BLOCK4_OPT},
                       {"HIST1", INS_CONING_HIST1},
                       {"HIST2_FIT", INS_CONING_HIST2_FIT},
                       {"HIST2_OPT", INS_CONING_HIST2_OPT},
                       {"HIST3_FIT", INS_CONING_HIST3_FIT},
                       {"HIST3_OPT", INS_CONING_HIST3_OPT},
                       {"HIST2_MU03", INS_CONING_HIST2_MU03},
                       {"HIST2_MU06", INS_CONING_HIST2_MU06},
                       {"HIST2_MU10", INS_CONING_HIST2_MU10}};

/// Half-cone a, n increments a turn: q(k) = {cos a/2, 0, sin a/2 cos k mu, sin a/2 sin k mu}, mu = 2 pi / n.
struct Cone
{
    double a;
    int n;
    Quat attitude(long k) const
    {
        const double angle = 2 * PI * static_cast<double>(k % n) / n;
        return {std::cos(a / 2), 0, std::sin(a / 2) * std::cos(angle), std::sin(a / 2) * std::sin(angle)};
    }
    /// From k to k + 1, with the difference of two cosines as a product: no digit is lost.
    Vec increment(long k) const
    {
        const double middle = 2 * PI * (static_cast<double>((k % n + n) % n) + 0.5) / n;
        const double chord = 2 * std::sin(a) * std::sin(PI / n);
        const double s = std::sin(a / 2);
        return {-2 * s * s * 2 * PI / n, -chord * std::sin(middle), chord * std::cos(middle)};
    }
    /// Mean rotation about the cone's axis [rad an increment] that `form` adds.
    double drift(int form) const
    {
        std::vector<Vec> pre;
        std::vector<Vec> incs;
        for (long k = -3; k < static_cast<long>(CYCLES) * n; k++)
        {
            (k < 0 ? pre : incs).push_back(increment(k));
        }
        const Track track = run_form(form, attitude(0), pre, incs);
        return rotation_between(track.back().second, attitude(static_cast<long>(track.back().first)))[0] /
               static_cast<double>(track.back().first);
    }
    /// Equation 5 of Zheng and Zhou misread: the cross products of all three increments on every new one.
    double misread() const
    {
        auto q = real(attitude(0));
        for (long k = 0; k < static_cast<long>(CYCLES) * n; k++)
        {
            ins_real theta[9];
            for (long i = 0; i < 3; i++)
            {
                const auto x = real(increment(k - 2 + i));
                std::copy(x.begin(), x.end(), theta + 3 * i);
            }
            ins_real phi[3];
            ins_real dq[4];
            EXPECT_EQ(ins_coning_phi(INS_CONING_BLOCK3_FIT, theta, phi), INS_OK);
            for (int i = 0; i < 3; i++)
            {
                phi[i] -= theta[i] + theta[3 + i];
            }
            EXPECT_EQ(ins_quat_from_rotvec(phi, dq), INS_OK);
            ins_quat_mul(q.data(), dq, q.data());
            ins_quat_normalise_approx(q.data());
        }
        return rotation_between(quat(q.data()), attitude(0))[0] / (static_cast<double>(CYCLES) * n);
    }
};

#ifndef INS_REAL_FLOAT
void table()
{
    // Columns of table C1: increments a turn and half-cone; the frequency follows from 10 ms.
    const Cone columns[] = {{1 * DEG, 100}, {1 * DEG, 24}, {1 * DEG, 12}, {5 * DEG, 12}};
    for (size_t i = 0; i < 4; i++)
    {
        const double x = static_cast<double>(i);
        for (const Named& f : FORMS)
        {
            point("table_coning", f.name, x, std::fabs(columns[i].drift(f.form)) / PERIOD_S / DEG_PER_HOUR);
        }
        point("table_coning", "misread", x, std::fabs(columns[i].misread()) / PERIOD_S / DEG_PER_HOUR);
    }
}

/// Of a slow and thin cone the drift is the difference of equal numbers: below 1e-11 a^2 Omega only rounding is left.
void against_frequency()
{
    for (const int n : {6, 7, 8, 10, 12, 16, 20, 24, 32, 48, 64, 96, 128})
    {
        const Cone cone = {0.5 * DEG, n};
        const double mu = 2 * PI / n;
        for (const Named& f : FORMS)
        {
            const double relative = std::fabs(cone.drift(f.form)) / (cone.a * cone.a * mu);
            if (f.form != INS_CONING_BLOCK2 && relative > 1e-11) // BLOCK2 has the drift of HIST1
            {
                point("coning_drift", f.name, mu, relative);
            }
        }
    }
}
#endif

void rotation_vector()
{
    const char* type = INS_TOL("double", "float");
    for (int i = 0; i <= 40; i++)
    {
        const double angle = std::pow(10.0, -3 + i * 0.1);
        double worst = 0;
        const int directions = 200;
        for (int k = 0; k < directions; k++)
        {
            const double z = (2 * k + 1.0) / directions - 1;
            const double r = std::sqrt(1 - z * z);
            const auto phi = real(Vec{angle * r * std::cos(2.4 * k), angle * r * std::sin(2.4 * k), angle * z});
            ins_real q[4];
            EXPECT_EQ(ins_quat_from_rotvec(phi.data(), q), INS_OK);
            long double square = 0;
            for (const ins_real x : phi)
            {
                square += static_cast<long double>(x) * x;
            }
            const long double size = std::sqrt(square);
            worst = larger(worst, static_cast<double>(std::fabs(q[0] - std::cos(size / 2))));
            for (size_t axis = 0; axis < 3; axis++)
            {
                const long double want = phi[axis] / size * std::sin(size / 2);
                worst = larger(worst, static_cast<double>(std::fabs(q[axis + 1] - want)));
            }
        }
        point("rotvec", type, angle, worst);
    }
}
#ifndef INS_REAL_FLOAT
/// Pitch this far from the pole, roll and yaw anything: the library's pitch, and the arc sine of the direction cosine.
void pole()
{
    for (int i = 0; i <= 32; i++)
    {
        const long double off = std::pow(10.0L, -8 + i * 0.25L);
        const long double pitch = std::acos(-1.0L) / 2 - off;
        double worst[2] = {0, 0};
        for (int k = 0; k < 100; k++)
        {
            const long double y = std::sin(1.7L * k), r = std::cos(2.3L * k); // half angles
            const long double c = std::cos(pitch / 2), s = std::sin(pitch / 2);
            const long double exact[4] = {std::cos(y) * c * std::cos(r) + std::sin(y) * s * std::sin(r),
                                          std::cos(y) * c * std::sin(r) - std::sin(y) * s * std::cos(r),
                                          std::cos(y) * s * std::cos(r) + std::sin(y) * c * std::sin(r),
                                          std::sin(y) * c * std::cos(r) - std::cos(y) * s * std::sin(r)};
            ins_real q[4];
            std::copy(exact, exact + 4, q);
            ins_real euler[3];
            ins_quat_to_euler(q, euler);
            const double sine = std::min(1.0, 2 * (q[0] * q[2] - q[1] * q[3]));
            worst[0] = larger(worst[0], static_cast<double>(std::fabs(euler[1] - pitch)));
            worst[1] = larger(worst[1], static_cast<double>(std::fabs(std::asin(sine) - pitch)));
        }
        point("euler_pole", "library", static_cast<double>(off), worst[0]);
        point("euler_pole", "arc sine", static_cast<double>(off), worst[1]);
    }
}
#endif
} // namespace

void figures::coning()
{
#ifndef INS_REAL_FLOAT
    table();
    against_frequency();
    pole();
#endif
    rotation_vector();
}
