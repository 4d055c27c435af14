/// \file   test_sci_fifo.cpp
/// \brief  FIFOs of the SCI: depth, levels, flags that are set again at once, overflow, resets, FFTXDLY.
/// SPDX-License-Identifier: MIT
#include "sci_rig.hpp"

namespace
{
constexpr unsigned TX_ON = 0xE020; ///< SCIFFTX: FIFO on, out of reset, interrupt on
constexpr unsigned RX_ON = 0x2020;

unsigned words(const sci_rig& sci, unsigned reg)
{
    return sci.p(reg) >> 8 & 0x1F;
}

/// The first word leaves for TXSHF at once, or as its start bit begins; 16 stay; more are dropped and reported.
TEST(sci_tx_fifo, is_sixteen_deep_behind_txshf)
{
    for (const uint8_t at_start : {F2812_SCI_TX_LOAD_WRITE, F2812_SCI_TX_LOAD_START})
    {
        f2812_switches_t switches{};
        switches.sci_tx_load = at_start;
        sci_rig sci(switches);
        sci.set_up();
        sci.fifo();
        sci.w(SCITXBUF, 0);
        EXPECT_EQ(words(sci, SCIFFTX), at_start);
        EXPECT_EQ(sci.is(SCICTL2, SCICTL2_TXEMPTY), false);
        sci.ticks(sciclk_ticks(BRR_19200));
        EXPECT_EQ(words(sci, SCIFFTX), 0u);
        for (unsigned n = 1; n <= 16; ++n)
        {
            EXPECT_TRUE(sci.is(SCICTL2, SCICTL2_TXRDY));
            sci.w(SCITXBUF, n);
            EXPECT_EQ(words(sci, SCIFFTX), n);
        }
        EXPECT_FALSE(sci.is(SCICTL2, SCICTL2_TXRDY));
        EXPECT_EQ(sci.reports.size(), 0u);
        sci.w(SCITXBUF, 0xEE);
        EXPECT_EQ(words(sci, SCIFFTX), 16u);
        ASSERT_EQ(sci.reports.size(), 1u);
        EXPECT_EQ(sci.reports[0], "SCI-A: SCITXBUF written with 16 words in the FIFO: the word is lost");
        const emu_time_t began = sci.edges.at(0).at;
        for (unsigned n = 0; n <= 16; ++n)
        {
            const auto frame = static_cast<emu_time_t>(n * 10 * sci_rig::bit_ps());
            sci.at(began + frame + static_cast<emu_time_t>(9.9 * sci_rig::bit_ps()));
            EXPECT_EQ(words(sci, SCIFFTX), 16 - n);
            EXPECT_EQ(sci.sent(10, began + frame - 1000), sci_rig::frame_8n1(n)) << "back to back";
        }
        EXPECT_FALSE(sci.is(SCICTL2, SCICTL2_TXEMPTY));
        sci.bits(0.2);
        EXPECT_TRUE(sci.is(SCICTL2, SCICTL2_TXEMPTY));
    }
}

/// Sixteen words in a row into an idle transmitter are never lost.
TEST(sci_tx_fifo, without_it_a_word_waits_as_the_switch_says)
{
    for (const uint8_t at_start : {F2812_SCI_TX_LOAD_WRITE, F2812_SCI_TX_LOAD_START})
    {
        f2812_switches_t switches{};
        switches.sci_tx_load = at_start;
        sci_rig sci(switches);
        sci.set_up();
        sci.w(SCITXBUF, 0);
        EXPECT_EQ(sci.is(SCICTL2, SCICTL2_TXRDY), at_start == 0);
        sci.ticks(sciclk_ticks(BRR_19200));
        EXPECT_TRUE(sci.is(SCICTL2, SCICTL2_TXRDY));
    }
}

TEST(sci_tx_fifo, interrupt_when_txffst_is_at_most_txffil)
{
    for (unsigned level = 0; level <= 16; ++level)
    {
        sci_rig sci;
        sci.set_up();
        sci.w(SCIFFTX, TX_ON | level);
        EXPECT_EQ(sci.tx_interrupts.size(), 1u) << "an empty FIFO is at most anything";
        for (unsigned n = 0; n < 17; ++n)
        {
            sci.w(SCITXBUF, n);
        }
        sci.w(SCIFFTX, TX_ON | SCIFF_INTCLR | level);
        EXPECT_EQ(sci.is(SCIFFTX, SCIFF_INT), level == 16);
        EXPECT_EQ(sci.tx_interrupts.size(), level == 16 ? 2u : 1u);
        while (words(sci, SCIFFTX) > level)
        {
            EXPECT_EQ(sci.tx_interrupts.size(), 1u);
            EXPECT_FALSE(sci.is(SCIFFTX, SCIFF_INT));
            sci.bits(10);
        }
        EXPECT_EQ(sci.tx_interrupts.size(), 2u);
        EXPECT_TRUE(sci.is(SCIFFTX, SCIFF_INT));
        sci.bits(200);
        EXPECT_EQ(sci.tx_interrupts.size(), 2u) << "while the flag stays there is no other";
    }
}

/// Clearing TXFFINT while TXFFST <= TXFFIL sets it again at once, a new edge: an interrupt function that writes TXINTCLR starts
/// transmission anew. With sci_ffint = event it does not.
TEST(sci_tx_fifo, the_flag_is_set_again_at_once)
{
    for (const uint8_t event : {F2812_SCI_FFINT_LEVEL, F2812_SCI_FFINT_EVENT})
    {
        f2812_switches_t switches{};
        switches.sci_ffint = event;
        sci_rig sci(switches);
        sci.set_up();
        sci.w(SCIFFTX, TX_ON);
        const size_t before = sci.tx_interrupts.size();
        EXPECT_EQ(before, event ? 0u : 1u);
        sci.w(SCIFFTX, TX_ON);
        EXPECT_EQ(sci.tx_interrupts.size(), before) << "without TXINTCLR nothing comes";
        sci.w(SCIFFTX, TX_ON | SCIFF_INTCLR);
        EXPECT_EQ(sci.tx_interrupts.size(), event ? 0u : 2u);
        sci.w(SCITXBUF, 0);
        sci.w(SCITXBUF, 0);
        sci.w(SCIFFTX, TX_ON | SCIFF_INTCLR);
        const size_t filled = sci.tx_interrupts.size();
        sci.bits(11);
        EXPECT_EQ(sci.tx_interrupts.size(), filled + 1) << "a word leaves";
    }
}

TEST(sci_tx_fifo, enabling_the_interrupt_with_the_flag_set_is_an_edge)
{
    sci_rig sci;
    sci.set_up();
    sci.w(SCICTL2, SCICTL2_TXINTENA);
    sci.w(SCIFFTX, 0xE000);
    EXPECT_EQ(sci.tx_interrupts.size(), 0u);
    sci.w(SCIFFTX, TX_ON);
    EXPECT_EQ(sci.tx_interrupts.size(), 1u);
    sci.w(SCIFFTX, 0xE000);
    sci.w(SCIFFTX, TX_ON);
    EXPECT_EQ(sci.tx_interrupts.size(), 2u);
    sci.w(SCIFFTX, 0xE000);
    sci.w(SCITXBUF, 0);
    EXPECT_EQ(sci.tx_interrupts.size(), 2u) << "TXINTENA's interrupt is not the FIFO's";
}

TEST(sci_tx_fifo, txfifoxreset_0_empties_and_holds_it)
{
    sci_rig sci;
    sci.set_up();
    sci.fifo();
    for (unsigned n = 0; n < 5; ++n)
    {
        sci.w(SCITXBUF, 0xFF);
    }
    sci.w(SCIFFTX, 0xC000);
    EXPECT_EQ(words(sci, SCIFFTX), 0u);
    sci.w(SCITXBUF, 0xFF);
    EXPECT_EQ(words(sci, SCIFFTX), 0u);
    EXPECT_EQ(sci.reports.size(), 1u);
    sci.w(SCIFFTX, 0xE000);
    sci.bits(100);
    EXPECT_EQ(sci.edges.size(), 2u) << "what was in TXSHF";
}

TEST(sci_fifo, scirst_0_resets_channels_and_pointers_and_keeps_the_configuration)
{
    sci_rig sci;
    sci.set_up();
    sci.w(SCIFFTX, TX_ON | 3);
    sci.w(SCIFFRX, RX_ON | 2);
    for (unsigned n = 0; n < 5; ++n)
    {
        sci.w(SCITXBUF, 0);
    }
    for (unsigned n = 0; n < 17; ++n)
    {
        sci.send_octet(n);
    }
    sci.w(SCITXBUF, 0);
    sci.bits(2);
    EXPECT_FALSE(sci.txd.level);
    const size_t interrupts = sci.tx_interrupts.size();
    sci.w(SCIFFTX, 0x6023);
    EXPECT_EQ(sci.p(SCIFFTX), 0x6023);
    EXPECT_EQ(sci.p(SCIFFRX), 0x2022);
    EXPECT_TRUE(sci.txd.level);
    sci.send_octet(0x77);
    sci.bits(20);
    EXPECT_EQ(sci.p(SCIFFRX), 0x2022) << "held";
    EXPECT_EQ(sci.tx_interrupts.size(), interrupts);
    sci.w(SCIFFTX, 0xE023);
    EXPECT_EQ(sci.p(SCIFFTX), 0xE0A3);
    EXPECT_EQ(sci.tx_interrupts.size(), interrupts + 1);
    sci.send_octet(0x78);
    EXPECT_EQ(sci.r(SCIRXBUF), 0x78);
}

TEST(sci_rx_fifo, interrupt_when_rxffst_is_at_least_rxffil)
{
    for (unsigned level = 1; level <= 17; ++level)
    {
        sci_rig sci;
        sci.set_up(BRR_19200, 0x07, SCICTL2_RXBKINTENA);
        sci.w(SCIFFTX, 0xE000);
        sci.w(SCIFFRX, RX_ON | level);
        for (unsigned n = 1; n <= 16; ++n)
        {
            sci.send_octet(n);
            EXPECT_EQ(words(sci, SCIFFRX), n);
            EXPECT_EQ(sci.rx_interrupts.size(), n >= level ? 1u : 0u) << level;
            EXPECT_EQ(sci.is(SCIFFRX, SCIFF_INT), n >= level);
        }
        EXPECT_EQ(sci.reports.size(), 0u);
    }
}

/// Cleared before the FIFO is drained it is set again at once; drained first, it stays clear.
TEST(sci_rx_fifo, the_flag_is_set_again_at_once)
{
    for (const uint8_t event : {F2812_SCI_FFINT_LEVEL, F2812_SCI_FFINT_EVENT})
    {
        f2812_switches_t switches{};
        switches.sci_ffint = event;
        sci_rig sci(switches);
        sci.set_up();
        sci.w(SCIFFTX, 0xE000);
        sci.w(SCIFFRX, RX_ON | 2);
        sci.send_octet(1);
        sci.send_octet(2);
        EXPECT_EQ(sci.rx_interrupts.size(), 1u);
        sci.w(SCIFFRX, RX_ON | SCIFF_INTCLR | 2);
        EXPECT_EQ(sci.rx_interrupts.size(), event ? 1u : 2u);
        EXPECT_EQ(sci.is(SCIFFRX, SCIFF_INT), event == 0);
        EXPECT_EQ(sci.r(SCIRXBUF), 1);
        EXPECT_EQ(sci.is(SCIFFRX, SCIFF_INT), event == 0) << "reading does not clear it";
        sci.w(SCIFFRX, RX_ON | SCIFF_INTCLR | 2);
        EXPECT_FALSE(sci.is(SCIFFRX, SCIFF_INT));
        sci.send_octet(3);
        EXPECT_EQ(sci.rx_interrupts.size(), event ? 2u : 3u);
    }
}

TEST(sci_rx_fifo, pops_in_order_and_scirxemu_does_not)
{
    sci_rig sci;
    sci.set_up();
    sci.fifo();
    for (unsigned n = 1; n <= 3; ++n)
    {
        sci.send_octet(0x40 + n);
    }
    EXPECT_EQ(sci.r(SCIRXEMU), 0x41);
    EXPECT_EQ(words(sci, SCIFFRX), 3u);
    for (unsigned n = 1; n <= 3; ++n)
    {
        EXPECT_TRUE(sci.is(SCIRXST, SCIRXST_RXRDY));
        EXPECT_EQ(sci.r(SCIRXBUF), 0x40 + n);
        EXPECT_EQ(words(sci, SCIFFRX), 3 - n);
    }
    EXPECT_FALSE(sci.is(SCIRXST, SCIRXST_RXRDY));
    EXPECT_EQ(sci.r(SCIRXBUF), 0x43) << "the last one";
    EXPECT_EQ(words(sci, SCIFFRX), 0u);
}

/// Each word has its own SCIFFFE and SCIFFPE; the interrupt of an error does not wait for the level.
TEST(sci_rx_fifo, words_keep_their_errors)
{
    sci_rig sci;
    sci.set_up(BRR_19200, 0x07, 0, 0x43);
    sci.w(SCIFFTX, 0xE000);
    sci.w(SCIFFRX, RX_ON | 16);
    std::vector<int> bad = sci_rig::frame_8n1(0xF2);
    bad.back() = 0;
    bad.push_back(1);
    sci.send_octet(0xF1);
    EXPECT_EQ(sci.rx_interrupts.size(), 0u);
    sci.send(bad, sci_rig::bit_ps());
    EXPECT_EQ(sci.rx_interrupts.size(), 1u);
    sci.send_octet(0xF3);
    EXPECT_EQ(sci.r(SCIRXBUF), 0xF1);
    EXPECT_EQ(sci.r(SCIRXBUF), 0xF2 | SCIRXBUF_SCIFFFE);
    EXPECT_EQ(sci.r(SCIRXBUF), 0xF3);
}

TEST(sci_rx_fifo, a_seventeenth_word_sets_rxffovf_and_the_first_or_the_newest_is_lost)
{
    for (const uint8_t newest : {F2812_SCI_RXFFOVF_FIRST, F2812_SCI_RXFFOVF_NEWEST})
    {
        f2812_switches_t switches{};
        switches.sci_rxffovf = newest;
        sci_rig sci(switches);
        sci.set_up(BRR_19200, 0x07, 3, 0x43);
        sci.w(SCIFFTX, 0xE000);
        sci.w(SCIFFRX, 0x201F);
        for (unsigned n = 1; n <= 17; ++n)
        {
            EXPECT_FALSE(sci.is(SCIFFRX, SCIFFRX_RXFFOVF)) << n;
            sci.send_octet(n);
        }
        EXPECT_EQ(sci.p(SCIFFRX), 0xB01F);
        EXPECT_EQ(sci.rx_interrupts.size(), 0u) << "it cannot interrupt by itself";
        EXPECT_EQ(sci.r(SCIRXST), SCIRXST_RXRDY);
        EXPECT_EQ(sci.reports.size(), 1u);
        sci.w(SCIFFRX, 0x201F);
        EXPECT_TRUE(sci.is(SCIFFRX, SCIFFRX_RXFFOVF));
        sci.w(SCIFFRX, 0x601F);
        EXPECT_EQ(sci.p(SCIFFRX), 0x301F);
        for (unsigned n = 1; n <= 16; ++n)
        {
            EXPECT_EQ(sci.r(SCIRXBUF), newest ? n : n + 1);
        }
        for (unsigned n = 0; n < 20; ++n)
        {
            sci.send_octet(n);
        }
        EXPECT_EQ(sci.reports.size(), 2u) << "told as RXFFOVF is set, not for each word";
    }
}

TEST(sci_rx_fifo, rxfiforeset_0_empties_and_holds_it)
{
    sci_rig sci;
    sci.set_up();
    sci.fifo();
    sci.send_octet(1);
    sci.send_octet(2);
    sci.w(SCIFFRX, 0x0001);
    EXPECT_EQ(words(sci, SCIFFRX), 0u);
    EXPECT_FALSE(sci.is(SCIRXST, SCIRXST_RXRDY));
    sci.send_octet(3);
    EXPECT_EQ(words(sci, SCIFFRX), 0u);
    sci.w(SCIFFRX, 0x2001);
    sci.send_octet(4);
    EXPECT_EQ(sci.r(SCIRXBUF), 4);
    EXPECT_EQ(sci.r(SCIRXST), 0) << "no overrun";
}

/// Reported by a user of an F2812: OE with RXFFOVF = 0, of a character that came before the FIFO was enabled.
TEST(sci_rx_fifo, a_character_from_before_the_fifo_makes_an_overrun)
{
    sci_rig sci;
    sci.set_up();
    sci.send_octet(1);
    sci.fifo();
    sci.send_octet(2);
    EXPECT_TRUE(sci.is(SCIRXST, SCIRXST_OE | SCIRXST_RXERROR));
    EXPECT_EQ(sci.r(SCIRXBUF), 2);
    EXPECT_EQ(sci.p(SCIFFRX) & (SCIFFRX_RXFFOVF | SCIFF_ST), 0);
    sci.send_octet(3);
    sci.send_octet(4);
    EXPECT_EQ(sci.r(SCIRXBUF), 3);
    EXPECT_EQ(sci.reports.size(), 1u);
}

/// FFTXDLY bits between the end of a frame and the next load of TXSHF; not before the first, not without FIFO.
TEST(sci_tx_fifo, fftxdly_parts_frames_by_bits)
{
    for (const uint8_t more : {F2812_SCI_FFTXDLY_255, F2812_SCI_FFTXDLY_256})
    {
        for (const unsigned delay : {0u, 1u, 7u, 255u})
        {
            for (const bool fifo : {true, false})
            {
                f2812_switches_t switches{};
                switches.sci_fftxdly = more;
                sci_rig sci(switches);
                sci.set_up();
                if (fifo)
                {
                    sci.fifo();
                }
                sci.w(SCIFFCT, delay);
                sci.w(SCITXBUF, 0xFF);
                sci.w(SCITXBUF, 0xFF);
                sci.bits(1);
                ASSERT_EQ(sci.edges.size(), 1u) << "the first does not wait";
                sci.bits(10 + delay - 0.8);
                EXPECT_EQ(sci.p(SCIFFTX) & SCIFF_ST, fifo && delay == 255 && more ? SCIFF_ST_ONE : 0)
                    << "the FIFO keeps it";
                sci.bits(20);
                ASSERT_EQ(sci.edges.size(), 4u);
                const uint64_t ticks =
                    f2812_clock_tick(&sci.lspclk, sci.edges[2].at) - f2812_clock_tick(&sci.lspclk, sci.edges[0].at);
                const unsigned bits = !fifo ? 0 : delay == 255 && more ? 256 : delay;
                EXPECT_EQ(ticks, (10 + bits) * bit_ticks(BRR_19200)) << delay;
            }
        }
    }
}
} // namespace
