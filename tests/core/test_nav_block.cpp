/// \file   test_nav_block.cpp
/// \brief  Navigation block: each field's octets by hand, there and back at every attitude, what is refused, over the handshake.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
#include <random>
using namespace core_test;

namespace
{
/// Half a step of 2^-23 in three components, and what that makes in the fourth: 2 sqrt(3) 2 2^-24. Float adds its own steps.
constexpr double TOL_ATTITUDE_RAD = INS_TOL(4.2e-7, 9e-7);
constexpr long ATTITUDES = 20000;
constexpr long ATTITUDES_BENCH = 5000000; ///< with INS_BENCH set
constexpr long RANDOM_BLOCKS = 100000;

using Block = std::array<ins_octet_t, INS_NAV_BLOCK_LEN>;

/// All fields distinct: 2009-07-28 near Hsinchu, heading south-west.
ins_nav_block_t example()
{
    ins_nav_block_t nav = {};
    nav.time_ms = 0x89ABCDEFu;
    nav.status = INS_NAV_BLOCK_ALIGNED | INS_NAV_BLOCK_FRACTION | INS_NAV_BLOCK_CLIPPED;
    nav.sats = 9;
    nav.fix_age = 3;
    nav.en_cm[0] = 24712345;
    nav.en_cm[1] = -276543210;
    nav.v_en[0] = INS_C(-1.5);
    nav.v_en[1] = INS_C(12.25);
    nav.q_nb[0] = INS_C(-0.5);
    nav.q_nb[1] = INS_C(0.5);
    nav.q_nb[2] = INS_C(-0.25);
    nav.q_nb[3] = static_cast<ins_real>(std::sqrt(1 - 0.5625));
    return nav;
}

Quat random_attitude(std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    Quat q;
    double n = 0;
    for (double& c : q)
    {
        c = normal(random);
        n += c * c;
    }
    for (double& c : q)
    {
        c /= std::sqrt(n);
    }
    return q;
}
} // namespace

TEST(nav_block, octets_of_each_field)
{
    const ins_nav_block_t nav = example();
    Block b;
    ASSERT_EQ(ins_nav_block_put(&nav, b.data()), INS_OK);
    const Block want = {0x07, 9,    0x04, 0x05,                         // version 1, component 3 left out
                        0x89, 0xAB, 0xCD, 0xEF,                         // ms
                        0x01, 0x79, 0x14, 0x99, 0xEF, 0x84, 0x49, 0x16, // cm
                        0xFF, 0xFA, 0x24, 0x00, 0x2F, 0xDA,             // mm/s: -1500, 12250
                        0xC0, 0x00, 0x00, 0x40, 0x00, 0x00, 0xE0, 0x00, 0x00, 3};
    for (size_t i = 0; i < b.size(); i++)
    {
        EXPECT_EQ(static_cast<unsigned>(b[i]), static_cast<unsigned>(want[i])) << "octet " << i;
    }
    ins_nav_block_t back;
    ASSERT_EQ(ins_nav_block_get(b.data(), &back), INS_OK);
    EXPECT_EQ(back.time_ms, nav.time_ms);
    EXPECT_EQ(back.status, nav.status);
    EXPECT_EQ(back.sats, nav.sats);
    EXPECT_EQ(back.fix_age, nav.fix_age);
    EXPECT_EQ(back.en_cm[0], nav.en_cm[0]);
    EXPECT_EQ(back.en_cm[1], nav.en_cm[1]);
    EXPECT_EQ(back.v_en[0], nav.v_en[0]);
    EXPECT_EQ(back.v_en[1], nav.v_en[1]);
    EXPECT_LE(angle_between(quat(back.q_nb), quat(nav.q_nb)), TOL_ATTITUDE_RAD);
}

TEST(nav_block, every_attitude_comes_back)
{
    const long count = std::getenv("INS_BENCH") ? ATTITUDES_BENCH : ATTITUDES;
    std::mt19937_64 random(2009);
    std::array<long, 4> left_out = {};
    double worst = 0;
    for (long k = 0; k < count; k++)
    {
        const Quat q = random_attitude(random);
        ins_nav_block_t nav = {};
        const auto narrow = real(q);
        std::copy(narrow.begin(), narrow.end(), nav.q_nb);
        Block b;
        ins_nav_block_t back;
        ASSERT_EQ(ins_nav_block_put(&nav, b.data()), INS_OK);
        ASSERT_EQ(ins_nav_block_get(b.data(), &back), INS_OK);
        worst = larger(worst, angle_between(quat(back.q_nb), q));
        left_out[b[0] & 3u]++;
    }
    std::printf("[ figure   ] attitude there and back: %.2e rad\n", worst);
    EXPECT_LE(worst, TOL_ATTITUDE_RAD);
    for (const long n : left_out)
    {
        EXPECT_GT(n, count / 5) << "each component is the largest in a quarter of all attitudes";
    }
}

TEST(nav_block, ends_of_the_scales)
{
    ins_nav_block_t nav = example();
    nav.en_cm[0] = INT32_MIN;
    nav.en_cm[1] = INT32_MAX;
    nav.v_en[0] = -INS_NAV_BLOCK_V_MAX;
    nav.v_en[1] = INS_NAV_BLOCK_V_MAX;
    nav.status = INS_NAV_BLOCK_STATUS_ALL;
    Block b;
    ins_nav_block_t back;
    ASSERT_EQ(ins_nav_block_put(&nav, b.data()), INS_OK);
    ASSERT_EQ(ins_nav_block_get(b.data(), &back), INS_OK);
    EXPECT_EQ(back.en_cm[0], INT32_MIN);
    EXPECT_EQ(back.en_cm[1], INT32_MAX);
    EXPECT_EQ(back.v_en[0], nav.v_en[0]);
    EXPECT_EQ(back.v_en[1], nav.v_en[1]);
    EXPECT_EQ(back.status, INS_NAV_BLOCK_STATUS_ALL);
    EXPECT_EQ(b[0] & 0xF0u, 0u);
    EXPECT_EQ(b[2] & 0xF0u, 0u);
}

TEST(nav_block, what_is_refused_changes_nothing)
{
    const ins_real nan = static_cast<ins_real>(std::nan(""));
    const std::vector<std::function<void(ins_nav_block_t&)>> bad = {
        [&](ins_nav_block_t& n) { n.v_en[0] = nan; },          [&](ins_nav_block_t& n) { n.v_en[1] = nan; },
        [](ins_nav_block_t& n) { n.v_en[0] = INS_C(8389.0); }, [](ins_nav_block_t& n) { n.v_en[1] = INS_C(-8389.0); },
        [&](ins_nav_block_t& n) { n.q_nb[2] = nan; },          [](ins_nav_block_t& n) { n.q_nb[3] = INS_C(0.7); },
        [](ins_nav_block_t& n) { n.status = 0x800; },
    };
    for (size_t k = 0; k < bad.size(); k++)
    {
        ins_nav_block_t nav = example();
        bad[k](nav);
        Block b;
        b.fill(0x5A);
        EXPECT_EQ(ins_nav_block_put(&nav, b.data()), INS_E_RANGE) << "case " << k;
        EXPECT_EQ(
            b, (Block{0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A,
                      0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A, 0x5A}))
            << "case " << k;
    }
    const ins_nav_block_t nav = example();
    Block right;
    ASSERT_EQ(ins_nav_block_put(&nav, right.data()), INS_OK);
    const std::vector<std::pair<size_t, unsigned>> octets = {{0, 0x0B}, {0, 0x17}, {2, 0x14}, {2, 0x0C}, {22, 0x80}};
    for (const auto& [at, octet] : octets)
    {
        Block b = right;
        b[at] = static_cast<ins_octet_t>(octet);
        ins_nav_block_t back = {};
        back.time_ms = 7;
        EXPECT_EQ(ins_nav_block_get(b.data(), &back), INS_E_RANGE) << "octet " << at << " = " << octet;
        EXPECT_EQ(back.time_ms, 7u);
    }
}

TEST(nav_block, what_is_taken_is_a_unit_quaternion_and_goes_out_the_same)
{
    std::mt19937_64 random(4);
    long taken = 0;
    for (long k = 0; k < RANDOM_BLOCKS; k++)
    {
        Block b;
        for (ins_octet_t& o : b)
        {
            o = static_cast<ins_octet_t>(random() & 0xFFu);
        }
        b[0] &= 0x07u;
        b[0] |= 0x04u;
        b[2] &= 0x07u;
        ins_nav_block_t nav;
        if (ins_nav_block_get(b.data(), &nav) != INS_OK)
        {
            continue;
        }
        taken++;
        const Quat q = quat(nav.q_nb);
        ASSERT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1.0, INS_TOL(1e-12, 3e-7)) << "block " << k;
    }
    EXPECT_GT(taken, RANDOM_BLOCKS / 10);
}

TEST(nav_block, over_the_handshake_with_its_number)
{
    ins_hs_config_t cfg = {INS_NAV_BLOCK_LEN, 1, 3, 100, 30};
    ins_hs_board_t board;
    ins_hs_host_t host;
    ASSERT_EQ(ins_hs_board_init(&board, &cfg), INS_OK);
    ASSERT_EQ(ins_hs_host_init(&host, &cfg), INS_OK);
    for (unsigned seq = 0; seq < 512; seq++)
    {
        ins_nav_block_t nav = example();
        nav.status = static_cast<uint16_t>(seq & INS_NAV_BLOCK_STATUS_ALL);
        nav.time_ms = 167 * seq;
        Block b;
        ASSERT_EQ(ins_nav_block_put(&nav, b.data()), INS_OK);
        ASSERT_EQ(ins_hs_board_offer(&board, b.data(), static_cast<uint_least8_t>(seq & 0xFFu), 0), INS_OK);
        int event = INS_HS_NOTHING;
        for (int16_t octet; (octet = ins_hs_board_tx(&board, 0)) >= 0;)
        {
            int16_t reply;
            event = ins_hs_host_rx(&host, static_cast<ins_octet_t>(octet), 0, &reply);
            if (reply >= 0)
            {
                ins_hs_board_rx(&board, static_cast<ins_octet_t>(reply), 0);
            }
        }
        ASSERT_EQ(event, INS_HS_BLOCK);
        EXPECT_EQ(host.seq, seq & 0xFFu);
        ins_nav_block_t back;
        ASSERT_EQ(ins_nav_block_get(host.block, &back), INS_OK);
        EXPECT_EQ(back.time_ms, nav.time_ms);
        EXPECT_EQ(back.status, nav.status);
    }
}
