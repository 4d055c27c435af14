/// \file   test_sci_break.cpp
/// \brief  Break, and the multiprocessor modes: idle line, address bit, SLEEP, TXWAKE, the erratum of the address bit.
/// SPDX-License-Identifier: MIT
#include "sci_rig.hpp"

namespace
{
/// The line is low from a fall on for so many SCICLK (the fall half of one before the first low sample); then high.
struct broken : sci_rig
{
    explicit broken(double sciclk, unsigned ctl2, unsigned ctl1 = 0x03, const f2812_switches_t& s = {}) : sci_rig(s)
    {
        set_up(BRR_19200, 0x07, ctl2, ctl1);
        ticks(20 * sciclk_ticks(BRR_19200) + sciclk_ticks(BRR_19200) / 2);
        drive(false);
        bits(sciclk / 8);
        drive(true);
        bits(2);
    }
};

/// 80 SCICLK of a frame with its missing stop bit, then 10 or 9.625 bits.
TEST(sci_break, brkdt_after_ten_low_bits_behind_a_missing_stop_bit)
{
    for (const uint8_t shorter : {F2812_SCI_BREAK_BITS_10, F2812_SCI_BREAK_BITS_9_625})
    {
        f2812_switches_t switches{};
        switches.sci_break_bits = shorter;
        const double enough = shorter ? 157 : 160;
        const broken just(enough + 0.6, 0, 0x03, switches), almost(enough - 1, 0, 0x03, switches);
        EXPECT_EQ(just.p(SCIRXST), SCIRXST_RXERROR | SCIRXST_RXRDY | SCIRXST_BRKDT | SCIRXST_FE);
        EXPECT_EQ(almost.p(SCIRXST), SCIRXST_RXERROR | SCIRXST_RXRDY | SCIRXST_FE);
    }
}

TEST(sci_break, any_high_sample_begins_it_anew)
{
    sci_rig sci;
    sci.set_up();
    sci.drive(false);
    sci.bits(19);
    sci.drive(true);
    sci.ticks(sciclk_ticks(BRR_19200) + 5);
    sci.drive(false);
    sci.bits(19);
    EXPECT_FALSE(sci.is(SCIRXST, SCIRXST_BRKDT));
    EXPECT_TRUE(sci.is(SCIRXST, SCIRXST_FE));
    sci.bits(2);
    EXPECT_TRUE(sci.is(SCIRXST, SCIRXST_BRKDT));
}

/// A break does not load SCIRXBUF; its interrupt is RXBKINTENA's; a stop bit that is missing loads it before.
TEST(sci_break, interrupts)
{
    EXPECT_EQ(broken(90, SCICTL2_RXBKINTENA).rx_interrupts.size(), 1u) << "00 with FE";
    EXPECT_EQ(broken(200, SCICTL2_RXBKINTENA).rx_interrupts.size(), 2u);
    EXPECT_EQ(broken(200, 0).rx_interrupts.size(), 0u);
    EXPECT_EQ(broken(200, 0, 0x43).rx_interrupts.size(), 1u) << "RXERROR begins once";
    EXPECT_EQ(broken(200, SCICTL2_RXBKINTENA, 0x02).rx_interrupts.size(), 0u) << "RXENA is 0";
    broken asleep(200, SCICTL2_RXBKINTENA, 0x07);
    EXPECT_EQ(asleep.rx_interrupts.size(), 1u) << "the break, whatever SLEEP is";
    EXPECT_TRUE(asleep.is(SCIRXST, SCIRXST_BRKDT));
}

/// "In order to receive more characters, the SCI must be reset by toggling the SW RESET bit."
TEST(sci_break, holds_the_receiver_until_swreset)
{
    for (const uint8_t off : {F2812_SCI_BREAK_HOLD_SWRESET, F2812_SCI_BREAK_HOLD_OFF})
    {
        f2812_switches_t switches{};
        switches.sci_break_hold = off;
        broken sci(200, 0, 0x03, switches);
        sci.r(SCIRXBUF);
        sci.send_octet(0x42);
        EXPECT_EQ(sci.is(SCIRXST, SCIRXST_RXRDY), off != 0);
        EXPECT_TRUE(sci.is(SCIRXST, SCIRXST_BRKDT | SCIRXST_RXERROR)) << "a character does not clear it";
        sci.w(SCICTL1, 0x03);
        EXPECT_EQ(sci.r(SCIRXST), 0);
        sci.w(SCICTL1, 0x23);
        sci.send_octet(0x43);
        EXPECT_EQ(sci.r(SCIRXBUF), 0x43);
        EXPECT_EQ(sci.r(SCIRXST), 0);
    }
}

constexpr unsigned IDLE_MODE = 0x07, ADDRESS_MODE = 0x0F, ASLEEP = SCICTL1_SWRESET | SCICTL1_SLEEP | 0x03;

/// Idle bits between stop bit and start bit: ten make an address.
TEST(sci_idle_line, ten_idle_bits_before_a_frame_make_it_an_address)
{
    for (const double idle : {9.0, 9.75, 10.0, 11.0})
    {
        sci_rig sci;
        sci.set_up(BRR_19200, IDLE_MODE);
        sci.bits(3);
        sci.send_octet(0x11);
        EXPECT_EQ(sci.r(SCIRXST), SCIRXST_RXRDY) << "three bits after SWRESET";
        sci.r(SCIRXBUF);
        sci.bits(idle);
        sci.send_octet(0x22);
        EXPECT_EQ(sci.r(SCIRXST), idle >= 10.0 ? SCIRXST_RXRDY | SCIRXST_RXWAKE : SCIRXST_RXRDY) << idle;
        sci.r(SCIRXBUF);
        EXPECT_EQ(sci.r(SCIRXST), 0) << "reading clears RXWAKE";
    }
}

/// The next frame clears RXWAKE, but not behind a FIFO; reading SCIRXBUF and SWRESET do.
TEST(sci_idle_line, rxwake_is_cleared_by_the_next_frame_without_fifo)
{
    for (const bool fifo : {false, true})
    {
        sci_rig sci;
        sci.set_up();
        if (fifo)
        {
            sci.fifo();
        }
        sci.bits(12);
        sci.send_octet(0x11);
        EXPECT_TRUE(sci.is(SCIRXST, SCIRXST_RXWAKE));
        sci.send_octet(0x22);
        EXPECT_EQ(sci.is(SCIRXST, SCIRXST_RXWAKE), fifo);
        sci.w(SCICTL1, 0x03);
        EXPECT_FALSE(sci.is(SCIRXST, SCIRXST_RXWAKE));
    }
}

/// A dip that is no start bit is no idle line either.
TEST(sci_idle_line, a_false_start_ends_the_idle_time)
{
    sci_rig sci;
    sci.set_up();
    sci.bits(8);
    sci.drive(false);
    sci.bits(0.25);
    sci.drive(true);
    sci.bits(8);
    sci.send_octet(0x33);
    EXPECT_EQ(sci.r(SCIRXST), SCIRXST_RXRDY);
}

TEST(sci_sleep, only_addresses_are_seen_and_the_program_wakes_itself)
{
    sci_rig sci;
    sci.set_up(BRR_19200, IDLE_MODE, SCICTL2_RXBKINTENA);
    sci.w(SCICTL1, ASLEEP);
    sci.bits(12);
    sci.send_octet(0x01);
    EXPECT_EQ(sci.r(SCIRXST), SCIRXST_RXRDY | SCIRXST_RXWAKE);
    EXPECT_EQ(sci.r(SCIRXBUF), 0x01);
    EXPECT_TRUE(sci.is(SCICTL1, SCICTL1_SLEEP)) << "hardware does not clear it";
    std::vector<int> bad = sci_rig::frame_8n1(0xFF);
    bad.back() = 0;
    bad.push_back(1);
    sci.send_octet(0x02);
    sci.send(bad, sci_rig::bit_ps());
    EXPECT_EQ(sci.r(SCIRXST), 0) << "neither data nor its errors";
    EXPECT_EQ(sci.rx_interrupts.size(), 1u);
    sci.w(SCICTL1, ASLEEP & ~static_cast<unsigned>(SCICTL1_SLEEP));
    sci.send_octet(0x03);
    EXPECT_EQ(sci.r(SCIRXBUF), 0x03);
    EXPECT_EQ(sci.rx_interrupts.size(), 2u);
}

/// TXWAKE and a dummy write: eleven bits of idle line behind the last frame, TXWAKE is cleared as it goes to WUT, and frames follow.
TEST(sci_idle_line, txwake_sends_eleven_idle_bits)
{
    sci_rig sci;
    sci.set_up();
    sci.w(SCITXBUF, 0xFF);
    sci.w(SCICTL1, 0x2B);
    sci.w(SCITXBUF, 0x00); // dummy
    EXPECT_TRUE(sci.is(SCICTL1, SCICTL1_TXWAKE)) << "double buffered: TXSHF has the frame before";
    sci.bits(10.5);
    EXPECT_FALSE(sci.is(SCICTL1, SCICTL1_TXWAKE));
    EXPECT_FALSE(sci.is(SCICTL2, SCICTL2_TXEMPTY));
    sci.w(SCITXBUF, 0xFF);
    sci.bits(30);
    ASSERT_EQ(sci.edges.size(), 4u);
    const uint64_t ticks =
        f2812_clock_tick(&sci.lspclk, sci.edges[2].at) - f2812_clock_tick(&sci.lspclk, sci.edges[0].at);
    EXPECT_EQ(ticks, (10 + 11) * bit_ticks(BRR_19200));
}

/// What one SCI marks another one knows.
TEST(sci_idle_line, an_address_goes_from_one_sci_to_the_other)
{
    sci_rig sci;
    sci.set_up(BRR_19200, IDLE_MODE | SCICCR_LOOPBKENA);
    sci.bits(3);
    sci.w(SCITXBUF, 0x11);
    sci.bits(10.5);
    EXPECT_EQ(sci.r(SCIRXST), SCIRXST_RXRDY);
    sci.r(SCIRXBUF);
    sci.w(SCICTL1, 0x2B);
    sci.w(SCITXBUF, 0x00);
    sci.w(SCITXBUF, 0x22);
    sci.bits(22);
    EXPECT_EQ(sci.r(SCIRXST), SCIRXST_RXRDY | SCIRXST_RXWAKE);
    EXPECT_EQ(sci.r(SCIRXBUF), 0x22);
}

std::vector<int> with_address(unsigned word, int address)
{
    std::vector<int> levels = sci_rig::frame_8n1(word);
    levels.insert(levels.end() - 1, address);
    return levels;
}

TEST(sci_address_bit, txwake_is_the_address_bit_and_is_cleared)
{
    for (const unsigned parity : {0u, 0x20u, 0x60u})
    {
        sci_rig sci;
        sci.set_up(BRR_19200, ADDRESS_MODE | parity);
        sci.w(SCICTL1, 0x2B);
        sci.w(SCITXBUF, 0x35); // four ones, and the address bit
        EXPECT_FALSE(sci.is(SCICTL1, SCICTL1_TXWAKE));
        sci.bits(20);
        std::vector<int> want = with_address(0x35, 1);
        if (parity)
        {
            want.insert(want.end() - 1, parity == 0x60 ? 1 : 0);
        }
        EXPECT_EQ(sci.sent(want.size()), want) << "parity takes the address bit in";
        const emu_time_t from = sci.now();
        sci.w(SCITXBUF, 0x35);
        sci.bits(20);
        want = with_address(0x35, 0);
        if (parity)
        {
            want.insert(want.end() - 1, parity == 0x60 ? 0 : 1);
        }
        EXPECT_EQ(sci.sent(want.size(), from), want);
    }
}

TEST(sci_address_bit, is_rxwake_and_wakes)
{
    f2812_switches_t switches{};
    for (const uint8_t off : {F2812_SCI_ADDR_ERRATUM_ON, F2812_SCI_ADDR_ERRATUM_OFF})
    {
        switches.sci_addr_erratum = off;
        sci_rig sci(switches);
        sci.set_up(BRR_19200, ADDRESS_MODE);
        sci.w(SCICTL1, ASLEEP);
        sci.bits(30);
        sci.send(with_address(0x01, 0), sci_rig::bit_ps());
        EXPECT_EQ(sci.r(SCIRXST), 0) << "idle line means nothing here";
        sci.send(with_address(0x02, 1), sci_rig::bit_ps());
        EXPECT_EQ(sci.r(SCIRXST), SCIRXST_RXRDY | SCIRXST_RXWAKE);
        EXPECT_EQ(sci.r(SCIRXBUF), 0x02);
        sci.w(SCICTL1, 0x23);
        sci.send(with_address(0x03, 0), sci_rig::bit_ps());
        EXPECT_EQ(sci.r(SCIRXST), SCIRXST_RXRDY);
        EXPECT_EQ(sci.r(SCIRXBUF), 0x03);
    }
}

/// SPRZ193: the stop bit behind the address bit is not looked at, and from SCICLK 6 of the address bit on a start bit is looked for: an
/// address bit of 0 that ends an SCICLK late is one (6, 7, 8 and 1 are low).
TEST(sci_address_bit, erratum)
{
    const auto receive = [](uint8_t off, int address, double late, int stop)
    {
        f2812_switches_t switches{};
        switches.sci_addr_erratum = off;
        sci_rig sci(switches);
        sci.set_up(BRR_19200, ADDRESS_MODE);
        sci.fifo();
        sci.ticks(20 * sciclk_ticks(BRR_19200) + sciclk_ticks(BRR_19200) / 2);
        std::vector<int> levels = with_address(0xFF, address);
        levels.pop_back();
        sci.send(levels, sci_rig::bit_ps());
        sci.bits(late / 8);
        sci.drive(stop != 0);
        sci.bits(1);
        sci.drive(true);
        sci.bits(20);
        return std::make_pair(sci.p(SCIFFRX) >> 8 & 0x1F, sci.is(SCIRXST, SCIRXST_FE));
    };
    using result = std::pair<int, bool>;
    EXPECT_EQ(receive(F2812_SCI_ADDR_ERRATUM_ON, 0, 0.0, 1), result(1, false));
    EXPECT_EQ(receive(F2812_SCI_ADDR_ERRATUM_ON, 0, 0.8, 1), result(2, false)) << "a false start";
    EXPECT_EQ(receive(F2812_SCI_ADDR_ERRATUM_OFF, 0, 0.8, 1), result(1, false));
    EXPECT_EQ(receive(F2812_SCI_ADDR_ERRATUM_ON, 1, 0.0, 0), result(2, false)) << "a missing stop bit is a start bit";
    EXPECT_EQ(receive(F2812_SCI_ADDR_ERRATUM_OFF, 1, 0.0, 0), result(1, true));
}
} // namespace
