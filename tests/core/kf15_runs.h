/// \file   kf15_runs.h
/// \brief  A drive, and the dense covariance in long double that the 15-error filter is held against. Frames: b -> n (NED). SI, rad.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_KF15_RUNS_H
#define INS_TESTS_KF15_RUNS_H
#include "core_test.h"

namespace core_test
{
constexpr unsigned N15 = INS_KF15_N;
using Dense = std::array<std::array<long double, N15>, N15>;
using Row15 = std::array<ins_real, N15>;

constexpr double PERIOD_S = 0.01;
constexpr double LATITUDE = 0.8;

inline ins_kf15_sensors_t mems()
{
    return {ins_real(1e-4), ins_real(1e-3), ins_real(1e-4), 300, ins_real(1e-2), 200};
}

/// A car that sways: increments of 10 ms, the same for every run.
inline ins_increment_t drive(long k)
{
    const double t = static_cast<double>(k) * PERIOD_S;
    const double w[3] = {0.05 * std::sin(1.3 * t), 0.04 * std::cos(0.9 * t), 0.3 * std::sin(0.2 * t)};
    const double f[3] = {1.5 * std::sin(0.31 * t), 2.0 * std::cos(0.17 * t), -9.81 + 0.5 * std::sin(2.1 * t)};
    ins_increment_t x;
    for (int i = 0; i < 3; i++)
    {
        x.theta_b[i] = static_cast<ins_real>(w[i] * PERIOD_S);
        x.v_b[i] = static_cast<ins_real>(f[i] * PERIOD_S);
    }
    return x;
}

inline ins_strapdown_t start_of_drive()
{
    const auto q = real(from_euler({0.02, -0.03, 0.7}));
    const ins_real v[3] = {20, 15, ins_real(0.5)};
    const ins_position_t at = {{static_cast<ins_real>(LATITUDE), ins_real(0.2), 100}, {0, 0, 0}};
    ins_strapdown_t s;
    EXPECT_EQ(ins_strapdown_init(&s, INS_CONING_HIST2_OPT, static_cast<ins_real>(PERIOD_S), q.data(), v, &at), INS_OK);
    return s;
}

inline ins_kf15_model_t start_of_model()
{
    ins_kf15_model_t m;
    const ins_kf15_sensors_t sensors = mems();
    EXPECT_EQ(ins_kf15_model_init(&m, static_cast<ins_real>(PERIOD_S), &sensors), INS_OK);
    return m;
}

/// The start's standard deviations; positions as given.
inline Row15 sigmas(double position = 10)
{
    const double of[5] = {0.02, 0.5, position, 1e-4, 1e-2};
    Row15 s;
    for (size_t i = 0; i < N15; i++)
    {
        s[i] = static_cast<ins_real>(of[i / 3] * (1 + 0.1 * static_cast<double>(i % 3)));
    }
    return s;
}

/// The textbook's filter: full matrices, long double, Joseph.
template <size_t N> struct DenseFilter
{
    std::array<std::array<long double, N>, N> P = {};
    std::array<long double, N> K = {};

    /// P = A P A'
    template <typename Matrix> void congruence(const Matrix& A)
    {
        std::array<std::array<long double, N>, N> AP = {};
        std::array<std::array<long double, N>, N> out = {};
        for (size_t i = 0; i < N; i++)
        {
            for (size_t k = 0; k < N; k++)
            {
                for (size_t j = 0; j < N; j++)
                {
                    AP[i][j] += A(i, k) * P[k][j];
                }
            }
        }
        for (size_t i = 0; i < N; i++)
        {
            for (size_t j = 0; j < N; j++)
            {
                for (size_t k = 0; k < N; k++)
                {
                    out[i][j] += AP[i][k] * A(j, k);
                }
            }
        }
        P = out;
    }
    void update(const std::array<ins_real, N>& h, double r)
    {
        std::array<long double, N> g = {};
        long double s = r;
        for (size_t i = 0; i < N; i++)
        {
            for (size_t j = 0; j < N; j++)
            {
                g[i] += P[i][j] * static_cast<long double>(h[j]);
            }
            s += g[i] * static_cast<long double>(h[i]);
        }
        for (size_t i = 0; i < N; i++)
        {
            K[i] = g[i] / s;
        }
        congruence([&](size_t i, size_t j) { return (i == j) - K[i] * static_cast<long double>(h[j]); });
        for (size_t i = 0; i < N; i++)
        {
            for (size_t j = 0; j < N; j++)
            {
                P[i][j] += K[i] * r * K[j];
            }
        }
    }
    void add_noise(const ins_kf15_model_t& m)
    {
        for (size_t i = 0; i < 3; i++)
        {
            P[i][i] += static_cast<long double>(m.q_phi);
            P[3 + i][3 + i] += static_cast<long double>(m.q_v);
            P[9 + i][9 + i] += static_cast<long double>(m.bg.q);
            P[12 + i][12 + i] += static_cast<long double>(m.ba.q);
        }
    }
};

struct Reference : DenseFilter<N15>
{
    explicit Reference(const Row15& sigma)
    {
        for (size_t i = 0; i < N15; i++)
        {
            P[i][i] = static_cast<long double>(sigma[i]) * static_cast<long double>(sigma[i]);
        }
    }
    void propagate(const ins_kf15_model_t& m)
    {
        ins_real Phi[N15 * N15];
        ins_kf15_transition(&m, Phi);
        congruence([&](size_t i, size_t j) { return static_cast<long double>(Phi[i * N15 + j]); });
        add_noise(m);
    }
};

/// Both forms behind one face.
struct Symmetric
{
    ins_kf15_t f;
    ins_status_t init(const Row15& sigma) { return ins_kf15_init(&f, sigma.data()); }
    void propagate(const ins_kf15_model_t& m) { ins_kf15_propagate(&f, &m); }
    ins_status_t update(const Row15& h, ins_innovation_t& z) { return ins_kf15_update(&f, h.data(), &z); }
    ins_status_t update_state(unsigned index, ins_innovation_t& z) { return ins_kf15_update_state(&f, index, &z); }
    std::array<ins_real, N15 * INS_KF15_ROW> packed() const
    {
        std::array<ins_real, N15 * INS_KF15_ROW> P;
        std::copy(std::begin(f.P), std::end(f.P), P.begin());
        return P;
    }
};

/// P - K h P and no more: what the textbook's first formula does, for comparison.
struct Conventional : Symmetric
{
    ins_status_t update(const Row15& h, ins_innovation_t& z)
    {
        std::array<ins_real, N15> g = {};
        ins_real s = z.r;
        for (size_t i = 0; i < N15; i++)
        {
            for (size_t j = 0; j < N15; j++)
            {
                g[i] += f.P[i * INS_KF15_ROW + j] * h[j];
            }
            s += h[i] * g[i];
        }
        for (size_t i = 0; i < N15; i++)
        {
            f.K[i] = g[i] / s;
            for (size_t j = 0; j < N15; j++)
            {
                f.P[i * INS_KF15_ROW + j] -= f.K[i] * g[j];
            }
        }
        return INS_OK;
    }
    ins_status_t update_state(unsigned index, ins_innovation_t& z)
    {
        Row15 h = {};
        h[index] = 1;
        return update(h, z);
    }
};

struct Factors
{
    ins_kf15_ud_t f;
    ins_status_t init(const Row15& sigma) { return ins_kf15_ud_init(&f, sigma.data()); }
    void propagate(const ins_kf15_model_t& m) { ins_kf15_ud_propagate(&f, &m); }
    ins_status_t update(const Row15& h, ins_innovation_t& z) { return ins_kf15_ud_update(&f, h.data(), &z); }
    ins_status_t update_state(unsigned index, ins_innovation_t& z) { return ins_kf15_ud_update_state(&f, index, &z); }
    std::array<ins_real, N15 * INS_KF15_ROW> packed() const
    {
        std::array<ins_real, N15 * INS_KF15_ROW> P;
        ins_kf15_ud_covariance(&f, P.data());
        return P;
    }
};

template <typename Form> Dense covariance(const Form& form)
{
    const auto packed = form.packed();
    Dense P;
    for (size_t i = 0; i < N15 * N15; i++)
    {
        P[i / N15][i % N15] = static_cast<long double>(packed[i / N15 * INS_KF15_ROW + i % N15]);
    }
    return P;
}

/// Largest element of P - want, in standard deviations of its row and column.
template <typename Matrix> double distance(const Matrix& P, const Matrix& want)
{
    double worst = 0;
    for (size_t i = 0; i < P.size(); i++)
    {
        for (size_t j = 0; j < P.size(); j++)
        {
            const long double e = std::fabs(P[i][j] - want[i][j]) / std::sqrt(want[i][i] * want[j][j]);
            worst = larger(worst, static_cast<double>(e));
        }
    }
    return worst;
}

/// Smallest pivot of the correlation matrix: not above 0 when P is no covariance.
template <typename Matrix> double smallest_pivot(const Matrix& P)
{
    Matrix L = P;
    for (size_t i = 0; i < P.size(); i++)
    {
        for (size_t j = 0; j < P.size(); j++)
        {
            L[i][j] /= std::sqrt(P[i][i] * P[j][j]);
        }
    }
    long double least = 1;
    for (size_t k = 0; k < P.size(); k++)
    {
        least = L[k][k] >= least ? least : L[k][k]; // NaN is least of all
        for (size_t i = k + 1; i < P.size(); i++)
        {
            for (size_t j = k + 1; j < P.size(); j++)
            {
                L[i][j] -= L[i][k] * L[k][j] / L[k][k];
            }
        }
    }
    return static_cast<double>(least);
}
} // namespace core_test

#endif // INS_TESTS_KF15_RUNS_H
