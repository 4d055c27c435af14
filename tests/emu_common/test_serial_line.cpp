/// Declared faults between two wires. The seed is printed with every statistical result.
/// SPDX-License-Identifier: MIT
#include "emu/serial.h"
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

namespace
{
constexpr uint64_t kSeed = 20100501;
constexpr double kBaud = 9600.0;
constexpr emu_time_t kMs = 1000 * EMU_PS_PER_US;

unsigned count(unsigned reduced, unsigned bench)
{
    return std::getenv("INS_BENCH") != nullptr ? bench : reduced;
}

struct line_t
{
    explicit line_t(const emu_serial_faults_t& faults)
    {
        emu_sched_init(&sched);
        emu_wire_init(&a, "a", true);
        emu_wire_init(&b, "b", true);
        emu_wire_init(&nc, "nc", true);
        EXPECT_EQ(emu_serial_end_init(&tx, &sched, &a, &nc, kBaud, nullptr, nullptr), 0);
        EXPECT_EQ(emu_serial_end_init(&rx, &sched, nullptr, &b, kBaud, put, this), 0);
        EXPECT_EQ(emu_serial_line_init(&line, &sched, &a, &b, &faults), 0);
    }
    static void put(void* ctx, uint8_t octet, bool framing_ok, emu_time_t at)
    {
        auto* self = static_cast<line_t*>(ctx);
        self->octets.push_back(octet);
        self->at.push_back(at);
        self->bad += octet != self->last || !framing_ok;
    }
    /// n octets, spaced by a bit more than a frame; the octet differs from its neighbours.
    void run(unsigned n, double frame_bits)
    {
        for (unsigned i = 0; i < n; i++)
        {
            last = static_cast<uint8_t>(i * 89 + 7);
            emu_serial_end_send(&tx, last);
            origin += frame_bits;
            emu_sched_advance(&sched, static_cast<emu_time_t>(origin * 1e12 / kBaud));
        }
    }
    emu_sched_t sched;
    emu_wire_t a, b, nc;
    emu_serial_end_t tx, rx;
    emu_serial_line_t line;
    std::vector<uint8_t> octets;
    std::vector<emu_time_t> at;
    uint8_t last = 0;
    unsigned bad = 0;
    double origin = 0.0;
};

emu_serial_faults_t faults(double bit_error, double octet_loss, uint64_t seed = kSeed)
{
    return {kBaud, bit_error, octet_loss, nullptr, 0, seed};
}

/// |got - n p| within 4 standard deviations.
void expect_binomial(double got, double n, double p, const char* what)
{
    const double sd = std::sqrt(n * p * (1.0 - p));
    EXPECT_NEAR(got, n * p, 4.0 * sd) << what << ", seed " << kSeed << ", n " << n << ", p " << p;
}

TEST(serial_line, without_faults_is_a_wire)
{
    const auto l = std::make_unique<line_t>(faults(0.0, 0.0));
    l->run(512, 10.0);
    l->run(1, 12.0);
    EXPECT_EQ(l->octets.size(), 513u);
    EXPECT_EQ(l->bad, 0u);
    EXPECT_EQ(l->line.slots_inverted, 0u);
}

TEST(serial_line, inverts_bits_with_the_stated_probability)
{
    constexpr double kP = 1e-4;
    const unsigned n = count(100000, 2000000);
    const auto l = std::make_unique<line_t>(faults(kP, 0.0));
    l->run(n, 11.0);
    expect_binomial(static_cast<double>(l->line.slots_inverted), 11.0 * n, kP, "slots inverted");
    // A frame shows an error when one of its ten bits is hit; an idle slot makes a ghost, which overlaps the next frame.
    const double shown = l->bad;
    const double p10 = 1.0 - std::pow(1.0 - kP, 10.0), p12 = 1.0 - std::pow(1.0 - kP, 12.0);
    EXPECT_GT(shown, n * p10 - 4.0 * std::sqrt(n * p10)) << "seed " << kSeed;
    EXPECT_LT(shown, 2.0 * n * p12 + 4.0 * std::sqrt(n * p12)) << "seed " << kSeed;
}

TEST(serial_line, swallows_whole_octets_with_the_stated_probability)
{
    constexpr double kP = 0.01;
    const unsigned n = count(20000, 200000);
    const auto l = std::make_unique<line_t>(faults(0.0, kP));
    l->run(n, 10.0);
    l->run(1, 12.0);
    expect_binomial(static_cast<double>(l->line.octets_swallowed), n, kP, "octets swallowed");
    EXPECT_EQ(l->octets.size() + l->line.octets_swallowed, n + 1);
    EXPECT_EQ(l->bad, 0u) << "what arrives is right";
}

TEST(serial_line, reads_idle_while_cut)
{
    const emu_serial_cut_t cuts[] = {{100 * kMs, 2100 * kMs}, {2500 * kMs, 2600 * kMs}};
    emu_serial_faults_t f = faults(0.0, 0.0);
    f.cuts = cuts;
    f.cut_count = 2;
    const auto l = std::make_unique<line_t>(f);
    l->run(3000, 10.0); // 3.125 s
    unsigned outside = 0;
    for (const emu_time_t at : l->at)
    {
        const bool in_first = at > 102 * kMs && at<2100 * kMs, in_second = at> 2502 * kMs && at < 2600 * kMs;
        EXPECT_FALSE(in_first || in_second) << at;
        outside++;
    }
    EXPECT_NEAR(outside, (3125.0 - 2100.0) / (10e3 / kBaud), 5.0);
    // The cut may fall inside a frame, and its end too: at most a wrong octet or two at each edge.
    EXPECT_LE(l->bad, 8u);
}

TEST(serial_line, one_seed_one_run)
{
    std::vector<uint8_t> first;
    for (const uint64_t seed : {kSeed, kSeed, kSeed + 1})
    {
        const auto l = std::make_unique<line_t>(faults(0.003, 0.003, seed));
        l->run(2000, 10.0);
        if (first.empty())
        {
            first = l->octets;
        }
        EXPECT_EQ(l->octets == first, seed == kSeed) << "seed " << seed;
    }
}

TEST(serial_line, a_tiny_probability_does_not_hang)
{
    const auto l = std::make_unique<line_t>(faults(1e-15, 0.0));
    emu_sched_advance(&l->sched, 60 * EMU_PS_PER_S);
    EXPECT_EQ(l->line.slots_inverted, 0u);
}

TEST(serial_line, refuses_bad_faults)
{
    const auto l = std::make_unique<line_t>(faults(0.0, 0.0));
    emu_wire_t to;
    emu_wire_init(&to, "to", true);
    emu_serial_line_t line;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double p : {-0.1, 0.6, nan})
    {
        for (const emu_serial_faults_t& f : {faults(p, 0.0), faults(0.0, p)})
        {
            EXPECT_EQ(emu_serial_line_init(&line, &l->sched, &l->a, &to, &f), -1) << p;
        }
    }
    const emu_serial_cut_t crossed[] = {{10, 30}, {20, 40}}, empty[] = {{10, 10}};
    emu_serial_faults_t f = faults(0.0, 0.0);
    f.cuts = crossed;
    f.cut_count = 2;
    EXPECT_EQ(emu_serial_line_init(&line, &l->sched, &l->a, &to, &f), -1);
    f.cuts = empty;
    f.cut_count = 1;
    EXPECT_EQ(emu_serial_line_init(&line, &l->sched, &l->a, &to, &f), -1);
    f = faults(0.1, 0.0);
    f.baud = 0.0;
    EXPECT_EQ(emu_serial_line_init(&line, &l->sched, &l->a, &to, &f), -1);
}
} // namespace
