/// \file   kalman_runs.h
/// \brief  A filter in Joseph or UD form, and its gain's error against P0/R: what the tests and the figures of docs share. Units: m, s.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_KALMAN_RUNS_H
#define INS_TESTS_KALMAN_RUNS_H
#include "core_test.h"

namespace core_test
{
using Reals = std::vector<ins_real>;

struct Filter
{
    unsigned n;
    bool ud;
    Reals x, P, UD;

    Filter(bool ud_form, const Reals& x0, const Reals& P0)
        : n(static_cast<unsigned>(x0.size())), ud(ud_form), x(x0), P(P0), UD(INS_UD_SIZE(n))
    {
        Reals work(n * n);
        EXPECT_EQ(ins_ud_factor(n, P.data(), UD.data(), work.data()), INS_OK);
    }
    void predict(const Reals& Phi, const Reals& Q)
    {
        if (ud)
        {
            Reals Q_ud(INS_UD_SIZE(n));
            Reals scratch(n * n);
            EXPECT_EQ(ins_ud_factor(n, Q.data(), Q_ud.data(), scratch.data()), INS_OK);
            Reals work(INS_UD_WORK(n));
            ins_ud_predict(n, x.data(), UD.data(), Phi.data(), Q_ud.data(), work.data());
        }
        else
        {
            Reals work(INS_KALMAN_WORK(n));
            ins_kalman_predict(n, x.data(), P.data(), Phi.data(), Q.data(), work.data());
        }
    }
    ins_status_t update(const Reals& h, ins_innovation_t& z, Reals* gain = nullptr)
    {
        Reals work(ud ? 3 * n : 2 * n);
        const ins_status_t status = ud ? ins_ud_update(n, x.data(), UD.data(), h.data(), &z, work.data())
                                       : ins_kalman_update(n, x.data(), P.data(), h.data(), &z, work.data());
        if (gain)
        {
            gain->assign(work.begin(), work.begin() + n);
        }
        return status;
    }
    /// P - K h P and no more, for comparison: the textbook's first formula, of Joseph's P.
    ins_status_t update_conventional(const Reals& h, const ins_innovation_t& z, Reals* gain)
    {
        Reals g(n, 0);
        ins_real s = z.r;
        for (size_t i = 0; i < n; i++)
        {
            for (size_t j = 0; j < n; j++)
            {
                g[i] += P[i * n + j] * h[j];
            }
            s += h[i] * g[i];
        }
        for (size_t i = 0; i < n; i++)
        {
            (*gain)[i] = g[i] / s;
            for (size_t j = 0; j < n; j++)
            {
                P[i * n + j] -= (*gain)[i] * g[j];
            }
        }
        return s > 0 ? INS_OK : INS_E_RANGE;
    }
    Reals covariance() const
    {
        Reals full = P;
        if (ud)
        {
            ins_ud_covariance(n, UD.data(), full.data());
        }
        return full;
    }
};

/// Largest relative error of a gain after step 3 in ins_real, against long double, over 400 steps.
inline double gain_error(bool ud, double r, double p0, bool conventional = false)
{
    const double T = 0.05;
    const double q = 1e-4;
    const double A[9] = {1, T, T * T / 2, 0, 1, T, 0, 0, 1};
    const double Q[9] = {q * std::pow(T, 5) / 20, q * std::pow(T, 4) / 8, q * std::pow(T, 3) / 6,
                         q * std::pow(T, 4) / 8,  q * std::pow(T, 3) / 3, q * T * T / 2,
                         q * std::pow(T, 3) / 6,  q * T * T / 2,          q * T};
    const auto real_of = [](const double* m)
    {
        Reals out(9);
        for (size_t i = 0; i < 9; i++)
        {
            out[i] = static_cast<ins_real>(m[i]);
        }
        return out;
    };
    const auto p = static_cast<ins_real>(p0);
    Filter f(ud, Reals(3, 0), {p, 0, 0, 0, p, 0, 0, 0, p});
    std::array<std::array<long double, 3>, 3> P = {{{p0, 0, 0}, {0, p0, 0}, {0, 0, p0}}};
    double worst = 0;
    for (int k = 0; k < 400; k++)
    {
        f.predict(real_of(A), real_of(Q));
        std::array<std::array<long double, 3>, 3> M = {};
        for (size_t i = 0; i < 9; i++)
        {
            long double sum = Q[i];
            for (size_t a = 0; a < 9; a++)
            {
                sum += A[3 * (i / 3) + a / 3] * P[a / 3][a % 3] * A[3 * (i % 3) + a % 3];
            }
            M[i / 3][i % 3] = sum;
        }
        const long double s = M[0][0] + r;
        ins_innovation_t z = {0, static_cast<ins_real>(r), 0, 0};
        Reals K(3, 0);
        if ((conventional ? f.update_conventional({1, 0, 0}, z, &K) : f.update({1, 0, 0}, z, &K)) != INS_OK)
        {
            return INFINITY; // no longer a covariance, and said so
        }
        for (size_t i = 0; i < 3; i++)
        {
            if (k >= 3)
            {
                const long double want = M[i][0] / s;
                worst = larger(worst, std::fabs(static_cast<double>((static_cast<long double>(K[i]) - want) / want)));
            }
            for (size_t j = 0; j < 3; j++) // Joseph, in long double
            {
                const auto IKH = [&](size_t a, size_t b) { return (a == b) - (b == 0 ? M[a][0] / s : 0.0L); };
                long double sum = M[i][0] / s * r * (M[j][0] / s);
                for (size_t a = 0; a < 9; a++)
                {
                    sum += IKH(i, a / 3) * M[a / 3][a % 3] * IKH(j, a % 3);
                }
                P[i][j] = sum;
            }
        }
    }
    return worst;
}

} // namespace core_test

#endif // INS_TESTS_KALMAN_RUNS_H
