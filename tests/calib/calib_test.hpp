/// \file   calib_test.hpp
/// \brief  What the tests of the calibration share: the core's test kit, and refusals in words.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_CALIB_TEST_HPP
#define INS_TESTS_CALIB_TEST_HPP
#include "../core/core_test.h"

namespace calib_test
{
using namespace core_test;

/// Room for a reason.
struct Reason
{
    char text[1024] = "";
    std::string str() const { return text; }
};
} // namespace calib_test

/// The reason contains these words.
#define EXPECT_SAYS(reason, words) EXPECT_NE((reason).str().find(words), std::string::npos) << (reason).text
#endif // INS_TESTS_CALIB_TEST_HPP
