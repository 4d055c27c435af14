/// \file   ins/accelfit.hpp
/// \brief  One accelerometer in full, fitted: bias, scale factor, misalignments, quadratic term and place. Frame: b. SI.
///
/// Thin: each function is one call of the C function named the same, whose header says frames, units and ranges.
/// SPDX-License-Identifier: MIT
#ifndef INS_ACCELFIT_HPP_INCLUDED
#define INS_ACCELFIT_HPP_INCLUDED
#include "ins/accelfit.h"
#include "ins/eigen.hpp"

namespace ins
{
/// ins_accelfit_t
class AccelFit
{
  public:
    /// b, SF, m1, m2, k2, r.
    using Parameters = Vector<INS_ACCELFIT_N>;

    /// What the fixture does at the body's origin.
    struct Motion
    {
        Vector3 f_b = Vector3::Zero();
        Vector3 w_ib_b = Vector3::Zero();
        Vector3 wd_ib_b = Vector3::Zero();

        [[nodiscard]] ins_accelfit_motion_t raw() const
        {
            return {{f_b.x(), f_b.y(), f_b.z()},
                    {w_ib_b.x(), w_ib_b.y(), w_ib_b.z()},
                    {wd_ib_b.x(), wd_ib_b.y(), wd_ib_b.z()}};
        }
    };
    struct Prediction
    {
        Real reading;
        Parameters jacobian;
    };

    Status init(const Vector3& u0, const Vector3& e1, const Vector3& e2, const Parameters& p)
    {
        return detail::status(ins_accelfit_init(&raw, u0.data(), e1.data(), e2.data(), p.data()));
    }
    [[nodiscard]] Prediction predict(const Motion& motion) const
    {
        const ins_accelfit_motion_t in = motion.raw();
        Prediction out;
        out.reading = ins_accelfit_predict(&raw, &in, out.jacobian.data());
        return out;
    }
    Status add(const Motion& motion, Real reading)
    {
        const ins_accelfit_motion_t in = motion.raw();
        return detail::status(ins_accelfit_add(&raw, &in, reading));
    }
    /// Largest component of the step.
    [[nodiscard]] Result<Real> step()
    {
        Result<Real> largest = {Status::Ok, 0};
        largest.status = detail::status(ins_accelfit_step(&raw, &largest.value));
        return largest;
    }
    [[nodiscard]] Result<Parameters> deviation(Real sigma) const
    {
        return detail::get<Parameters>([&](Real* out) { return ins_accelfit_deviation(&raw, sigma, out); });
    }
    [[nodiscard]] Parameters p() const { return Parameters(raw.p); }

    ins_accelfit_t raw = {};
};
} // namespace ins

#endif // INS_ACCELFIT_HPP_INCLUDED
