/// \file   ins/filters.hpp
/// \brief  Kalman filter of N states in Joseph and UD form, that of an axis, and fusion, over fixed-size Eigen matrices.
///
/// Thin: each function is one call of the C function named the same. Those of GPS and dead reckoning: ins/gps_dr.hpp.
/// SPDX-License-Identifier: MIT
#ifndef INS_FILTERS_HPP_INCLUDED
#define INS_FILTERS_HPP_INCLUDED
#include "ins/eigen.hpp"
#include "ins/fusion.h"
#include "ins/kalman.h"
#include "ins/pva.h"

namespace ins
{
/// Joseph form, full covariance. x and P are the caller's to read and to set.
template <int N> class Kalman
{
  public:
    Vector<N> x = Vector<N>::Zero();
    Square<N> P = Square<N>::Zero();

    /// x = Phi x and P = Phi P Phi' + Q.
    void predict(const Square<N>& Phi, const Square<N>& Q)
    {
        ins_kalman_predict(N, x.data(), P.data(), Phi.data(), Q.data(), work);
    }
    /// The same for P alone: the caller has moved x by its own model.
    void predict_covariance(const Square<N>& Phi, const Square<N>& Q)
    {
        ins_kalman_predict(N, nullptr, P.data(), Phi.data(), Q.data(), work);
    }
    /// One scalar measurement; z.nis is set, also when the gate refuses.
    Status update(const Vector<N>& h, ins_innovation_t& z)
    {
        return detail::status(ins_kalman_update(N, x.data(), P.data(), h.data(), &z, work));
    }
    /// Of the last update.
    [[nodiscard]] Vector<N> gain() const { return Vector<N>(work); }

  private:
    Real work[INS_KALMAN_WORK(N)] = {};
};

/// UD form: twice the work, and stands a larger P0/R in float.
template <int N> class Ud
{
  public:
    using Packed = Vector<INS_UD_SIZE(N)>;
    Vector<N> x = Vector<N>::Zero();
    Packed UD = Packed::Zero();

    /// Factors of a symmetric, positive semidefinite matrix: of Q for predict.
    [[nodiscard]] static Result<Packed> factor(const Square<N>& P)
    {
        Real scratch[N * N];
        return detail::get<Packed>([&](Real* out) { return ins_ud_factor(N, P.data(), out, scratch); });
    }
    [[nodiscard]] Square<N> covariance() const
    {
        return detail::fill<Square<N>>([&](Real* out) { ins_ud_covariance(N, UD.data(), out); });
    }
    void predict(const Square<N>& Phi, const Packed& Q_ud)
    {
        ins_ud_predict(N, x.data(), UD.data(), Phi.data(), Q_ud.data(), work);
    }
    void predict_covariance(const Square<N>& Phi, const Packed& Q_ud)
    {
        ins_ud_predict(N, nullptr, UD.data(), Phi.data(), Q_ud.data(), work);
    }
    Status update(const Vector<N>& h, ins_innovation_t& z)
    {
        return detail::status(ins_ud_update(N, x.data(), UD.data(), h.data(), &z, work));
    }
    [[nodiscard]] Vector<N> gain() const { return Vector<N>(work); }

  private:
    Real work[INS_UD_WORK(N)] = {};
};

/// Position, velocity and acceleration of one axis: ins_pva_t.
class Pva
{
  public:
    Status init(const Vector3& var) { return detail::status(ins_pva_init(&raw, var.data())); }
    Status predict(Real dt, Real q) { return detail::status(ins_pva_predict(&raw, dt, q)); }
    Status update(int what, ins_innovation_t& z) { return detail::status(ins_pva_update(&raw, what, &z)); }
    [[nodiscard]] Vector3 x() const { return Vector3(raw.x); }
    [[nodiscard]] Square<3> P() const { return Square<3>(raw.P); }
    [[nodiscard]] Vector3 gain() const { return Vector3(raw.K); }

    ins_pva_t raw = {};
};

/// Sum of the information of estimates taken for uncorrelated.
template <int N> class Fusion
{
  public:
    struct Estimate
    {
        Vector<N> x = Vector<N>::Zero();
        Square<N> P = Square<N>::Zero();
    };

    Status add(const Estimate& estimate)
    {
        Real scratch[N * N];
        return detail::status(ins_fusion_add(N, info.data(), y.data(), estimate.x.data(), estimate.P.data(), scratch));
    }
    [[nodiscard]] Result<Estimate> solve() const
    {
        Result<Estimate> fused = {Status::Ok, {}};
        fused.status =
            detail::status(ins_fusion_solve(N, info.data(), y.data(), fused.value.x.data(), fused.value.P.data()));
        return fused;
    }

  private:
    Square<N> info = Square<N>::Zero();
    Vector<N> y = Vector<N>::Zero();
};

/// P / beta for a local filter.
template <int N> [[nodiscard]] Result<Square<N>> fusion_share(const Square<N>& P, Real beta)
{
    return detail::get<Square<N>>([&](Real* out) { return ins_fusion_share(N, P.data(), beta, out); });
}
} // namespace ins

#endif // INS_FILTERS_HPP_INCLUDED
