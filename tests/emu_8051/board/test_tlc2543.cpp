/// The TLC2543 at its edges: one test for each line of the table at the top of parts/tlc2543.c.
/// SPDX-License-Identifier: MIT
#include "tlc2543_rig.hpp"
#include <cmath>

namespace
{
TEST_F(tlc2543, gives_the_result_of_the_transfer_before)
{
    EXPECT_EQ(adc.transfer(12, 0x00), kPowerUp);
    for (unsigned ch = 1; ch <= 11; ch++)
    {
        EXPECT_EQ(adc.transfer(12, (ch % 11) << 4), 0x123 + 0x111 * (ch - 1)) << "channel " << ch - 1;
    }
    ASSERT_EQ(adc.samples.size(), 12u);
    EXPECT_EQ(adc.samples[7].channel, 7u);
    EXPECT_EQ(adc.samples[7].code, 0x123 + 0x777);
}

TEST_F(tlc2543, self_test_channels)
{
    adc.transfer(12, 0xB0);
    EXPECT_EQ(adc.transfer(12, 0xC0), 2048u);
    EXPECT_EQ(adc.transfer(12, 0xD0), 0u);
    EXPECT_EQ(adc.transfer(12, 0x00), 4095u);
    EXPECT_EQ(adc.samples[0].channel, 11u);
    EXPECT_EQ(adc.samples[0].volts, 2.5);
}

TEST_F(tlc2543, eight_twelve_and_sixteen_bits)
{
    adc.transfer(8, 0x14); // code 0x234
    EXPECT_EQ(adc.transfer(8, 0x14), 0x23u);
    EXPECT_EQ(adc.transfer(16, 0x1C), 0x2300u) << "8-bit word, then zeros";
    EXPECT_EQ(adc.transfer(16, 0x1C), 0x2340u);
    EXPECT_EQ(adc.transfer(12, 0x10), 0x234u) << "the length is that of the current transfer";
    EXPECT_EQ(adc.transfer(12, 0x18), 0x234u) << "x0 is 12 bits";
    EXPECT_EQ(adc.transfer(8, 0x14), 0x23u) << "12-bit word, upper 8";
}

TEST_F(tlc2543, lsb_first_and_bipolar_belong_to_the_next_word)
{
    const auto flipped = [](unsigned x, unsigned bits)
    {
        unsigned y = 0;
        for (unsigned i = 0; i < bits; i++)
        {
            y = y << 1 | (x >> i & 1u);
        }
        return y;
    };
    adc.transfer(12, 0x12);
    EXPECT_EQ(adc.transfer(16, 0x1E), flipped(0x234, 12) << 4);
    EXPECT_EQ(adc.transfer(8, 0x16), flipped(0x2340, 16) >> 8) << "16 bits LSB first: four zeros lead";
    EXPECT_EQ(adc.transfer(12, 0x11), flipped(0x23, 8) << 4);
    EXPECT_EQ(adc.transfer(12, 0xB1), 0x234u ^ 0x800u);
    EXPECT_EQ(adc.transfer(12, 0xC1), 0u) << "mid-scale is zero";
    EXPECT_EQ(adc.transfer(12, 0xD1), 0x800u);
    EXPECT_EQ(adc.transfer(12, 0x00), 0x7FFu);
    EXPECT_EQ(adc.samples[3].code, 0x234) << "the sample itself is told in straight binary";
}

TEST_F(tlc2543, codes_are_centred_and_clamped)
{
    const struct
    {
        double lsb;
        unsigned code;
    } rows[] = {{-1.0, 0},        {0.499, 0},     {0.501, 1},     {1.499, 1}, {2047.6, 2048}, {4094.499, 4094},
                {4094.501, 4095}, {4095.7, 4095}, {5000.0, 4095}, {-1e9, 0},  {1e9, 4095}};
    for (const auto& r : rows)
    {
        adc.fixed[0] = r.lsb * kLsb;
        adc.transfer(12, 0x00);
        EXPECT_EQ(adc.transfer(12, 0x00), r.code) << r.lsb << " LSB";
    }
}

TEST(tlc2543_errors, offset_and_gain_shift_the_transfer)
{
    adc_t adc;
    adc.config.offset_lsb = 1.5;
    adc.config.gain_lsb = -2.0;
    adc.config.ref_minus_v = 1.0;
    adc.config.ref_plus_v = 3.0;
    adc.start();
    const double lsb = 2.0 / 4096;
    for (const auto& [at, want] : {std::pair{0.0, 2u}, {2048.0, 2049u}, {4000.0, 4000u}})
    {
        adc.fixed[3] = 1.0 + at * lsb;
        adc.transfer(12, 0x30);
        EXPECT_EQ(adc.transfer(12, 0x30), want) << at; // +1.5 - 2 at / 4096, rounded
    }
}

TEST_F(tlc2543, samples_at_the_last_falling_edge)
{
    adc.fixed[0] = 1.0;
    adc.slope = 1e-9; // 1 mV/us
    for (const unsigned n : {8u, 12u, 16u})
    {
        adc.select();
        adc.clocks(n, n == 8 ? 0x04 : n == 12 ? 0x00 : 0x0C);
        const emu_time_t last_fall = adc.sched.now;
        ASSERT_FALSE(adc.samples.empty());
        EXPECT_EQ(adc.samples.back().at, last_fall);
        EXPECT_EQ(adc.samples.back().volts, 1.0 + 1e-9 * static_cast<double>(last_fall));
        EXPECT_EQ(adc.samples.back().code, std::floor(adc.samples.back().volts / kLsb + 0.5));
        adc.wait(kUs);
        adc.deselect();
    }
}

TEST_F(tlc2543, eoc_falls_after_its_delay_and_rises_after_the_conversion)
{
    std::vector<std::pair<bool, emu_time_t>> edges;
    emu_wire_watch(
        &adc.w[adc_t::kEoc],
        [](void* ctx, bool level, emu_time_t at)
        { static_cast<std::vector<std::pair<bool, emu_time_t>>*>(ctx)->emplace_back(level, at); },
        &edges);
    adc.select();
    adc.clocks(12, 0x00);
    const emu_time_t t = adc.sched.now;
    adc.wait(20 * kUs);
    EXPECT_EQ(edges, (decltype(edges){{false, t + 1500000}, {true, t + 9500000}}));
}

TEST_F(tlc2543, data_out_is_driven_only_while_selected)
{
    const emu_wire_t& out = adc.w[adc_t::kOut];
    EXPECT_TRUE(out.floating);
    adc.set(adc_t::kCs, false);
    adc.wait(699999);
    EXPECT_TRUE(out.floating) << "0.7 us from /CS low to driven";
    adc.wait(1);
    EXPECT_FALSE(out.floating);
    EXPECT_TRUE(out.level) << "first bit of A5A";
    adc.wait(kUs);
    adc.clocks(1, 0);
    EXPECT_FALSE(out.level) << "next bit on the falling edge";
    adc.clocks(1, 0);
    EXPECT_TRUE(out.level);
    adc.clocks(10, 0);
    EXPECT_FALSE(out.level || out.floating) << "low while it converts";
    adc.set(adc_t::kCs, true);
    EXPECT_TRUE(out.floating);
    adc.wait(20 * kUs);
    adc.set(adc_t::kCs, false);
    adc.wait(500000);
    adc.set(adc_t::kCs, true);
    adc.wait(kUs);
    EXPECT_TRUE(out.floating) << "deselected before it drove";
}

TEST_F(tlc2543, runs_with_cs_held_low)
{
    adc.select();
    EXPECT_EQ(adc.clocks(12, 0x00), kPowerUp);
    adc.wait(20 * kUs);
    EXPECT_EQ(adc.clocks(12, 0x10), 0x123u);
    adc.wait(20 * kUs);
    EXPECT_EQ(adc.clocks(12, 0x20), 0x234u);
}

TEST_F(tlc2543, clocks_with_cs_high_do_nothing)
{
    adc.transfer(12, 0x40);
    adc.clocks(7, 0xFF);
    EXPECT_EQ(adc.transfer(12, 0x00), 0x123u + 0x444u);
}

TEST_F(tlc2543, cs_falling_soon_after_the_last_clock_aborts)
{
    adc.transfer(12, 0x00);
    adc.select();
    EXPECT_EQ(adc.clocks(12, 0x50), 0x123u);
    adc.wait(kUs);
    adc.set(adc_t::kCs, true);
    adc.wait(3 * kUs);
    EXPECT_FALSE(adc.w[adc_t::kEoc].level);
    adc.select(); // 4 us after the last falling edge
    EXPECT_TRUE(adc.w[adc_t::kEoc].level);
    EXPECT_EQ(adc.clocks(12, 0x60), 0x123u) << "the previous result stays";
    adc.wait(kUs);
    adc.set(adc_t::kCs, true);
    adc.wait(5 * kUs);
    adc.select(); // 6 us: too late, the conversion runs on
    EXPECT_FALSE(adc.w[adc_t::kEoc].level);
    adc.wait(20 * kUs);
    EXPECT_EQ(adc.clocks(12, 0x00), 0x123u + 0x666u);
}

TEST_F(tlc2543, clocks_during_a_conversion_are_reported_and_ignored)
{
    adc.transfer(12, 0x70);
    adc.select();
    adc.clocks(12, 0x80);
    adc.clocks(3, 0xFF);
    adc.wait(20 * kUs);
    EXPECT_EQ(adc.clocks(12, 0x00), 0x123u + 0x888u);
    EXPECT_EQ(expect_guest("during a conversion"), 3u);
}

TEST_F(tlc2543, cs_rising_inside_a_transfer_is_reported_and_converts_nothing)
{
    adc.transfer(12, 0x90);
    EXPECT_EQ(adc.transfer(5, 0x10), (0x123u + 0x999u) >> 7);
    EXPECT_EQ(adc.transfer(11, 0x10), (0x123u + 0x999u) >> 1) << "one clock too few";
    EXPECT_EQ(adc.samples.size(), 1u);
    EXPECT_EQ(adc.transfer(12, 0x00), 0x123u + 0x999u) << "the previous result stays";
    EXPECT_EQ(expect_guest("inside a transfer"), 2u);
}

TEST_F(tlc2543, a_clock_too_soon_after_cs_is_reported)
{
    adc.set(adc_t::kCs, false);
    adc.clocks(12, 0x00); // first rise 1 us after /CS
    adc.wait(kUs);
    adc.deselect();
    EXPECT_EQ(expect_guest("1.425 us"), 1u);
}

TEST_F(tlc2543, power_down_converts_nothing_and_a_valid_address_wakes)
{
    adc.transfer(12, 0x20);
    EXPECT_EQ(adc.transfer(12, 0xE0), 0x123u + 0x222u);
    EXPECT_TRUE(adc.w[adc_t::kEoc].level);
    EXPECT_EQ(adc.samples.size(), 1u);
    EXPECT_EQ(adc.transfer(12, 0x30), 0x123u + 0x222u);
    EXPECT_EQ(adc.transfer(12, 0x00), 0x123u + 0x333u);
}

TEST_F(tlc2543, address_15_is_reported)
{
    adc.transfer(12, 0xF0);
    EXPECT_EQ(adc.transfer(12, 0x00), 0u);
    EXPECT_EQ(adc.samples.size(), 1u);
    EXPECT_EQ(expect_guest("1111"), 1u);
}

TEST(tlc2543_errors, not_a_number_is_said_and_bad_arguments_are_refused)
{
    adc_t adc;
    adc.start();
    adc.fixed[2] = std::nan("");
    adc.transfer(12, 0x20);
    EXPECT_EQ(adc.transfer(12, 0x00), 0u);
    EXPECT_EQ(adc.gap.size(), 1u);
    tlc2543_config_t bad = adc.config;
    bad.ref_plus_v = bad.ref_minus_v;
    emu_wire_t* const w = adc.w;
    EXPECT_EQ(tlc2543_create(&bad, &adc.sched, w, w + 1, w + 2, w + 3, w + 4), nullptr);
    while (emu_wire_add_driver(&w[adc_t::kOut]) >= 0)
    {
    }
    EXPECT_EQ(tlc2543_create(&adc.config, &adc.sched, w, w + 1, w + 2, w + 3, w + 4), nullptr);
}
} // namespace
