/// \file   test_thesis_board.cpp
/// \brief  The thesis's firmware on the emulated DSP, GIMU and PC on its lines: calibration, turns, commands, disturbed lines.
/// SPDX-License-Identifier: MIT
#include "thesis_system.hpp"

namespace
{
constexpr double REST_S = 60;
constexpr uint16_t WDCR = 0x7029, WDCR_WDDIS = 0x0040;

gimu_config_t specimen()
{
    gimu_config_t c;
    gimu_thesis_config(&c);
    return c;
}

double largest_deg(const thesis::System& s)
{
    double worst = 0;
    for (const double a : s.angle)
    {
        worst = std::max(worst, std::fabs(a) / thesis::DEG);
    }
    return worst;
}

uint32_t bits(const thesis::System& s, uint32_t mask)
{
    return s.last.status & mask;
}
} // namespace

// 4.5.2 of the thesis: 8 to 10 degrees in 60 s without nulls, 1 to 2 with.
TEST(thesis_board, sixty_seconds_at_rest)
{
    double drift_deg[2];
    for (const bool nulls : {false, true})
    {
        thesis::System s(specimen(), nulls ? "lk" : "lkn");
        s.run(thesis::CALIBRATED_S + REST_S);
        drift_deg[nulls] = largest_deg(s);
        EXPECT_EQ(s.last.status, INS_NAV_BLOCK_ALIGNED + nulls * INS_NAV_BLOCK_FRACTION);
        EXPECT_EQ(s.input().counts.lost + s.input().counts.corrupt + s.input().counts.timeouts, 0u);
        EXPECT_NEAR(static_cast<double>(s.input().counts.accepted), (thesis::CALIBRATED_S + REST_S) * 6, 3);
        EXPECT_EQ(s.stats().starts, 1u) << "the watchdog is served";
        EXPECT_EQ(f2812_peek(s.device(), WDCR) & WDCR_WDDIS, 0) << "and on";
    }
    std::printf("[ figure   ] 60 s at rest: %.2f deg without nulls, %.2f with\n", drift_deg[0], drift_deg[1]);
    EXPECT_GT(drift_deg[0], 8);
    EXPECT_LT(drift_deg[0], 11);
    EXPECT_LT(drift_deg[1], 4);
}

TEST(thesis_board, a_turn_about_each_axis_is_seen)
{
    for (int axis = 0; axis < 3; axis++)
    {
        gimu_config_t c = specimen();
        c.motion_ctx = &axis;
        c.motion = [](void* ctx, int64_t t_ps, double rate[3], double f[3])
        {
            const double t = static_cast<double>(t_ps) * 1e-12;
            const bool turning = t >= thesis::CALIBRATED_S && t < thesis::CALIBRATED_S + 3;
            std::fill(rate, rate + 3, 0.0);
            std::fill(f, f + 3, 0.0);
            rate[*static_cast<const int*>(ctx)] = turning ? 30 * thesis::DEG : 0;
            f[2] = -9.8;
        };
        thesis::System s(c, "lk");
        s.run(thesis::CALIBRATED_S + 4);
        for (int i = 0; i < 3; i++)
        {
            EXPECT_NEAR(s.angle[static_cast<size_t>(i)] / thesis::DEG, i == axis ? 90 : 0, 1.5) << "axis " << axis;
        }
    }
}

TEST(thesis_board, a_cut_of_the_sensors_line_is_said_and_over_with_it)
{
    const double from = 5.03, to = 8.05; // in the middle of a packet, both
    thesis::System s(specimen(), "", {{static_cast<emu_time_t>(from * 1e12), static_cast<emu_time_t>(to * 1e12)}});
    int gaps = 0, after = 0;
    s.run(10,
          [&](const ins_nav_solution_t& x)
          {
              const bool gap = (x.status & INS_NAV_BLOCK_GAP) != 0;
              gaps += gap;
              after += x.t_s > to + 0.4 && !gap;
              EXPECT_FALSE(x.t_s > from + 0.2 && x.t_s < to - 0.1) << "no packet came at " << x.t_s;
          });
    EXPECT_EQ(gaps, 1);
    EXPECT_GT(after, 6);
    EXPECT_EQ(s.input().counts.lost, 0u);
}

TEST(thesis_board, noise_on_the_sensors_line_is_said)
{
    // Cuts of 200 us: bits of an octet turn to idle, now and then a stop bit's neighbour, and packets break.
    std::vector<emu_serial_cut_t> cuts;
    for (int k = 0; k < 200; k++)
    {
        const auto at = static_cast<emu_time_t>(1e12 + k * 20.137e9);
        cuts.push_back({at, at + 200 * EMU_PS_PER_US});
    }
    thesis::System s(specimen(), "", cuts);
    int disturbed = 0;
    s.run(8, [&](const ins_nav_solution_t& x)
          { disturbed += (x.status & (INS_NAV_BLOCK_LINE_ERROR | INS_NAV_BLOCK_GAP)) != 0; });
    EXPECT_GT(disturbed, 0);
    EXPECT_EQ(bits(s, INS_NAV_BLOCK_LINE_ERROR | INS_NAV_BLOCK_GAP), 0u) << "two seconds after the last";
}

TEST(thesis_board, the_pc_may_be_silent_and_then_commands)
{
    thesis::System s(specimen(), "");
    s.run(3);
    const uint64_t before = s.input().counts.accepted;
    s.mute = true;
    s.run(6);
    s.mute = false;
    s.run(8);
    EXPECT_GT(s.input().counts.accepted, before + 8) << "it goes on";
    EXPECT_EQ(bits(s, INS_NAV_BLOCK_FRACTION), static_cast<uint32_t>(INS_NAV_BLOCK_FRACTION));
    s.send("i");
    s.run(9);
    EXPECT_EQ(bits(s, INS_NAV_BLOCK_FRACTION | INS_NAV_BLOCK_INTEGER), static_cast<uint32_t>(INS_NAV_BLOCK_INTEGER));
    EXPECT_NE(bits(s, INS_NAV_BLOCK_FILTER), 0u);
    s.send("k");
    s.run(10);
    EXPECT_EQ(bits(s, INS_NAV_BLOCK_FILTER), 0u);
}

TEST(thesis_board, the_position_is_that_of_the_gps)
{
    gimu_config_t c = specimen();
    c.fix = [](void*, int64_t t_ps, gimu_fix_t* fix)
    {
        *fix = {};
        fix->of_ps = t_ps;
        fix->latitude = 24.983333 * thesis::DEG; // the example of figure 4.5
        fix->longitude = 120.205760 * thesis::DEG;
        fix->sats = 8;
        return true;
    };
    thesis::System s(c, "");
    s.run(thesis::CALIBRATED_S + 10);
    EXPECT_EQ(s.last.zone, 121u);
    EXPECT_NEAR(s.last.en_m[0], 169816.94, 1) << "TWD97 TM2, by Krueger's series in double";
    EXPECT_NEAR(s.last.en_m[1], 2764166.27, 1);
    EXPECT_NEAR(s.last.lat_lon_rad[0], 24.983333 * thesis::DEG, 2e-7);
    EXPECT_NEAR(s.last.lat_lon_rad[1], 120.205760 * thesis::DEG, 2e-7);
}

TEST(thesis_board, the_same_octets_from_run_to_run)
{
    std::string first;
    for (int run = 0; run < 2; run++)
    {
        thesis::System s(specimen(), "");
        s.run(5);
        EXPECT_GT(s.octets.size(), 25u * 30);
        EXPECT_TRUE(run == 0 || s.octets == first) << "they differ";
        first = s.octets;
    }
}
