/// \file   test_gimu.cpp
/// \brief  GIMU packets: the reference streams, every state with every octet, random octets; scaling.
/// SPDX-License-Identifier: MIT
#include "gimu_file.h"
#include <random>
using namespace core_test;

namespace
{
constexpr long RANDOM_OCTETS = 1000000;
constexpr long RANDOM_OCTETS_BENCH = 100000000; ///< with INS_BENCH set

/// What the machine promises between any two octets.
void expect_sound(const ins_gimu_t& g, long octets)
{
    ASSERT_LT(g.count, INS_GIMU_LOOK);
    ASSERT_EQ(g.count + g.skipped + INS_GIMU_T1_LEN * g.t1 + INS_GIMU_T2_LEN * g.t2, static_cast<uint32_t>(octets))
        << "every octet waits, is skipped, or is in a packet";
    if (g.count >= 2)
    {
        ASSERT_EQ(g.wait[0], 0xAA);
        ASSERT_EQ(g.wait[1], 0x55);
    }
    if (g.packet.has_position)
    {
        ASSERT_LE(g.packet.lat_e7, 900000000);
        ASSERT_LE(g.packet.lon_e7, 1810000000);
        ASSERT_GE(g.packet.lat_e7, 0);
        ASSERT_LE(g.packet.sats, 32);
    }
}

Octets t1(unsigned n)
{
    Octets p = {0xAA, 0x55};
    for (unsigned i = 0; i < 6; i++)
    {
        p.push_back(static_cast<ins_octet_t>((n + i) & 0x0F));
        p.push_back(static_cast<ins_octet_t>((17 * n + 31 * i) & 0xFF));
    }
    return p;
}

Octets t2(unsigned n)
{
    Octets p = t1(n);
    for (const uint32_t c : {24590000u, 120123456u})
    {
        for (int shift = 24; shift >= 0; shift -= 8)
        {
            p.push_back(static_cast<ins_octet_t>((c >> shift) & 0xFF));
        }
    }
    p.push_back(7);
    return p;
}
} // namespace

TEST(vector_gimu, streams)
{
    const json file = load("gimu.json");
    ASSERT_FALSE(file["streams"].empty());
    for (const json& s : file["streams"])
    {
        ins_gimu_t g;
        ins_gimu_init(&g, s["strict12"].get<bool>());
        size_t found = 0;
        const std::string name = s["name"];
        const auto check = [&](int type)
        {
            if (type == INS_GIMU_NOTHING)
            {
                return;
            }
            ASSERT_LT(found, s["packets"].size()) << name;
            expect_packet(type, g.packet, s["packets"][found++], name);
        };
        long octets = 0;
        for (const ins_octet_t o : unhex(s["hex"]))
        {
            check(ins_gimu_rx(&g, o));
            expect_sound(g, ++octets);
        }
        for (int type; (type = ins_gimu_flush(&g)) != INS_GIMU_NOTHING;)
        {
            check(type);
        }
        EXPECT_EQ(found, s["packets"].size()) << name;
        // The reference leaves the last 13 octets unread; the machine has dropped those of them that begin nothing.
        const auto dropped = g.skipped - s["skipped"].get<uint32_t>();
        EXPECT_EQ(static_cast<size_t>(octets) - g.count, s["rest_offset"].get<size_t>() + dropped) << name;
        EXPECT_LT(dropped + g.count, INS_GIMU_T1_LEN) << name;
    }
}

TEST(vector_gimu, coordinates)
{
    const json file = load("gimu.json");
    for (const json& c : file["latlon"])
    {
        EXPECT_NEAR(ins_gimu_e7(c["raw"].get<uint32_t>()), c["decimal_deg"].get<double>() * 1e7, 0.51) << c.dump();
    }
}

TEST(vector_gimu, scaling)
{
    const json file = load("gimu.json");
    ins_gimu_scale_t thesis;
    ins_gimu_scale_t nominal;
    ins_gimu_scale_thesis(&thesis);
    ins_gimu_scale_nominal(&nominal);
    Worst worst;
    const double deg = 180 / PI;
    for (const json& c : file["conversions"])
    {
        const auto raw1 = static_cast<uint16_t>(c["raw"].get<unsigned>());
        const uint16_t raw[6] = {raw1, raw1, raw1, raw1, raw1, raw1};
        for (ins_real* null : {thesis.null, nominal.null})
        {
            std::fill(null, null + 6, static_cast<ins_real>(c["null"].get<double>()));
        }
        ins_real dtheta[3];
        ins_real dv[3];
        ins_gimu_increments(&thesis, raw, 1, dtheta, dv);
        const std::string place = c.dump();
        const char* const names[] = {"dps_KP", "dps_KQ", "dps_KR"};
        for (size_t i = 0; i < 3; i++)
        {
            worst.take(static_cast<double>(dtheta[i]) * deg, c[names[i]], 500, place);
            worst.take(static_cast<double>(dv[i]) / 9.8, c["g_datasheet"], 2, place);
        }
        ins_gimu_increments(&thesis, raw, 1 / static_cast<ins_real>(INS_GIMU_RATE_HZ), dtheta, dv);
        worst.take(static_cast<double>(dtheta[0]) * deg, c["dtheta_deg_KP"], 100, place);
        ins_gimu_increments(&nominal, raw, 1, dtheta, dv);
        worst.take(static_cast<double>(dtheta[2]) * deg, c["dps_datasheet"], 500, place);
    }
    expect_within(worst, INS_TOL(1e-15, 3e-7), "GIMU scaling");
    const json& drift = file["static_drift"];
    ins_gimu_scale_thesis(&thesis);
    EXPECT_NEAR(static_cast<double>(thesis.rate[0]) * deg * 60 * drift["d"].get<double>(),
                drift["angle_deg_60s"].get<double>(), 1e-5);
}

TEST(gimu, each_channel_has_its_null_and_its_scale)
{
    ins_gimu_scale_t scale = {{1000, 2000, 3000, 1500, 2500, 3500}, {2, 3, 5}, 7};
    const uint16_t raw[6] = {1001, 2002, 3004, 1508, 2516, 3532};
    ins_real dtheta[3];
    ins_real dv[3];
    ins_gimu_increments(&scale, raw, INS_C(0.5), dtheta, dv);
    EXPECT_EQ(json(vec(dtheta)), json(Vec{2 * 1 * 0.5, 3 * 2 * 0.5, 5 * 4 * 0.5}));
    EXPECT_EQ(json(vec(dv)), json(Vec{7 * 8 * 0.5, 7 * 16 * 0.5, 7 * 32 * 0.5}));
}

TEST(gimu, order_of_the_coordinates)
{
    struct Case
    {
        uint32_t first, second;
        int has;
        int32_t lat, lon;
    };
    for (const Case& c :
         {Case{24300000, 121000000, 1, 245000000, 1210000000}, // 24 deg 30'
          Case{121000000, 24300000, 1, 245000000, 1210000000}, Case{90000000, 90000000, 1, 900000000, 900000000},
          Case{90000001, 90000001, 0, 0, 0}, Case{24000000, 23000000, 1, 240000000, 230000000}})
    {
        ins_gimu_t g;
        ins_gimu_init(&g, 1);
        Octets p = t1(3);
        for (const uint32_t v : {c.first, c.second})
        {
            for (int shift = 24; shift >= 0; shift -= 8)
            {
                p.push_back(static_cast<ins_octet_t>((v >> shift) & 0xFF));
            }
        }
        p.push_back(4);
        for (const ins_octet_t o : p)
        {
            EXPECT_EQ(ins_gimu_rx(&g, o), INS_GIMU_NOTHING) << "without the next header";
        }
        ASSERT_EQ(ins_gimu_flush(&g), INS_GIMU_T2);
        EXPECT_EQ(g.packet.has_position, c.has);
        EXPECT_EQ(g.packet.lat_e7, c.lat);
        EXPECT_EQ(g.packet.lon_e7, c.lon);
    }
}

/// Every length of window, of either type, with every octet next, both checks: sound, and the good packets after it are found.
TEST(gimu, every_state_with_every_octet)
{
    long cases = 0;
    for (const int strict : {0, 1})
    {
        for (const bool long_packet : {false, true})
        {
            Octets stream = long_packet ? t2(5) : t1(5);
            stream.push_back(0xAA);
            for (size_t length = 0; length <= stream.size(); length++)
            {
                for (unsigned octet = 0; octet < 256; octet++)
                {
                    ins_gimu_t g;
                    ins_gimu_init(&g, strict);
                    long octets = 0;
                    const auto put = [&](unsigned o)
                    {
                        const int type = ins_gimu_rx(&g, static_cast<ins_octet_t>(o));
                        expect_sound(g, ++octets);
                        return type;
                    };
                    for (size_t i = 0; i < length; i++)
                    {
                        put(stream[i]);
                    }
                    put(octet);
                    cases++;
                    unsigned good = 0;
                    for (unsigned n = 8; n < 14; n++)
                    {
                        for (const ins_octet_t o : n == 13 ? t2(n) : t1(n))
                        {
                            good += put(o) != INS_GIMU_NOTHING;
                        }
                    }
                    while (ins_gimu_flush(&g) != INS_GIMU_NOTHING)
                    {
                        good++;
                    }
                    ASSERT_GE(good, 5u) << "one packet at most is lost after octet " << octet << " at " << length;
                    ASSERT_EQ(g.packet.sats, 7);
                }
            }
        }
    }
    std::printf("[ figure   ] %ld states with an octet\n", cases);
}

TEST(gimu, random_octets)
{
    const unsigned seed = 19200;
    const long count = std::getenv("INS_BENCH") ? RANDOM_OCTETS_BENCH : RANDOM_OCTETS;
    std::printf("seed %u, %ld octets\n", seed, count);
    std::mt19937 random(seed);
    static const ins_octet_t likely[] = {0xAA, 0x55, 0x00, 0x01, 0x0F, 0x07, 0x1F, 0x20};
    ins_gimu_t g[2];
    ins_gimu_init(&g[0], 0);
    ins_gimu_init(&g[1], 1);
    Octets insert;
    for (long k = 1; k <= count; k++)
    {
        if (insert.empty() && random() % 64 == 0)
        {
            insert = random() % 2 ? t2(static_cast<unsigned>(k)) : t1(static_cast<unsigned>(k));
            insert.resize(1 + random() % insert.size());
        }
        ins_octet_t octet = static_cast<ins_octet_t>(random() % 3 ? likely[random() % 8] : random() % 256);
        if (!insert.empty())
        {
            octet = insert.front();
            insert.erase(insert.begin());
        }
        for (ins_gimu_t& machine : g)
        {
            ins_gimu_rx(&machine, octet);
            if (random() % 100 == 0)
            {
                ins_gimu_flush(&machine);
            }
            expect_sound(machine, k);
        }
        if (testing::Test::HasFatalFailure())
        {
            FAIL() << "at octet " << k;
        }
    }
    EXPECT_GT(g[1].t1, 0u);
    EXPECT_GT(g[1].t2, 0u);
    EXPECT_GT(g[0].t1 + g[0].t2, g[1].t1 + g[1].t2);
    std::printf("12-bit check: %u + %u packets, %u skipped; without: %u + %u, %u\n", g[1].t1, g[1].t2, g[1].skipped,
                g[0].t1, g[0].t2, g[0].skipped);
}

TEST(gimu, the_check_of_twelve_bits_is_exact)
{
    for (unsigned place = 2; place < INS_GIMU_T1_LEN; place += 2)
    {
        for (const unsigned high : {0x0Fu, 0x10u})
        {
            ins_gimu_t g;
            ins_gimu_init(&g, 1);
            Octets p = t1(1);
            p[place] = static_cast<ins_octet_t>(high);
            for (const ins_octet_t o : p)
            {
                EXPECT_EQ(ins_gimu_rx(&g, o), INS_GIMU_NOTHING);
            }
            EXPECT_EQ(ins_gimu_flush(&g), high == 0x0F ? INS_GIMU_T1 : INS_GIMU_NOTHING) << place;
        }
    }
}

TEST(gimu, a_short_rest_goes_on_waiting)
{
    ins_gimu_t g;
    ins_gimu_init(&g, 1);
    const Octets p = t1(9);
    for (size_t i = 0; i + 1 < p.size(); i++)
    {
        ins_gimu_rx(&g, p[i]);
    }
    EXPECT_EQ(ins_gimu_flush(&g), INS_GIMU_NOTHING);
    EXPECT_EQ(ins_gimu_rx(&g, p.back()), INS_GIMU_NOTHING);
    EXPECT_EQ(ins_gimu_flush(&g), INS_GIMU_T1);
    EXPECT_EQ(g.count, 0);
}
