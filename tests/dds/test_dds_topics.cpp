// The topics of libins_dds: every field of every kind, what is kept for those who come later, decimation, profiles of QoS, JSON.
// SPDX-License-Identifier: MIT
#include "ins_dds/dds.h"
#include "process.hpp"
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

namespace
{
const double limit_s = 20;

struct Close
{
    void operator()(ins_dds_t* dds) const { ins_dds_close(dds); }
};
using Handle = std::unique_ptr<ins_dds_t, Close>;

ins_dds_config_t config(int publishes, int subscribes, int network = INS_DDS_LOOPBACK)
{
    ins_dds_config_t cfg;
    ins_dds_config_default(&cfg);
    cfg.domain = 100 + static_cast<uint32_t>(getpid()) % 100;
    cfg.network = network;
    cfg.publishes = publishes;
    cfg.subscribes = subscribes;
    for (int kind = 0; kind < INS_DDS_KINDS; kind++)
    {
        ins_dds_config_carry(&cfg, static_cast<ins_dds_kind_t>(kind));
    }
    return cfg;
}

Handle open(const ins_dds_config_t& cfg)
{
    ins_dds_t* dds = nullptr;
    EXPECT_EQ(ins_dds_open(&cfg, &dds), INS_DDS_OK) << ins_dds_error_text();
    return Handle(dds);
}

std::vector<ins_dds_sample_t> take(const Handle& dds, size_t count, double wait_s = limit_s)
{
    std::vector<ins_dds_sample_t> all;
    for (const double end = seconds_now() + wait_s; all.size() < count && seconds_now() < end;)
    {
        ins_dds_sample_t some[3];
        const int got = ins_dds_take(dds.get(), 0.1, some, 3);
        EXPECT_GE(got, 0) << ins_dds_error_text();
        all.insert(all.end(), some, some + std::max(got, 0));
    }
    return all;
}

void fill(double* at, size_t count, double from)
{
    for (size_t i = 0; i < count; i++)
    {
        at[i] = from + 0.01 * static_cast<double>(i);
    }
}

ins_navigation_t navigation_of(int64_t n)
{
    ins_navigation_t x;
    std::memset(&x, 0, sizeof x);
    x.time_ns = n;
    x.time_base = INS_NAVIGATION_GNSS;
    x.valid = 0xFF;
    fill(x.q_nb, 4, 1);
    fill(x.w_ib_b, 3, 2);
    fill(x.f_b, 3, 3);
    fill(x.v_n, 3, 4);
    fill(x.llh, 3, 5);
    for (int i = 0; i < INS_NAVIGATION_P; i++)
    {
        for (int j = 0; j < INS_NAVIGATION_P; j++)
        {
            x.P[INS_NAVIGATION_P * i + j] = i * j + 0.1 * (i + j);
        }
    }
    return x;
}

ins_nav_state_t state_of(const ins_navigation_t& navigation, uint64_t index)
{
    ins_nav_state_t s;
    std::memset(&s, 0, sizeof s);
    s.index = index;
    s.t_s = 0.5;
    std::memcpy(s.q_nb, navigation.q_nb, sizeof s.q_nb);
    std::memcpy(s.w_ib_b, navigation.w_ib_b, sizeof s.w_ib_b);
    fill(s.euler_rad, 3, 6);
    fill(s.dtheta_b, 3, 7);
    s.seq = 8;
    s.bridged = 9;
    s.status = 10;
    s.used = 11;
    s.missed = 12;
    s.counts = {13, 14, 15, 16, 17, 18, 19};
    return s;
}

ins_dds_status_t status_of(uint32_t mode)
{
    ins_dds_status_t s;
    std::memset(&s, 0, sizeof s);
    s.time_ns = 1;
    s.time_base = INS_NAVIGATION_BOARD;
    s.mode = mode;
    s.alerts = INS_DDS_ALERT_LOST | INS_DDS_ALERT_DROPPED;
    s.sigma_horizontal_m = 2.5;
    s.sigma_vertical_m = 3.5;
    s.sigma_heading_rad = 4.5;
    s.fix_age_s = 5.5;
    s.sats = 6;
    s.fixes = 7;
    s.position_refused = 8;
    s.velocity_refused = 9;
    s.aid_refused = 10;
    s.imu_refused = 11;
    s.published = 12;
    s.dropped = 13;
    s.counts = {14, 15, 16, 17, 18, 19, 20};
    return s;
}

ins_dds_innovations_t innovations_of()
{
    ins_dds_innovations_t x;
    std::memset(&x, 0, sizeof x);
    x.time_ns = 1;
    x.time_base = INS_NAVIGATION_GNSS;
    x.kind = INS_DDS_VELOCITY;
    x.verdict = INS_DDS_REFUSED_GATE;
    x.size = 3;
    fill(x.innovation, 3, 2);
    fill(x.sigma, 3, 3);
    x.nis = 4;
    return x;
}

ins_dds_raw_imu_t raw_imu_of()
{
    ins_dds_raw_imu_t x;
    std::memset(&x, 0, sizeof x);
    x.time_ns = 1;
    x.time_base = INS_NAVIGATION_BOARD;
    x.increments = 1;
    x.index = 2;
    x.t_s = 3;
    x.dt_s = 4;
    fill(x.gyro_b, 3, 5);
    fill(x.accel_b, 3, 6);
    x.temperature_k = 293.15;
    return x;
}

nlohmann::json json_of(const ins_dds_sample_t& sample)
{
    char line[INS_DDS_JSON_MAX];
    EXPECT_GT(ins_dds_sample_json(&sample, line, sizeof line), 0U);
    return nlohmann::json::parse(line);
}

template <typename T> bool same(const T& a, const T& b)
{
    return std::memcmp(&a, &b, sizeof a) == 0;
}
} // namespace

TEST(DdsTopics, CarryEveryFieldAndTellItInJson)
{
    const Handle dds = open(config(1, 1));
    const auto navigation = navigation_of(77);
    const auto state = state_of(navigation, 3);
    const auto status = status_of(INS_DDS_MODE_AIDED);
    const auto innovations = innovations_of();
    const auto raw_imu = raw_imu_of();
    ASSERT_EQ(ins_dds_publish_navigation(dds.get(), &state, &navigation, "a", 1), INS_DDS_OK) << ins_dds_error_text();
    ASSERT_EQ(ins_dds_publish_status(dds.get(), &status, "a", 2), INS_DDS_OK) << ins_dds_error_text();
    ASSERT_EQ(ins_dds_publish_innovations(dds.get(), &innovations, "a", 3), INS_DDS_OK) << ins_dds_error_text();
    ASSERT_EQ(ins_dds_publish_raw_imu(dds.get(), &raw_imu, "a", 4), INS_DDS_OK) << ins_dds_error_text();
    std::map<int, ins_dds_sample_t> got;
    for (const auto& s : take(dds, 5))
    {
        got[s.kind] = s;
    }
    ASSERT_EQ(got.size(), 5U) << "the state twice, once decimated";
    for (const int kind : {INS_DDS_STATE, INS_DDS_STATE_DECIMATED})
    {
        EXPECT_TRUE(same(got[kind].state, state));
        EXPECT_TRUE(same(got[kind].navigation, navigation));
        EXPECT_EQ(got[kind].published_ns, 1);
    }
    EXPECT_TRUE(same(got[INS_DDS_STATUS].status, status));
    EXPECT_TRUE(same(got[INS_DDS_INNOVATIONS].innovations, innovations));
    EXPECT_TRUE(same(got[INS_DDS_RAW_IMU].raw_imu, raw_imu));

    const auto told = json_of(got[INS_DDS_STATE]);
    EXPECT_EQ(told["source"], "a");
    EXPECT_EQ(told["navigation"]["time_base"], "gnss");
    EXPECT_EQ(told["navigation"]["valid"].size(), 8U);
    EXPECT_EQ(told["navigation"]["P"].size(), 45U);
    EXPECT_DOUBLE_EQ(told["navigation"]["P"][9].get<double>(), navigation.P[INS_NAVIGATION_P + 1]);
    EXPECT_EQ(told["navigation"]["llh"][2].get<double>(), navigation.llh[2]);
    const auto how = json_of(got[INS_DDS_STATUS]);
    EXPECT_EQ(how["mode"], "aided");
    EXPECT_EQ(how["alerts"], (std::vector<std::string>{"lost", "dropped"}));
    EXPECT_EQ(how["dropped"], 13);
    EXPECT_EQ(how["link"]["stray"], 20);
    const auto measured = json_of(got[INS_DDS_INNOVATIONS]);
    EXPECT_EQ(measured["kind"], "velocity");
    EXPECT_EQ(measured["verdict"], "gate");
    EXPECT_EQ(measured["innovation"].size(), 3U);
    const auto sensed = json_of(got[INS_DDS_RAW_IMU]);
    EXPECT_EQ(sensed["increments"], true);
    EXPECT_EQ(sensed["temperature_k"], 293.15);
}

TEST(DdsTopics, WhatIsNotKnownIsNullInJsonAndASourceCannotBreakIt)
{
    ins_dds_sample_t s;
    std::memset(&s, 0, sizeof s);
    std::strcpy(s.source, "a\"b\\c\n");
    s.kind = INS_DDS_RAW_IMU;
    s.raw_imu.temperature_k = std::nan("");
    const auto told = json_of(s);
    EXPECT_EQ(told["source"], "a\"b\\c\n");
    EXPECT_TRUE(told["temperature_k"].is_null());
    s.kind = INS_DDS_STATE;
    EXPECT_FALSE(json_of(s)["navigation"].contains("P"));
    s.kind = INS_DDS_INNOVATIONS;
    s.innovations.kind = 99; // of a newer publisher
    s.innovations.size = 1000;
    EXPECT_EQ(json_of(s)["kind"], "unknown");
    EXPECT_EQ(json_of(s)["innovation"].size(), 3U);
    char small[40];
    EXPECT_EQ(ins_dds_sample_json(&s, small, sizeof small), 0U);
}

TEST(DdsTopics, LateReadersGetTheNewestStatusAndNoOldState)
{
    const Handle source = open(config(1, 0));
    const auto navigation = navigation_of(1);
    const auto state = state_of(navigation, 1);
    const auto older = status_of(INS_DDS_MODE_ALIGN);
    const auto newer = status_of(INS_DDS_MODE_AIDED);
    ASSERT_EQ(ins_dds_publish_navigation(source.get(), &state, &navigation, "a", 1), INS_DDS_OK);
    ASSERT_EQ(ins_dds_publish_status(source.get(), &older, "a", 2), INS_DDS_OK);
    ASSERT_EQ(ins_dds_publish_status(source.get(), &newer, "a", 3), INS_DDS_OK);
    const Handle late = open(config(0, 1, INS_DDS_JOIN));
    const auto got = take(late, 2, 1.0);
    ASSERT_EQ(got.size(), 1U);
    EXPECT_EQ(got[0].kind, INS_DDS_STATUS);
    EXPECT_EQ(got[0].status.mode, static_cast<uint32_t>(INS_DDS_MODE_AIDED));
}

TEST(DdsTopics, OneOfSoManyGoesOntoADecimatedTopic)
{
    auto cfg = config(1, 1);
    cfg.topic[INS_DDS_STATE].decimate = 2;
    cfg.topic[INS_DDS_STATE_DECIMATED].decimate = 5;
    const Handle dds = open(cfg);
    const auto navigation = navigation_of(1);
    for (uint64_t n = 0; n < 12; n++)
    {
        const auto state = state_of(navigation, n);
        ASSERT_EQ(ins_dds_publish_navigation(dds.get(), &state, &navigation, "a", 1), INS_DDS_OK);
    }
    std::map<int, std::vector<uint64_t>> got;
    for (const auto& s : take(dds, 9))
    {
        got[s.kind].push_back(s.state.index);
    }
    EXPECT_EQ(got[INS_DDS_STATE], (std::vector<uint64_t>{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(got[INS_DDS_STATE_DECIMATED], (std::vector<uint64_t>{0, 5, 10}));
}

TEST(DdsTopics, ProfilesHoldWhatTheirNamesSay)
{
    const auto taken = [](const char* writer, const char* reader, double wait_s)
    {
        auto cfg = config(1, 0);
        EXPECT_EQ(ins_dds_qos_profile(writer, &cfg.topic[INS_DDS_STATE].qos), INS_DDS_OK);
        const Handle source = open(cfg);
        auto join = config(0, 1, INS_DDS_JOIN);
        EXPECT_EQ(ins_dds_qos_profile(reader, &join.topic[INS_DDS_STATE].qos), INS_DDS_OK);
        const Handle sink = open(join);
        const auto navigation = navigation_of(1);
        for (uint64_t n = 0; n < 20; n++)
        {
            const auto state = state_of(navigation, n);
            EXPECT_EQ(ins_dds_publish_navigation(source.get(), &state, &navigation, "a", 1), INS_DDS_OK);
        }
        std::this_thread::sleep_for(std::chrono::duration<double>(wait_s));
        size_t count = 0;
        for (const auto& s : take(sink, 22, 0.5)) // two of the decimated topic
        {
            count += s.kind == INS_DDS_STATE;
        }
        return count;
    };
    EXPECT_EQ(taken("default", "default", 0), 16U);
    EXPECT_EQ(taken("reliable", "reliable", 0), 20U);
    EXPECT_EQ(taken("latched", "latched", 0), 1U);
    EXPECT_EQ(taken("default", "sensor_data", 0), 5U);
    EXPECT_EQ(taken("sensor_data", "sensor_data", 0), 5U);
    EXPECT_EQ(taken("sensor_data", "sensor_data", 0.8), 0U) << "older than its lifespan of 0.5 s";
    EXPECT_EQ(taken("sensor_data", "default", 0), 0U) << "best effort does not serve a reliable reader";
    ins_dds_qos_t qos;
    EXPECT_EQ(ins_dds_qos_profile("fast", &qos), INS_DDS_E_ARGUMENT);
    EXPECT_NE(std::string(ins_dds_error_text()).find("'fast' is no QoS profile: it is one of default, sensor_data"),
              std::string::npos)
        << ins_dds_error_text();
}

TEST(DdsTopics, AStatusFollowsFromAnInstant)
{
    ins_dds_status_t s;
    auto n = navigation_of(5);
    n.P[INS_NAVIGATION_P * 6 + 6] = 4;
    n.P[INS_NAVIGATION_P * 7 + 7] = 4;
    n.P[INS_NAVIGATION_P * 6 + 7] = n.P[INS_NAVIGATION_P * 7 + 6] = 3; // eigenvalues 7 and 1
    n.P[INS_NAVIGATION_P * 8 + 8] = 9;
    n.P[INS_NAVIGATION_P * 2 + 2] = 0.25;
    ins_dds_status_from_navigation(&n, &s);
    EXPECT_EQ(s.mode, static_cast<uint32_t>(INS_DDS_MODE_AIDED));
    EXPECT_DOUBLE_EQ(s.sigma_horizontal_m, std::sqrt(7.0));
    EXPECT_DOUBLE_EQ(s.sigma_vertical_m, 3.0);
    EXPECT_DOUBLE_EQ(s.sigma_heading_rad, 0.5);
    EXPECT_EQ(s.time_ns, 5);
    n.valid = INS_NAVIGATION_ATTITUDE;
    ins_dds_status_from_navigation(&n, &s);
    EXPECT_EQ(s.mode, static_cast<uint32_t>(INS_DDS_MODE_ATTITUDE));
    EXPECT_TRUE(std::isnan(s.sigma_horizontal_m));
    EXPECT_TRUE(std::isnan(s.fix_age_s));
}
