/// \file   main.cpp
/// \brief  Prints every point of every figure that this number type has, as figure, curve, x, y between tabs.
///
/// Exit code 1 when a run was refused or a point is no number.
/// SPDX-License-Identifier: MIT
#include "figures.hpp"
#include <gtest/gtest.h>

int main()
{
    figures::coning();
    figures::attitude();
    figures::navigation();
    figures::filters();
    return testing::UnitTest::GetInstance()->Failed() ? 1 : 0;
}
