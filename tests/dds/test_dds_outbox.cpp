// The outbox: order, counts of what is dropped, status once a second and on change, a reader that stands still.
// SPDX-License-Identifier: MIT
#include "ins_dds/outbox.h"
#include "process.hpp"
#include <array>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

namespace
{
const double limit_s = 20;

uint32_t domain()
{
    return 100 + static_cast<uint32_t>(getpid()) % 100;
}

struct Close
{
    void operator()(ins_dds_t* dds) const { ins_dds_close(dds); }
};
using Handle = std::unique_ptr<ins_dds_t, Close>;

Handle open(int publishes, int subscribes, int network = INS_DDS_LOOPBACK)
{
    ins_dds_config_t cfg;
    ins_dds_config_default(&cfg);
    cfg.domain = domain();
    cfg.network = network;
    cfg.publishes = publishes;
    cfg.subscribes = subscribes;
    cfg.topic[INS_DDS_STATE].qos.history = 100000;
    ins_dds_config_carry(&cfg, INS_DDS_STATUS);
    cfg.topic[INS_DDS_STATUS].qos.history = 1000;
    ins_dds_t* dds = nullptr;
    EXPECT_EQ(ins_dds_open(&cfg, &dds), INS_DDS_OK) << ins_dds_error_text();
    return Handle(dds);
}

ins_dds_outbox_t* outbox_on(const Handle& dds, uint32_t size)
{
    ins_dds_outbox_t* outbox = nullptr;
    EXPECT_EQ(ins_dds_outbox_open(dds.get(), nullptr, "unit", size, &outbox), INS_DDS_OK) << ins_dds_error_text();
    return outbox;
}

ins_dds_message_t state(uint64_t index)
{
    ins_dds_message_t m;
    std::memset(&m, 0, sizeof m);
    m.kind = INS_DDS_STATE;
    m.is.instant.state.index = index;
    return m;
}

ins_dds_message_t status(uint32_t mode, uint32_t alerts = 0)
{
    ins_dds_message_t m;
    std::memset(&m, 0, sizeof m);
    m.kind = INS_DDS_STATUS;
    m.is.status.mode = mode;
    m.is.status.alerts = alerts;
    return m;
}

/// Until `done` says so of a sample.
template <typename Done> std::vector<ins_dds_sample_t> take_until(const Handle& dds, Done done)
{
    std::vector<ins_dds_sample_t> all;
    for (const double end = seconds_now() + limit_s; seconds_now() < end;)
    {
        ins_dds_sample_t s;
        if (ins_dds_take(dds.get(), 0.1, &s, 1) == 1 && s.valid)
        {
            all.push_back(s);
            if (done(s))
            {
                return all;
            }
        }
    }
    ADD_FAILURE() << "what was waited for did not come";
    return all;
}
} // namespace

TEST(Outbox, WhatIsPutIsPublishedInOrderOrCounted)
{
    const Handle dds = open(1, 1);
    ins_dds_outbox_t* outbox = outbox_on(dds, 4);
    const uint64_t count = 20000;
    uint64_t put = 0;
    for (uint64_t n = 0; n < count; n++)
    {
        const auto m = state(n);
        put += static_cast<uint64_t>(ins_dds_outbox_put(outbox, &m));
    }
    ins_dds_outbox_counts_t counts;
    ins_dds_outbox_close(outbox, &counts);
    EXPECT_EQ(counts.published, put);
    EXPECT_EQ(counts.dropped, count - put);
    EXPECT_GT(counts.dropped, 0U) << "a ring of 4, and a copy is faster than a dds_write";
    EXPECT_EQ(counts.refused, 0U);
    uint64_t got = 0;
    uint64_t last = 0;
    ins_dds_sample_t s;
    while (ins_dds_take(dds.get(), 0, &s, 1) == 1)
    {
        ASSERT_TRUE(got == 0 || s.state.index > last) << s.state.index << " after " << last;
        last = s.state.index;
        got++;
    }
    EXPECT_EQ(got, put) << "what waited at the end is published";
}

TEST(Outbox, AStatusIsToldWhenItChangesElseOnceASecondAndSaysWhenNothingComes)
{
    const Handle dds = open(1, 1);
    ins_dds_outbox_t* outbox = outbox_on(dds, 64);
    for (const auto& m : {status(INS_DDS_MODE_ALIGN), status(INS_DDS_MODE_ALIGN), status(INS_DDS_MODE_AIDED),
                          status(INS_DDS_MODE_AIDED), status(INS_DDS_MODE_AIDED, INS_DDS_ALERT_REFUSED),
                          status(INS_DDS_MODE_AIDED, INS_DDS_ALERT_REFUSED), status(INS_DDS_MODE_AIDED)})
    {
        EXPECT_EQ(ins_dds_outbox_put(outbox, &m), 1);
    }
    const auto got = take_until(dds, [](const auto& s) { return (s.status.alerts & INS_DDS_ALERT_SILENT) != 0; });
    ins_dds_outbox_close(outbox, nullptr);
    std::vector<std::pair<uint32_t, uint32_t>> told;
    for (const auto& s : got)
    {
        told.emplace_back(s.status.mode, s.status.alerts);
    }
    const std::pair<uint32_t, uint32_t> first{INS_DDS_MODE_ALIGN, 0};
    const std::pair<uint32_t, uint32_t> aided{INS_DDS_MODE_AIDED, 0};
    const std::pair<uint32_t, uint32_t> refused{INS_DDS_MODE_AIDED, INS_DDS_ALERT_REFUSED};
    const std::pair<uint32_t, uint32_t> silent{INS_DDS_MODE_AIDED, INS_DDS_ALERT_SILENT};
    ASSERT_GE(told.size(), 4U);
    EXPECT_EQ(told[0], first);
    EXPECT_EQ(told[1], aided);
    EXPECT_EQ(told[2], refused);
    EXPECT_EQ(told.back(), silent);
    EXPECT_LE(told.size(), 5U) << "nothing new, nothing told";
}

TEST(Outbox, StatusSaysWhatWasDroppedAndLost)
{
    const Handle dds = open(1, 1);
    ins_dds_outbox_t* outbox = outbox_on(dds, 1);
    for (uint64_t n = 0; n < 5000; n++)
    {
        const auto m = state(n);
        (void)ins_dds_outbox_put(outbox, &m);
    }
    auto m = status(INS_DDS_MODE_ATTITUDE);
    m.is.status.counts.lost = 3;
    while (ins_dds_outbox_put(outbox, &m) == 0)
    {
    }
    const auto got = take_until(dds, [](const auto& s) { return s.kind == INS_DDS_STATUS; });
    ins_dds_outbox_counts_t counts;
    ins_dds_outbox_close(outbox, &counts);
    ASSERT_FALSE(got.empty());
    const auto& told = got.back().status;
    EXPECT_EQ(told.alerts, static_cast<uint32_t>(INS_DDS_ALERT_DROPPED | INS_DDS_ALERT_LOST));
    EXPECT_EQ(told.dropped, counts.dropped);
    EXPECT_EQ(told.published, counts.published);
}

TEST(Outbox, AReaderThatStandsStillCostsTheNavigatorNoMessage)
{
    const Handle dds = open(1, 0);
    Process reader({DDS_READER, std::to_string(domain())});
    for (const double end = seconds_now() + limit_s; ins_dds_matched(dds.get()) < 1 && seconds_now() < end;)
    {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    reader.signal(SIGSTOP);
    const uint64_t count = 2000;
    ins_dds_outbox_t* outbox = outbox_on(dds, 4096);
    for (uint64_t n = 0; n < count; n++)
    {
        const auto m = state(n);
        EXPECT_EQ(ins_dds_outbox_put(outbox, &m), 1);
    }
    ins_dds_outbox_counts_t counts;
    ins_dds_outbox_close(outbox, &counts);
    reader.signal(SIGCONT);
    reader.signal(SIGTERM);
    EXPECT_EQ(counts.published, count) << "the writer overwrites, it does not wait";
    EXPECT_EQ(counts.dropped + counts.refused, 0U);
}

TEST(Outbox, TheDaemonTellsItsStatusAndWhatTheGyrosSaid)
{
    ins_dds_config_t cfg;
    ins_dds_config_default(&cfg);
    cfg.domain = domain();
    cfg.publishes = 0;
    cfg.subscribes = 1;
    ins_dds_config_carry(&cfg, INS_DDS_STATUS);
    ins_dds_config_carry(&cfg, INS_DDS_RAW_IMU);
    ins_dds_config_carry(&cfg, INS_DDS_STATE_DECIMATED);
    (void)ins_dds_qos_profile("reliable", &cfg.topic[INS_DDS_RAW_IMU].qos);
    (void)ins_dds_qos_profile("latched", &cfg.topic[INS_DDS_STATE_DECIMATED].qos); // heard only if the writer is so too
    ins_dds_t* opened = nullptr;
    ASSERT_EQ(ins_dds_open(&cfg, &opened), INS_DDS_OK) << ins_dds_error_text();
    const Handle dds(opened);
    Pty pty;
    Process navd({INS_NAVD, "--device", pty.path, "--dds=" + std::to_string(domain()), "--null-code", "0",
                  "--lsb-deg-s", "0.01", "--source", "imu7", "--decimate", "10", "--qos",
                  "nav_state_decimated=latched"});
    for (const double end = seconds_now() + limit_s; ins_dds_matched(dds.get()) < 4 && seconds_now() < end;)
    {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    Board board(pty.fd, 0, 1000000);
    std::map<uint64_t, std::array<double, 3>> raw;
    std::map<uint64_t, ins_nav_state_t> states;
    size_t decimated = 0;
    const auto got =
        take_until(dds,
                   [&](const auto& s)
                   {
                       if (s.kind == INS_DDS_RAW_IMU)
                       {
                           raw[s.raw_imu.index] = {s.raw_imu.gyro_b[0], s.raw_imu.gyro_b[1], s.raw_imu.gyro_b[2]};
                           EXPECT_TRUE(std::isnan(s.raw_imu.accel_b[0]));
                       }
                       if (s.kind == INS_DDS_STATE)
                       {
                           states[s.state.index] = s.state;
                       }
                       decimated += s.kind == INS_DDS_STATE_DECIMATED ? 1 : 0;
                       return s.kind == INS_DDS_STATUS && s.status.published > 100;
                   });
    ASSERT_FALSE(got.empty()) << navd.err;
    const ins_dds_status_t& status = got.back().status;
    EXPECT_GE(decimated, 1U); // with a history of 1 not every one needs to arrive
    EXPECT_LE(decimated, (status.published + status.dropped) / 10 + 2);
    EXPECT_STREQ(got.back().source, "imu7");
    EXPECT_EQ(status.mode, static_cast<uint32_t>(INS_DDS_MODE_ATTITUDE));
    EXPECT_GT(status.counts.accepted, 100U);
    EXPECT_TRUE(std::isnan(status.sigma_horizontal_m));
    size_t both = 0;
    for (const auto& [index, gyro] : raw)
    {
        const auto state = states.find(index);
        if (state != states.end())
        {
            both++;
            for (size_t axis = 0; axis < 3; axis++)
            {
                EXPECT_NEAR(gyro.at(axis), state->second.w_ib_b[axis], 1e-12) << "no delays, so the rate is the code's";
            }
        }
    }
    EXPECT_GT(both, 20U);
}

TEST(Outbox, RefusesASourceOrSizeThatIsNone)
{
    auto* outbox = reinterpret_cast<ins_dds_outbox_t*>(1);
    EXPECT_EQ(ins_dds_outbox_open(nullptr, nullptr, "", 1, &outbox), INS_DDS_E_ARGUMENT);
    EXPECT_EQ(outbox, nullptr);
    EXPECT_EQ(ins_dds_outbox_open(nullptr, nullptr, "a", 0, &outbox), INS_DDS_E_ARGUMENT);
    EXPECT_NE(std::strstr(ins_dds_error_text(), "room for 1 to 1000000 messages, here 0"), nullptr);
    ins_dds_outbox_close(nullptr, nullptr);
}
