/// \file   eigen_kf15.cpp
/// \brief  A load for callgrind: the covariance of 15 errors as one writes it with Eigen, dense and in Joseph form, beside ins_kf15_*, which must agree.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#include <Eigen/Dense>
#include <cstdio>
#include <cstdlib>

namespace
{
using P15 = Eigen::Matrix<double, 15, 15>;
using H6 = Eigen::Matrix<double, 6, 15>;
using R6 = Eigen::Matrix<double, 6, 6>;
const double TOL = 1e-9; ///< of the standard deviations
const double PERIOD_S = 0.01;
} // namespace

extern "C" void eigen_kf15_propagate(P15* P, const P15* Phi, const P15* Q);
extern "C" void eigen_kf15_update6(P15* P, const H6* H, const R6* R);

extern "C" void eigen_kf15_propagate(P15* P, const P15* Phi, const P15* Q)
{
    *P = *Phi * *P * Phi->transpose() + *Q;
}

extern "C" void eigen_kf15_update6(P15* P, const H6* H, const R6* R)
{
    const R6 S = *H * *P * H->transpose() + *R;
    const Eigen::Matrix<double, 15, 6> K = *P * H->transpose() * S.inverse();
    const P15 rest = P15::Identity() - K * *H;
    *P = rest * *P * rest.transpose() + K * *R * K.transpose();
}

int main(int argc, char** argv)
{
    const unsigned long steps = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 100;
    const double variance = 0.01;
    const double level[4] = {1, 0, 0, 0};
    const double velocity[3] = {100, 50, -1};
    const double v_b[3] = {0.02, -0.01, -0.1};
    const ins_position_t place = {{0.4, 2, 100}, {0, 0, 0}};
    const ins_kf15_sensors_t sensors = {1e-4, 1e-3, 1e-4, 300, 1e-2, 300};
    const double sigma[] = {.01, .01, .1, 1, 1, 1, 10, 10, 10, 1e-4, 1e-4, 1e-4, .01, .01, .01};
    ins_strapdown_t strapdown;
    ins_kf15_model_t model;
    ins_kf15_t filter;
    if (ins_strapdown_init(&strapdown, INS_CONING_HIST2_OPT, PERIOD_S, level, velocity, &place) != INS_OK ||
        ins_kf15_model_init(&model, PERIOD_S, &sensors) != INS_OK || ins_kf15_init(&filter, sigma) != INS_OK)
    {
        return 1;
    }
    P15 P = P15::Zero();
    P15 Q = P15::Zero();
    P15 Phi;
    H6 H = H6::Zero();
    H.block<6, 6>(0, INS_KF15_V).setIdentity();
    const R6 R = variance * R6::Identity();
    for (int i = 0; i < 15; i++)
    {
        const double q[] = {model.q_phi, model.q_v, 0, model.bg.q, model.ba.q};
        P(i, i) = sigma[i] * sigma[i];
        Q(i, i) = q[i / 3];
    }
    ins_kf15_model(&model, &strapdown, v_b);
    double dense[15 * 15];
    ins_kf15_transition(&model, dense);
    Phi = Eigen::Map<Eigen::Matrix<double, 15, 15, Eigen::RowMajor>>(dense);
    for (unsigned long k = 0; k < steps; k++)
    {
        eigen_kf15_propagate(&P, &Phi, &Q);
        eigen_kf15_update6(&P, &H, &R);
        ins_kf15_propagate(&filter, &model);
        for (unsigned i = 0; i < 6; i++)
        {
            ins_innovation_t z = {0, variance, 0, 0};
            ins_kf15_update_state(&filter, INS_KF15_V + i, &z);
        }
    }
    double worst = 0;
    for (int i = 0; i < 15; i++)
    {
        for (int j = 0; j < 15; j++)
        {
            const double e = std::fabs(filter.P[INS_KF15_ROW * i + j] - P(i, j)) / std::sqrt(P(i, i) * P(j, j));
            worst = e <= worst ? worst : e;
        }
    }
    std::printf("%.2e of the standard deviations\n", worst);
    return worst <= TOL ? 0 : 1;
}
