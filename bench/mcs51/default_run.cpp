/// \file   default_run.cpp
/// \brief  A load for callgrind: N seconds of the default scenario in C++, with or without the record of edges.
///
///     bench_default_run IMAGE.ihx N [trace|save|restore M]
///
/// Run twice with different N: the difference over the difference is the cost of a simulated second, start-up subtracted; with
/// different M, that of a snapshot of the board, saved or restored, at the end.
/// Prints what the run counted.
/// SPDX-License-Identifier: MIT
#include "run.hpp"
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

namespace
{

/// Data records of an Intel HEX file; the image comes from our own linker, so nothing is checked.
std::vector<libins::Segment> read_hex(const char* path)
{
    std::ifstream in(path);
    if (!in)
    {
        throw std::runtime_error(std::string(path) + ": cannot be read; build the target firmware_8051");
    }
    std::vector<libins::Segment> image;
    std::string line;
    const auto octet = [&line](size_t at) { return std::stoul(line.substr(at, 2), nullptr, 16); };
    while (std::getline(in, line))
    {
        if (line.size() < 11 || octet(7) != 0)
        {
            continue;
        }
        libins::Segment segment{static_cast<uint16_t>(octet(3) << 8 | octet(5)), {}};
        for (size_t i = 0; i < octet(1); i++)
        {
            segment.octets.push_back(static_cast<char>(octet(9 + 2 * i)));
        }
        image.push_back(segment);
    }
    return image;
}

/// scenarios/default.toml
libins::RunConfig config_of(const char* image, bool trace, const ins_gyro_config_t& gyro)
{
    ins_nav_config_t nav;
    ins_nav_config_default(&nav);
    nav.period_s = 0.02;
    nav.seq = 1;
    const double skew_s[3] = {0.0, 125.868e-6, 260.417e-6};
    for (unsigned i = 0; i < 3; i++)
    {
        nav.delay_s[i] = skew_s[i];
        ins_gyro_scale(&gyro, i, 12, 0.0, 5.0, &nav.lsb_rad_s[i], &nav.null_code[i]);
    }
    libins::RunConfig config;
    config.image = read_hex(image);
    config.nav = nav;
    config.trace = trace;
    return config;
}

} // namespace

int main(int argc, char** argv)
try
{
    if (argc < 3)
    {
        throw std::runtime_error("bench_default_run IMAGE.ihx SECONDS [trace]");
    }
    ins_gyro_config_t gyro;
    ins_gyro_default_config(&gyro);
    const ins_motion_sines_t sines = {{0.0, 1.0, 0.2, 0.0}, {0.0, 0.5, 0.3, 0.0}, {0.0, 0.3, 0.25, 0.0}};
    char why[256];
    const std::shared_ptr<ins_motion_t> motion(ins_motion_create_euler(&sines, 2.0, why, sizeof why),
                                               ins_motion_destroy);
    const bool trace = argc > 3 && std::strcmp(argv[3], "trace") == 0;
    libins::Run run(config_of(argv[1], trace, gyro), motion, gyro);
    run.until(std::atoll(argv[2]) * 1'000'000'000'000);
    std::vector<uint8_t> octets(acq_board_save(run.board(), nullptr, 0));
    acq_board_save(run.board(), octets.data(), octets.size());
    for (int i = 0; argc > 4 && i < std::atoi(argv[4]); i++)
    {
        if (std::strcmp(argv[3], "restore") == 0
                ? acq_board_restore(run.board(), octets.data(), octets.size()) != 0
                : acq_board_save(run.board(), octets.data(), octets.size()) != octets.size())
        {
            throw std::runtime_error("the board refuses its own snapshot");
        }
    }
    std::printf("instructions %llu cycles %llu accepted %llu edges %zu snapshot %zu\n",
                static_cast<unsigned long long>(mcs51_instructions(run.cpu())),
                static_cast<unsigned long long>(mcs51_cycle(run.cpu())),
                static_cast<unsigned long long>(run.counts().accepted), run.take_edges().size(), octets.size());
    return 0;
}
catch (const std::exception& error)
{
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
