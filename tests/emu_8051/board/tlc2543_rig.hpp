/// \file   tlc2543_rig.hpp
/// \brief  A TLC2543 with its five wires in the test's hand.
/// SPDX-License-Identifier: MIT
#pragma once
#include "emu_8051/tlc2543.h"
#include <gtest/gtest.h>
#include <string>
#include <vector>

constexpr emu_time_t kUs = EMU_PS_PER_US;
constexpr double kLsb = 5.0 / 4096;
constexpr unsigned kPowerUp = 0xA5A;

struct sample_t
{
    unsigned channel;
    uint16_t code;
    double volts;
    emu_time_t at;
};

struct adc_t
{
    adc_t() { tlc2543_default_config(&config); }
    ~adc_t() { tlc2543_destroy(chip); }
    void start()
    {
        emu_sched_init(&sched);
        const char* const names[] = {"EOC", "I/O CLOCK", "DATA IN", "DATA OUT", "/CS"};
        for (int i = 0; i < 5; i++)
        {
            emu_wire_init(&w[i], names[i], i != 1);
            d[i] = emu_wire_add_driver(&w[i]);
        }
        set(kClock, false);
        set(kCs, true);
        config.analog = {
            [](void* ctx, unsigned channel, int64_t t) { return static_cast<adc_t*>(ctx)->volts(channel, t); }, this};
        config.sampled = [](void* ctx, unsigned channel, uint16_t code, double v, emu_time_t at) {
            static_cast<adc_t*>(ctx)->samples.push_back({channel, code, v, at});
        };
        config.sampled_ctx = this;
        config.report = {[](void* ctx, emu_report_kind_t kind, const char* text, uint32_t, emu_time_t)
                         {
                             auto* self = static_cast<adc_t*>(ctx);
                             (kind == EMU_GUEST_ERROR ? self->guest : self->gap).emplace_back(text);
                         },
                         this};
        chip = tlc2543_create(&config, &sched, &w[kEoc], &w[kClock], &w[kIn], &w[kOut], &w[kCs]);
        ASSERT_NE(chip, nullptr);
    }
    enum
    {
        kEoc,
        kClock,
        kIn,
        kOut,
        kCs
    };
    void set(int wire, bool level) { emu_wire_drive(&w[wire], d[wire], level ? EMU_STRONG1 : EMU_STRONG0, sched.now); }
    void wait(emu_time_t t) { emu_sched_advance(&sched, sched.now + t); }
    void select()
    {
        set(kCs, false);
        wait(2 * kUs);
    }
    /// Clocks with the 16-bit command word's upper bits out, DATA OUT in; reads before each rising edge.
    unsigned clocks(unsigned n, unsigned command)
    {
        unsigned word = 0;
        for (unsigned i = 0; i < n; i++)
        {
            set(kIn, i < 8 && (command >> (7 - i) & 1u) != 0);
            word = word << 1 | w[kOut].level;
            wait(kUs);
            set(kClock, true);
            wait(kUs);
            set(kClock, false);
        }
        return word;
    }
    void deselect()
    {
        set(kCs, true);
        wait(20 * kUs);
    }
    unsigned transfer(unsigned n, unsigned command)
    {
        select();
        const unsigned word = clocks(n, command);
        wait(kUs);
        deselect();
        return word;
    }
    double volts(unsigned channel, int64_t t) const
    {
        return channel < 11 ? fixed[channel] + slope * static_cast<double>(t) : -1.0;
    }

    tlc2543_config_t config;
    emu_sched_t sched;
    emu_wire_t w[5];
    int d[5];
    tlc2543_t* chip = nullptr;
    std::vector<sample_t> samples;
    std::vector<std::string> guest, gap;
    double fixed[11] = {}, slope = 0.0;
};

class tlc2543 : public testing::Test
{
  protected:
    void SetUp() override
    {
        for (int i = 0; i < 11; i++)
        {
            adc.fixed[i] = (0x123 + 0x111 * i) * kLsb;
        }
        adc.start();
    }
    void TearDown() override
    {
        for (const std::string& text : adc.guest)
        {
            EXPECT_FALSE(quiet) << text;
        }
        EXPECT_TRUE(adc.gap.empty());
    }
    unsigned expect_guest(const char* part)
    {
        quiet = false;
        unsigned n = 0;
        for (const std::string& text : adc.guest)
        {
            n += text.find(part) != std::string::npos;
        }
        return n;
    }
    bool quiet = true;
    adc_t adc;
};
