/// \file   eigen_steps.cpp
/// \brief  A load for callgrind: N steps of the Eigen reference, and of the core on the same increments, which must agree.
/// SPDX-License-Identifier: MIT
#include "eigen_peer.h"
#include "ins/ins.h"
#include <cstdio>
#include <cstdlib>

namespace
{
const int SAMPLES = 16;
const int START_UP = 2;        // steps in which the core has less history: not compared
const double TOL_ANGLE = 1e-9; // rad
const double TOL_ANGLE_F32 = 1e-3;
const double TOL_V = 1e-6;    // m/s
const double TOL_LAT = 1e-11; // rad
const double PERIOD_S = 0.01;

ins_increment_t sample(int i)
{
    ins_increment_t x;
    for (int axis = 0; axis < 3; axis++)
    {
        x.theta_b[axis] = (i % (5 + axis) - 2) * 0.01 + 0.001;
        x.v_b[axis] = (i % (7 - axis) - 3) * 0.02;
    }
    return x;
}

double distance(const Eigen::Quaterniond& a, const double q[4])
{
    return a.angularDistance(Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
}
} // namespace

int main(int argc, char** argv)
{
    const unsigned long steps = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 1000;
    const double level[4] = {1, 0, 0, 0};
    const double velocity[3] = {100, 50, -1};
    const ins_position_t place = {{0.4, 2, 100}, {0, 0, 0}};
    ins_increment_t increment[SAMPLES];
    for (int i = 0; i < SAMPLES; i++)
    {
        increment[i] = sample(i);
    }
    ins_attitude_t attitude;
    ins_strapdown_t strapdown;
    eigen_peer::Attitude<double> peer_attitude;
    eigen_peer::Attitude<float> peer_attitude_f32;
    eigen_peer::Sculling peer_sculling;
    eigen_peer::Strapdown peer;
    if (ins_attitude_init(&attitude, INS_CONING_HIST2_OPT, level) != INS_OK ||
        ins_strapdown_init(&strapdown, INS_CONING_HIST2_OPT, PERIOD_S, level, velocity, &place) != INS_OK)
    {
        return 1;
    }
    for (unsigned long k = 0; k < steps + START_UP; k++)
    {
        const ins_increment_t& x = increment[k % SAMPLES];
        ins_attitude_step(&attitude, x.theta_b);
        ins_strapdown_step(&strapdown, &x);
        if (k + 1 == START_UP)
        {
            // From here both have the same history and the same state.
            const double* q = attitude.q_nb;
            const double* s = strapdown.sculling.q_nb;
            for (int i = 0; i < 3; i++)
            {
                peer_attitude.theta1[i] = increment[1].theta_b[i];
                peer_attitude.theta2[i] = increment[0].theta_b[i];
                peer_attitude_f32.theta1[i] = static_cast<float>(increment[1].theta_b[i]);
                peer_attitude_f32.theta2[i] = static_cast<float>(increment[0].theta_b[i]);
                peer_sculling.v1[i] = increment[1].v_b[i];
                peer_sculling.v2[i] = increment[0].v_b[i];
                peer.v[i] = strapdown.v_n[i];
                peer.change_of_v[i] = 2 * strapdown.half_dv[i];
            }
            peer_attitude.q = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
            peer_attitude_f32.q = peer_attitude.q.cast<float>();
            peer_sculling.theta1 = peer_attitude.theta1;
            peer_sculling.theta2 = peer_attitude.theta2;
            peer_sculling.q = peer_attitude.q;
            peer.sculling = peer_sculling;
            peer.sculling.q = Eigen::Quaterniond(s[0], s[1], s[2], s[3]);
            peer.period = PERIOD_S;
            peer.lat = strapdown.position.anchor[0] + strapdown.position.offset[0];
            peer.lon = strapdown.position.anchor[1] + strapdown.position.offset[1];
            peer.h = strapdown.position.anchor[2] + strapdown.position.offset[2];
            peer.change_of_lat = 2 * strapdown.half_dlat;
            peer.change_of_h = -PERIOD_S * strapdown.v_n[2];
        }
        if (k >= START_UP)
        {
            const float theta[3] = {static_cast<float>(x.theta_b[0]), static_cast<float>(x.theta_b[1]),
                                    static_cast<float>(x.theta_b[2])};
            eigen_attitude_f64(&peer_attitude, x.theta_b);
            eigen_attitude_f32(&peer_attitude_f32, theta);
            eigen_sculling(&peer_sculling, x.theta_b, x.v_b);
            eigen_strapdown(&peer, x.theta_b, x.v_b);
        }
    }
    const ins_position_t& p = strapdown.position;
    const double off[] = {distance(peer_attitude.q, attitude.q_nb) / TOL_ANGLE,
                          distance(peer_sculling.q, attitude.q_nb) / TOL_ANGLE,
                          distance(peer_attitude_f32.q.cast<double>().normalized(), attitude.q_nb) / TOL_ANGLE_F32,
                          distance(peer.sculling.q, strapdown.sculling.q_nb) / TOL_ANGLE,
                          std::fabs(peer.v[0] - strapdown.v_n[0]) / TOL_V,
                          std::fabs(peer.v[1] - strapdown.v_n[1]) / TOL_V,
                          std::fabs(peer.v[2] - strapdown.v_n[2]) / TOL_V,
                          std::fabs(peer.lat - p.anchor[0] - p.offset[0]) / TOL_LAT,
                          std::fabs(peer.lon - p.anchor[1] - p.offset[1]) / TOL_LAT};
    int failures = 0;
    for (const double x : off)
    {
        std::printf("%.2e ", x);
        failures += !(x <= 1);
    }
    std::printf("of the tolerance\n");
    return failures;
}
