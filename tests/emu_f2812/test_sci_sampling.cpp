/// \file   test_sci_sampling.cpp
/// \brief  What the receiver makes of a line: start bit of four SCICLK, majority of SCICLK 4, 5, 6, against an oracle that samples each one.
/// SPDX-License-Identifier: MIT
#include "sci_rig.hpp"
#include <array>
#include <cmath>
#include <random>

namespace
{
constexpr unsigned SEED = 20261122;

struct octet
{
    unsigned value;
    bool framing_error;
    bool operator==(const octet& o) const { return value == o.value && framing_error == o.framing_error; }
};

/// A line: starts high, toggles at these instants [SCICLK, SCICLK n is sampled at n].
using toggles = std::vector<double>;

/// The rule in few words, one SCICLK after another; first: number of the first low SCICLK.
std::vector<octet> oracle(const toggles& line, unsigned samples, unsigned first)
{
    std::vector<octet> result;
    size_t passed = 0;
    bool last = true;
    int count = -1; // SCICLK of the frame, -1: none
    unsigned votes = 0, bits = 0;
    for (unsigned n = 0; n < samples; ++n)
    {
        while (passed < line.size() && line[passed] < n)
        {
            ++passed;
        }
        const bool level = passed % 2 == 0;
        count = count >= 0 ? count + 1 : last && !level ? static_cast<int>(first) : -1;
        last = level;
        if (count >= 0 && count <= 4 && level)
        {
            count = -1;
        }
        const int bit = (count - 1) / 8, sub = (count - 1) % 8 + 1;
        if (count < 9 || sub < 4 || sub > 6)
        {
            continue;
        }
        votes += level;
        if (sub == 6)
        {
            bits |= (votes >= 2 ? 1u : 0u) << (bit - 1);
            votes = 0;
            if (bit == 9)
            {
                const bool stop = bits >> 8 & 1u;
                result.push_back({bits & 0xFFu, !stop});
                bits = 0;
                count = stop && !level ? static_cast<int>(first) : -1;
            }
        }
    }
    return result;
}

/// 8N1 octets back to back; `at`: fall of the first start bit [SCICLK], bit: its length [SCICLK].
toggles line_of(const std::vector<unsigned>& octets, double at, double bit)
{
    toggles line;
    int level = 1;
    for (size_t i = 0; i < octets.size(); ++i)
    {
        const std::vector<int> levels = sci_rig::frame_8n1(octets[i]);
        for (size_t b = 0; b < levels.size(); ++b)
        {
            if (levels[b] != level)
            {
                line.push_back(at + static_cast<double>(10 * i + b) * bit);
                level = levels[b];
            }
        }
    }
    return line;
}

/// What the SCI makes of the same line, word by word with its own framing error.
struct receiver : sci_rig
{
    uint64_t origin; ///< LSPCLK of SCICLK 0: the divider begins anew at the write of SCILBAUD
    unsigned brr;
    std::vector<octet> got;
    explicit receiver(unsigned brr_, const f2812_switches_t& s = {}) : sci_rig(s), origin(0), brr(brr_)
    {
        ticks(1000);
        set_up(brr);
        fifo();
        w(SCIFFRX, 0x2021);
        origin = tick();
    }
    void take()
    {
        while ((p(SCIFFRX) & SCIFF_ST) != 0)
        {
            const unsigned word = r(SCIRXBUF);
            got.push_back({word & 0xFFu, (word & SCIRXBUF_SCIFFFE) != 0});
        }
    }
    void play(const toggles& levels)
    {
        bool level = true;
        for (const double t : levels)
        {
            const double lsp_ticks = static_cast<double>(origin) + t * static_cast<double>(sciclk_ticks(brr));
            at(static_cast<emu_time_t>(std::llround(lsp_ticks * 1e12 / LSPCLK_HZ)));
            take();
            level = !level;
            drive(level);
        }
        pass(static_cast<emu_time_t>(30 * bit_ps(brr)));
        take();
    }
};

std::vector<unsigned> random_octets(unsigned count, unsigned seed)
{
    std::mt19937 random(seed);
    std::vector<unsigned> octets(count);
    for (unsigned& o : octets)
    {
        o = random() & 0xFFu;
    }
    return octets;
}

std::vector<octet> clean(const std::vector<unsigned>& octets)
{
    std::vector<octet> result;
    for (const unsigned o : octets)
    {
        result.push_back({o, false});
    }
    return result;
}

/// All phases of SCICLK at F3h. \return frames that had errors, by the oracle, of all.
unsigned at_every_phase(double sender, unsigned octets_a_phase, uint8_t start_count = F2812_SCI_START_COUNT_1)
{
    const unsigned phases = static_cast<unsigned>(sciclk_ticks(BRR_19200));
    const double bit = 8.0 / (1.0 + sender);
    unsigned wrong = 0;
    for (unsigned phase = 0; phase < phases; ++phase)
    {
        const std::vector<unsigned> octets = random_octets(octets_a_phase, SEED + phase);
        const toggles line = line_of(octets, 40.0 + (phase + 0.5) / phases, bit);
        f2812_switches_t switches{};
        switches.sci_start_count = start_count;
        receiver sci(BRR_19200, switches);
        sci.play(line);
        const unsigned samples = static_cast<unsigned>(line.back() + 200);
        const std::vector<octet> want = oracle(line, samples, start_count == F2812_SCI_START_COUNT_1 ? 1 : 0);
        EXPECT_TRUE(sci.got == want) << "sender " << sender << " phase " << phase << " seed " << SEED + phase;
        EXPECT_EQ(sci.reports.size(), 0u);
        for (const octet& o : want)
        {
            wrong += o.framing_error;
        }
        const bool all = want == clean(octets);
        wrong += !all && wrong == 0;
    }
    return wrong;
}

TEST(sci_sampling, twenty_thousand_random_octets_are_received_at_all_phases)
{
    EXPECT_EQ(at_every_phase(0.0, sci_count(82, 20000)), 0u); // 244 phases
}

TEST(sci_sampling, senders_two_and_a_half_percent_fast_and_four_and_a_half_slow_are_received_clean)
{
    EXPECT_EQ(at_every_phase(0.025, sci_count(20, 1000)), 0u);
    EXPECT_EQ(at_every_phase(-0.045, sci_count(20, 1000)), 0u);
}

TEST(sci_sampling, senders_four_percent_fast_and_seven_and_a_half_slow_give_the_framing_errors_of_the_rule)
{
    EXPECT_GT(at_every_phase(0.04, sci_count(40, 1000)), 0u);
    EXPECT_GT(at_every_phase(-0.075, sci_count(40, 1000)), 0u);
}

TEST(sci_sampling, the_first_low_sciclk_may_be_the_fall_itself)
{
    const uint8_t as_fall = F2812_SCI_START_COUNT_0;
    EXPECT_EQ(at_every_phase(0.025, sci_count(20, 1000), as_fall), 0u);
    EXPECT_EQ(at_every_phase(-0.045, sci_count(20, 1000), as_fall), 0u);
    EXPECT_GT(at_every_phase(0.04, sci_count(20, 1000), as_fall), 0u);
    EXPECT_GT(at_every_phase(-0.075, sci_count(20, 1000), as_fall), 0u);
}

/// One octet, then a start bit at once. The stop bit is decided by the second of its samples 4, 5, 6, SCICLK 77 (the fall being before
/// SCICLK 1 by up to one): a stop bit that is over by then is missed, and one that has not begun.
TEST(sci_sampling, the_limits_of_the_sender_are_those_of_the_stop_bits_samples)
{
    constexpr double FAST = 80.0 / 77.0, SLOW = 72.0 / 76.0, STEP = 1e-3,
                     EDGE = 1e-3; // phase: just after, just before an SCICLK
    const struct
    {
        double sender, phase;
        unsigned octet;
        bool good;
    } cases[] = {{FAST - STEP, EDGE, 0xFF, true},
                 {FAST + STEP, EDGE, 0xFF, false},
                 {SLOW + STEP, 1 - EDGE, 0x00, true},
                 {SLOW - STEP, 1 - EDGE, 0x00, false}};
    for (const auto& c : cases)
    {
        receiver sci(BRR_19200);
        sci.play(line_of({c.octet, 0xFF}, 40 + c.phase, 8.0 / c.sender));
        ASSERT_GE(sci.got.size(), 1u);
        EXPECT_EQ(sci.got[0].value, c.octet);
        EXPECT_EQ(sci.got[0].framing_error, !c.good) << c.sender;
    }
}

/// Low for n SCICLK out of an idle line: four are a start bit, three are none.
TEST(sci_sampling, a_start_bit_is_four_low_sciclk)
{
    for (unsigned low = 1; low <= 6; ++low)
    {
        for (const uint8_t start_count : {F2812_SCI_START_COUNT_1, F2812_SCI_START_COUNT_0})
        {
            f2812_switches_t switches{};
            switches.sci_start_count = start_count;
            receiver sci(BRR_19200, switches);
            sci.play({40.5, 40.5 + low});
            EXPECT_EQ(sci.got.size(), low >= 4u + start_count ? 1u : 0u) << low;
        }
    }
}

/// A real start bit right behind a short dip is found.
TEST(sci_sampling, after_a_false_start_the_next_fall_counts)
{
    receiver sci(BRR_19200);
    toggles line = {40.5, 43.5};
    for (const double t : line_of({0x5A}, 45.5, 8))
    {
        line.push_back(t);
    }
    sci.play(line);
    EXPECT_TRUE(sci.got == clean({0x5A}));
}

/// One sample of the eight of a bit is inverted: only two of 4, 5, 6 turn the bit over.
TEST(sci_sampling, two_of_samples_four_five_and_six_make_a_bit)
{
    for (unsigned bit = 1; bit <= 9; ++bit)
    {
        for (unsigned spoilt = 0; spoilt < 256; ++spoilt)
        {
            toggles line = {40.5};
            for (unsigned sub = 1; sub <= 8; ++sub)
            {
                if (spoilt >> (sub - 1) & 1)
                {
                    line.push_back(40.5 + 8 * bit + sub - 1);
                    line.push_back(40.5 + 8 * bit + sub);
                }
            }
            line.push_back(40.5 + 90);
            receiver sci(BRR_19200);
            sci.play(line);
            const unsigned votes = (spoilt >> 3 & 1) + (spoilt >> 4 & 1) + (spoilt >> 5 & 1);
            ASSERT_GE(sci.got.size(), 1u);
            ASSERT_EQ(sci.got[0].value, bit < 9 && votes >= 2 ? 1u << (bit - 1) : 0u) << bit << " " << spoilt;
            ASSERT_EQ(sci.got[0].framing_error, !(bit == 9 && votes >= 2)) << bit << " " << spoilt;
        }
    }
}

/// Any line at all: random lengths from parts of an SCICLK to many bits.
TEST(sci_sampling, noise_is_read_as_the_oracle_reads_it)
{
    for (unsigned seed = 1; seed <= sci_count(300, 20000); ++seed)
    {
        std::mt19937 random(seed);
        toggles line;
        double t = 40.0037; // never on an SCICLK
        for (unsigned i = 0; i < 2 * (50 + random() % 50); ++i)
        {
            const unsigned scale = random() % 4 == 0 ? 300 : 4000;
            t += 0.05 + static_cast<double>(random() % scale) / 100.0;
            line.push_back(t);
        }
        const unsigned brr = std::array<unsigned, 4>{0, 1, 7, BRR_19200}[seed % 4];
        f2812_switches_t switches{};
        switches.sci_break_hold = F2812_SCI_BREAK_HOLD_OFF; // the oracle knows no break
        receiver sci(brr, switches);
        sci.play(line);
        ASSERT_TRUE(sci.got == oracle(line, static_cast<unsigned>(t + 200), 1)) << "seed " << seed << " BRR " << brr;
    }
}
} // namespace
