/// The exchange under faults: a silent host, a wrong baud, noise, lost octets, a cut line. Seeds are printed.
/// SPDX-License-Identifier: MIT
#include "acq_rig.hpp"
#include <cstdio>
#include <cstdlib>

namespace
{
constexpr uint64_t kSeed = 2010;
constexpr double kPeriodMs = 20.0;
/// Longest wait in the default image: 4 tries of 8 ticks of 1.11 ms for AA, once more for the block; then an exchange.
constexpr double kTimeoutsMs = 2 * 4 * 9 * 1.1112 + 11.0;

double run_s()
{
    return std::getenv("INS_BENCH") != nullptr ? 600.0 : 30.0;
}

/// Blocks that are not what was sampled, though their sum agreed. A block is held against the newest sample of its number.
unsigned corrupt_accepted(const acq_rig_t& rig)
{
    unsigned wrong = 0;
    size_t taken = 0;
    for (const block_t& b : rig.blocks)
    {
        while (4 * taken + 3 < rig.samples.size() && rig.sample(taken, 3).at < b.at)
        {
            taken++;
        }
        const size_t back = (taken - b.seq) % 256;
        bool same = back < taken;
        for (unsigned channel = 0; channel < 3 && same; channel++)
        {
            same = b.codes[channel] == rig.sample(taken - back - 1, channel).code;
        }
        wrong += !same;
    }
    return wrong;
}

/// Of all samples taken: sent, lost, and at most one on its way and one that waits.
void expect_adding_up(acq_rig_t& rig)
{
    const unsigned left = (rig.sampled() - rig.sent() - rig.lost()) & 0xFFFFu;
    EXPECT_LE(left, 2u) << "sampled " << rig.sampled() << ", sent " << rig.sent() << ", lost " << rig.lost();
    // The host may hold a block whose 00 was lost and which the board then gave up, never the other way round.
    EXPECT_GE(rig.host.accepted, rig.sent());
    EXPECT_LE(rig.host.accepted, rig.sent() + rig.given_up() + 1);
}

double ramp(unsigned channel, int64_t t)
{
    return 0.5 + 0.5 * channel + 1e-13 * static_cast<double>(t % (30 * EMU_PS_PER_S));
}

TEST(acq_faults, a_silent_host_costs_samples_and_nothing_else)
{
    rig_config_t config;
    config.volts = ramp;
    acq_rig_t rig(config);
    rig.run_to_ms(505.0);
    const size_t before = rig.blocks.size();
    EXPECT_EQ(before, 24u);
    rig.silent = true;
    rig.run_to_ms(2505.0);
    EXPECT_EQ(rig.blocks.size(), before);
    rig.silent = false;
    rig.run_to_ms(2505.0 + kPeriodMs + kTimeoutsMs);
    ASSERT_GT(rig.blocks.size(), before + 1) << "resumed within a period and the time-outs";
    const block_t &first = rig.blocks[before], &second = rig.blocks[before + 1];
    EXPECT_EQ(first.seq, (before + 1 + first.gap) % 256) << "the gap is known";
    EXPECT_LT(static_cast<double>(second.at - rig.sample(before + first.gap + 1 + second.gap, 0).at) * 1e-9,
              2 * kPeriodMs)
        << "the newest sample replaced those that waited";
    rig.run_to_ms(4000.0);
    EXPECT_EQ(corrupt_accepted(rig), 0u);
    EXPECT_EQ(rig.sampled(), 199u);
    EXPECT_NEAR(rig.lost(), 100, 4);
    EXPECT_GT(rig.given_up(), 40u);
    expect_adding_up(rig);
}

TEST(acq_faults, a_host_at_another_baud_hears_errors_and_the_board_runs_on)
{
    for (const double baud : {4800.0, 10400.0, 19200.0, 115200.0})
    {
        rig_config_t config;
        config.host_baud = baud;
        acq_rig_t rig(config);
        rig.run_to_ms(4000.0);
        EXPECT_EQ(rig.sampled(), 199u) << baud;
        EXPECT_EQ(rig.sent(), 0u) << baud;
        EXPECT_EQ(rig.host.accepted, 0u) << baud;
        EXPECT_GT(rig.end.framing_errors + rig.host.stray + rig.host.timeouts, 50u) << baud;
        EXPECT_GT(rig.given_up(), 50u) << baud;
        expect_adding_up(rig);
    }
}

struct fault_t
{
    const char* name;
    double bit_error, octet_loss;
    double accepted_least; ///< of the samples taken
    double pause_ms_most;  ///< between two blocks; one fault costs the time-outs once
};

void PrintTo(const fault_t& fault, std::ostream* out)
{
    *out << fault.name;
}

class acq_fault : public testing::TestWithParam<fault_t>
{
};

TEST_P(acq_fault, is_survived_and_counted)
{
    const fault_t& f = GetParam();
    rig_config_t config;
    config.volts = ramp;
    config.up = {config.baud, f.bit_error, f.octet_loss, nullptr, 0, kSeed};
    config.down = {config.baud, f.bit_error, f.octet_loss, nullptr, 0, kSeed + 1};
    acq_rig_t rig(config);
    rig.run_to_ms(run_s() * 1e3);
    uint64_t known = 0;
    emu_time_t last = 0, longest = 0;
    for (const block_t& b : rig.blocks)
    {
        known += 1u + b.gap;
        longest = std::max(longest, b.at - last);
        last = b.at;
    }
    for (size_t k = 1; 4 * k < rig.samples.size(); k++)
    {
        ASSERT_EQ(rig.cycle(rig.sample(k, 0).at) - rig.cycle(rig.sample(k - 1, 0).at), 18432u)
            << "whatever the serial interrupt does, scan " << k;
    }
    const unsigned wrong = corrupt_accepted(rig);
    std::printf(
        "%s, seed %llu: %zu scans, accepted %u, lost %u, resent %u, duplicates %u, corrupt %u, timeouts %u, stray %u, "
        "slots inverted %llu, octets swallowed %llu, corrupt accepted %u, longest pause %.1f ms\n",
        f.name, static_cast<unsigned long long>(kSeed), rig.samples.size() / 4, rig.host.accepted, rig.lost(),
        rig.resent(), rig.host.duplicates, rig.host.corrupt, rig.host.timeouts, rig.host.stray,
        static_cast<unsigned long long>(rig.up.slots_inverted + rig.down.slots_inverted),
        static_cast<unsigned long long>(rig.up.octets_swallowed + rig.down.octets_swallowed), wrong,
        static_cast<double>(longest) * 1e-9);
    EXPECT_GT(rig.resent() + rig.host.corrupt, 0u) << "there were faults";
    EXPECT_GE(rig.host.accepted, f.accepted_least * static_cast<double>(rig.samples.size()) / 4);
    EXPECT_LE(longest, static_cast<emu_time_t>(f.pause_ms_most * 1e9));
    EXPECT_LE(wrong, rig.blocks.size() / 100);
    if (wrong == 0)
    {
        EXPECT_EQ(rig.host.accepted, rig.blocks.size());
        EXPECT_LE(rig.samples.size() / 4 - known, 3u) << "accepted and gaps are all samples";
    }
    expect_adding_up(rig);
}

INSTANTIATE_TEST_SUITE_P(faults, acq_fault,
                         testing::Values(fault_t{"bit_errors_1e4", 1e-4, 0.0, 0.97, kPeriodMs + kTimeoutsMs},
                                         fault_t{"octet_loss_1e3", 0.0, 1e-3, 0.97, kPeriodMs + kTimeoutsMs},
                                         fault_t{"both_tenfold", 1e-3, 1e-2, 0.6, 250.0}),
                         [](const auto& p) { return std::string(p.param.name); });

TEST(acq_faults, a_cut_of_two_seconds_ends_within_a_period_and_the_time_outs)
{
    const emu_serial_cut_t cuts[] = {{1003 * kMs, 3003 * kMs}, {4010 * kMs, 6010 * kMs}, {7017 * kMs, 9017 * kMs}};
    for (const int which : {1, 2, 3})
    {
        rig_config_t config;
        config.volts = ramp;
        if ((which & 1) != 0)
        {
            config.up = {config.baud, 0.0, 0.0, cuts, 3, kSeed};
        }
        if ((which & 2) != 0)
        {
            config.down = {config.baud, 0.0, 0.0, cuts, 3, kSeed};
        }
        acq_rig_t rig(config);
        rig.run_to_ms(10000.0);
        for (const emu_serial_cut_t& cut : cuts)
        {
            unsigned during = 0;
            double resumed_ms = 1e9;
            for (const block_t& b : rig.blocks)
            {
                during += b.at > cut.from + 11 * kMs && b.at < cut.to;
                if (b.at >= cut.to)
                {
                    resumed_ms = static_cast<double>(b.at - cut.to) * 1e-9;
                    break;
                }
            }
            // With only the way back cut, the host cannot answer: nothing passes either.
            EXPECT_LE(during, 1u) << which;
            EXPECT_LE(resumed_ms, kPeriodMs + kTimeoutsMs) << which;
            std::printf("line %d cut to %.0f ms: next block after %.1f ms\n", which, static_cast<double>(cut.to) * 1e-9,
                        resumed_ms);
        }
        EXPECT_EQ(corrupt_accepted(rig), 0u);
        EXPECT_NEAR(rig.lost(), 300, 12);
        expect_adding_up(rig);
    }
}

/// Octets without pause, their phase against the sampling drifting: the serial interrupt never delays a scan.
TEST(acq_faults, a_babbling_host_does_not_disturb_the_sampling)
{
    constexpr double kBabbleMs = 15000.0;
    rig_config_t config;
    config.volts = ramp;
    config.host_baud = 9587.0;
    acq_rig_t rig(config);
    rig.silent = true;
    for (double ms = 0.0; ms < kBabbleMs; ms += 100.0)
    {
        while (rig.end.fifo_count < 100)
        {
            emu_serial_end_send(&rig.end, 0x55);
        }
        rig.run_to_ms(ms);
    }
    for (size_t k = 1; 4 * k < rig.samples.size(); k++)
    {
        ASSERT_EQ(rig.cycle(rig.sample(k, 0).at) - rig.cycle(rig.sample(k - 1, 0).at), 18432u) << "scan " << k;
    }
    EXPECT_EQ(rig.sampled(), 744u);
    EXPECT_EQ(rig.sent(), 0u);
    rig.silent = false;
    rig.run_to_ms(kBabbleMs + 200.0 + kPeriodMs + kTimeoutsMs);
    EXPECT_GT(rig.sent(), 0u) << "and the exchange resumes";
    EXPECT_TRUE(rig.reports.empty()) << rig.reports.front();
    expect_adding_up(rig);
}

/// A host so slow that the board is about to copy a waiting sample just as the next scan replaces it, at every phase.
TEST(acq_faults, a_scan_during_the_copy_does_not_mix_samples)
{
    constexpr emu_time_t kSweep = 2 * kMs, kStep = 7 * EMU_PS_PER_US;
    rig_config_t config;
    config.ignored_requests = 3;
    config.volts = [](unsigned channel, int64_t t)
    { return kLsb * static_cast<double>((t / (20 * kMs) * 301 + 1000 * channel) % 4096); };
    acq_rig_t rig(config);
    double ms = 0.0;
    for (emu_time_t delay = 0; delay < kSweep; delay += kStep)
    {
        rig.ack_delay = delay;
        rig.run_to_ms(ms += 40.0);
    }
    EXPECT_GT(rig.blocks.size(), static_cast<size_t>(kSweep / kStep) * 3 / 4);
    EXPECT_EQ(corrupt_accepted(rig), 0u);
    EXPECT_GT(rig.lost(), 100u);
    expect_adding_up(rig);
}

TEST(acq_faults, one_seed_one_run)
{
    std::vector<emu_time_t> first;
    uint64_t instructions = 0;
    for (const uint64_t seed : {kSeed, kSeed, kSeed + 7})
    {
        rig_config_t config;
        config.up = {config.baud, 1e-3, 1e-3, nullptr, 0, seed};
        config.down = {config.baud, 1e-3, 1e-3, nullptr, 0, seed + 1};
        acq_rig_t rig(config);
        rig.run_to_ms(3000.0);
        std::vector<emu_time_t> at;
        for (const block_t& b : rig.blocks)
        {
            at.push_back(b.at);
        }
        if (first.empty())
        {
            first = at;
            instructions = mcs51_instructions(rig.cpu);
        }
        EXPECT_EQ(at == first && instructions == mcs51_instructions(rig.cpu), seed == kSeed) << "seed " << seed;
    }
}
} // namespace
