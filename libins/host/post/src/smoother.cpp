/// \file   smoother.cpp
/// \brief  ins_post/gps_ins.hpp: the smoother, and arithmetic of errors. SPDX-License-Identifier: MIT
#include "ins/earth.h"
#include "ins/quat.h"
#include "post_internal.hpp"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ins_post
{
namespace
{
using Matrix = Eigen::Matrix<double, INS_KF15_N, INS_KF15_N, Eigen::RowMajor>;
using Vector = Eigen::Matrix<double, INS_KF15_N, 1>;
using View = Eigen::Map<const Matrix>;

Vec3 part(const Vector& errors, int first)
{
    return {errors[first], errors[first + 1], errors[first + 2]};
}

/// Errors that lead from b to a: a less b.
Vector difference(const Nominal& a, const Nominal& b)
{
    Vector errors;
    const Eigen::Quaterniond qa(a.q_nb[0], a.q_nb[1], a.q_nb[2], a.q_nb[3]);
    const Eigen::Quaterniond qb(b.q_nb[0], b.q_nb[1], b.q_nb[2], b.q_nb[3]);
    const Eigen::AngleAxisd turn(qa * qb.conjugate());
    errors.segment<3>(INS_KF15_PHI) = turn.angle() * turn.axis();
    double ned[3];
    ins_position_difference(&b.position, &a.position, ned);
    for (int i = 0; i < 3; i++)
    {
        const auto k = static_cast<size_t>(i);
        errors[INS_KF15_V + i] = a.v_n[k] - b.v_n[k];
        errors[INS_KF15_P + i] = ned[i];
        errors[INS_KF15_BG + i] = a.bias_g[k] - b.bias_g[k];
        errors[INS_KF15_BA + i] = a.bias_a[k] - b.bias_a[k];
    }
    return errors;
}

Nominal sum(const Nominal& a, const Vector& errors)
{
    Nominal out = a;
    const Eigen::Vector3d phi = errors.segment<3>(INS_KF15_PHI);
    const double angle = phi.norm();
    const Eigen::Quaterniond turn(
        Eigen::AngleAxisd(angle, angle > 0.0 ? Eigen::Vector3d(phi / angle) : Eigen::Vector3d::UnitX()));
    const Eigen::Quaterniond q = turn * Eigen::Quaterniond(a.q_nb[0], a.q_nb[1], a.q_nb[2], a.q_nb[3]);
    out.q_nb = {q.w(), q.x(), q.y(), q.z()};
    move(out.position, part(errors, INS_KF15_P));
    for (size_t i = 0; i < 3; i++)
    {
        const auto k = static_cast<int>(i);
        out.v_n[i] += errors[INS_KF15_V + k];
        out.bias_g[i] += errors[INS_KF15_BG + k];
        out.bias_a[i] += errors[INS_KF15_BA + k];
    }
    return out;
}

Vec3 sigma(const Square& P, size_t first)
{
    const auto at = [&](size_t i) { return std::sqrt(std::max(0.0, P[i * (INS_KF15_N + 1)])); };
    return {at(first), at(first + 1), at(first + 2)};
}
} // namespace

Nominal nominal(const ins_gps_ins_t& filter)
{
    Nominal out;
    std::copy(filter.nav.sculling.q_nb, filter.nav.sculling.q_nb + 4, out.q_nb.begin());
    std::copy(filter.nav.v_n, filter.nav.v_n + 3, out.v_n.begin());
    std::copy(filter.gyro_bias, filter.gyro_bias + 3, out.bias_g.begin());
    std::copy(filter.accel_bias, filter.accel_bias + 3, out.bias_a.begin());
    out.position = filter.nav.position;
    return out;
}

Square square(const ins_kf15_t& kf)
{
    Square out;
    for (size_t i = 0; i < INS_KF15_N; i++)
    {
        std::copy(kf.P + INS_KF15_ROW * i, kf.P + INS_KF15_ROW * i + INS_KF15_N,
                  out.begin() + INS_KF15_N * static_cast<ptrdiff_t>(i));
    }
    return out;
}

Square identity()
{
    Square out{};
    for (size_t i = 0; i < INS_KF15_N; i++)
    {
        out[i * (INS_KF15_N + 1)] = 1.0;
    }
    return out;
}

Square product(const Square& a, const Square& b)
{
    Square out;
    Eigen::Map<Matrix>(out.data()).noalias() = View(a.data()) * View(b.data());
    return out;
}

Square transition(const ins_kf15_model_t& model)
{
    Square out;
    ins_kf15_transition(&model, out.data());
    return out;
}

void move(ins_position_t& position, const Vec3& ned)
{
    const double latitude = position.anchor[0] + position.offset[0];
    const double height = position.anchor[2] + position.offset[2];
    double radii[2];
    ins_earth_radii(std::sin(latitude), radii);
    position.offset[0] += ned[0] / (radii[0] + height);
    position.offset[1] += ned[1] / ((radii[1] + height) * std::cos(latitude));
    position.offset[2] -= ned[2];
}

State described(double t, const Nominal& at, const Square& P)
{
    State out{};
    out.t = t;
    for (size_t i = 0; i < 3; i++)
    {
        out.position[i] = at.position.anchor[i] + at.position.offset[i];
    }
    out.v_n = at.v_n;
    out.q_nb = at.q_nb;
    out.bias_g = at.bias_g;
    out.bias_a = at.bias_a;
    out.sigma_phi = sigma(P, INS_KF15_PHI);
    out.sigma_v = sigma(P, INS_KF15_V);
    out.sigma_p = sigma(P, INS_KF15_P);
    out.sigma_bias_g = sigma(P, INS_KF15_BG);
    out.sigma_bias_a = sigma(P, INS_KF15_BA);
    size_t k = 0;
    for (size_t i = 0; i < INS_KF15_BG; i++)
    {
        for (size_t j = i; j < INS_KF15_BG; j++)
        {
            out.P[k++] = P[INS_KF15_N * i + j];
        }
    }
    return out;
}

std::vector<State> smooth(const std::vector<Node>& nodes)
{
    if (nodes.empty())
    {
        throw std::invalid_argument("smooth: there are no nodes");
    }
    std::vector<State> out(nodes.size());
    Nominal at = nodes.back().after;
    Square P = nodes.back().P_after;
    out.back() = described(nodes.back().t, at, P);
    for (size_t k = nodes.size() - 1; k-- > 0;)
    {
        const Node& here = nodes[k];
        const Node& next = nodes[k + 1];
        const Eigen::LDLT<Matrix> factored(View(next.P_before.data()));
        if (factored.info() != Eigen::Success || !factored.isPositive())
        {
            throw std::invalid_argument("smooth: a covariance is not positive definite");
        }
        const Matrix G = factored.solve(View(next.Phi.data()) * View(here.P_after.data())).transpose();
        const Matrix narrowed = View(P.data()) - View(next.P_before.data());
        at = sum(here.after, G * difference(at, next.before));
        const Matrix smoothed = View(here.P_after.data()) + G * narrowed * G.transpose();
        Eigen::Map<Matrix>(P.data()) = 0.5 * (smoothed + smoothed.transpose());
        out[k] = described(here.t, at, P);
    }
    return out;
}

} // namespace ins_post
