/// \file   test_version.cpp
/// \brief  The version is the project's, and a header for the other number type or version is refused.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#include <gtest/gtest.h>
#include <string>

TEST(version, is_the_projects)
{
    EXPECT_EQ(std::to_string(INS_VERSION_MAJOR) + "." + std::to_string(INS_VERSION_MINOR) + "." +
                  std::to_string(INS_VERSION_PATCH),
              PROJECT_VERSION_TEXT);
    EXPECT_EQ(ins_version(), INS_VERSION);
}

TEST(version, abi_check_refuses_the_other_library)
{
    EXPECT_EQ(INS_ABI_CHECK(), INS_OK);
    EXPECT_EQ(ins_abi_check(INS_VERSION, sizeof(ins_real) == sizeof(float) ? sizeof(double) : sizeof(float)),
              INS_E_ABI);
    for (const long minor : {-100L, 100L, 10000L})
    {
        EXPECT_EQ(ins_abi_check(INS_VERSION + minor, sizeof(ins_real)), INS_E_ABI) << minor;
    }
    EXPECT_EQ(ins_abi_check(INS_VERSION / 100 * 100 + 99, sizeof(ins_real)), INS_OK) << "another patch";
}

TEST(version, every_status_has_a_text)
{
    for (const int status : {INS_OK, INS_E_RANGE, INS_E_STATE, INS_E_ABI, INS_E_GATE, INS_S_START})
    {
        EXPECT_STRNE(ins_status_text(status), ins_status_text(-1000));
    }
    EXPECT_STREQ(ins_status_text(-1000), "unknown status");
}
