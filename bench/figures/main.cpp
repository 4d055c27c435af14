/// \file   main.cpp
/// \brief  Prints every point of every figure that this number type has, as figure, curve, x, y between tabs.
///
/// Exit code 1 when a run was refused or a point is no number.
/// SPDX-License-Identifier: MIT
#include "figures.hpp"
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

void figures::point(const std::string& figure, const std::string& curve, double x, double y)
{
    EXPECT_TRUE(std::isfinite(x) && std::isfinite(y)) << figure << ", " << curve << " at " << x;
    std::printf("%s\t%s\t%.6g\t%.6e\n", figure.c_str(), curve.c_str(), x, y);
}

int main()
{
    figures::coning();
    figures::attitude();
    figures::navigation();
    figures::filters();
    return testing::UnitTest::GetInstance()->Failed() ? 1 : 0;
}
