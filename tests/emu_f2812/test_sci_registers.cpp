/// \file   test_sci_registers.cpp
/// \brief  Registers of the SCI: reset values, what can be written, what a write and a read do (docs/f2812.md, tables of the SCI).
/// SPDX-License-Identifier: MIT
#include "sci_rig.hpp"

namespace
{
constexpr unsigned ALL[] = {SCICCR,   SCICTL1,  SCIHBAUD, SCILBAUD, SCICTL2, SCIRXST, SCIRXEMU,
                            SCIRXBUF, SCITXBUF, SCIFFTX,  SCIFFRX,  SCIFFCT, SCIPRI};

TEST(sci_registers, reset_values)
{
    sci_rig sci;
    const auto expect_reset = [&]
    {
        for (const unsigned reg : ALL)
        {
            const unsigned want = reg == SCICTL2 ? 0xC0 : reg == SCIFFTX ? 0xA000 : reg == SCIFFRX ? 0x201F : 0;
            EXPECT_EQ(sci.p(reg), want) << reg;
            EXPECT_EQ(sci.r(reg), want) << reg;
        }
    };
    expect_reset();
    sci.set_up(BRR_19200, 0xEF, 3, 0x4F);
    sci.fifo(5, 5);
    sci.w(SCIFFCT, 0x2007);
    sci.w(SCIPRI, 0x18);
    sci.w(SCITXBUF, 0x55);
    sci.ticks(5000);
    sci_reset(&sci.sci);
    expect_reset();
    EXPECT_TRUE(sci.txd.level);
}

/// Written as ones and as zeros, FIFO off: what sticks.
TEST(sci_registers, writable_bits)
{
    const struct
    {
        unsigned reg, ones, zeros;
    } rows[] = {{SCICCR, 0x00FF, 0x0000},   {SCICTL1, 0x006F, 0x0000},  {SCIHBAUD, 0x00FF, 0x0000},
                {SCILBAUD, 0x00FF, 0x0000}, {SCICTL2, 0x00C3, 0x00C0},  {SCIRXST, 0x0000, 0x0000},
                {SCIRXEMU, 0x0000, 0x0000}, {SCIRXBUF, 0x0000, 0x0000}, {8, 0x0000, 0x0000},
                {SCITXBUF, 0x00FF, 0x0000}, {SCIFFRX, 0x203F, 0x0000},  {SCIFFCT, 0x20FF, 0x0000},
                {0xD, 0x0000, 0x0000},      {0xE, 0x0000, 0x0000},      {SCIPRI, 0x0018, 0x0000}};
    for (const auto& row : rows)
    {
        sci_rig sci;
        sci.w(row.reg, 0xFFFF);
        EXPECT_EQ(sci.p(row.reg), row.ones) << row.reg;
        sci.w(row.reg, 0);
        EXPECT_EQ(sci.p(row.reg), row.zeros) << row.reg;
    }
    sci_rig sci;
    sci.w(SCIFFTX, 0xBFFF);
    EXPECT_EQ(sci.p(SCIFFTX), 0xA03F);
}

/// A reader of an F28346 wrote E040 and 204F, and read E080 and 200F.
TEST(sci_registers, clear_bits_read_zero_and_an_empty_transmit_fifo_sets_its_flag_at_once)
{
    sci_rig sci;
    sci.set_up();
    sci.w(SCIFFTX, 0xE040);
    sci.w(SCIFFRX, 0x204F);
    EXPECT_EQ(sci.r(SCIFFTX), 0xE080);
    EXPECT_EQ(sci.r(SCIFFRX), 0x200F);
    sci.w(SCIFFCT, 0x4000);
    EXPECT_EQ(sci.r(SCIFFCT), 0);
}

TEST(sci_registers, reading_scirxbuf_clears_rxrdy_and_reading_scirxemu_does_not)
{
    sci_rig sci;
    sci.set_up();
    sci.send_octet(0x5A);
    EXPECT_TRUE(sci.is(SCIRXST, SCIRXST_RXRDY));
    EXPECT_EQ(sci.r(SCIRXEMU), 0x5A);
    EXPECT_EQ(sci.p(SCIRXBUF), 0x5A);
    EXPECT_TRUE(sci.is(SCIRXST, SCIRXST_RXRDY));
    EXPECT_EQ(sci.r(SCIRXBUF), 0x5A);
    EXPECT_EQ(sci.r(SCIRXST), 0);
}

TEST(sci_registers, swreset_0_clears_the_flags_holds_both_ways_and_keeps_the_configuration)
{
    sci_rig sci;
    sci.set_up(BRR_19200, 0x27, 3);
    sci.w(SCITXBUF, 0x00);
    sci.w(SCITXBUF, 0x00);
    std::vector<int> wrong = sci_rig::frame_8n1(0xA5); // parity and stop bit low: PE and FE
    wrong.back() = 0;
    wrong.push_back(0);
    sci.send(wrong, sci_rig::bit_ps());
    sci.drive(true);
    sci.bits(2);
    EXPECT_TRUE(sci.is(SCIRXST, SCIRXST_RXERROR | SCIRXST_RXRDY | SCIRXST_FE));
    EXPECT_FALSE(sci.is(SCICTL2, SCICTL2_TXEMPTY));
    sci.w(SCICTL1, 0x03);
    EXPECT_EQ(sci.r(SCIRXST), 0);
    EXPECT_EQ(sci.r(SCICTL2), 0xC3);
    EXPECT_EQ(sci.r(SCICCR), 0x27);
    EXPECT_EQ(sci.r(SCILBAUD), BRR_19200);
    EXPECT_TRUE(sci.txd.level) << "the frame is cut off";
    const size_t edges = sci.edges.size();
    sci.send_octet(0x5A);
    sci.w(SCITXBUF, 0x33);
    sci.bits(20);
    EXPECT_EQ(sci.r(SCIRXST), 0) << "held";
    EXPECT_EQ(sci.r(SCICTL2), 0xC3) << "held";
    EXPECT_EQ(sci.edges.size(), edges) << "held";
    sci.w(SCICTL1, 0x23);
    sci.bits(20);
    EXPECT_EQ(sci.edges.size(), edges) << "what was written is gone";
    EXPECT_EQ(sci.reports.size(), 1u);
}

/// FE, OE, PE and BRKDT stay until SWRESET, RXERROR is their OR.
TEST(sci_registers, error_flags_stay_until_swreset)
{
    for (const uint8_t by_read : {F2812_SCI_ERRORS_SWRESET, F2812_SCI_ERRORS_READ})
    {
        f2812_switches_t switches{};
        switches.sci_errors = by_read;
        sci_rig sci(switches);
        sci.set_up();
        std::vector<int> bad = sci_rig::frame_8n1(0xFF);
        bad.back() = 0;
        sci.send(bad, sci_rig::bit_ps());
        sci.drive(true);
        sci.bits(1);
        EXPECT_EQ(sci.r(SCIRXST), SCIRXST_RXERROR | SCIRXST_RXRDY | SCIRXST_FE);
        EXPECT_EQ(sci.r(SCIRXBUF), 0xFF);
        EXPECT_EQ(sci.r(SCIRXST), by_read ? 0 : SCIRXST_RXERROR | SCIRXST_FE);
        sci.send_octet(0x11);
        EXPECT_EQ(sci.r(SCIRXST), by_read ? SCIRXST_RXRDY : SCIRXST_RXERROR | SCIRXST_RXRDY | SCIRXST_FE)
            << "a good frame clears none";
        EXPECT_EQ(sci.r(SCIRXBUF), 0x11);
        sci.w(SCICTL1, 0x03);
        EXPECT_EQ(sci.r(SCIRXST), 0);
    }
}

TEST(sci_registers, a_character_before_the_last_was_read_sets_oe_and_replaces_it)
{
    sci_rig sci;
    sci.set_up();
    sci.send_octet(0x11);
    sci.send_octet(0x22);
    EXPECT_EQ(sci.r(SCIRXST), SCIRXST_RXERROR | SCIRXST_RXRDY | SCIRXST_OE);
    EXPECT_EQ(sci.r(SCIRXBUF), 0x22);
    ASSERT_EQ(sci.reports.size(), 1u);
    EXPECT_EQ(sci.reports[0], "SCI-A: overrun: the character before it was not read");
    sci.send_octet(0x33);
    sci.send_octet(0x44);
    EXPECT_EQ(sci.reports.size(), 1u) << "told as OE is set, not again";
}

/// Interrupts without FIFO: a character by RXBKINTENA, an error that begins by RXERRINTENA, and one edge for both.
TEST(sci_registers, rxint_by_rxbkintena_and_rxerrintena)
{
    const struct
    {
        unsigned ctl2, ctl1;
        size_t good, bad, bad_again;
    } rows[] = {{0, 0x03, 0, 0, 0}, {2, 0x03, 1, 2, 3}, {0, 0x43, 0, 1, 1}, {2, 0x43, 1, 2, 3}};
    for (const auto& row : rows)
    {
        sci_rig sci;
        sci.set_up(BRR_19200, 0x07, row.ctl2, row.ctl1);
        std::vector<int> bad = sci_rig::frame_8n1(0xFF);
        bad.back() = 0;
        bad.push_back(1);
        sci.send_octet(0x11);
        EXPECT_EQ(sci.rx_interrupts.size(), row.good);
        sci.r(SCIRXBUF);
        sci.send(bad, sci_rig::bit_ps());
        EXPECT_EQ(sci.rx_interrupts.size(), row.bad);
        sci.r(SCIRXBUF);
        sci.send(bad, sci_rig::bit_ps());
        EXPECT_EQ(sci.rx_interrupts.size(), row.bad_again) << "RXERROR was set already";
        EXPECT_EQ(sci.tx_interrupts.size(), 0u);
    }
}

/// "An interrupt cannot fire until we write to SCITXBUF": enabling it with TXRDY = 1 is none.
TEST(sci_registers, txint_is_an_edge_at_each_load_of_txshf)
{
    sci_rig sci;
    sci.set_up();
    sci.w(SCICTL2, SCICTL2_TXINTENA);
    sci.bits(20);
    EXPECT_EQ(sci.tx_interrupts.size(), 0u);
    sci.w(SCITXBUF, 0x00);
    EXPECT_EQ(sci.tx_interrupts.size(), 1u);
    EXPECT_EQ(sci.r(SCICTL2), SCICTL2_TXRDY | SCICTL2_TXINTENA);
    sci.w(SCITXBUF, 0x00);
    EXPECT_EQ(sci.r(SCICTL2), SCICTL2_TXINTENA);
    EXPECT_EQ(sci.tx_interrupts.size(), 1u);
    sci.bits(10.5);
    EXPECT_EQ(sci.tx_interrupts.size(), 2u);
    EXPECT_EQ(sci.r(SCICTL2), SCICTL2_TXRDY | SCICTL2_TXINTENA);
    sci.bits(10);
    EXPECT_EQ(sci.tx_interrupts.size(), 2u);
    EXPECT_EQ(sci.r(SCICTL2), SCICTL2_TXRDY | SCICTL2_TXEMPTY | SCICTL2_TXINTENA);
    EXPECT_EQ(sci.reports.size(), 0u);
}

TEST(sci_registers, a_write_before_txrdy_replaces_the_word_and_is_reported)
{
    sci_rig sci;
    sci.set_up();
    sci.w(SCITXBUF, 0xFF);
    sci.w(SCITXBUF, 0x01);
    sci.w(SCITXBUF, 0x02);
    ASSERT_EQ(sci.reports.size(), 1u);
    EXPECT_EQ(sci.reports[0], "SCI-A: SCITXBUF written before TXRDY: the word before it is lost");
    sci.bits(10.5);
    const emu_time_t second = sci.now();
    sci.bits(20);
    EXPECT_EQ(sci.sent(10, second - static_cast<emu_time_t>(sci_rig::bit_ps())), sci_rig::frame_8n1(0x02));
}

TEST(sci_registers, format_and_baud_changed_amid_a_frame_are_reported)
{
    for (const unsigned reg : {SCICCR, SCIHBAUD, SCILBAUD})
    {
        sci_rig sci;
        sci.set_up();
        sci.w(reg, sci.r(reg));
        sci.w(SCITXBUF, 0);
        sci.bits(3);
        sci.w(reg, sci.r(reg));
        EXPECT_EQ(sci.reports.size(), 0u);
        sci.w(reg, 0x03);
        EXPECT_EQ(sci.reports.size(), 1u);
        sci_rig receiving;
        receiving.set_up();
        receiving.drive(false);
        receiving.bits(3);
        receiving.w(reg, 0x03);
        EXPECT_EQ(receiving.reports.size(), 1u);
    }
}
} // namespace
