/// \file   eigen_peer.cpp
/// \brief  The same steps as one writes them with Eigen, for comparison: libm's sine and cosine, exact normalisation. b -> n, NED. SI, rad.
///
/// Same formulas of coning and sculling, same WGS-84 gravity, Earth at mid-step extrapolated from the step before.
/// SPDX-License-Identifier: MIT
#include "eigen_peer.h"
#include <cmath>

namespace
{
template <typename T> using Vec = Eigen::Matrix<T, 3, 1>;

template <typename T> Eigen::Quaternion<T> turn(const Vec<T>& phi)
{
    const T angle = phi.norm();
    return Eigen::Quaternion<T>(Eigen::AngleAxis<T>(angle, phi / angle));
}

template <typename T> void step(eigen_peer::Attitude<T>& self, const T* dtheta)
{
    const Vec<T> theta(dtheta[0], dtheta[1], dtheta[2]);
    const Vec<T> phi = theta + (T(7) / 60 * self.theta1 - T(1) / 60 * self.theta2).cross(theta);
    self.q = (self.q * turn(phi)).normalized();
    self.theta2 = self.theta1;
    self.theta1 = theta;
}

void step(eigen_peer::Sculling& self, const double* dtheta, const double* dv)
{
    const Eigen::Vector3d t(dtheta[0], dtheta[1], dtheta[2]);
    const Eigen::Vector3d v(dv[0], dv[1], dv[2]);
    const Eigen::Vector3d a = 7. / 60 * self.theta1 - 1. / 60 * self.theta2;
    const Eigen::Vector3d b = 7. / 60 * self.v1 - 1. / 60 * self.v2;
    self.dv = v + 0.5 * t.cross(v) + a.cross(v) + b.cross(t);
    self.q = (self.q * turn<double>(t + a.cross(t))).normalized();
    self.theta2 = self.theta1;
    self.theta1 = t;
    self.v2 = self.v1;
    self.v1 = v;
}
} // namespace

extern "C" void eigen_attitude_f64(eigen_peer::Attitude<double>* self, const double* dtheta)
{
    step(*self, dtheta);
}

extern "C" void eigen_attitude_f32(eigen_peer::Attitude<float>* self, const float* dtheta)
{
    step(*self, dtheta);
}

extern "C" void eigen_sculling(eigen_peer::Sculling* self, const double* dtheta, const double* dv)
{
    step(*self, dtheta, dv);
}

extern "C" void eigen_strapdown(eigen_peer::Strapdown* self, const double* dtheta, const double* dv)
{
    const double A = 6378137, F = 1 / 298.257223563, E2 = F * (2 - F), OMEGA = 7.292115e-5, T = self->period;
    const Eigen::Vector3d vm = self->v + 0.5 * self->change_of_v;
    const double lat = self->lat + 0.5 * self->change_of_lat;
    const double h = self->h + 0.5 * self->change_of_h;
    const double s = std::sin(lat), c = std::cos(lat), s2 = s * s;
    const double w = std::sqrt(1 - E2 * s2);
    const double north = A * (1 - E2) / (w * w * w) + h, east = A / w + h;
    const double g = 9.7803253359 * (1 + 0.00193185265241 * s2) / w *
                     (1 - 2 / A * (1 + F + 0.00344978650684084 - 2 * F * s2) * h + 3 * h * h / (A * A));
    const Eigen::Vector3d w_ie(OMEGA * c, 0, -OMEGA * s);
    const Eigen::Vector3d w_en(vm.y() / east, -vm.x() / north, -vm.y() * s / (c * east));
    const Eigen::Quaterniond start = self->sculling.q;
    step(self->sculling, dtheta, dv);
    const Eigen::Vector3d f = start * self->sculling.dv;
    const Eigen::Vector3d zeta = (w_ie + w_en) * T;
    self->change_of_v = f - 0.5 * zeta.cross(f) + T * (Eigen::Vector3d(0, 0, g) - (2 * w_ie + w_en).cross(vm));
    const Eigen::Vector3d mean = self->v + 0.5 * self->change_of_v;
    self->change_of_lat = T * mean.x() / north;
    self->change_of_h = -T * mean.z();
    self->lat += self->change_of_lat;
    self->lon += T * mean.y() / (east * c);
    self->h += self->change_of_h;
    self->v += self->change_of_v;
    self->sculling.q = (turn<double>(-zeta) * self->sculling.q).normalized();
}
