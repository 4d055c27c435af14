/// \file   test_sci_lines.cpp
/// \brief  Autobaud, loopback, pins, and an LSPCLK that stops, starts and changes amid frames.
/// SPDX-License-Identifier: MIT
#include "sci_rig.hpp"
#include <cmath>

namespace
{
constexpr unsigned CDC = SCIFFCT_CDC, ABD = SCIFFCT_ABD, ABDCLR = SCIFFCT_ABDCLR;

/// As TI has it: CDC, ABDCLR, a baud below 500 kbit/s, then 'A' or 'a' from the host.
struct autobaud : sci_rig
{
    explicit autobaud(unsigned fftx = 0xE020, const f2812_switches_t& s = {}) : sci_rig(s)
    {
        set_up(1, 0x07, 3);
        w(SCIFFTX, fftx);
        w(SCIFFCT, CDC | ABDCLR);
        tx_interrupts.clear();
    }
    void host(unsigned octet, double baud)
    {
        send(frame_8n1(octet), 1e12 / baud);
        pass(static_cast<emu_time_t>(3e12 / baud));
    }
    unsigned brr() const { return static_cast<unsigned>(p(SCIHBAUD)) << 8 | p(SCILBAUD); }
};

TEST(sci_autobaud, a_and_lower_a_set_brr_abd_and_txint_and_are_received)
{
    for (const unsigned octet : {0x41u, 0x61u})
    {
        for (const double baud : {300.0, 9600.0, 19200.0, 38400.0, 115200.0})
        {
            for (const bool fifo : {false, true})
            {
                autobaud sci(fifo ? 0xE000 : 0xA000);
                sci.host(octet, baud);
                EXPECT_EQ(sci.brr(), static_cast<unsigned>(std::lround(static_cast<double>(LSPCLK_HZ) / baud / 8)) - 1)
                    << baud;
                EXPECT_EQ(sci.p(SCIFFCT), ABD | CDC);
                EXPECT_EQ(sci.tx_interrupts.size(), 1u);
                EXPECT_EQ(sci.rx_interrupts.size(), fifo ? 0u : 1u) << "what TI's example waits for";
                EXPECT_EQ(sci.r(SCIRXBUF), octet);
                EXPECT_EQ(sci.r(SCIRXST), 0);
                sci.host(0x3C, baud * 1.01);
                EXPECT_EQ(sci.r(SCIRXBUF), 0x3C) << "CDC left set";
                sci.host('A', baud);
                sci.r(SCIRXBUF);
                sci.w(SCIFFCT, CDC | ABDCLR);
                sci.host('A', baud);
                EXPECT_EQ(sci.tx_interrupts.size(), 1u) << "no other interrupt";
                EXPECT_EQ(sci.p(SCIFFCT), CDC);
                EXPECT_EQ(sci.r(SCIRXBUF), 'A');
                EXPECT_EQ(sci.r(SCIRXST), 0) << "received as any other";
            }
        }
    }
}

TEST(sci_autobaud, other_characters_do_not_lock)
{
    for (unsigned octet = 0; octet < 256; ++octet)
    {
        if (octet == 'A' || octet == 'a')
        {
            continue;
        }
        autobaud sci;
        sci.host(octet, 9600);
        EXPECT_EQ(sci.p(SCIFFCT), CDC) << octet;
        EXPECT_EQ(sci.r(SCIRXST), 0) << "nothing is received at the baud that is not yet known";
        sci.host('a', 9600);
        EXPECT_EQ(sci.p(SCIFFCT), ABD | CDC) << octet;
        EXPECT_EQ(sci.brr(), 487u);
    }
}

/// A bit that is a third off is none of 'A'.
TEST(sci_autobaud, lengths_that_do_not_fit_do_not_lock)
{
    autobaud sci;
    const double bit = 1e12 / 9600;
    double lengths[] = {1.34, 1, 5, 1, 1};
    bool level = false;
    for (const double bits : lengths)
    {
        sci.drive(level);
        sci.pass(static_cast<emu_time_t>(bits * bit));
        level = !level;
    }
    sci.drive(true);
    sci.bits(5);
    EXPECT_EQ(sci.p(SCIFFCT), CDC);
}

/// The boot ROM writes 2000h, which does not clear ABD: a second autobaud never locks. ABDCLR does.
TEST(sci_autobaud, a_second_one_needs_abd_cleared)
{
    autobaud sci;
    sci.host('A', 9600);
    sci.w(SCIFFCT, 0);
    EXPECT_EQ(sci.p(SCIFFCT), ABD);
    sci.w(SCIFFCT, CDC);
    sci.host('A', 19200);
    EXPECT_EQ(sci.brr(), 487u);
    sci.w(SCIFFCT, ABDCLR);
    EXPECT_EQ(sci.p(SCIFFCT), 0);
    sci.w(SCIFFCT, CDC);
    sci.host('A', 19200);
    EXPECT_EQ(sci.brr(), 243u);
}

TEST(sci_autobaud, needs_cdc_and_scirst)
{
    sci_rig plain;
    plain.set_up();
    plain.send_octet('A');
    EXPECT_EQ(plain.p(SCIFFCT), 0);
    EXPECT_EQ(plain.r(SCIRXBUF), 'A');
    autobaud held(0x2000);
    held.host('A', 9600);
    EXPECT_EQ(held.p(SCIFFCT), CDC);
}

/// ABD left set keeps TX interrupts away, with and without FIFO.
TEST(sci_autobaud, abd_blocks_txint)
{
    for (const uint8_t passes : {F2812_SCI_ABD_BLOCKS, F2812_SCI_ABD_PASSES})
    {
        f2812_switches_t switches{};
        switches.sci_abd = passes;
        for (const unsigned fftx : {0xE020u, 0xA000u})
        {
            autobaud sci(fftx, switches);
            sci.host('A', 9600);
            const size_t locked = sci.tx_interrupts.size();
            sci.w(SCITXBUF, 0x55);
            sci.w(SCIFFTX, fftx | SCIFF_INTCLR);
            EXPECT_EQ(sci.tx_interrupts.size() > locked, passes != 0);
            sci.bits(50);
            const size_t before = sci.tx_interrupts.size();
            sci.w(SCIFFCT, ABDCLR);
            sci.w(SCITXBUF, 0x55);
            sci.w(SCIFFTX, fftx | SCIFF_INTCLR);
            EXPECT_GT(sci.tx_interrupts.size(), before);
        }
    }
}

TEST(sci_loopback, what_is_sent_is_received)
{
    for (const uint8_t idle : {F2812_SCI_LOOP_TXD_SENDS, F2812_SCI_LOOP_TXD_IDLE})
    {
        f2812_switches_t switches{};
        switches.sci_loop_txd = idle;
        sci_rig sci(switches);
        sci.set_up(BRR_19200, 0x07 | SCICCR_LOOPBKENA);
        sci_pins(&sci.sci, !idle, false); // needs no pin
        for (unsigned octet = 0; octet < 256; ++octet)
        {
            sci.w(SCITXBUF, octet);
            sci.bits(11);
            EXPECT_EQ(sci.r(SCIRXST), SCIRXST_RXRDY);
            EXPECT_EQ(sci.r(SCIRXBUF), octet);
        }
        EXPECT_EQ(sci.edges.empty(), idle != 0);
    }
}

TEST(sci_loopback, scitxd_sends_or_idles)
{
    for (const uint8_t idle : {F2812_SCI_LOOP_TXD_SENDS, F2812_SCI_LOOP_TXD_IDLE})
    {
        f2812_switches_t switches{};
        switches.sci_loop_txd = idle;
        sci_rig sci(switches);
        sci.set_up(BRR_19200, 0x07 | SCICCR_LOOPBKENA);
        sci.w(SCITXBUF, 0x00);
        sci.bits(11);
        EXPECT_EQ(sci.edges.size(), idle ? 0u : 2u);
        EXPECT_EQ(sci.r(SCIRXST), SCIRXST_RXRDY);
    }
}

TEST(sci_loopback, scirxd_is_cut_or_joined)
{
    for (const uint8_t joined : {F2812_SCI_LOOP_RXD_CUT, F2812_SCI_LOOP_RXD_JOINED})
    {
        f2812_switches_t switches{};
        switches.sci_loop_rxd = joined;
        sci_rig sci(switches);
        sci.set_up(BRR_19200, 0x07 | SCICCR_LOOPBKENA);
        sci.send_octet(0x5A);
        EXPECT_EQ(sci.r(SCIRXST), joined ? SCIRXST_RXRDY : 0);
        sci.w(SCICCR, 0x07);
        sci.r(SCIRXBUF);
        sci.send_octet(0x5B);
        EXPECT_EQ(sci.r(SCIRXBUF), 0x5B) << "without loopback the pin is back";
    }
}

TEST(sci_pins, a_pin_that_is_not_the_scis_is_not_driven_and_reads_idle)
{
    sci_rig sci;
    sci.set_up();
    sci_pins(&sci.sci, false, false);
    EXPECT_TRUE(sci.txd.floating);
    sci.w(SCITXBUF, 0x00);
    sci.send_octet(0x5A);
    sci.bits(2);
    EXPECT_EQ(sci.edges.size(), 0u);
    EXPECT_TRUE(sci.is(SCICTL2, SCICTL2_TXEMPTY)) << "the SCI sends all the same";
    EXPECT_EQ(sci.r(SCIRXST), 0);
    sci_pins(&sci.sci, true, true);
    EXPECT_FALSE(sci.txd.floating);
    sci.w(SCITXBUF, 0x00);
    sci.send_octet(0x5A);
    EXPECT_EQ(sci.r(SCIRXBUF), 0x5A);
    sci.bits(2);
    EXPECT_EQ(sci.edges.size(), 2u);
}

/// Without LSPCLK a frame stands where it is, and goes on with as many ticks as were left.
TEST(sci_clock, stands_and_goes_on)
{
    sci_rig sci, other;
    for (sci_rig* const s : {&sci, &other})
    {
        s->set_up();
        s->w(SCITXBUF, 0x55);
        s->ticks(4321);
    }
    sci_clock(&sci.sci, false);
    sci.ticks(100000);
    sci_clock(&sci.sci, true);
    sci.bits(12);
    other.bits(12);
    ASSERT_EQ(sci.edges.size(), other.edges.size());
    for (size_t i = 0; i < sci.edges.size(); ++i)
    {
        const uint64_t with = f2812_clock_tick(&sci.lspclk, sci.edges[i].at),
                       without = f2812_clock_tick(&other.lspclk, other.edges[i].at);
        EXPECT_EQ(with - without, without > 4321 ? 100000u : 0u) << i;
    }
    EXPECT_TRUE(sci.is(SCICTL2, SCICTL2_TXEMPTY));
}

TEST(sci_clock, a_frame_that_comes_while_it_stands_is_not_heard)
{
    sci_rig sci;
    sci.set_up();
    sci_clock(&sci.sci, false);
    sci.send_octet(0x55);
    sci.bits(1);
    sci_clock(&sci.sci, true);
    sci.bits(20);
    EXPECT_EQ(sci.r(SCIRXST), 0);
    sci.send_octet(0x56);
    EXPECT_EQ(sci.r(SCIRXBUF), 0x56);
}

/// LSPCLK halves amid a frame: what is left of it takes twice as long, both ways.
TEST(sci_clock, another_rate_amid_a_frame)
{
    sci_rig sci;
    sci.set_up();
    const double bit = sci_rig::bit_ps();
    sci.w(SCITXBUF, 0x55);
    const std::vector<int> levels = sci_rig::frame_8n1(0xA6);
    const std::vector<int> begin(levels.begin(), levels.begin() + 5), end(levels.begin() + 5, levels.end());
    sci.send(begin, bit);
    const uint64_t cycle = emu_ticker_tick(&sci.sysclk, sci.now());
    f2812_clock_divide(&sci.lspclk, cycle, 8);
    sci_clock_changed(&sci.sci);
    const emu_time_t change = sci.now();
    sci.send(end, 2 * bit);
    EXPECT_EQ(sci.r(SCIRXST), SCIRXST_RXRDY);
    EXPECT_EQ(sci.r(SCIRXBUF), 0xA6);
    sci.pass(static_cast<emu_time_t>(4 * bit));
    ASSERT_EQ(sci.edges.size(), 10u);
    for (size_t i = 1; i < sci.edges.size(); ++i)
    {
        const emu_time_t a = sci.edges[i - 1].at, b = sci.edges[i].at;
        const double before = b <= change   ? static_cast<double>(b - a)
                              : a >= change ? 0.0
                                            : static_cast<double>(change - a);
        const double after = static_cast<double>(b - a) - before;
        EXPECT_NEAR(before + after / 2, bit, 60000) << i; // two ticks of LSPCLK
    }
}

/// SCIPRI: FREE goes on, SOFT ends the frame, neither stops at once; all go on afterwards.
TEST(sci_emulation, stop)
{
    for (const unsigned pri : {0x00u, 0x10u, 0x08u, 0x18u})
    {
        sci_rig sci;
        sci.set_up();
        sci.w(SCIPRI, pri);
        sci.w(SCITXBUF, 0xFF);
        sci.w(SCITXBUF, 0xFF);
        sci.bits(0.5);
        sci_emulation_stop(&sci.sci, true);
        sci.bits(50);
        EXPECT_EQ(sci.edges.size(), pri & 8u ? 4u : pri ? 2u : 1u) << pri;
        sci.send_octet(0x21);
        EXPECT_EQ(sci.is(SCIRXST, SCIRXST_RXRDY), (pri & 8u) != 0) << pri;
        sci.r(SCIRXBUF);
        sci_emulation_stop(&sci.sci, false);
        sci.bits(50);
        EXPECT_EQ(sci.edges.size(), 4u);
        sci.send_octet(0x22);
        EXPECT_EQ(sci.r(SCIRXBUF), 0x22);
    }
}

TEST(sci_emulation, soft_receives_the_frame_to_its_end)
{
    sci_rig sci;
    sci.set_up();
    sci.w(SCIPRI, SCIPRI_SOFT);
    const std::vector<int> levels = sci_rig::frame_8n1(0x96);
    sci.send({levels.begin(), levels.begin() + 5}, sci_rig::bit_ps());
    sci_emulation_stop(&sci.sci, true);
    sci.send({levels.begin() + 5, levels.end()}, sci_rig::bit_ps());
    EXPECT_EQ(sci.r(SCIRXBUF), 0x96);
}
} // namespace
