/// The acquisition firmware on its board, without faults: pacing, scan, block, ages, memory.
/// SPDX-License-Identifier: MIT
#include "acq_rig.hpp"
#include "acq_timing.h"
#include <algorithm>
#include <cstdio>

namespace
{
constexpr size_t kScans = 300;
constexpr unsigned kFlash = 4096, kRam = 128;
constexpr uint8_t kSp = 0x81, kPcon = 0x87, kUntouched = 0xA5;

struct image_t
{
    const char* name;
    uint64_t period_cycles;
    double baud;
    uint8_t block_len, seq;
    double exchange_ms_max; ///< start of AA to end of 00
    unsigned channels = 3;
};

void PrintTo(const image_t& image, std::ostream* out)
{
    *out << image.name;
}

rig_config_t config_of(const image_t& image)
{
    rig_config_t config;
    config.image = image.name;
    config.baud = image.baud;
    config.block_len = image.block_len;
    config.seq = image.seq;
    config.channels = image.channels;
    return config;
}

double ms_of(const image_t& image, double scans)
{
    return static_cast<double>(image.period_cycles) * scans * 1e3 / kCyclesPerSecond;
}

/// Three slow ramps in opposite directions, all over the converter's span.
double ramps(unsigned channel, int64_t t)
{
    const double s = static_cast<double>(t) * 1e-12;
    return channel == 0 ? 0.1 + 0.2 * s : channel == 1 ? 4.9 - 0.2 * s : 0.5 * channel + 0.15 * s;
}

class acq_image : public testing::TestWithParam<image_t>
{
};

TEST_P(acq_image, samples_at_exactly_its_period)
{
    acq_rig_t rig(config_of(GetParam()));
    rig.run_to_ms(ms_of(GetParam(), kScans + 2));
    ASSERT_GT(rig.samples.size(), (GetParam().channels + 1) * kScans);
    for (size_t k = 1; k <= kScans; k++)
    {
        const uint64_t step = rig.cycle(rig.sample(k, 0).at) - rig.cycle(rig.sample(k - 1, 0).at);
        ASSERT_EQ(step, GetParam().period_cycles) << "scan " << k;
    }
}

TEST_P(acq_image, scans_its_channels_with_the_published_skew)
{
    static const uint64_t skew[] = {
        0, ACQ_SKEW_Y_CYCLES, ACQ_SKEW_Z_CYCLES, ACQ_SKEW_3_CYCLES, ACQ_SKEW_4_CYCLES, ACQ_SKEW_5_CYCLES};
    const unsigned channels = GetParam().channels;
    acq_rig_t rig(config_of(GetParam()));
    rig.run_to_ms(ms_of(GetParam(), kScans + 2));
    for (size_t k = 0; k < kScans; k++)
    {
        const uint64_t x = rig.cycle(rig.sample(k, 0).at);
        for (unsigned transfer = 0; transfer <= channels; transfer++)
        {
            ASSERT_EQ(rig.sample(k, transfer).channel, transfer % channels) << "scan " << k;
        }
        for (unsigned channel = 1; channel < channels; channel++)
        {
            ASSERT_EQ(rig.cycle(rig.sample(k, channel).at) - x, skew[channel]) << "scan " << k << ", " << channel;
        }
    }
    EXPECT_EQ(rig.u8("_adc_timeouts"), 0u);
    EXPECT_TRUE(rig.reports.empty()) << rig.reports.front();
}

TEST_P(acq_image, hands_over_every_sample_of_its_own_scan_in_time)
{
    rig_config_t config = config_of(GetParam());
    config.volts = ramps;
    acq_rig_t rig(config);
    rig.run_to_ms(ms_of(GetParam(), kScans + 1.9));
    ASSERT_GE(rig.blocks.size(), kScans);
    double age_max = 0.0, exchange_max = 0.0;
    for (size_t k = 0; k < kScans; k++)
    {
        const block_t& b = rig.blocks[k];
        for (unsigned channel = 0; channel < GetParam().channels; channel++)
        {
            ASSERT_EQ(b.codes[channel], rig.sample(k, channel).code) << "scan " << k << ", channel " << channel;
        }
        ASSERT_EQ(b.seq, config.seq ? (k + 1) % 256 : 0u);
        ASSERT_EQ(b.gap, 0u);
        for (size_t i = 2 * GetParam().channels; i < b.octets.size(); i++)
        {
            ASSERT_EQ(b.octets[i], 0u) << "octets after the last channel's are zero";
        }
        const double bit_ms = 1e3 / config.baud;
        age_max = std::max(age_max, static_cast<double>(b.at - rig.sample(k, 0).at) * 1e-9);
        exchange_max = std::max(exchange_max, static_cast<double>(b.at - rig.request_at[k]) * 1e-9 + 19.5625 * bit_ms);
    }
    std::printf("%s: exchange %.3f ms at most, age of X when its block is accepted %.3f ms at most\n", GetParam().name,
                exchange_max, age_max);
    EXPECT_LT(exchange_max, GetParam().exchange_ms_max);
    EXPECT_LT(age_max, ms_of(GetParam(), 1));
    EXPECT_EQ(rig.blocks.size(), rig.host.accepted);
    EXPECT_EQ(rig.host.corrupt + rig.host.timeouts + rig.host.stray + rig.host.duplicates, 0u);
    EXPECT_EQ(rig.lost() + rig.given_up() + rig.resent(), 0u);
    EXPECT_LE(rig.sampled() - rig.sent(), 1u);
}

TEST_P(acq_image, fits_flash_and_ram)
{
    std::ifstream in(std::string(INS_FIRMWARE_DIR "/") + GetParam().name + ".mem");
    std::string line;
    unsigned flash = 0, stack = 0;
    while (std::getline(in, line))
    {
        std::sscanf(line.c_str(), " ROM/EPROM/FLASH %*x %*x %u", &flash);
        std::sscanf(line.c_str(), "Stack starts at: 0x%x", &stack);
    }
    acq_rig_t rig(config_of(GetParam()));
    double ms = ms_of(GetParam(), 1.2);
    do
    {
        rig.run_to_ms(ms += 0.01);
    } while ((mcs51_sfr(rig.cpu, kPcon) & 1u) == 0); // idle: the stack is that of main alone
    for (unsigned a = mcs51_sfr(rig.cpu, kSp) + 1u; a < kRam; a++)
    {
        mcs51_set_iram(rig.cpu, static_cast<uint8_t>(a), kUntouched);
    }
    rig.silent = true;
    rig.run_to_ms(ms_of(GetParam(), kScans / 2));
    rig.silent = false;
    rig.run_to_ms(ms_of(GetParam(), kScans));
    unsigned top = kRam;
    while (mcs51_iram(rig.cpu, static_cast<uint8_t>(top - 1)) == kUntouched)
    {
        top--;
    }
    std::printf("%s: flash %u of %u octets, RAM %u + stack %u used of %u\n", GetParam().name, flash, kFlash, stack,
                top - stack, kRam);
    EXPECT_GT(flash, 1000u);
    EXPECT_LE(flash, kFlash);
    EXPECT_GT(stack, 32u);
    EXPECT_LE(top, kRam - 4) << "four octets of stack to spare at least";
}

INSTANTIATE_TEST_SUITE_P(images, acq_image,
                         testing::Values(image_t{"acq_default", 18432, 9600.0, 6, 1, 10.9},
                                         image_t{"acq_s3_paper", 73728, 9600.0, 6, 0, 10.9},
                                         image_t{"acq_80ms_seq", 73728, 9600.0, 6, 1, 10.9},
                                         image_t{"acq_57600", 9216, 57600.0, 6, 1, 4.0},
                                         image_t{"acq_six", 9216, 57600.0, 12, 1, 6.0, 6},
                                         image_t{"test_block14", 23040, 19200.0, 14, 0, 10.5}),
                         [](const auto& p) { return std::string(p.param.name); });

/// A step just before each scan: every value of the block knows it.
TEST(acq_board, no_value_is_older_than_its_scan)
{
    rig_config_t config;
    config.image = "acq_80ms_seq";
    config.volts = [](unsigned, int64_t t)
    {
        const double scans = static_cast<double>(t) * 1e-12 / 0.08; // X of scan k is sampled at 1.017 + k
        return (100.0 * std::floor(scans) + 50.0) * kLsb;
    };
    acq_rig_t rig(config);
    rig.run_to_ms(80.0 * 40);
    ASSERT_GT(rig.blocks.size(), 30u);
    for (size_t k = 0; k < rig.blocks.size(); k++)
    {
        for (const unsigned code : rig.blocks[k].codes)
        {
            ASSERT_EQ(code, 100 * (k + 1) + 50) << "scan " << k;
        }
    }
}

TEST(acq_board, a_wrong_crystal_shows_on_the_line)
{
    rig_config_t config;
    config.crystal_hz = 12000000; // 10,417 Bd
    acq_rig_t rig(config);
    rig.run_to_ms(1000.0);
    EXPECT_EQ(rig.sampled(), 54u) << "18432 cycles of 1 us";
    EXPECT_EQ(rig.host.accepted + rig.sent(), 0u);
    EXPECT_GT(rig.host.stray + rig.end.framing_errors, 50u);
    EXPECT_GT(rig.given_up(), 20u);
}

TEST(acq_board, names_its_wires_and_refuses_a_bad_config)
{
    emu_sched_t sched;
    emu_sched_init(&sched);
    acq_board_config_t config;
    acq_board_default_config(&config);
    acq_board_t* const board = acq_board_create(&config, &sched);
    ASSERT_NE(board, nullptr);
    for (const char* name : {"EOC", "I/O CLOCK", "DATA IN", "DATA OUT", "/CS", "TXD", "RXD"})
    {
        ASSERT_NE(acq_board_wire(board, name), nullptr) << name;
        EXPECT_STREQ(acq_board_wire(board, name)->name, name);
        EXPECT_TRUE(acq_board_wire(board, name)->level) << name << " after reset";
    }
    EXPECT_EQ(acq_board_wire(board, "SDA"), nullptr);
    acq_board_destroy(board);
    config.crystal_hz = 0;
    EXPECT_EQ(acq_board_create(&config, &sched), nullptr);
    acq_board_default_config(&config);
    config.adc.ref_plus_v = -1.0;
    EXPECT_EQ(acq_board_create(&config, &sched), nullptr);
    EXPECT_EQ(sched.earlier, nullptr);
}
} // namespace
