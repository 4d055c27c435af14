// ins-gpsdr as a process, a receiver and an odometer board on the other end of its ptys.
// SPDX-License-Identifier: MIT
#include "ins_nav/vehicle.h"
#include "process.hpp"
#include "vehicle_drive.hpp"
#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>

namespace
{
const double limit_s = 20; ///< no test waits longer for something
using vehicle_drive::Drive;

void send(const Pty& pty, const std::string& text)
{
    for (size_t at = 0; at < text.size();)
    {
        const ssize_t n = write(pty.fd, text.data() + at, text.size() - at);
        ASSERT_GT(n, 0);
        at += static_cast<size_t>(n);
    }
}

std::vector<std::string> gpsdr(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), {INS_GPSDR, "--metres-per-count", "0.04"});
    return arguments;
}

/// Waits until the daemon has the line, so that nothing is lost.
bool is_open(Process& p, size_t lines)
{
    return p.read_until([&] { return p.events("open").size() == lines; }, limit_s, false);
}

ptrdiff_t lines(const Process& p)
{
    return std::count(p.out.begin(), p.out.end(), '\n');
}
} // namespace

TEST(Gpsdr, SaysOfALineWhatTheLibrarySaysOfItsOctets)
{
    const double seconds = 60;
    Pty pty;
    Process p(gpsdr({"--gps", pty.path, "--limit", "599"}));
    ASSERT_TRUE(is_open(p, 1)) << p.err;
    ins_vehicle_config_t cfg;
    ins_vehicle_config_default(&cfg);
    cfg.metres_per_count = 0.04;
    ins_vehicle_t v;
    ASSERT_EQ(ins_vehicle_init(&v, &cfg), INS_OK);
    std::vector<ins_nav_solution_t> want;
    Drive d(1);
    std::thread feeder(
        [&]
        {
            while (d.t < seconds - 0.05)
            {
                const std::string text = d.step(d.t < 40);
                send(pty, text);
                ins_nav_solution_t s;
                for (const char c : text)
                {
                    if (ins_vehicle_octet(&v, 0, static_cast<ins_octet_t>(c), &s))
                    {
                        want.push_back(s);
                    }
                }
            }
        });
    const int code = p.finish(limit_s);
    feeder.join();
    EXPECT_EQ(code, 0) << p.err;
    const auto said = p.states();
    ASSERT_EQ(said.size(), 599u);
    ASSERT_EQ(want.size(), said.size());
    for (size_t k = 0; k < said.size(); k++)
    {
        ASSERT_EQ(said[k]["index"], k + 1);
        for (size_t i = 0; i < 2; i++)
        {
            const auto got = said[k]["lat_lon_rad"][i].get<double>();
            ASSERT_EQ(std::memcmp(&got, &want[k].lat_lon_rad[i], sizeof got), 0) << k;
        }
    }
    EXPECT_EQ(said.back()["status"].size(), 2u) << said.back();
    EXPECT_GE(p.events("source").size(), 3u) << "ALIGN, GPS, DR: " << p.err;
    const auto summary = p.events("summary");
    ASSERT_EQ(summary.size(), 1u);
    EXPECT_EQ(summary[0]["reason"], "limit");
    EXPECT_EQ(summary[0]["samples"], 599);
    EXPECT_EQ(summary[0]["bad_nmea"], 0);
}

TEST(Gpsdr, ShowsThePapersDisplayAndEndsOnSigterm)
{
    Pty pty;
    Process p(gpsdr({"--gps", pty.path, "--display"}));
    ASSERT_TRUE(is_open(p, 1)) << p.err;
    Drive d(2);
    while (d.t < 29.95)
    {
        send(pty, d.step(true, true));
    }
    const auto shown = [&] { return p.out.find("GPS ") != std::string::npos; };
    EXPECT_TRUE(p.read_until(shown, limit_s)) << p.out << p.err;
    p.signal(SIGTERM);
    EXPECT_EQ(p.finish(limit_s), 0) << p.err;
    const std::string last = p.out.substr(p.out.rfind("\n\n") + 2);
    std::istringstream text(last);
    std::string line[4];
    for (std::string& l : line)
    {
        ASSERT_TRUE(std::getline(text, l)) << p.out;
    }
    EXPECT_EQ(line[0].substr(0, 4), " 52 ") << last;
    EXPECT_NE(line[0].find(" N   13 22."), std::string::npos) << last;
    EXPECT_EQ(line[0].back(), 'W') << last;
    EXPECT_EQ(line[1].substr(0, 15), "2026-05-03 12:3") << last;
    EXPECT_NE(line[2].find(" km/h   heading "), std::string::npos) << last;
    EXPECT_NEAR(std::stod(line[2]), 36.0, 2.0) << last;
    EXPECT_NE(line[3].find("9 satellites  +-"), std::string::npos) << last;
    EXPECT_EQ(p.events("summary").at(0)["reason"], "signal");
}

TEST(Gpsdr, TakesReceiverAndBoardFromLinesOfTheirOwn)
{
    Pty gps;
    Pty board;
    Process p(gpsdr({"--gps", gps.path, "--board", board.path}));
    ASSERT_TRUE(is_open(p, 2)) << p.err;
    Drive d(4);
    ptrdiff_t ticks = 0;
    while (d.t < 19.95)
    {
        const std::string text = d.step(true, true);
        const size_t at = text.find("$PINSD");
        send(gps, text.substr(0, at));
        std::this_thread::sleep_for(
            std::chrono::milliseconds(at > 0 ? 30 : 0)); // both lines are read before the board goes on
        send(board, text.substr(at));
        ASSERT_TRUE(p.read_until([&] { return lines(p) >= ticks; }, limit_s)) << p.err;
        ticks++;
    }
    EXPECT_TRUE(p.read_until([&] { return lines(p) >= 199; }, limit_s)) << p.err;
    p.signal(SIGTERM);
    EXPECT_EQ(p.finish(limit_s), 0);
    const auto last = p.states().back();
    EXPECT_NEAR((last["lat_lon_rad"][0].get<double>() - d.latitude()) * vehicle_drive::RADIUS_N, 0, 12);
    EXPECT_EQ(last["sats"], 9);
    EXPECT_GE(p.events("summary").at(0)["fixes"], 18);
}

TEST(Gpsdr, SurvivesALineThatComesAndGoes)
{
    char name[] = "/tmp/ins_gpsdr_XXXXXX";
    const std::string directory = mkdtemp(name);
    const std::string link = directory + "/line";
    auto pty = std::make_unique<Pty>();
    ASSERT_EQ(symlink(pty->path.c_str(), link.c_str()), 0);
    Process p(gpsdr({"--gps", link}));
    ASSERT_TRUE(is_open(p, 1)) << p.err;
    Drive d(3);
    while (d.t < 29.95)
    {
        send(*pty, d.step(true));
    }
    EXPECT_TRUE(p.read_until([&] { return lines(p) >= 299; }, limit_s)) << p.err;
    pty.reset();
    EXPECT_TRUE(p.read_until([&] { return p.events("lost").size() == 1; }, limit_s)) << p.err;
    pty = std::make_unique<Pty>();
    ASSERT_EQ(unlink(link.c_str()), 0);
    ASSERT_EQ(symlink(pty->path.c_str(), link.c_str()), 0);
    EXPECT_TRUE(p.read_until([&] { return p.events("reopened").size() == 1; }, limit_s)) << p.err;
    while (d.t < 39.95)
    {
        send(*pty, d.step(true));
    }
    EXPECT_TRUE(p.read_until([&] { return lines(p) >= 399; }, limit_s)) << p.err;
    p.signal(SIGTERM);
    EXPECT_EQ(p.finish(limit_s), 0);
    EXPECT_EQ(p.events("summary").at(0)["reopens"], 1);
    EXPECT_EQ(unlink(link.c_str()), 0);
    EXPECT_EQ(rmdir(directory.c_str()), 0);
}

TEST(Gpsdr, SaysWhatIsWrongAndWhatWouldBeRight)
{
    struct Case
    {
        std::vector<std::string> arguments;
        const char* word;
    };
    const std::vector<Case> cases = {
        {{}, "give --gps"},
        {{"--gps", "/nowhere/tty"}, "No such file"},
        {{"--gps", "/dev/null"}, "no serial device"},
        {{"--gps", "tcp:127.0.0.1"}, "tcp:HOST:PORT"},
        {{"--gps", "x", "--filter", "best"}, "paper-printed"},
        {{"--gps", "x", "--tau-fix-s", "-1"}, "--tau-fix-s: '-1' is not a number from 0"},
        {{"--gps", "x", "--lsb-deg-s", "0"}, "yaw rate per code"},
        {{"--gps", "x", "--baud", "12345"}, "not a rate"},
        {{"--gps", "x", "--topic", "t"}, "want --dds"},
        {{"--gps", "x", "--display", "--json", "-"}, "standard output"},
        {{"--gps", "x", "y"}, "too many"},
        {{"--speed"}, "try --help"},
    };
    for (const Case& c : cases)
    {
        Process p(gpsdr(c.arguments));
        EXPECT_EQ(p.finish(limit_s), 2) << c.word;
        EXPECT_NE(p.err.find(c.word), std::string::npos) << p.err;
    }
    Pty pty;
    Process p(gpsdr({"--gps", pty.path, "--timeout-s", "0.2"}));
    EXPECT_EQ(p.finish(limit_s), 1);
    EXPECT_NE(p.err.find("no sentence of the board for 0.2 s"), std::string::npos) << p.err;
    Process help(gpsdr({"--help"}));
    EXPECT_EQ(help.finish(limit_s), 0);
    EXPECT_NE(help.out.find("--metres-per-count"), std::string::npos);
}
