// ins-navd as a process, a board on the other end of its pty or TCP connection.
// SPDX-License-Identifier: MIT
#include "ins_nav/nav.h"
#include "process.hpp"
#include <arpa/inet.h>
#include <cstring>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace
{
const double limit_s = 20; ///< no test waits longer for something

std::vector<std::string> navd(std::vector<std::string> arguments)
{
    // A long queue: the boards here send faster than real time. A later --queue counts.
    arguments.insert(arguments.begin(), {INS_NAVD, "--queue", "100000"});
    return arguments;
}

/// The daemon's lines must be the very states that the library makes of samples 0, 1, ... (no sample lost).
void expect_states(const std::vector<nlohmann::json>& states, size_t count)
{
    ASSERT_EQ(states.size(), count);
    ins_nav_config_t cfg;
    ins_nav_config_default(&cfg);
    ins_nav_t nav;
    ASSERT_EQ(ins_nav_init(&nav, &cfg), INS_OK);
    for (size_t k = 0; k < count; k++)
    {
        ins_nav_state_t want;
        const auto code = sample(k);
        ASSERT_EQ(ins_nav_codes(&nav, code.data(), 0, &want), INS_OK);
        ASSERT_EQ(states[k]["index"], k);
        ASSERT_EQ(states[k]["bridged"], 0);
        for (size_t i = 0; i < 4; i++)
        {
            const auto got = states[k]["q_nb"][i].get<double>();
            ASSERT_EQ(std::memcmp(&got, &want.q_nb[i], sizeof got), 0) << "sample " << k;
        }
    }
}

class TemporaryDirectory
{
  public:
    TemporaryDirectory()
    {
        char name[] = "/tmp/ins_navd_XXXXXX";
        path = mkdtemp(name);
    }
    ~TemporaryDirectory()
    {
        unlink(link().c_str());
        rmdir(path.c_str());
    }
    std::string link() const { return path + "/board"; }
    std::string path;
};

TEST(Navd, TurnsABoardsSamplesIntoStates)
{
    const size_t count = 500;
    Pty pty;
    Board board(pty.fd, 0, 1000000);
    Process p(navd({"--device", pty.path, "--limit", std::to_string(count)}));
    EXPECT_EQ(p.finish(limit_s), 0) << p.err;
    expect_states(p.states(), count);
    ASSERT_EQ(p.events("summary").size(), 1u) << p.err;
    const auto summary = p.events("summary")[0];
    EXPECT_EQ(summary["reason"], "limit");
    EXPECT_EQ(summary["states"], count);
    EXPECT_EQ(summary["lost"], 0);
    EXPECT_LT(summary["age_max_ms"], 1000);
}

TEST(Navd, EndsCleanlyOnSigterm)
{
    Pty pty;
    Board board(pty.fd, 0, 100);
    Process p(navd({"--device", pty.path}));
    ASSERT_TRUE(board.wait_sent(100, limit_s));
    p.signal(SIGTERM);
    EXPECT_EQ(p.finish(limit_s), 0) << p.err;
    ASSERT_FALSE(p.out.empty());
    EXPECT_EQ(p.out.back(), '\n');
    expect_states(p.states(), 100);
    ASSERT_EQ(p.events("summary").size(), 1u);
    EXPECT_EQ(p.events("summary")[0]["reason"], "signal");
    EXPECT_EQ(p.events("summary")[0]["accepted"], 100);
}

TEST(Navd, SurvivesUnpluggingAndReplugging)
{
    TemporaryDirectory directory;
    auto pty = std::make_unique<Pty>();
    ASSERT_EQ(symlink(pty->path.c_str(), directory.link().c_str()), 0);
    auto board = std::make_unique<Board>(pty->fd, 0, 100);
    Process p(navd({"--device", directory.link()}));
    uint64_t next = 0;
    const int replugs = 3;
    for (int i = 1; i <= replugs; i++)
    {
        ASSERT_TRUE(board->wait_sent(100u * static_cast<unsigned>(i), limit_s)) << p.err;
        board->stop();
        next = board->sent();
        pty.reset(); // the far end is gone: the daemon reads an end of file or an error
        ASSERT_TRUE(p.read_until([&] { return p.events("lost").size() == static_cast<size_t>(i); }, limit_s)) << p.err;
        unlink(directory.link().c_str());
        pty = std::make_unique<Pty>();
        ASSERT_EQ(symlink(pty->path.c_str(), directory.link().c_str()), 0);
        board = std::make_unique<Board>(pty->fd, next, 100);
        ASSERT_TRUE(p.read_until([&] { return p.events("reopened").size() == static_cast<size_t>(i); }, limit_s))
            << p.err;
    }
    ASSERT_TRUE(board->wait_sent(next + 100, limit_s));
    p.signal(SIGINT);
    EXPECT_EQ(p.finish(limit_s), 0) << p.err;
    expect_states(p.states(), 100 * (replugs + 1));
    EXPECT_EQ(p.events("summary")[0]["reopens"], replugs);
}

// Nobody reads the lines: the computing thread waits in its output, the queue runs full, what is dropped is counted and bridged.
TEST(Navd, CountsWhatAFullQueueDrops)
{
    const uint64_t count = 200;
    Pty pty;
    Board board(pty.fd, 0, count);
    Process p(navd({"--device", pty.path, "--queue", "3"}));
    p.shrink_out();
    ASSERT_TRUE(board.wait_sent(count, limit_s)) << "the receiving thread must go on answering";
    board.stop();
    Board more(pty.fd, count, 1);
    // The last samples find a queue that empties now that the lines are read.
    ASSERT_TRUE(p.read_until([&] { return p.states().size() >= 5; }, limit_s));
    ASSERT_TRUE(more.wait_sent(count + 1, limit_s));
    more.stop();
    // One at a time, until the queue is empty again and the newest sample is the newest state.
    uint64_t sent = count + 1;
    bool caught_up = false;
    for (; !caught_up && sent < count + 41; sent++)
    {
        Board one(pty.fd, sent, 1);
        ASSERT_TRUE(one.wait_sent(sent + 1, limit_s));
        one.stop();
        caught_up = p.read_until([&] { return !p.states().empty() && p.states().back()["index"] == sent; }, 0.5);
    }
    ASSERT_TRUE(caught_up) << p.err;
    p.signal(SIGTERM);
    EXPECT_EQ(p.finish(limit_s), 0) << p.err;
    const auto summary = p.events("summary")[0];
    const auto states = p.states();
    uint64_t bridged = 0;
    for (const auto& s : states)
    {
        bridged += s["bridged"].get<uint64_t>();
        const auto& flags = s["status"];
        EXPECT_EQ(std::count(flags.begin(), flags.end(), "bridged"), s["bridged"] > 0 ? 1 : 0);
    }
    EXPECT_GT(summary["overruns"], 100);
    EXPECT_EQ(summary["overruns"], bridged);
    EXPECT_EQ(summary["missed"], bridged);
    EXPECT_EQ(summary["lost"], 0) << "nothing was lost on the line";
    EXPECT_EQ(summary["accepted"], sent);
    EXPECT_EQ(states.size() + bridged, sent);
}

TEST(Navd, StopsWhileNobodyReadsItsLines)
{
    Pty pty;
    Board board(pty.fd, 0, 100);
    Process p(navd({"--device", pty.path, "--queue", "3"}));
    p.shrink_out();
    ASSERT_TRUE(board.wait_sent(100, limit_s));
    p.signal(SIGTERM);
    ASSERT_TRUE(p.read_until([&] { return p.events("summary").size() == 1; }, limit_s, false)) << "no hang: " << p.err;
    EXPECT_GT(p.events("summary")[0]["unwritten"], 0);
    EXPECT_EQ(p.finish(limit_s), 0);
    for (const auto& s : p.states())
    {
        EXPECT_TRUE(s.contains("link")) << "whole lines only";
    }
}

TEST(Navd, AClosedPipeIsAnErrorOfItsOwn)
{
    Pty pty;
    Board board(pty.fd, 0, 1000000);
    Process p(navd({"--device", pty.path}));
    p.close_out();
    EXPECT_EQ(p.finish(limit_s), 1);
    EXPECT_NE(p.err.find("cannot write -: Broken pipe"), std::string::npos) << p.err;
}

TEST(Navd, TellsASilentLine)
{
    Pty pty;
    Process p(navd({"--device", pty.path, "--timeout-s", "0.3"}));
    EXPECT_EQ(p.finish(limit_s), 1);
    EXPECT_NE(p.err.find("no sample for 0.3 s"), std::string::npos) << p.err;
    EXPECT_NE(p.err.find("not one octet came"), std::string::npos) << p.err;
    EXPECT_TRUE(p.out.empty());
}

// What a wrong baud looks like: octets, but no block.
TEST(Navd, HintsAtTheSettingsWhenNoBlockIsRight)
{
    Pty pty;
    Process p(navd({"--device", pty.path, "--timeout-s", "3"}));
    ASSERT_TRUE(p.read_until([&] { return p.events("open").size() == 1; }, limit_s));
    const double end = seconds_now() + 10;
    while (p.events("no_samples").empty() && seconds_now() < end)
    {
        const uint8_t noise[4] = {0xAA, 0x01, 0x80, 0xFE};
        ASSERT_EQ(write(pty.fd, noise, sizeof noise), 4);
        (void)p.read_until([] { return false; }, 0.02);
    }
    EXPECT_EQ(p.finish(limit_s), 1);
    ASSERT_EQ(p.events("no_samples").size(), 1u) << p.err;
    EXPECT_NE(p.err.find("octets came, but no right block"), std::string::npos) << p.err;
}

TEST(Navd, RefusesWhatItCannotUse)
{
    Pty pty;
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{}, "no device"},
        {{"--device", "/dev/there_is_none"}, "No such file or directory: is the board plugged in?"},
        {{"--device", "/dev/null"}, "this is no serial device or pty"},
        {{"--device", "/etc/passwd", "--wait"}, "this is no serial device or pty"},
        {{"--device", "tcp:127.0.0.1"}, "write tcp:HOST:PORT"},
        {{"--device", "tcp:127.0.0.1:1"}, "Connection refused; is the other end running?"},
        {{"--device", pty.path, "--baud", "9601"}, "--baud: not a rate of this system"},
        {{"--device", pty.path, "--baud", "fast"}, "--baud: 'fast' is not a whole number"},
        {{"--device", pty.path, "--period", "nan"}, "--period: 'nan' is not a number"},
        {{"--device", pty.path, "--period", "0"}, "the period must be"},
        {{"--device", pty.path, "--attitude-deg", "1,2"}, "--attitude-deg: '1,2' is not three numbers"},
        {{"--device", pty.path, "--form", "best"}, "--form: 'best' is none of"},
        {{"--device", pty.path, "--json", "/nowhere/x"}, "cannot write /nowhere/x"},
        {{"--device", pty.path, "--topic", "x"}, "want --dds"},
        {{"--device", pty.path, "--decimate", "10"}, "want --dds"},
        {{"--device", pty.path, "--dds", "--qos", "nav_state=fast"}, "sensor_data"},
        {{"--device", pty.path, "--dds=231"}, "is not a whole number from 0 to 230"},
        {{"--device", pty.path, "more"}, "an argument too many"},
        {{"--frobnicate"}, "unrecognized option"},
    };
    for (const auto& [arguments, message] : cases)
    {
        Process p(navd(arguments));
        EXPECT_EQ(p.finish(limit_s), 2) << message << "\n" << p.err;
        EXPECT_NE(p.err.find(message), std::string::npos) << p.err;
        EXPECT_TRUE(p.out.empty());
    }
}

TEST(Navd, RefusesADeviceThatAnotherOneHolds)
{
    Pty pty;
    Process first(navd({"--device", pty.path}));
    ASSERT_TRUE(first.read_until([&] { return first.events("open").size() == 1; }, limit_s));
    Process second(navd({"--device", pty.path}));
    EXPECT_EQ(second.finish(limit_s), 2);
    EXPECT_NE(second.err.find("another program has it open"), std::string::npos) << second.err;
}

TEST(Navd, WaitsForADeviceWhenTold)
{
    TemporaryDirectory directory;
    Process p(navd({"--device", directory.link(), "--wait", "--limit", "20"}));
    ASSERT_TRUE(p.read_until([&] { return p.events("waiting").size() == 1; }, limit_s)) << p.err;
    Pty pty;
    Board board(pty.fd, 0, 1000000);
    ASSERT_EQ(symlink(pty.path.c_str(), directory.link().c_str()), 0);
    EXPECT_EQ(p.finish(limit_s), 0) << p.err;
    expect_states(p.states(), 20);
}

TEST(Navd, TakesATcpConnectionAndComesBackToIt)
{
    const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    ASSERT_EQ(bind(listener, reinterpret_cast<sockaddr*>(&address), length), 0);
    ASSERT_EQ(listen(listener, 1), 0);
    ASSERT_EQ(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &length), 0);
    Process p(navd({"--device", "tcp:127.0.0.1:" + std::to_string(ntohs(address.sin_port)), "--limit", "100"}));
    for (uint64_t first = 0; first < 100; first += 50)
    {
        pollfd ready = {listener, POLLIN, 0};
        ASSERT_EQ(poll(&ready, 1, static_cast<int>(limit_s * 1000)), 1) << p.err;
        const int fd = accept(listener, nullptr, nullptr);
        ASSERT_GE(fd, 0);
        Board board(fd, first, 50);
        if (first == 0)
        {
            ASSERT_TRUE(board.wait_sent(50, limit_s)) << p.err;
        }
        else
        {
            // The last acknowledgement may go down with the connection that the daemon closes at its limit.
            EXPECT_EQ(p.finish(limit_s), 0) << p.err;
        }
        board.stop();
        close(fd);
    }
    close(listener);
    expect_states(p.states(), 100);
}

// INS_NAVD_ARM is the path of an ARM build of ins-navd (preset armel).
TEST(Navd, TheArmBinaryGivesTheSameBits)
{
    const char* arm = std::getenv("INS_NAVD_ARM");
    ASSERT_NE(arm, nullptr)
        << "INS_NAVD_ARM is not set: cmake --preset armel && cmake --build --preset armel, then set it to "
           "build/armel/libins/host/navd/ins-navd; ./dev test does both";
    const size_t count = 1000;
    const std::vector<std::string> options = {"--limit",        std::to_string(count),
                                              "--attitude-deg", "10,-20,130",
                                              "--skew-us",      "0,300,600",
                                              "--queue",        "100000",
                                              "--timeout-s",    "15"};
    std::vector<std::vector<nlohmann::json>> states;
    const std::vector<std::vector<std::string>> programs = {navd({}), {"qemu-arm", "-cpu", "arm926", arm}};
    for (std::vector<std::string> command : programs)
    {
        Pty pty;
        Board board(pty.fd, 0, 1000000);
        command.insert(command.end(), {"--device", pty.path});
        command.insert(command.end(), options.begin(), options.end());
        Process p(command);
        ASSERT_EQ(p.finish(60), 0) << p.err;
        states.push_back(p.states());
        ASSERT_EQ(states.back().size(), count);
    }
    for (size_t k = 0; k < count; k++)
    {
        for (const char* key : {"q_nb", "w_ib_b", "dtheta_b"})
        {
            ASSERT_EQ(states[0][k][key].dump(), states[1][k][key].dump()) << "sample " << k;
        }
    }
    EXPECT_NE(states[0][0]["q_nb"], states[0][count - 1]["q_nb"]);
}
} // namespace
