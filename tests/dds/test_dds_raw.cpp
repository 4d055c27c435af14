// libins_dds, octets: what is found, taken and published again, and what is refused. Loopback only.
// SPDX-License-Identifier: MIT
#include "ins_dds/raw.h"
#include "ins_dds/ros.h"
#include <chrono>
#include <cstring>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace
{
constexpr double WALL_LIMIT_S = 20;
using Octets = std::vector<uint8_t>;

ins_dds_config_t config(int network)
{
    ins_dds_config_t cfg;
    ins_dds_config_default(&cfg);
    cfg.domain = 100 + static_cast<uint32_t>(getpid()) % 100;
    cfg.network = network;
    return cfg;
}

struct Close
{
    void operator()(ins_dds_raw_t* raw) const { ins_dds_raw_close(raw); }
    void operator()(ins_dds_t* dds) const { ins_dds_close(dds); }
    void operator()(ins_ros_t* ros) const { ins_ros_close(ros); }
};
using Raw = std::unique_ptr<ins_dds_raw_t, Close>;
using Dds = std::unique_ptr<ins_dds_t, Close>;

Raw open_raw(int network)
{
    const ins_dds_config_t cfg = config(network);
    ins_dds_raw_t* raw = nullptr;
    EXPECT_EQ(ins_dds_raw_open(&cfg, &raw), INS_DDS_OK) << ins_dds_error_text();
    return Raw(raw);
}

Dds open_dds(const ins_dds_config_t& cfg)
{
    ins_dds_t* dds = nullptr;
    EXPECT_EQ(ins_dds_open(&cfg, &dds), INS_DDS_OK) << ins_dds_error_text();
    return Dds(dds);
}

template <typename F> bool comes(const F& done)
{
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(WALL_LIMIT_S);
    while (!done())
    {
        if (std::chrono::steady_clock::now() > end)
        {
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

/// All that the domain has, by name.
std::map<std::string, ins_dds_raw_topic_t> found(ins_dds_raw_t* raw, size_t count)
{
    std::map<std::string, ins_dds_raw_topic_t> topics;
    EXPECT_TRUE(comes(
        [&]
        {
            ins_dds_raw_topic_t topic;
            while (ins_dds_raw_found(raw, &topic, 1) > 0)
            {
                topics[topic.name] = topic;
            }
            return topics.size() >= count;
        }));
    return topics;
}

std::vector<Octets> taken(ins_dds_raw_t* raw, size_t count)
{
    std::vector<Octets> all;
    EXPECT_TRUE(comes(
        [&]
        {
            ins_dds_raw_message_t messages[3];
            const int got = ins_dds_raw_take(raw, 0.01, messages, 3);
            for (int i = 0; i < got; i++)
            {
                all.emplace_back(messages[i].octets, messages[i].octets + messages[i].size);
            }
            return all.size() >= count;
        }));
    return all;
}

ins_nav_state_t state(uint64_t index)
{
    ins_nav_state_t s = {};
    s.index = index;
    s.t_s = 0.1 * static_cast<double>(index);
    s.q_nb[0] = 1;
    s.seq = 7;
    return s;
}

ins_dds_raw_topic_t topic_of(const char* name, const char* type)
{
    ins_dds_raw_topic_t topic = {};
    std::strcpy(topic.name, name);
    std::strcpy(topic.type, type);
    return topic;
}
} // namespace

TEST(DdsRaw, OctetsThatAreTakenAndPublishedAgainAreTheSame)
{
    constexpr size_t COUNT = 100;
    const Raw raw = open_raw(INS_DDS_LOOPBACK);
    auto cfg = config(INS_DDS_JOIN);
    cfg.strength = 3;
    cfg.partition = "left";
    cfg.topic[INS_DDS_STATE].qos.history = COUNT;
    const Dds source = open_dds(cfg);
    auto topics = found(raw.get(), 1);
    ins_dds_raw_topic_t topic = topics.at("libins/nav_state");
    EXPECT_STREQ(topic.type, "libins::NavState");
    EXPECT_STREQ(topic.partition, "left");
    EXPECT_EQ(topic.strength, 3);
    EXPECT_TRUE(topic.exclusive);
    EXPECT_FALSE(topic.latched);
    EXPECT_DOUBLE_EQ(topic.deadline_s, 1.0);
    ASSERT_EQ(ins_dds_raw_subscribe(raw.get(), &topic), 0) << ins_dds_error_text();
    ASSERT_TRUE(comes([&] { return ins_dds_matched(source.get()) == 1; }));
    for (uint64_t i = 0; i < COUNT; i++)
    {
        const ins_nav_state_t s = state(i);
        ASSERT_EQ(ins_dds_publish(source.get(), &s, "imu0", 1000 + static_cast<int64_t>(i)), INS_DDS_OK);
    }
    const std::vector<Octets> octets = taken(raw.get(), COUNT);
    ASSERT_EQ(octets.size(), COUNT);

    std::strcpy(topic.name, "again");
    const int writer = ins_dds_raw_publish(raw.get(), &topic);
    const int reader = ins_dds_raw_subscribe(raw.get(), &topic);
    ASSERT_GE(writer, 0) << ins_dds_error_text();
    ASSERT_GE(reader, 0) << ins_dds_error_text();
    cfg.topic[INS_DDS_STATE].name = "again";
    cfg.publishes = 0;
    cfg.subscribes = 1;
    const Dds sink = open_dds(cfg);
    ASSERT_TRUE(comes([&] { return ins_dds_raw_matched(raw.get(), writer) == 2; }));
    for (const Octets& each : octets)
    {
        EXPECT_EQ((Octets(each.begin(), each.begin() + 4)), (Octets{0, 1, 0, 0}));
        ASSERT_EQ(ins_dds_raw_write(raw.get(), writer, each.data(), each.size()), INS_DDS_OK) << ins_dds_error_text();
    }
    EXPECT_EQ(taken(raw.get(), COUNT), octets);
    ins_dds_sample_t sample;
    for (uint64_t i = 0; i < COUNT; i++)
    {
        ASSERT_EQ(ins_dds_take(sink.get(), WALL_LIMIT_S, &sample, 1), 1);
        const ins_nav_state_t s = state(i);
        EXPECT_STREQ(sample.source, "imu0");
        EXPECT_EQ(sample.published_ns, 1000 + static_cast<int64_t>(i));
        EXPECT_EQ(sample.state.index, s.index);
        EXPECT_EQ(sample.state.t_s, s.t_s);
        EXPECT_EQ(sample.state.seq, s.seq);
    }
}

TEST(DdsRaw, TopicsOfRosAreFoundWithTheirHashesAndSequencesPassThrough)
{
    const Raw raw = open_raw(INS_DDS_LOOPBACK);
    ins_ros_config_t cfg;
    ins_ros_config_default(&cfg);
    cfg.dds.domain = config(0).domain;
    cfg.dds.network = INS_DDS_JOIN;
    ins_ros_t* opened = nullptr;
    ASSERT_EQ(ins_ros_open(&cfg, &opened), INS_DDS_OK) << ins_dds_error_text();
    const std::unique_ptr<ins_ros_t, Close> node(opened);
    auto topics = found(raw.get(), INS_ROS_TOPICS + 1);
    const ins_dds_raw_topic_t info = topics.at("ros_discovery_info");
    EXPECT_TRUE(info.latched);
    EXPECT_EQ(ins_dds_raw_subscribe(raw.get(), &info), INS_DDS_E_ARGUMENT);
    EXPECT_NE(std::string(ins_dds_error_text()).find("ParticipantEntitiesInfo_"), std::string::npos);
    const ins_dds_raw_topic_t diagnostics = topics.at("rt/diagnostics");
    EXPECT_EQ(std::string(diagnostics.user).rfind("typehash=RIHS01_", 0), 0U) << diagnostics.user;
    ASSERT_EQ(ins_dds_raw_subscribe(raw.get(), &diagnostics), 0) << ins_dds_error_text();
    ASSERT_TRUE(comes([&] { return ins_ros_matched(node.get(), INS_ROS_DIAGNOSTICS) == 1; }));
    const ins_ros_value_t values[2] = {{"lost", "3"}, {"accepted", "12345"}};
    ASSERT_EQ(ins_ros_diagnose(node.get(), 5, INS_ROS_LEVEL_WARN, "lost", values, 2), INS_DDS_OK);
    const std::vector<Octets> octets = taken(raw.get(), 1);
    ins_dds_raw_topic_t again = diagnostics;
    std::strcpy(again.name, "rt/again");
    const int writer = ins_dds_raw_publish(raw.get(), &again);
    ASSERT_GE(ins_dds_raw_subscribe(raw.get(), &again), 0);
    ASSERT_EQ(ins_dds_raw_write(raw.get(), writer, octets[0].data(), octets[0].size()), INS_DDS_OK);
    EXPECT_EQ(taken(raw.get(), 1), octets);
}

TEST(DdsRaw, ABestEffortWriterIsHeardToo)
{
    const Raw raw = open_raw(INS_DDS_LOOPBACK);
    auto cfg = config(INS_DDS_JOIN);
    ASSERT_EQ(ins_dds_qos_profile("sensor_data", &cfg.topic[INS_DDS_STATE].qos), INS_DDS_OK);
    const Dds source = open_dds(cfg);
    const ins_dds_raw_topic_t topic = found(raw.get(), 1).at("libins/nav_state");
    EXPECT_TRUE(topic.best_effort);
    ASSERT_EQ(ins_dds_raw_subscribe(raw.get(), &topic), 0) << ins_dds_error_text();
    ASSERT_TRUE(comes([&] { return ins_dds_matched(source.get()) == 1; }));
    const ins_nav_state_t s = state(1);
    ASSERT_EQ(ins_dds_publish(source.get(), &s, "imu0", 1), INS_DDS_OK);
    EXPECT_EQ(taken(raw.get(), 1).size(), 1U);
}

TEST(DdsRaw, WhatALatchedTopicSaidIsThereForWhoComesLate)
{
    const Raw raw = open_raw(INS_DDS_LOOPBACK);
    ins_dds_raw_topic_t topic = topic_of("latched", "tf2_msgs::msg::dds_::TFMessage_");
    topic.latched = 1;
    const int writer = ins_dds_raw_publish(raw.get(), &topic);
    ASSERT_GE(writer, 0) << ins_dds_error_text();
    const Octets octets{0, 1, 0, 0, 0, 0, 0, 0}; // no transforms
    ASSERT_EQ(ins_dds_raw_write(raw.get(), writer, octets.data(), octets.size()), INS_DDS_OK) << ins_dds_error_text();
    ASSERT_GE(ins_dds_raw_subscribe(raw.get(), &topic), 0);
    EXPECT_EQ(taken(raw.get(), 1), std::vector<Octets>{octets});
}

TEST(DdsRaw, WhatIsNoCdrOfTheTypeIsRefused)
{
    const Raw raw = open_raw(INS_DDS_LOOPBACK);
    const auto topic = topic_of("refused", "libins::NavState");
    const int writer = ins_dds_raw_publish(raw.get(), &topic);
    ASSERT_GE(writer, 0) << ins_dds_error_text();
    const Octets header{0, 1, 0, 0};
    Octets long_name(500, 0x41);
    std::copy(header.begin(), header.end(), long_name.begin());
    for (const Octets& octets : {Octets{}, Octets{0, 1}, header, Octets{0, 1, 0, 0, 2, 0, 0, 0, 'a', 0}, long_name,
                                 Octets{9, 9, 0, 0, 1, 0, 0, 0, 0, 0}})
    {
        EXPECT_EQ(ins_dds_raw_write(raw.get(), writer, octets.data(), octets.size()), INS_DDS_E_DDS) << octets.size();
    }
    EXPECT_EQ(ins_dds_raw_write(raw.get(), writer + 1, header.data(), header.size()), INS_DDS_E_ARGUMENT);
    const auto unknown = topic_of("unknown", "px4::Odometry");
    EXPECT_EQ(ins_dds_raw_publish(raw.get(), &unknown), INS_DDS_E_ARGUMENT);
    EXPECT_STREQ(ins_dds_error_text(), "topic unknown: libins_dds has no type px4::Odometry");
}

TEST(DdsRaw, EveryTypeMakesATopicAndTheListEnds)
{
    const Raw raw = open_raw(INS_DDS_LOOPBACK);
    int count = 0;
    for (; ins_dds_raw_type(count) != nullptr; count++)
    {
        const auto topic = topic_of(("t" + std::to_string(count)).c_str(), ins_dds_raw_type(count));
        EXPECT_EQ(ins_dds_raw_publish(raw.get(), &topic), count) << ins_dds_error_text();
        EXPECT_EQ(ins_dds_raw_matched(raw.get(), count), 0);
    }
    EXPECT_GE(count, 8);
    EXPECT_EQ(ins_dds_raw_type(-1), nullptr);
}
