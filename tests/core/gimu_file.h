/// \file   gimu_file.h
/// \brief  Streams and packets of the reference file gimu.json.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_GIMU_FILE_H
#define INS_TESTS_GIMU_FILE_H
#include "core_test.h"

namespace core_test
{
using Octets = std::vector<ins_octet_t>;

inline Octets unhex(const std::string& text)
{
    Octets octets;
    for (size_t i = 0; i + 1 < text.size(); i += 2)
    {
        octets.push_back(static_cast<ins_octet_t>(std::stoul(text.substr(i, 2), nullptr, 16)));
    }
    return octets;
}

inline void expect_packet(int type, const ins_gimu_packet_t& got, const json& want, const std::string& name)
{
    ASSERT_EQ(type, want["type"].get<int>()) << name;
    EXPECT_EQ(json(std::vector<unsigned>(got.raw, got.raw + 6)), want["raw"]) << name;
    if (type == INS_GIMU_T2)
    {
        EXPECT_EQ(got.coordinate[0], want["lat_raw"].get<uint32_t>()) << name;
        EXPECT_EQ(got.coordinate[1], want["lon_raw"].get<uint32_t>()) << name;
        EXPECT_EQ(got.sats, want["sats"].get<unsigned>()) << name;
        const double f1 = want["f1_deg"];
        const double f2 = want["f2_deg"];
        ASSERT_TRUE(got.has_position);
        EXPECT_NEAR(got.lat_e7, (f1 > 90 ? f2 : f1) * 1e7, 0.51) << name;
        EXPECT_NEAR(got.lon_e7, (f1 > 90 ? f1 : f2) * 1e7, 0.51) << name;
    }
}
} // namespace core_test

#endif // INS_TESTS_GIMU_FILE_H
