// libins_dds, ROS 2 topics: what is refused, and what is published of which instant. Loopback only.
// SPDX-License-Identifier: MIT
#include "ins_dds/ros.h"
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <unistd.h>

namespace
{
uint32_t domain()
{
    return 100 + static_cast<uint32_t>(getpid()) % 100;
}

ins_ros_config_t config()
{
    ins_ros_config_t cfg;
    ins_ros_config_default(&cfg);
    cfg.dds.domain = domain();
    return cfg;
}

struct Close
{
    void operator()(ins_ros_t* ros) const { ins_ros_close(ros); }
};
using Handle = std::unique_ptr<ins_ros_t, Close>;

Handle open(const ins_ros_config_t& cfg)
{
    ins_ros_t* ros = nullptr;
    EXPECT_EQ(ins_ros_open(&cfg, &ros), INS_DDS_OK) << ins_dds_error_text();
    return Handle(ros);
}

void expect_refused(const ins_ros_config_t& cfg, const std::string& word)
{
    auto* ros = reinterpret_cast<ins_ros_t*>(1);
    EXPECT_EQ(ins_ros_open(&cfg, &ros), INS_DDS_E_ARGUMENT) << word;
    EXPECT_EQ(ros, nullptr);
    EXPECT_NE(std::string(ins_dds_error_text()).find(word), std::string::npos) << ins_dds_error_text();
}

ins_navigation_t level()
{
    ins_navigation_t n = {};
    n.valid = INS_NAVIGATION_ATTITUDE | INS_NAVIGATION_POSITION | INS_NAVIGATION_VELOCITY;
    n.q_nb[0] = 1;
    n.llh[0] = 0.5;
    return n;
}
} // namespace

TEST(Ros, WrongNamesAreRefusedByName)
{
    auto cfg = config();
    for (const char* node : {"", "ins-navd", "1st", "a/b"})
    {
        cfg.node = node;
        expect_refused(cfg, "ROS node '" + std::string(node) + "'");
    }
    cfg = config();
    for (const char* space : {"", "car", "/car/", "//car", "/car nav"})
    {
        cfg.name_space = space;
        expect_refused(cfg, "ROS namespace '" + std::string(space) + "'");
    }
    cfg = config();
    cfg.base = "base link";
    expect_refused(cfg, "ROS frame 'base link'");
    cfg = config();
    cfg.topic[INS_ROS_FIX].name = "gnss//fix";
    expect_refused(cfg, "ROS topic 'gnss//fix'");
    cfg = config();
    cfg.topic[INS_ROS_TF].decimate = 0;
    expect_refused(cfg, "/tf is decimated by 0");
    cfg = config();
    cfg.gid_octets = 24;
    expect_refused(cfg, "16 octets");
    cfg = config();
    cfg.rate_sigma = std::nan("");
    expect_refused(cfg, "rate_sigma");
    cfg = config();
    cfg.dds.domain = 231;
    expect_refused(cfg, "domain id 231");
}

TEST(Ros, TheDomainOfTheEnvironmentIsHonoured)
{
    auto cfg = config();
    cfg.dds.domain = INS_ROS_DOMAIN_ENV;
    for (const char* text : {"seven", "-1", "231", "7x"})
    {
        ASSERT_EQ(setenv("ROS_DOMAIN_ID", text, 1), 0);
        expect_refused(cfg, "ROS_DOMAIN_ID is '" + std::string(text) + "'");
    }
    ASSERT_EQ(setenv("ROS_DOMAIN_ID", std::to_string(domain()).c_str(), 1), 0);
    const auto first = open(cfg);
    ins_dds_config_t same;
    ins_dds_config_default(&same);
    same.domain = domain();
    ins_dds_t* second = nullptr;
    EXPECT_EQ(ins_dds_open(&same, &second), INS_DDS_E_DOMAIN); // it is in use
    ASSERT_EQ(unsetenv("ROS_DOMAIN_ID"), 0);
}

TEST(Ros, AnInstantThatIsNoneIsRefusedWhole)
{
    const auto ros = open(config());
    auto n = level();
    EXPECT_EQ(ins_ros_publish(ros.get(), &n), INS_DDS_OK) << ins_dds_error_text();
    const auto refused = [&](const ins_navigation_t& bad)
    { return ins_ros_publish(ros.get(), &bad) == INS_DDS_E_ARGUMENT; };
    n.v_n[1] = std::nan("");
    EXPECT_TRUE(refused(n));
    n = level();
    n.q_nb[0] = 0.5;
    EXPECT_TRUE(refused(n));
    n = level();
    n.llh[0] = 2;
    EXPECT_TRUE(refused(n));
    n = level();
    n.P[80] = HUGE_VAL;
    EXPECT_TRUE(refused(n));
    EXPECT_EQ(ins_ros_diagnose(ros.get(), 0, 4, "", nullptr, 0), INS_DDS_E_ARGUMENT);
    EXPECT_EQ(ins_ros_diagnose(ros.get(), 0, 0, "", nullptr, 65), INS_DDS_E_ARGUMENT);
}

TEST(Ros, OpensAndClosesManyTimes)
{
    const int rounds = 20;
    for (int i = 0; i < rounds; i++)
    {
        const auto ros = open(config());
        const auto n = level();
        ASSERT_EQ(ins_ros_publish(ros.get(), &n), INS_DDS_OK) << ins_dds_error_text();
        ASSERT_EQ(ins_ros_matched(ros.get(), INS_ROS_IMU), 0);
    }
}

TEST(Ros, JoinsTheDomainOfAnotherHandle)
{
    ins_dds_config_t states;
    ins_dds_config_default(&states);
    states.domain = domain();
    ins_dds_t* own = nullptr;
    ASSERT_EQ(ins_dds_open(&states, &own), INS_DDS_OK);
    auto cfg = config();
    cfg.dds.network = INS_DDS_JOIN;
    {
        const auto ros = open(cfg);
        const auto n = level();
        EXPECT_EQ(ins_ros_publish(ros.get(), &n), INS_DDS_OK) << ins_dds_error_text();
    }
    ins_dds_close(own);
}
