/// \file   gps_dr_file.h
/// \brief  What the tests of the GPS and dead-reckoning filters share: the reference file's numbers, comparison by element.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_GPS_DR_FILE_H
#define INS_TESTS_GPS_DR_FILE_H
#include "core_test.h"
#include <limits>

namespace core_test
{
constexpr double TOL_MODEL = INS_TOL(1e-10, 2e-6); ///< Phi and Q; the file's come from Van Loan, good to 1e-11
constexpr double TOL_RUN = INS_TOL(1e-11, 2e-3);   ///< of an element over 1 or its own size
constexpr double TOL_STEP = INS_TOL(1e-12, 2e-5);
constexpr ins_real NOT_A_NUMBER = std::numeric_limits<ins_real>::quiet_NaN();

inline ins_real number(const json& value)
{
    return static_cast<ins_real>(value.get<double>());
}

inline std::vector<ins_real> numbers(const json& list)
{
    std::vector<ins_real> r;
    for (const json& value : list)
    {
        if (value.is_array())
        {
            const auto inner = numbers(value);
            r.insert(r.end(), inner.begin(), inner.end());
        }
        else
        {
            r.push_back(number(value));
        }
    }
    return r;
}

inline void compare(Worst& worst, const ins_real* got, const json& want, const std::string& place)
{
    size_t i = 0;
    for (const json& row : want)
    {
        for (const json& value : row.is_array() ? row : json::array({row}))
        {
            const double w = value;
            worst.take(static_cast<double>(got[i++]), w, std::max(1.0, std::fabs(w)), place);
        }
    }
    ASSERT_GT(i, 0u) << place;
}

inline std::vector<ins_real> diagonal(const ins_real* P, size_t n)
{
    std::vector<ins_real> d;
    for (size_t i = 0; i < n; i++)
    {
        d.push_back(P[(n + 1) * i]);
    }
    return d;
}
} // namespace core_test

#endif // INS_TESTS_GPS_DR_FILE_H
