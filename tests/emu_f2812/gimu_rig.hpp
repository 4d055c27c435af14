// A GIMU on two wires with a receiver on each, its packets taken apart by the core.
// SPDX-License-Identifier: MIT
#pragma once
#include "emu_f2812/gimu_part.h"
#include "ins/gimu.h"
#include "ins_truth/elementary.h"
#include "ins_truth/gps.h"
#include "ins_truth/track.h"
#include <array>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

constexpr double deg = INS_TRUTH_PI / 180.0;
constexpr emu_time_t second = EMU_PS_PER_S;
constexpr emu_time_t power_up = second * 8 / 100;
/// Chung Hua University, Hsinchu.
constexpr ins_track_site_t hsinchu = {24.757 * deg, 120.951 * deg, 60.0, INS_TRACK_G_THESIS, false};
using Track = std::unique_ptr<ins_track_t, decltype(&ins_track_destroy)>;

/// Packet n begins here when the clock is right.
inline emu_time_t packet_start(std::uint64_t n)
{
    const emu_clock_t six = {6, 1};
    return power_up + emu_clock_time(&six, n);
}

struct Packet
{
    int type;
    ins_gimu_packet_t content;
};

/// What the motion input of a GIMU is in a test.
using Input = std::function<void(std::int64_t t_ps, double rate[3], double force[3])>;
/// What its GPS module says.
using Fix = std::function<bool(std::int64_t t_ps, gimu_fix_t* fix)>;

struct Rig
{
    explicit Rig(const gimu_config_t& wanted, Input moved = nullptr, Fix known = nullptr, emu_time_t power_on = 0)
        : input(std::move(moved)), fix(std::move(known))
    {
        gimu_config_t config = wanted;
        config.motion = input ? motion : config.motion;
        config.motion_ctx = input ? this : config.motion_ctx;
        config.fix = fix ? newest : nullptr;
        config.fix_ctx = this;
        config.sampled = sampled;
        config.sampled_ctx = this;
        emu_sched_init(&sched);
        emu_sched_advance(&sched, power_on);
        emu_wire_init(&t, "GIMU T", false);
        emu_wire_init(&r, "GIMU R", false);
        char why[200] = "";
        EXPECT_TRUE(gimu_init(&gimu, &config, &sched, &t, &r, why, sizeof why)) << why;
        EXPECT_EQ(emu_wire_watch(&t, edge, this), 0);
        EXPECT_EQ(emu_serial_end_init(&t_end, &sched, nullptr, &t, config.baud, take_octet, this), 0);
        EXPECT_EQ(emu_serial_end_init(&r_end, &sched, nullptr, &r, config.nmea_baud, take_character, this), 0);
        ins_gimu_init(&decoder, 1);
    }
    Rig(const Rig&) = delete;
    Rig& operator=(const Rig&) = delete;

    void run_until(emu_time_t at)
    {
        emu_sched_advance(&sched, at);
        const int type = ins_gimu_flush(&decoder);
        if (type != INS_GIMU_NOTHING)
        {
            packets.push_back({type, decoder.packet});
        }
    }
    /// Code of channel i in every packet so far.
    std::vector<double> codes(std::size_t i) const
    {
        std::vector<double> out;
        for (const auto& raw : samples)
        {
            out.push_back(raw[i]);
        }
        return out;
    }

    static void motion(void* ctx, std::int64_t t_ps, double rate[3], double force[3])
    {
        static_cast<Rig*>(ctx)->input(t_ps, rate, force);
    }
    static bool newest(void* ctx, std::int64_t t_ps, gimu_fix_t* fix) { return static_cast<Rig*>(ctx)->fix(t_ps, fix); }
    static void sampled(void* ctx, std::uint64_t packet, const std::uint16_t raw[GIMU_CHANNELS], emu_time_t at)
    {
        auto* const self = static_cast<Rig*>(ctx);
        EXPECT_EQ(packet, self->samples.size());
        self->samples.push_back({raw[0], raw[1], raw[2], raw[3], raw[4], raw[5]});
        self->sampled_at.push_back(at);
    }
    static void edge(void* ctx, bool level, emu_time_t at)
    {
        auto* const self = static_cast<Rig*>(ctx);
        if (!level && (self->falls.empty() || at - self->falls.back() > second / 20))
        {
            self->starts.push_back(at);
        }
        if (!level)
        {
            self->falls.push_back(at);
        }
    }
    static void take_octet(void* ctx, std::uint8_t octet, bool framing_ok, emu_time_t at)
    {
        auto* const self = static_cast<Rig*>(ctx);
        EXPECT_TRUE(framing_ok) << at;
        self->octets.push_back(octet);
        const int type = ins_gimu_rx(&self->decoder, octet);
        if (type != INS_GIMU_NOTHING)
        {
            self->packets.push_back({type, self->decoder.packet});
        }
        self->octet_at.push_back(at);
    }
    static void take_character(void* ctx, std::uint8_t octet, bool framing_ok, emu_time_t at)
    {
        auto* const self = static_cast<Rig*>(ctx);
        EXPECT_TRUE(framing_ok) << at;
        self->text += static_cast<char>(octet);
        self->text_at.push_back(at);
    }

    Input input;
    Fix fix;
    emu_sched_t sched;
    emu_wire_t t, r;
    gimu_t gimu;
    emu_serial_end_t t_end, r_end;
    ins_gimu_t decoder;
    std::vector<std::uint8_t> octets;
    std::vector<emu_time_t> octet_at, text_at, falls, starts, sampled_at;
    std::vector<std::array<std::uint16_t, GIMU_CHANNELS>> samples;
    std::vector<Packet> packets;
    std::string text;
};

inline gimu_config_t default_config()
{
    gimu_config_t config;
    gimu_default_config(&config);
    return config;
}

inline gimu_config_t thesis_config()
{
    gimu_config_t config;
    gimu_thesis_config(&config);
    return config;
}

/// A fix that stays.
inline Fix fixed(double latitude, double longitude, unsigned sats)
{
    return [=](std::int64_t, gimu_fix_t* fix)
    {
        fix->latitude = latitude;
        fix->longitude = longitude;
        fix->sats = sats;
        return true;
    };
}
