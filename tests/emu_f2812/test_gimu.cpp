// The GIMU's packets: cadence, sampling instant, layout, coordinates, clock error, seed, refusals.
// SPDX-License-Identifier: MIT
#include "gimu_rig.hpp"
#include <cmath>

namespace
{
constexpr int rest_code_z = 1054; // 2047 - 800 mV * 4095 / 3300 mV = 1054.27
constexpr double lsb_rate = 3300.0 / 4095.0 / 4.0 * deg;
constexpr double lsb_force = 3300.0 / 4095.0 / 800.0 * 9.8;
} // namespace

TEST(gimu, six_packets_a_second_the_sixth_with_coordinates)
{
    Rig rig(default_config(), nullptr, fixed(24.757 * deg, 120.951 * deg, 7));
    rig.run_until(10 * second + power_up - 1);
    ASSERT_EQ(rig.packets.size(), 60u);
    ASSERT_EQ(rig.starts.size(), 60u);
    EXPECT_LE(rig.starts[0], second / 10) << "the thesis: within 100 ms";
    EXPECT_EQ(rig.octets.size(), 10u * (5 * INS_GIMU_T1_LEN + INS_GIMU_T2_LEN));
    EXPECT_EQ(rig.decoder.skipped, 0u);
    std::size_t octet = 0;
    for (std::size_t n = 0; n < 60; n++)
    {
        const Packet& p = rig.packets[n];
        EXPECT_EQ(rig.starts[n], packet_start(n)) << n;
        EXPECT_EQ(rig.sampled_at[n], packet_start(n)) << n;
        EXPECT_EQ(p.type, n % 6 == 5 ? INS_GIMU_T2 : INS_GIMU_T1) << n;
        for (std::size_t i = 0; i < GIMU_CHANNELS; i++)
        {
            EXPECT_EQ(p.content.raw[i], i == 5 ? rest_code_z : 2047) << n << " channel " << i;
            EXPECT_EQ(p.content.raw[i], rig.samples[n][i]);
        }
        // Its octets follow each other without a pause; the decision of one comes at 9/16 of its stop bit.
        const std::size_t length = p.type == INS_GIMU_T2 ? INS_GIMU_T2_LEN : INS_GIMU_T1_LEN;
        for (std::size_t k = 0; k < length; k++, octet++)
        {
            const double bits = 10.0 * static_cast<double>(k) + 9.0 + 9.0 / 16.0;
            EXPECT_NEAR(static_cast<double>(rig.octet_at[octet] - packet_start(n)), bits * 1e12 / 19200.0, 50.0) << n;
        }
    }
    EXPECT_EQ(rig.gimu.packets, 60u);
    EXPECT_EQ(rig.gimu.clipped, 0u);
}

TEST(gimu, pins_idle_high_from_power_on)
{
    Rig rig(default_config());
    EXPECT_TRUE(rig.t.level);
    EXPECT_TRUE(rig.r.level);
    EXPECT_FALSE(rig.t.floating);
}

TEST(gimu, time_counts_from_power_on)
{
    gimu_config_t config = default_config();
    config.channel[0].drift_v_s = 3.3 / 4095.0; // a code a second
    const emu_time_t on = 7 * second + second / 7;
    Rig rig(config, nullptr, nullptr, on);
    rig.run_until(on + 10 * second);
    ASSERT_EQ(rig.samples.size(), 60u);
    for (std::size_t n = 0; n < 60; n++)
    {
        EXPECT_EQ(rig.starts[n], on + packet_start(n)) << n;
        EXPECT_NEAR(rig.samples[n][0], 2047.0 + static_cast<double>(packet_start(n)) * 1e-12, 0.5 + 1e-9) << n;
    }
    const emu_time_t burst = 8 * second + config.nmea_delay; // the first whole second that the module lives to see
    ASSERT_FALSE(rig.text_at.empty());
    EXPECT_NEAR(static_cast<double>(rig.text_at[0] - burst), 9.5625e12 / 4800.0, 200.0);
}

TEST(gimu, samples_are_of_the_start_of_the_first_bit)
{
    // 40 deg/s and 10 m/s^2 in a second: a code is passed every 5 ms and 0.8 ms.
    const auto ramp = [](std::int64_t t_ps, double rate[3], double force[3])
    {
        const double t = static_cast<double>(t_ps) * 1e-12;
        for (int i = 0; i < 3; i++)
        {
            rate[i] = (i + 1) * 40.0 * deg * (t - 0.5);
            force[i] = (3 - i) * 3.0 * (t - 0.5);
        }
    };
    Rig rig(default_config(), ramp);
    rig.run_until(second);
    ASSERT_EQ(rig.samples.size(), 6u);
    for (std::size_t n = 0; n < 6; n++)
    {
        double rate[3];
        double force[3];
        ramp(packet_start(n), rate, force);
        for (std::size_t i = 0; i < 3; i++)
        {
            EXPECT_NEAR(rig.samples[n][i], 2047.0 + rate[i] / lsb_rate, 0.5 + 1e-6) << n;
            EXPECT_NEAR(rig.samples[n][3 + i], 2047.0 + force[i] / lsb_force, 0.5 + 1e-6) << n;
        }
    }
}

TEST(gimu, a_track_comes_out_of_the_core_again)
{
    const ins_track_speed_t speed = {6.0, 2.0, 3.0, 40.0, 3.0};
    const Track track(ins_track_create_circle(&hsinchu, 0.4, 30.0, &speed, nullptr, nullptr, 0), ins_track_destroy);
    gimu_config_t config = default_config();
    config.motion = ins_track_motion;
    config.motion_ctx = track.get();
    Rig rig(config);
    rig.run_until(60 * second);
    ins_gimu_scale_t scale;
    ins_gimu_scale_nominal(&scale);
    double turned = 0.0;
    for (std::size_t n = 0; n < rig.packets.size(); n++)
    {
        ins_track_state_t truth;
        ins_real dtheta[3];
        ins_real dv[3];
        ins_track_at(track.get(), static_cast<double>(packet_start(n)) * 1e-12, &truth);
        ins_gimu_increments(&scale, rig.packets[n].content.raw, 1, dtheta, dv);
        for (int i = 0; i < 3; i++)
        {
            EXPECT_NEAR(dtheta[i], truth.w_ib_b[i], 0.5001 * lsb_rate) << n;
            EXPECT_NEAR(dv[i], truth.f_b[i], 0.5001 * lsb_force) << n;
        }
        turned += dtheta[2] / 6.0;
    }
    EXPECT_NEAR(turned, 6.0 * 43.0 / 30.0, 0.02) << "way over radius";
}

TEST(gimu, coordinates_are_degrees_and_minutes_in_the_order_asked_for)
{
    gimu_config_t config = default_config();
    for (const gimu_order_t order : {GIMU_LONGITUDE_FIRST, GIMU_LATITUDE_FIRST})
    {
        config.order = order;
        Rig rig(config, nullptr, fixed((24.0 + 59.0 / 60.0) * deg, (120.0 + 12.3456 / 60.0) * deg, 4));
        rig.run_until(second + power_up - 1);
        const ins_gimu_packet_t& p = rig.packets[5].content;
        const std::size_t longitude = order == GIMU_LONGITUDE_FIRST ? 0 : 1;
        EXPECT_EQ(p.coordinate[longitude], 120123456u) << "figure 4.5";
        EXPECT_EQ(p.coordinate[1 - longitude], 24590000u);
        EXPECT_EQ(p.sats, 4u);
        EXPECT_EQ(p.has_position, 1u);
        EXPECT_NEAR(p.lat_e7, 249833333, 1);
        EXPECT_NEAR(p.lon_e7, 1202057600, 1);
    }
    // Figure 4.5, octets 14 to 22 of a type 2 packet.
    config.order = GIMU_LONGITUDE_FIRST;
    Rig rig(config, nullptr, fixed((24.0 + 59.0 / 60.0) * deg, (120.0 + 12.3456 / 60.0) * deg, 4));
    rig.run_until(second + power_up - 1);
    const std::vector<std::uint8_t> end(rig.octets.end() - 9, rig.octets.end());
    EXPECT_EQ(end, (std::vector<std::uint8_t>{0x07, 0x28, 0xF0, 0x40, 0x01, 0x77, 0x36, 0xB0, 0x04}));
}

TEST(gimu, coordinates_carry_at_60_minutes_and_lose_the_hemisphere)
{
    const auto sent = [](double latitude, double longitude)
    {
        Rig rig(default_config(), nullptr, fixed(latitude * deg, longitude * deg, 9));
        rig.run_until(second + power_up - 1);
        const ins_gimu_packet_t& p = rig.packets[5].content;
        return std::array<std::uint32_t, 2>{p.coordinate[1], p.coordinate[0]};
    };
    EXPECT_EQ(sent(24.999999999, 120.999999999), (std::array<std::uint32_t, 2>{25000000, 121000000}));
    EXPECT_EQ(sent(24.0 + 59.99994 / 60.0, 0.0), (std::array<std::uint32_t, 2>{24599999, 0}));
    EXPECT_EQ(sent(-33.5, -151.25), (std::array<std::uint32_t, 2>{33300000, 151150000}));
    EXPECT_EQ(sent(90.0, 180.0), (std::array<std::uint32_t, 2>{90000000, 180000000}));
}

TEST(gimu, without_a_fix_the_last_one_or_zeros_with_the_satellites_in_view)
{
    const auto lost = [](std::int64_t t_ps, gimu_fix_t* fix)
    {
        const bool known = t_ps > second && t_ps < 2 * second;
        fix->latitude = known ? 10.0 * deg : 77.0;
        fix->longitude = known ? 20.0 * deg : 77.0;
        fix->sats = known ? 6 : 2;
        return known;
    };
    for (const gimu_no_fix_t no_fix : {GIMU_HOLD_LAST, GIMU_SEND_ZEROS})
    {
        gimu_config_t config = default_config();
        config.no_fix = no_fix;
        Rig rig(config, nullptr, lost);
        rig.run_until(3 * second + power_up - 1);
        const std::uint32_t held = no_fix == GIMU_HOLD_LAST ? 10000000 : 0;
        EXPECT_EQ(rig.packets[5].content.coordinate[1], 0u) << "none yet";
        EXPECT_EQ(rig.packets[11].content.coordinate[1], 10000000u);
        EXPECT_EQ(rig.packets[17].content.coordinate[1], held);
        EXPECT_EQ(rig.packets[17].content.coordinate[0], 2 * held);
        EXPECT_EQ(rig.packets[5].content.sats, 2u);
        EXPECT_EQ(rig.packets[11].content.sats, 6u);
        EXPECT_EQ(rig.packets[17].content.sats, 2u);
    }
}

TEST(gimu, gps_errors_reach_the_packet)
{
    const Track track(ins_track_create_still(&hsinchu, nullptr, nullptr, 0), ins_track_destroy);
    ins_gps_config_t c;
    ins_gps_default_config(&c);
    c.outages = 1;
    c.outage[0] = {3.0, 5.0};
    ins_gps_t gps;
    ASSERT_TRUE(ins_gps_init(&gps, &c, track.get(), nullptr, 0));
    const auto module = [&](std::int64_t t_ps, gimu_fix_t* fix)
    {
        ins_gps_fix_t f;
        const bool valid = ins_gps_fix(&gps, t_ps, &f);
        *fix = {f.of_ps, f.llh[0], f.llh[1], f.llh[2], f.speed, f.course, f.hdop, f.sats};
        return valid;
    };
    Rig rig(default_config(), nullptr, module);
    rig.run_until(20 * second + power_up - 1);
    for (std::size_t m = 0; m < 20; m++)
    {
        // The packet of type 2 begins 83 ms before the next second: it carries the fix of this one.
        ins_gps_fix_t f;
        ins_gps_number(&gps, static_cast<std::int64_t>(m), &f);
        const ins_gimu_packet_t& p = rig.packets[6 * m + 5].content;
        EXPECT_EQ(p.sats, m == 3 || m == 4 ? 0u : f.sats) << m;
        if (f.valid)
        {
            EXPECT_NEAR(p.lat_e7, f.llh[0] / deg * 1e7, 9.0) << m; // half of 1e-4 minutes
            EXPECT_NEAR(p.lon_e7, f.llh[1] / deg * 1e7, 9.0) << m;
        }
    }
    EXPECT_NE(rig.packets[5].content.lat_e7, rig.packets[11].content.lat_e7);
}

TEST(gimu, a_clock_that_is_off_moves_cadence_and_bits)
{
    gimu_config_t config = default_config();
    config.clock_ppb = 2000000; // 0.2 % fast
    Rig rig(config);
    rig.run_until(30 * second);
    EXPECT_EQ(rig.starts[0], power_up);
    EXPECT_NEAR(static_cast<double>(rig.starts[179] - power_up), 179.0 / 6.0 / 1.002 * 1e12, 1.0);
    // AA: start 0, then 0101 0101, LSB first: the line falls at bits 0, 3, 5, 7.
    EXPECT_NEAR(static_cast<double>(rig.falls[3] - rig.falls[0]), 7.0 * 1e12 / 19200.0 / 1.002, 2.0);
    EXPECT_EQ(rig.packets.size(), 180u);
}

TEST(gimu, octets_are_those_of_the_seed)
{
    const auto stream = [](std::uint64_t seed)
    {
        gimu_config_t config = thesis_config();
        config.seed = seed;
        Rig rig(config, nullptr, fixed(0.4, 2.1, 8));
        rig.run_until(60 * second);
        return rig.octets;
    };
    const std::vector<std::uint8_t> one = stream(1);
    EXPECT_EQ(one, stream(1));
    EXPECT_NE(one, stream(2));
    std::uint64_t sum = 0;
    for (std::uint8_t octet : one)
    {
        sum = sum * 257 + octet;
    }
    EXPECT_EQ(sum, 3441579326818249575u); // a change here changes every recorded run
}

TEST(gimu, a_long_run_keeps_its_cadence)
{
    Rig rig(default_config());
    constexpr std::uint64_t hours = 2;
    rig.run_until(static_cast<emu_time_t>(hours) * 3600 * second + power_up);
    ASSERT_EQ(rig.gimu.packets, hours * 3600 * 6 + 1);
    EXPECT_EQ(rig.starts.back(), static_cast<emu_time_t>(hours) * 3600 * second + power_up);
}

TEST(gimu, refuses_a_bad_configuration_by_name)
{
    emu_sched_t sched;
    emu_wire_t t;
    emu_sched_init(&sched);
    emu_wire_init(&t, "T", true);
    const auto gimu = std::make_unique<gimu_t>();
    char why[200];
    const auto refused = [&](const gimu_config_t& c, const std::string& text)
    {
        why[0] = '\0';
        EXPECT_FALSE(gimu_init(gimu.get(), &c, &sched, &t, nullptr, why, sizeof why)) << text;
        EXPECT_NE(std::string(why).find(text), std::string::npos) << "want: " << text << ", got: " << why;
    };
    gimu_config_t c = default_config();
    c.channel[4].sensitivity = 0.0;
    refused(c, "GIMU: AY: |sensitivity| is 0, give 1e-06");
    c = default_config();
    c.channel[2].axis[2] = 0.5;
    refused(c, "R: the length of axis squared is 0.25");
    c = default_config();
    c.channel[0].noise_density = 1e-4;
    refused(c, "P: bandwidth_hz (with noise_density) is 0");
    c = default_config();
    c.channel[3].null_v = std::nan("");
    refused(c, "AX: null_v is nan");
    c = default_config();
    c.vcc_v = 5.0;
    refused(c, "vcc_v is 5, give 3 to 3.6");
    c = default_config();
    c.baud = 300.0;
    refused(c, "baud is 300");
    c = default_config();
    c.clock_ppb = 200000000;
    refused(c, "clock_ppb is 200000000");
    c = default_config();
    c.utc_s = 0;
    refused(c, "utc_s (2000 to 2099) is 0");
    c = default_config();
    for (int i = 0; i < EMU_WIRE_DRIVERS; i++)
    {
        (void)emu_wire_add_driver(&t);
    }
    refused(c, "a wire has 8 drivers already");
    EXPECT_EQ(emu_sched_next(&sched), EMU_TIME_MAX) << "nothing half-done is left behind";
}
