/// \file   eigen_peer.h
/// \brief  States and steps of the Eigen reference; each function is what callgrind counts.
/// SPDX-License-Identifier: MIT
#ifndef INS_BENCH_EIGEN_PEER_H_INCLUDED
#define INS_BENCH_EIGEN_PEER_H_INCLUDED
#include <Eigen/Geometry>

namespace eigen_peer
{
template <typename T> struct Attitude
{
    Eigen::Quaternion<T> q = Eigen::Quaternion<T>::Identity();
    Eigen::Matrix<T, 3, 1> theta1 = Eigen::Matrix<T, 3, 1>::Zero(), theta2 = theta1;
};

struct Sculling
{
    Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
    Eigen::Vector3d theta1 = Eigen::Vector3d::Zero(), theta2 = theta1, v1 = theta1, v2 = theta1, dv = theta1;
};

struct Strapdown
{
    Sculling sculling;
    double period, lat, lon, h;
    Eigen::Vector3d v, change_of_v = Eigen::Vector3d::Zero();
    double change_of_lat = 0, change_of_h = 0;
};
} // namespace eigen_peer

extern "C" void eigen_attitude_f64(eigen_peer::Attitude<double>* self, const double* dtheta);
extern "C" void eigen_attitude_f32(eigen_peer::Attitude<float>* self, const float* dtheta);
extern "C" void eigen_sculling(eigen_peer::Sculling* self, const double* dtheta, const double* dv);
extern "C" void eigen_strapdown(eigen_peer::Strapdown* self, const double* dtheta, const double* dv);

#endif // INS_BENCH_EIGEN_PEER_H_INCLUDED
