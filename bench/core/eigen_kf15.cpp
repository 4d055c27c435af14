/// \file   eigen_kf15.cpp
/// \brief  A load for callgrind: the covariance of 15 errors, and of 21, as one writes it with Eigen, dense and in Joseph form, beside
///         ins_kf15_* and ins_kf15_scale_*, which must agree.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#include <Eigen/Dense>
#include <cstdio>
#include <cstdlib>

namespace
{
constexpr int N15 = INS_KF15_N;
constexpr int N21 = INS_KF15_N + INS_KF15_SCALE_N;
template <int N> using Square = Eigen::Matrix<double, N, N>;
template <int N> using H6 = Eigen::Matrix<double, 6, N>;
using R6 = Eigen::Matrix<double, 6, 6>;
const double TOL = 1e-9; ///< of the standard deviations
const double PERIOD_S = 0.01;
const double TAU_S = 1e5; ///< of scale factors
const double VARIANCE = 0.01;

template <int N> void propagate(Square<N>* P, const Square<N>* Phi, const Square<N>* Q)
{
    *P = *Phi * *P * Phi->transpose() + *Q;
}

template <int N> void update6(Square<N>* P, const H6<N>* H, const R6* R)
{
    const R6 S = *H * *P * H->transpose() + *R;
    const Eigen::Matrix<double, N, 6> K = *P * H->transpose() * S.inverse();
    const Square<N> rest = Square<N>::Identity() - K * *H;
    *P = rest * *P * rest.transpose() + K * *R * K.transpose();
}
} // namespace

extern "C" [[gnu::noinline]] void eigen_kf15_propagate(Square<N15>* P, const Square<N15>* Phi, const Square<N15>* Q);
extern "C" [[gnu::noinline]] void eigen_kf15_update6(Square<N15>* P, const H6<N15>* H, const R6* R);
extern "C" [[gnu::noinline]] void eigen_kf21_propagate(Square<N21>* P, const Square<N21>* Phi, const Square<N21>* Q);
extern "C" [[gnu::noinline]] void eigen_kf21_update6(Square<N21>* P, const H6<N21>* H, const R6* R);

extern "C" void eigen_kf15_propagate(Square<N15>* P, const Square<N15>* Phi, const Square<N15>* Q)
{
    propagate(P, Phi, Q);
}

extern "C" void eigen_kf15_update6(Square<N15>* P, const H6<N15>* H, const R6* R)
{
    update6(P, H, R);
}

extern "C" void eigen_kf21_propagate(Square<N21>* P, const Square<N21>* Phi, const Square<N21>* Q)
{
    propagate(P, Phi, Q);
}

extern "C" void eigen_kf21_update6(Square<N21>* P, const H6<N21>* H, const R6* R)
{
    update6(P, H, R);
}

namespace
{
/// Largest difference of the two, in standard deviations. \param[in] at  P(i, j) of the core.
template <int N, typename At> double distance(const Square<N>& P, const At& at)
{
    double worst = 0;
    for (int i = 0; i < N; i++)
    {
        for (int j = 0; j < N; j++)
        {
            const double e = std::fabs(at(i, j) - P(i, j)) / std::sqrt(P(i, i) * P(j, j));
            worst = e <= worst ? worst : e;
        }
    }
    return worst;
}
} // namespace

int main(int argc, char** argv)
{
    const unsigned long steps = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 100;
    const double level[4] = {1, 0, 0, 0};
    const double velocity[3] = {100, 50, -1};
    const double theta_b[3] = {0.001, -0.002, 0.003};
    const double v_b[3] = {0.02, -0.01, -0.1};
    const ins_position_t place = {{0.4, 2, 100}, {0, 0, 0}};
    const ins_kf15_sensors_t sensors = {1e-4, 1e-3, 1e-4, 300, 1e-2, 300};
    const ins_kf15_scale_sensors_t scales = {0.01, 0.01, TAU_S, TAU_S};
    const double sigma[] = {.01, .01, .1, 1, 1, 1, 10, 10, 10, 1e-4, 1e-4, 1e-4, .01, .01, .01};
    ins_strapdown_t strapdown;
    ins_kf15_model_t model;
    ins_kf15_t filter;
    ins_kf15_t scaled;
    ins_kf15_scale_t scale;
    if (ins_strapdown_init(&strapdown, INS_CONING_HIST2_OPT, PERIOD_S, level, velocity, &place) != INS_OK ||
        ins_kf15_model_init(&model, PERIOD_S, &sensors) != INS_OK || ins_kf15_init(&filter, sigma) != INS_OK ||
        ins_kf15_init(&scaled, sigma) != INS_OK || ins_kf15_scale_init(&scale, &scales) != INS_OK)
    {
        return 1;
    }
    ins_kf15_model(&model, &strapdown, v_b);
    double dense[N15 * N15];
    ins_kf15_transition(&model, dense);
    const double fall = PERIOD_S / TAU_S;
    Square<N21> P = Square<N21>::Zero();
    Square<N21> Q = Square<N21>::Zero();
    Square<N21> Phi = Square<N21>::Zero();
    Phi.topLeftCorner<N15, N15>() = Eigen::Map<Eigen::Matrix<double, N15, N15, Eigen::RowMajor>>(dense);
    for (int i = 0; i < N15; i++)
    {
        const double q[] = {model.q_phi, model.q_v, 0, model.bg.q, model.ba.q};
        P(i, i) = sigma[i] * sigma[i];
        Q(i, i) = q[i / 3];
    }
    for (int i = 0; i < INS_KF15_SCALE_N; i++)
    {
        P(N15 + i, N15 + i) = 1e-4;
        Q(N15 + i, N15 + i) = 1e-4 * fall * (2 - fall);
        Phi(N15 + i, N15 + i) = 1 - fall;
        const double by = i < 3 ? theta_b[i] : v_b[i - 3];
        Phi.block<3, 1>(i < 3 ? 0 : 3, N15 + i) =
            -by / PERIOD_S * Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(model.C).col(i % 3);
    }
    H6<N21> H = H6<N21>::Zero();
    H.block<6, 6>(0, INS_KF15_V).setIdentity();
    const R6 R = VARIANCE * R6::Identity();
    Square<N15> P15 = P.topLeftCorner<N15, N15>();
    const Square<N15> Q15 = Q.topLeftCorner<N15, N15>();
    const Square<N15> Phi15 = Phi.topLeftCorner<N15, N15>();
    const H6<N15> H15 = H.leftCols<N15>();
    for (unsigned long k = 0; k < steps; k++)
    {
        eigen_kf15_propagate(&P15, &Phi15, &Q15);
        eigen_kf15_update6(&P15, &H15, &R);
        eigen_kf21_propagate(&P, &Phi, &Q);
        eigen_kf21_update6(&P, &H, &R);
        ins_kf15_propagate(&filter, &model);
        ins_kf15_scale_propagate(&scale, &scaled, &model, theta_b, v_b);
        for (unsigned i = 0; i < 6; i++)
        {
            ins_innovation_t z = {0, VARIANCE, 0, 0};
            const double none[INS_KF15_SCALE_N] = {0};
            double h[N15] = {0};
            h[INS_KF15_V + i] = 1;
            ins_kf15_update_state(&filter, INS_KF15_V + i, &z);
            ins_kf15_scale_update(&scale, &scaled, h, none, &z);
        }
    }
    const double of15 = distance<N15>(P15, [&](int i, int j) { return filter.P[INS_KF15_ROW * i + j]; });
    const double of21 = distance<N21>(P,
                                      [&](int i, int j)
                                      {
                                          const int row = i < j ? i : j;
                                          const int column = i < j ? j : i;
                                          return column < N15 ? scaled.P[INS_KF15_ROW * row + column]
                                                              : scale.B[INS_KF15_SCALE_N * row + column - N15];
                                      });
    std::printf("15: %.2e, 21: %.2e of the standard deviations\n", of15, of21);
    return of15 <= TOL && of21 <= TOL ? 0 : 1;
}
