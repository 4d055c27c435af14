/// Serial ends: octets as bits on a wire, sampled by another clock.
/// SPDX-License-Identifier: MIT
#include "emu/serial.h"
#include <gtest/gtest.h>
#include <memory>
#include <vector>

namespace
{
struct rx_t
{
    std::vector<uint8_t> octets;
    std::vector<bool> framing_ok;
    std::vector<emu_time_t> at;
    static void put(void* ctx, uint8_t octet, bool framing_ok, emu_time_t at)
    {
        auto* self = static_cast<rx_t*>(ctx);
        self->octets.push_back(octet);
        self->framing_ok.push_back(framing_ok);
        self->at.push_back(at);
    }
};

struct link_t
{
    explicit link_t(double tx_baud, double rx_baud)
    {
        emu_sched_init(&sched);
        emu_wire_init(&wire, "line", true);
        emu_wire_init(&back, "back", true);
        EXPECT_EQ(emu_serial_end_init(&tx, &sched, &wire, &back, tx_baud, nullptr, nullptr), 0);
        EXPECT_EQ(emu_serial_end_init(&rx, &sched, nullptr, &wire, rx_baud, rx_t::put, &got), 0);
    }
    void all_octets()
    {
        for (unsigned i = 0; i < 256; i++)
        {
            sent.push_back(static_cast<uint8_t>(i * 167 + 13));
            EXPECT_TRUE(emu_serial_end_send(&tx, sent.back()));
        }
        emu_sched_advance(&sched, sched.now + static_cast<emu_time_t>(256 * 10.5e12 / tx.baud));
    }
    emu_sched_t sched;
    emu_wire_t wire, back;
    emu_serial_end_t tx, rx;
    rx_t got;
    std::vector<uint8_t> sent;
};

TEST(serial_end, carries_every_octet_back_to_back)
{
    for (const double baud : {50.0, 9600.0, 57600.0, 4e6})
    {
        const auto l = std::make_unique<link_t>(baud, baud);
        l->all_octets();
        EXPECT_EQ(l->got.octets, l->sent) << baud;
        EXPECT_EQ(l->tx.octets_sent, 256u);
        EXPECT_EQ(l->rx.octets_received, 256u);
        EXPECT_EQ(l->rx.framing_errors + l->rx.false_starts, 0u);
        // The last decision: 255 frames, then 9 bits and 9/16.
        EXPECT_NEAR(static_cast<double>(l->got.at.back()), (2550 + 9.5625) * 1e12 / baud, 256.0);
    }
}

TEST(serial_end, puts_each_bit_at_its_instant)
{
    const auto l = std::make_unique<link_t>(9600.0, 9600.0);
    struct edges_t
    {
        std::vector<emu_time_t> at;
    } edges;
    emu_wire_watch(
        &l->wire, [](void* c, bool, emu_time_t at) { static_cast<edges_t*>(c)->at.push_back(at); }, &edges);
    emu_sched_advance(&l->sched, 1000);
    emu_serial_end_send(&l->tx, 0x55); // start 0, then 1010 1010, stop 1: an edge at each bit
    emu_sched_advance(&l->sched, EMU_PS_PER_S);
    ASSERT_EQ(edges.at.size(), 10u);
    for (unsigned n = 0; n < 10; n++)
    {
        EXPECT_EQ(edges.at[n], 1000 + static_cast<emu_time_t>(n * 1e12 / 9600.0 + 0.5)) << "bit " << n;
    }
}

TEST(serial_end, a_small_mismatch_is_harmless_and_a_large_one_shows)
{
    for (const double off : {-0.04, -0.02, 0.02, 0.04})
    {
        const auto l = std::make_unique<link_t>(9600.0, 9600.0 * (1.0 + off));
        l->all_octets();
        EXPECT_EQ(l->got.octets, l->sent) << off;
        EXPECT_EQ(l->rx.framing_errors, 0u) << off;
    }
    for (const double baud : {9600.0 * 0.93, 9600.0 * 1.085, 4800.0, 19200.0})
    {
        const auto l = std::make_unique<link_t>(9600.0, baud);
        l->all_octets();
        EXPECT_NE(l->got.octets, l->sent) << baud;
        EXPECT_GT(l->rx.framing_errors, 0u) << baud;
    }
}

TEST(serial_end, a_glitch_at_one_of_three_samples_is_outvoted)
{
    constexpr double kBit = 1e12 / 9600.0;
    for (int samples = 1; samples <= 2; samples++)
    {
        const auto l = std::make_unique<link_t>(9600.0, 9600.0);
        const int d = emu_wire_add_driver(&l->wire);
        emu_serial_end_send(&l->tx, 0xFF);
        // Pull the line low (a contention, which reads low) around the first samples of data bit 3.
        emu_sched_advance(&l->sched, static_cast<emu_time_t>(kBit * (4 + 6.5 / 16)));
        emu_wire_drive(&l->wire, d, EMU_STRONG0, l->sched.now);
        emu_sched_advance(&l->sched, static_cast<emu_time_t>(kBit * (4 + (6.5 + samples) / 16)));
        emu_wire_drive(&l->wire, d, EMU_Z, l->sched.now);
        emu_sched_advance(&l->sched, EMU_PS_PER_S);
        ASSERT_EQ(l->got.octets.size(), 1u);
        EXPECT_EQ(l->got.octets[0], samples == 1 ? 0xFF : 0xF7) << samples << " samples hit";
    }
}

TEST(serial_end, a_short_low_is_a_false_start_and_a_break_is_one_framing_error)
{
    const auto l = std::make_unique<link_t>(9600.0, 9600.0);
    const int d = emu_wire_add_driver(&l->wire);
    emu_wire_drive(&l->wire, d, EMU_STRONG0, l->sched.now);
    emu_sched_advance(&l->sched, 40 * EMU_PS_PER_US);
    emu_wire_drive(&l->wire, d, EMU_Z, l->sched.now);
    emu_sched_advance(&l->sched, EMU_PS_PER_S);
    EXPECT_EQ(l->rx.false_starts, 1u);
    EXPECT_TRUE(l->got.octets.empty());
    emu_wire_drive(&l->wire, d, EMU_STRONG0, l->sched.now);
    emu_sched_advance(&l->sched, 2 * EMU_PS_PER_S);
    emu_wire_drive(&l->wire, d, EMU_Z, l->sched.now);
    emu_sched_advance(&l->sched, 3 * EMU_PS_PER_S);
    EXPECT_EQ(l->got.octets, std::vector<uint8_t>{0});
    EXPECT_EQ(l->rx.framing_errors, 1u);
}

TEST(serial_end, another_baud_is_that_of_the_next_bits)
{
    const auto l = std::make_unique<link_t>(9600.0, 9600.0);
    for (const double baud : {4800.0, 57600.0, 9600.0})
    {
        EXPECT_TRUE(emu_serial_end_set_baud(&l->tx, baud));
        EXPECT_TRUE(emu_serial_end_set_baud(&l->rx, baud));
        l->got = {};
        l->sent.clear();
        l->all_octets();
        EXPECT_EQ(l->got.octets, l->sent) << baud;
    }
    EXPECT_FALSE(emu_serial_end_set_baud(&l->rx, 49.0));
    EXPECT_EQ(l->rx.baud, 9600.0);
    // In the middle of a frame: the bits that were heard stay, and the frame ends at the new pace.
    l->got = {};
    emu_serial_end_send(&l->tx, 0x0F);
    const emu_time_t start = l->sched.now;
    emu_sched_advance(&l->sched,
                      start + static_cast<emu_time_t>(5.2e12 / 9600.0)); // in bit 4 of the octet, the first 0
    EXPECT_TRUE(emu_serial_end_set_baud(&l->rx, 9600.0 / 1.05));
    emu_sched_advance(&l->sched, start + static_cast<emu_time_t>(12e12 / 9600.0));
    ASSERT_EQ(l->got.octets, std::vector<uint8_t>{0x0F});
    EXPECT_NEAR(static_cast<double>(l->got.at[0] - start), 9.5625 * 1.05e12 / 9600.0, 1.0);
}

TEST(serial_end, a_full_queue_is_counted_and_bad_arguments_are_refused)
{
    const auto l = std::make_unique<link_t>(9600.0, 9600.0);
    for (int i = 0; i < EMU_SERIAL_FIFO + 1; i++)
    {
        EXPECT_TRUE(emu_serial_end_send(&l->tx, 0)); // one is in the shift register
    }
    EXPECT_FALSE(emu_serial_end_send(&l->tx, 0));
    EXPECT_EQ(l->tx.overflow, 1u);
    EXPECT_FALSE(emu_serial_end_send(&l->rx, 0)) << "a listener cannot send";
    const auto end = std::make_unique<emu_serial_end_t>();
    for (const double baud : {0.0, 49.0, 4.1e6, -9600.0, std::numeric_limits<double>::quiet_NaN()})
    {
        EXPECT_EQ(emu_serial_end_init(end.get(), &l->sched, &l->wire, &l->back, baud, nullptr, nullptr), -1) << baud;
    }
    while (emu_wire_add_driver(&l->wire) >= 0)
    {
    }
    EXPECT_EQ(emu_serial_end_init(end.get(), &l->sched, &l->wire, &l->back, 9600.0, nullptr, nullptr), -1);
}
} // namespace
