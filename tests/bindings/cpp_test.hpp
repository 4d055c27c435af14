/// \file   cpp_test.hpp
/// \brief  What the tests of the C++ headers share: numbers of the reference files as Eigen's types, comparison by element.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_CPP_TEST_HPP
#define INS_TESTS_CPP_TEST_HPP
#include "../core/gps_dr_file.h"
#include "ins/ins.hpp"

namespace cpp_test
{
using namespace core_test;
using Columns = Eigen::Matrix<ins_real, 3, Eigen::Dynamic>;
using Attitudes = Eigen::Matrix<ins_real, 4, Eigen::Dynamic>;

template <int N> ins::Vector<N> vector(const json& x)
{
    ins::Vector<N> v;
    for (int i = 0; i < N; i++)
    {
        v(i) = number(x[static_cast<size_t>(i)]);
    }
    return v;
}

inline ins::Quaternion quaternion(const json& x)
{
    return {number(x[0]), number(x[1]), number(x[2]), number(x[3])};
}

inline Columns columns(const json& list, size_t from, size_t count)
{
    Columns c(3, static_cast<Eigen::Index>(count));
    for (size_t k = 0; k < count; k++)
    {
        c.col(static_cast<Eigen::Index>(k)) = vector<3>(list[from + k]);
    }
    return c;
}

template <int N> ins::Square<N> square(const json& x)
{
    ins::Square<N> m;
    for (int i = 0; i < N; i++)
    {
        for (int j = 0; j < N; j++)
        {
            m(i, j) = number(x[static_cast<size_t>(i)][static_cast<size_t>(j)]);
        }
    }
    return m;
}

inline void take(Worst& worst, const ins::Quaternion& got, const json& want, const std::string& place)
{
    const double sign = got.dot(quaternion(want)) < 0 ? -1 : 1;
    const ins_real wxyz[] = {got.w(), got.x(), got.y(), got.z()};
    for (size_t i = 0; i < 4; i++)
    {
        worst.take(sign * static_cast<double>(wxyz[i]), want[i], 1, place);
    }
}

template <class Derived>
void take(Worst& worst, const Eigen::MatrixBase<Derived>& got, const json& want, double scale, const std::string& place)
{
    ASSERT_EQ(static_cast<size_t>(got.size()), want.size()) << place;
    for (Eigen::Index i = 0; i < got.size(); i++)
    {
        worst.take(static_cast<double>(got(i)), want[static_cast<size_t>(i)], scale, place);
    }
}
} // namespace cpp_test

#endif // INS_TESTS_CPP_TEST_HPP
