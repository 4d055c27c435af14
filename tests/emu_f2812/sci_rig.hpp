/// \file   sci_rig.hpp
/// \brief  One SCI on its own: clocks, two wires, what it says, and a line that the test bends as it likes.
/// SPDX-License-Identifier: MIT
#ifndef SCI_RIG_HPP_INCLUDED
#define SCI_RIG_HPP_INCLUDED
extern "C" {
#include "sci/sci.h"
#include "sci/sci_bits.h"
}
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

constexpr uint64_t SYSCLK_HZ = 150000000;
constexpr uint64_t LSPCLK_HZ = 37500000;
constexpr unsigned BRR_19200 = 0xF3; ///< as the thesis has it

/// LSPCLK ticks of an SCICLK and of a bit.
constexpr uint64_t sciclk_ticks(unsigned brr)
{
    return brr == 0 ? 2 : brr + 1;
}
constexpr uint64_t bit_ticks(unsigned brr)
{
    return 8 * sciclk_ticks(brr);
}

struct sci_rig
{
    struct edge
    {
        emu_time_t at;
        bool level;
    };
    emu_sched_t sched{};
    emu_ticker_t sysclk{};
    f2812_clock_t lspclk{};
    f2812_switches_t switches{};
    emu_wire_t txd{}, rxd{};
    int line = -1;
    sci_t sci{};
    std::vector<edge> edges; ///< of SCITXD
    std::vector<emu_time_t> tx_interrupts, rx_interrupts;
    std::vector<std::string> reports;

    explicit sci_rig(const f2812_switches_t& s = {}, uint64_t divider = 4) : switches(s)
    {
        const emu_clock_t clock{SYSCLK_HZ, 1};
        emu_sched_init(&sched);
        emu_ticker_init(&sysclk, &clock);
        f2812_clock_init(&lspclk, &sysclk, divider);
        emu_wire_init(&txd, "SCITXD", true);
        emu_wire_init(&rxd, "SCIRXD", true);
        line = emu_wire_add_driver(&rxd);
        emu_wire_drive(&rxd, line, EMU_STRONG1, 0);
        emu_wire_watch(
            &txd,
            [](void* c, bool level, emu_time_t at) {
                static_cast<sci_rig*>(c)->edges.push_back({at, level});
            },
            this);
        sci_env_t env{};
        env.sched = &sched;
        env.lspclk = &lspclk;
        env.switches = &switches;
        env.txd = &txd;
        env.rxd = &rxd;
        env.interrupt = [](void* c, bool tx)
        {
            auto* const self = static_cast<sci_rig*>(c);
            (tx ? self->tx_interrupts : self->rx_interrupts).push_back(self->sched.now);
        };
        env.ctx = this;
        env.report.put = [](void* c, emu_report_kind_t kind, const char* text, uint32_t, emu_time_t)
        {
            EXPECT_EQ(kind, EMU_GUEST_ERROR);
            static_cast<sci_rig*>(c)->reports.emplace_back(text);
        };
        env.report.ctx = this;
        env.name = "SCI-A";
        EXPECT_EQ(sci_init(&sci, &env), 0);
        sci_clock(&sci, true);
        sci_pins(&sci, true, true);
    }
    sci_rig(const sci_rig&) = delete;
    sci_rig& operator=(const sci_rig&) = delete;

    uint16_t r(unsigned reg) { return sci_read(&sci, reg); }
    uint16_t p(unsigned reg) const { return sci_peek(&sci, reg); }
    void w(unsigned reg, unsigned value) { sci_write(&sci, reg, static_cast<uint16_t>(value)); }
    bool is(unsigned reg, unsigned bits) const { return (sci_peek(&sci, reg) & bits) == bits; }

    /// As TI's examples do: held, set up, let go.
    void set_up(unsigned brr = BRR_19200, unsigned ccr = 0x07, unsigned ctl2 = 0, unsigned ctl1 = 0x03)
    {
        w(SCICTL1, ctl1);
        w(SCICCR, ccr);
        w(SCICTL2, ctl2);
        w(SCIHBAUD, brr >> 8);
        w(SCILBAUD, brr & 0xFFu);
        w(SCICTL1, ctl1 | SCICTL1_SWRESET);
    }
    void fifo(unsigned tx_level = 0, unsigned rx_level = 1)
    {
        w(SCIFFTX, 0xE040u | tx_level);
        w(SCIFFRX, 0x2040u | rx_level);
    }

    emu_time_t now() const { return sched.now; }
    void at(emu_time_t t) { emu_sched_advance(&sched, t); }
    void pass(emu_time_t ps) { at(sched.now + ps); }
    emu_time_t tick_time(uint64_t tick) const { return f2812_clock_time(&lspclk, tick); }
    uint64_t tick() const { return f2812_clock_tick(&lspclk, sched.now); }
    void ticks(uint64_t n) { at(tick_time(tick() + n)); }
    void bits(double n, unsigned brr = BRR_19200)
    {
        ticks(static_cast<uint64_t>(n * static_cast<double>(bit_ticks(brr))));
    }
    void drive(bool level) { emu_wire_drive(&rxd, line, level ? EMU_STRONG1 : EMU_STRONG0, sched.now); }

    /// Levels on SCIRXD, one a bit, from now on; returns as the last one ends.
    void send(const std::vector<int>& levels, double bit_ps)
    {
        const emu_time_t from = sched.now;
        for (size_t i = 0; i < levels.size(); ++i)
        {
            at(from + static_cast<emu_time_t>(static_cast<double>(i) * bit_ps));
            drive(levels[i] != 0);
        }
        at(from + static_cast<emu_time_t>(static_cast<double>(levels.size()) * bit_ps));
    }
    static std::vector<int> frame_8n1(unsigned octet)
    {
        std::vector<int> levels{0};
        for (unsigned i = 0; i < 8; ++i)
        {
            levels.push_back(octet >> i & 1);
        }
        levels.push_back(1);
        return levels;
    }
    static double bit_ps(unsigned brr = BRR_19200) { return static_cast<double>(bit_ticks(brr)) * 1e12 / LSPCLK_HZ; }
    void send_octet(unsigned octet, unsigned brr = BRR_19200) { send(frame_8n1(octet), bit_ps(brr)); }
    /// Level of SCITXD at an instant.
    bool txd_at(emu_time_t t) const
    {
        bool level = true;
        for (const edge& e : edges)
        {
            level = e.at <= t ? e.level : level;
        }
        return level;
    }
    /// Levels of SCITXD in the middles of bits from its first fall at or after `from` on.
    std::vector<int> sent(size_t count, emu_time_t from = 0, unsigned brr = BRR_19200) const
    {
        std::vector<int> levels;
        for (const edge& e : edges)
        {
            if (e.at >= from && !e.level)
            {
                for (size_t i = 0; i < count; ++i)
                {
                    levels.push_back(
                        txd_at(e.at + static_cast<emu_time_t>((static_cast<double>(i) + 0.5) * bit_ps(brr))));
                }
                break;
            }
        }
        return levels;
    }
};

/// Larger counts where INS_BENCH=1 asks for them.
inline unsigned sci_count(unsigned usual, unsigned bench)
{
    const char* const asked = std::getenv("INS_BENCH");
    return asked != nullptr && std::string(asked) == "1" ? bench : usual;
}

#endif // SCI_RIG_HPP_INCLUDED
