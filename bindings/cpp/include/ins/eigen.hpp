/// \file   ins/eigen.hpp
/// \brief  Eigen types of the core's number type, status and result, and the border between Eigen's layout and the core's.
///
/// The core's quaternion is {w, x, y, z} and its matrices are row-major; Eigen::Quaternion stores x, y, z, w. They meet here alone.
/// SPDX-License-Identifier: MIT
#ifndef INS_EIGEN_HPP_INCLUDED
#define INS_EIGEN_HPP_INCLUDED
#include "ins/config.h"
#include "ins/version.h"
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ins
{
using Real = ins_real;
template <int N> using Vector = Eigen::Matrix<Real, N, 1>;
/// Row-major, as the core's; a vector of one number is a column to Eigen.
template <int N> using Square = Eigen::Matrix<Real, N, N, N == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
using Vector2 = Vector<2>;
using Vector3 = Vector<3>;
using Matrix3 = Eigen::Matrix<Real, 3, 3>;
using Quaternion = Eigen::Quaternion<Real>;

/// One sample of three axes a column: any matrix, block or map of 3 rows. Another layout is copied, which allocates.
using Samples = Eigen::Ref<const Eigen::Matrix<Real, 3, Eigen::Dynamic>>;
using SamplesOut = Eigen::Ref<Eigen::Matrix<Real, 3, Eigen::Dynamic>>;
/// One attitude a column, x, y, z, w: Eigen::Map<const Quaternion>(q.col(k).data()) is one.
using QuaternionsOut = Eigen::Ref<Eigen::Matrix<Real, 4, Eigen::Dynamic>>;

/// As ins_status_t: negative means refused and nothing changed, positive done with a remark.
enum class [[nodiscard]] Status : int{
    Ok = INS_OK,
    Range = INS_E_RANGE, ///< an argument is out of range, not a number, or of another size
    State = INS_E_STATE, Abi = INS_E_ABI, Gate = INS_E_GATE,
    Start = INS_S_START ///< done with fewer previous samples than the formula wants
};

[[nodiscard]] constexpr bool ok(Status status)
{
    return static_cast<int>(status) >= 0;
}

[[nodiscard]] inline const char* text(Status status)
{
    return ins_status_text(static_cast<int>(status));
}

/// Headers and library are of one version and one number type: call once at start.
inline Status abi_check()
{
    return static_cast<Status>(INS_ABI_CHECK());
}

/// value is zero where the status says refused.
template <class T> struct [[nodiscard]] Result
{
    Status status;
    T value;
    explicit operator bool() const { return ok(status); }
};

namespace detail
{
constexpr Status status(ins_status_t raw)
{
    return static_cast<Status>(raw);
}

/// The core's order of an Eigen quaternion.
struct Quat
{
    Real q[4];
    explicit Quat(const Quaternion& from) : q{from.w(), from.x(), from.y(), from.z()} {}
};

inline Quaternion quaternion(const Real q[4])
{
    return {q[0], q[1], q[2], q[3]};
}

/// What a call that cannot fail wrote.
template <class T, class Call> T fill(Call call)
{
    T out;
    call(out.data());
    return out;
}

/// What a call wrote, and its status.
template <class T, class Call> Result<T> get(Call call)
{
    Result<T> result = {Status::Ok, T::Zero()};
    result.status = status(call(result.value.data()));
    return result;
}

template <class Call> Result<Quaternion> get_quaternion(Call call)
{
    Real q[4] = {0, 0, 0, 0};
    const Status s = status(call(q));
    return {s, quaternion(q)};
}

template <class Call> Quaternion fill_quaternion(Call call)
{
    Real q[4];
    call(q);
    return quaternion(q);
}

template <class Call> Matrix3 fill_matrix(Call call)
{
    return fill<Square<3>>(call);
}

/// Calls step(k) for each column until one is refused; value is how many were done, status that of the last.
template <class Step> Result<Eigen::Index> for_each(Eigen::Index count, Step step)
{
    Result<Eigen::Index> done = {Status::Ok, 0};
    for (; done.value < count; done.value++)
    {
        done.status = step(done.value);
        if (!ok(done.status))
        {
            break;
        }
    }
    return done;
}
} // namespace detail
} // namespace ins

#endif // INS_EIGEN_HPP_INCLUDED
