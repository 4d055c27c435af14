/// \file   test_selftest.cpp
/// \brief  The self-test passes on a sound library; check_selftest.py shows that it fails on others.
/// SPDX-License-Identifier: MIT
#include "core_test.h"

TEST(selftest, sound_library_passes)
{
    EXPECT_EQ(ins_selftest(), 0u);
}
