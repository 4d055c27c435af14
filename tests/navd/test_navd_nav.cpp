// ins-navd --input nav as a process, a navigating board on the other end of its pty.
// SPDX-License-Identifier: MIT
#include "ins_nav/nav_input.h"
#include "process.hpp"
#include <cstring>
#include <gtest/gtest.h>

namespace
{
const double limit_s = 20; ///< no test waits longer for something

std::vector<std::string> navd(const Pty& pty, const std::vector<std::string>& more)
{
    std::vector<std::string> arguments = {INS_NAVD, "--device", pty.path, "--input", "nav", "--queue", "100000"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

void expect_bits(const nlohmann::json& got, double want)
{
    const auto value = got.get<double>();
    EXPECT_EQ(std::memcmp(&value, &want, sizeof value), 0) << got << ", want " << want;
}
} // namespace

TEST(NavdNav, PrintsWhatTheBoardSays)
{
    const size_t count = 300;
    Pty pty;
    Board board(pty.fd, 0, 1000000, nav_block);
    Process p(navd(pty, {"--limit", std::to_string(count)}));
    EXPECT_EQ(p.finish(limit_s), 0) << p.err;
    const auto lines = p.states();
    ASSERT_EQ(lines.size(), count);
    for (size_t k = 0; k < count; k++)
    {
        const ins_nav_block_t want = nav_of(k);
        ASSERT_EQ(lines[k]["index"], k);
        ASSERT_EQ(lines[k]["lost"], 0);
        ASSERT_EQ(lines[k]["seq"], k & 0xFF);
        EXPECT_EQ(lines[k]["status"].size(), 4u);
        EXPECT_EQ(lines[k]["zone"], 121);
        EXPECT_EQ(lines[k]["sats"], 8);
        expect_bits(lines[k]["t_s"], want.time_ms * 1e-3);
        expect_bits(lines[k]["en_m"][0], want.en_cm[0] * 0.01);
        expect_bits(lines[k]["en_m"][1], want.en_cm[1] * 0.01);
        expect_bits(lines[k]["v_en_m_s"][1], 0.063); // of 62.5 mm/s
        EXPECT_NEAR(lines[k]["q_nb"][3].get<double>(), want.q_nb[3], 2.1e-7);
    }
    const auto summary = p.events("summary");
    ASSERT_EQ(summary.size(), 1u) << p.err;
    EXPECT_EQ(summary[0]["states"], count);
    EXPECT_EQ(summary[0]["lost"], 0);
    EXPECT_GE(summary[0]["accepted"], count);
}

TEST(NavdNav, AGapInTheNumbersIsCounted)
{
    Pty pty;
    auto board = std::make_unique<Board>(pty.fd, 0, 10, nav_block);
    Process p(navd(pty, {"--limit", "20"}));
    ASSERT_TRUE(board->wait_sent(10, limit_s)) << p.err;
    board = nullptr;
    board = std::make_unique<Board>(pty.fd, 17, 10, nav_block);
    EXPECT_EQ(p.finish(limit_s), 0) << p.err;
    const auto lines = p.states();
    ASSERT_EQ(lines.size(), 20u);
    EXPECT_EQ(lines[10]["lost"], 7);
    EXPECT_EQ(lines[10]["index"], 17);
    EXPECT_EQ(p.events("summary")[0]["missed"], 7);
    EXPECT_EQ(p.events("summary")[0]["lost"], 7);
}

TEST(NavdNav, CodesForANavigatingBoardAreHintedAt)
{
    Pty pty;
    Board board(pty.fd, 0, 1000000); // blocks of 6: no block of 32 gets its sum right but by chance
    Process p(navd(pty, {"--timeout-s", "3"}));
    EXPECT_EQ(p.finish(limit_s), 1) << p.err;
    EXPECT_NE(p.err.find("compare --baud and --input"), std::string::npos) << p.err;
}

TEST(NavdNav, OptionsOfTheOtherInputAreRefused)
{
    const std::vector<std::pair<std::vector<std::string>, std::string>> bad = {
        {{"--input", "gps"}, "--input: 'gps' is none of codes, nav, six"},
        {{"--input", "nav", "--period", "0.1"}, "--period is for --input codes"},
        {{"--skew-us", "0,1,2", "--input", "nav"}, "--skew-us is for --input codes"},
        {{"--input", "nav", "--no-seq"}, "--no-seq is for --input codes"},
        {{"--input", "nav", "-a", "0,0,0"}, "--attitude-deg is for --input codes"},
        {{"--input", "nav", "--bridge-max", "3"}, "--bridge-max is for --input codes"},
        {{"--input", "nav", "--still-s", "1"}, "--still-s is for --input six: a navigating board"},
        {{"--still-s", "1"}, "--still-s is for --input six: these are gyros"},
        {{"--input", "six", "--form", "one"}, "--form is for --input codes: these are accelerometers"},
        {{"--input", "six"}, "--position-deg: is missing"},
        {{"--input", "six", "--position-deg", "24,121,60", "--skew-us", "0,1,2"}, "'0,1,2' is not six numbers"},
        {{"--input", "six", "--position-deg", "24,121,60", "--accel", "7,0,1,0,0,0,0,1"}, "no number from 1 to 6"},
        {{"--input", "six", "--position-deg", "24,121,60", "--accel", "1,0,1,0,0,0,0,1"}, "for all six, or for none"},
        {{"--input", "six", "--position-deg", "95,121,60"}, "--input six: the accelerometers"},
        {{"--input", "nav", "--block-len", "32"}, "--block-len is for --input codes"},
    };
    for (const auto& [arguments, text] : bad)
    {
        std::vector<std::string> all = {INS_NAVD, "--device", "/dev/null"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        Process p(all);
        EXPECT_EQ(p.finish(limit_s), 2) << text;
        EXPECT_NE(p.err.find(text), std::string::npos) << p.err;
    }
    Pty pty;
    Process p({INS_NAVD, "--device", pty.path, "--input", "codes", "--period", "0.1", "--timeout-s", "0.2"});
    EXPECT_EQ(p.finish(limit_s), 1) << p.err;
}
