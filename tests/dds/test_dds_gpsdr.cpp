// ins-gpsdr publishes over DDS what it prints: a process with a drive on its pty, heard on loopback.
// SPDX-License-Identifier: MIT
#include "ins_dds/dds.h"
#include "process.hpp"
#include "vehicle_drive.hpp"
#include <gtest/gtest.h>
#include <map>

namespace
{
const double limit_s = 20;
const int ticks = 300;
} // namespace

TEST(DdsGpsdr, PublishesTheSolutionsItPrints)
{
    const uint32_t domain = 100 + static_cast<uint32_t>(getpid()) % 100;
    ins_dds_config_t cfg;
    ins_dds_config_default(&cfg);
    cfg.domain = domain;
    ins_dds_config_carry(&cfg, INS_DDS_SOLUTION);
    cfg.publishes = 0;
    cfg.subscribes = 1;
    cfg.topic[INS_DDS_SOLUTION].qos.history = cfg.topic[INS_DDS_STATE].qos.history = ticks;
    ins_dds_t* opened = nullptr;
    ASSERT_EQ(ins_dds_open(&cfg, &opened), INS_DDS_OK) << ins_dds_error_text();
    const std::unique_ptr<ins_dds_t, void (*)(ins_dds_t*)> dds(opened, ins_dds_close);
    Pty pty;
    Process p({INS_GPSDR, "--gps", pty.path, "--metres-per-count", "0.04", "--dds=" + std::to_string(domain), "--json",
               "-", "--source", "car", "--limit", std::to_string(ticks - 1)});
    for (const double end = seconds_now() + limit_s; ins_dds_matched(dds.get()) < 2 && seconds_now() < end;)
    {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    vehicle_drive::Drive d(1);
    std::thread feeder(
        [&]
        {
            for (int k = 0; k < ticks; k++)
            {
                const std::string text = d.step(true, true);
                EXPECT_EQ(write(pty.fd, text.data(), text.size()), static_cast<ssize_t>(text.size()));
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
        });
    std::map<uint64_t, ins_nav_solution_t> got;
    std::map<uint64_t, ins_navigation_t> states;
    bool gone = false;
    bool drained = false;
    for (const double end = seconds_now() + limit_s; !(gone && drained) && seconds_now() < end;)
    {
        ins_dds_sample_t s;
        drained = ins_dds_take(dds.get(), 0.1, &s, 1) == 0;
        if (!drained)
        {
            EXPECT_STREQ(s.source, "car");
            gone = s.gone != 0;
            if (s.valid && s.kind == INS_DDS_SOLUTION)
            {
                got[s.solution.index] = s.solution;
            }
            if (s.valid && s.kind == INS_DDS_STATE)
            {
                states[s.state.index] = s.navigation;
            }
        }
        (void)p.read_until([] { return false; }, 0.001);
    }
    feeder.join();
    EXPECT_EQ(p.finish(limit_s), 0) << p.err;
    EXPECT_TRUE(gone) << "its publisher has left";
    const auto lines = p.states();
    ASSERT_EQ(lines.size(), static_cast<size_t>(ticks - 1)) << p.err;
    EXPECT_GE(got.size(), lines.size() * 9 / 10) << p.err;
    size_t placed = 0;
    for (const auto& line : lines)
    {
        const auto found = got.find(line["index"].get<uint64_t>());
        if (found != got.end())
        {
            EXPECT_EQ(line["lat_lon_rad"][0].get<double>(), found->second.lat_lon_rad[0]);
            EXPECT_EQ(line["euler_rad"][2].get<double>(), found->second.euler_rad[2]);
        }
        const auto full = states.find(line["index"].get<uint64_t>());
        if (full != states.end() && (full->second.valid & INS_NAVIGATION_POSITION) != 0)
        {
            EXPECT_EQ(line["lat_lon_rad"][0].get<double>(), full->second.llh[0]);
            EXPECT_EQ(line["v_en_m_s"][0].get<double>(), full->second.v_n[1]);
            placed++;
        }
    }
    EXPECT_GE(placed, lines.size() / 2);
    const uint32_t wanted = INS_NAV_BLOCK_POSITION | INS_NAV_BLOCK_ALIGNED;
    EXPECT_EQ(got.rbegin()->second.status & wanted, wanted);
    EXPECT_EQ(p.events("summary").at(0)["unpublished"], 0);
}
