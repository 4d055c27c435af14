/// \file   point.cpp
/// \brief  One line of output of a program of figures.
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
