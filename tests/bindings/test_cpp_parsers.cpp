/// \file   test_cpp_parsers.cpp
/// \brief  The parsers as a C++ program calls them, against their reference files; GIMU samples to increments. Units: rad, m/s.
/// SPDX-License-Identifier: MIT
#include "../core/gimu_file.h"
#include "../core/handshake_link.h"
#include "cpp_test.hpp"
using namespace cpp_test;

TEST(cpp_vector_gimu, streams_and_coordinates)
{
    const json file = load("gimu.json");
    for (const json& s : file["streams"])
    {
        ins_gimu_t g;
        ins_gimu_init(&g, s["strict12"].get<bool>());
        std::vector<std::pair<int, ins_gimu_packet_t>> packets;
        for (const ins_octet_t octet : unhex(s["hex"]))
        {
            packets.push_back({ins_gimu_rx(&g, octet), g.packet});
        }
        do
        {
            packets.push_back({ins_gimu_flush(&g), g.packet});
        } while (packets.back().first != INS_GIMU_NOTHING);
        size_t found = 0;
        for (const auto& [type, packet] : packets)
        {
            if (type != INS_GIMU_NOTHING)
            {
                ASSERT_LT(found, s["packets"].size());
                expect_packet(type, packet, s["packets"][found++], s["name"]);
            }
        }
        EXPECT_EQ(found, s["packets"].size()) << s["name"];
    }
    for (const json& c : file["latlon"])
    {
        EXPECT_NEAR(ins_gimu_e7(c["raw"].get<uint32_t>()), c["decimal_deg"].get<double>() * 1e7, 0.51);
    }
}

TEST(cpp_vector_gimu, scaling)
{
    const double deg = 180 / PI;
    ins_gimu_scale_t thesis;
    ins_gimu_scale_t nominal;
    ins_gimu_scale_thesis(&thesis);
    ins_gimu_scale_nominal(&nominal);
    Worst worst;
    const json file = load("gimu.json");
    for (const json& c : file["conversions"])
    {
        for (ins_gimu_scale_t* const scale : {&thesis, &nominal})
        {
            std::fill(scale->null, scale->null + 6, number(c["null"]));
        }
        const auto code = c["raw"].get<uint16_t>();
        const uint16_t raw[6] = {code, code, code, code, code, code};
        const ins::Increment one = ins::gimu_increments(thesis, raw, 1);
        take(worst, one.theta_b * static_cast<ins_real>(deg), {c["dps_KP"], c["dps_KQ"], c["dps_KR"]}, 500, "thesis");
        take(worst, one.v_b / INS_GIMU_G, {c["g_datasheet"], c["g_datasheet"], c["g_datasheet"]}, 2, "g");
        const ins::Increment plain = ins::gimu_increments(nominal, raw, 1);
        worst.take(static_cast<double>(plain.theta_b.z()) * deg, c["dps_datasheet"], 500, "data sheet");
    }
    expect_within(worst, INS_TOL(1e-15, 3e-7), "GIMU scaling");
}

TEST(cpp_vector_handshake, transcripts)
{
    const json file = load("handshake.json");
    ASSERT_FALSE(file["cases"].empty());
    for (const json& c : file["cases"])
    {
        const ins_hs_config_t cfg = config(false, 2); // a block is sent three times in the file
        ins_hs_board_t board;
        ins_hs_host_t host;
        ASSERT_EQ(ins_hs_board_init(&board, &cfg), INS_OK);
        ASSERT_EQ(ins_hs_host_init(&host, &cfg), INS_OK);
        ins_octet_t block[6];
        ins_hs_block_put(c["xyz"].get<std::array<uint16_t, 3>>().data(), block);
        ASSERT_EQ(ins_hs_board_offer(&board, block, 0, 0), INS_OK);
        json accepted;
        EXPECT_EQ(transcript_of(c, &board, &host, &accepted), c["transcript"]) << c.dump();
        EXPECT_EQ(accepted, c["accepted"]) << c.dump();
    }
}
