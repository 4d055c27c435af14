/// What the TLC2543 asks of its clock and DATA IN, and the choices where the data sheet at hand is silent.
/// SPDX-License-Identifier: MIT
#include "tlc2543_rig.hpp"

namespace
{
TEST_F(tlc2543, a_clock_faster_than_4_1_mhz_is_reported)
{
    adc.set(adc_t::kIn, false);
    for (const emu_time_t period : {243902, 243901, 100000})
    {
        adc.select();
        for (unsigned i = 0; i < 12; i++)
        {
            adc.set(adc_t::kClock, true);
            adc.wait(period / 2);
            adc.set(adc_t::kClock, false);
            adc.wait(period - period / 2);
        }
        adc.deselect();
        EXPECT_EQ(expect_guest("4.1 MHz"), period == 243902 ? 0u : period == 243901 ? 11u : 22u) << period << " ps";
    }
    EXPECT_EQ(adc.guest.size(), 22u) << "and nothing else";
    EXPECT_EQ(adc.samples.size(), 3u) << "it converts all the same";
}

TEST_F(tlc2543, data_in_has_to_be_stable_before_the_clock_rises)
{
    const auto clock_after = [this](emu_time_t stable)
    {
        adc.select();
        for (unsigned i = 0; i < 12; i++)
        {
            adc.set(adc_t::kIn, i == 3); // rises and falls once: bits 3 and 4
            adc.wait(stable);
            adc.set(adc_t::kClock, true);
            adc.wait(kUs);
            adc.set(adc_t::kClock, false);
            adc.wait(kUs);
        }
        adc.deselect();
        return expect_guest("100 ns before");
    };
    adc.set(adc_t::kIn, false);
    adc.wait(kUs);
    EXPECT_EQ(clock_after(100000), 0u);
    EXPECT_EQ(clock_after(99999), 2u);
    EXPECT_EQ(clock_after(0), 4u) << "one write to the port for both";
    EXPECT_EQ(adc.samples.back().channel, 1u) << "the new level counts all the same";
}

TEST_F(tlc2543, data_in_has_to_stay_while_the_clock_rises)
{
    const auto change_after = [this](emu_time_t held)
    {
        adc.set(adc_t::kIn, false);
        adc.select();
        for (unsigned i = 0; i < 12; i++)
        {
            adc.set(adc_t::kClock, true);
            adc.wait(held);
            adc.set(adc_t::kIn, i == 2);
            adc.wait(kUs);
            adc.set(adc_t::kClock, false);
            adc.wait(kUs);
        }
        adc.deselect();
        return expect_guest("as I/O CLOCK rose");
    };
    EXPECT_EQ(change_after(0), 2u) << "one write to the port, the clock first";
    EXPECT_EQ(adc.samples.back().channel, 1u) << "the old level counts: bit 3 of the address";
    EXPECT_EQ(change_after(1), 2u) << "after it: good, with a hold time of 0";
    tlc2543_destroy(adc.chip);
    adc.chip = nullptr;
    adc.config.t_hold = 50000;
    adc.start();
    EXPECT_EQ(change_after(50000), 4u);
    EXPECT_EQ(change_after(50001), 4u);
}

/// What is not in the data sheet at hand: the default, and the other choice.
struct tlc2543_choices : testing::Test
{
    /// A transfer of 12 bits each. \return the words read.
    std::vector<unsigned> words(std::initializer_list<unsigned> commands)
    {
        adc.fixed[2] = 0x345 * kLsb;
        adc.start();
        std::vector<unsigned> read;
        for (const unsigned command : commands)
        {
            read.push_back(adc.transfer(12, command));
        }
        return read;
    }
    adc_t adc;
};

TEST_F(tlc2543_choices, what_is_read_at_power_up)
{
    adc.config.power_up_code = 0x0F1;
    EXPECT_EQ(words({0x20, 0x20}), (std::vector<unsigned>{0x0F1, 0x345}));
}

TEST_F(tlc2543_choices, the_first_results_after_power_up_may_be_lost)
{
    adc.config.power_up_lost = 2;
    EXPECT_EQ(words({0x20, 0x20, 0x20, 0x20}), (std::vector<unsigned>{kPowerUp, kPowerUp, kPowerUp, 0x345}));
}

TEST_F(tlc2543_choices, results_after_a_power_down_may_be_lost)
{
    adc.config.wake_lost = 1;
    EXPECT_EQ(words({0x20, 0x20, 0xE0, 0x20, 0x20, 0x20}),
              (std::vector<unsigned>{kPowerUp, 0x345, 0x345, 0x345, kPowerUp, 0x345}));
}

TEST_F(tlc2543_choices, an_early_cs_may_lose_the_result)
{
    adc.config.early_cs_loses_result = true;
    (void)words({0x20});
    EXPECT_EQ(adc.transfer(5, 0x20), 0x345u >> 7);
    EXPECT_EQ(adc.transfer(12, 0x20), 0u);
    EXPECT_EQ(adc.transfer(12, 0x20), 0x345u);
    EXPECT_EQ(adc.guest.size(), 1u);
}

TEST_F(tlc2543_choices, the_low_bits_of_sixteen_may_be_ones)
{
    adc.config.pad = 0xF;
    (void)words({0x20});
    EXPECT_EQ(adc.transfer(16, 0x2C), 0x3450u) << "a 12-bit word, then zeros";
    EXPECT_EQ(adc.transfer(16, 0x2C), 0x345Fu);
}
} // namespace
