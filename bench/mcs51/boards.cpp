/// \file   boards.cpp
/// \brief  A load for bench_mcs51.py: boards on threads of their own, each running an image to its halt again and again.
///
///     bench_mcs51_boards IMAGE.bin BOARDS TIMES PINS       PINS 1: a port callback that counts the edges
///
/// Prints the edges of one run, and the seconds that the boards ran.
/// SPDX-License-Identifier: MIT
#include "emu_8051/mcs51.h"
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

namespace
{

void count_edge(void* ctx, unsigned, uint8_t, uint8_t, uint64_t)
{
    ++*static_cast<uint64_t*>(ctx);
}

/// \return edges, or -1 if the program did not end.
int64_t run(const std::vector<char>& image, bool pins)
{
    uint64_t edges = 0;
    mcs51_config_t config{};
    config.clock = {11059200, 12};
    config.port = pins ? count_edge : nullptr;
    config.ctx = &edges;
    mcs51_t* const cpu = mcs51_create(&config);
    const auto* const octets = reinterpret_cast<const uint8_t*>(image.data());
    const bool ended =
        cpu != nullptr && mcs51_load(cpu, 0, octets, image.size()) == 0 && mcs51_run(cpu, UINT64_MAX) == MCS51_HALTED;
    mcs51_destroy(cpu);
    return ended ? static_cast<int64_t>(edges) : -1;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 5)
    {
        std::fprintf(stderr, "usage: bench_mcs51_boards IMAGE.bin BOARDS TIMES PINS\n");
        return 2;
    }
    std::ifstream file(argv[1], std::ios::binary);
    const std::vector<char> image((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    const auto boards = static_cast<size_t>(std::atoi(argv[2]));
    const int times = std::atoi(argv[3]);
    const bool pins = std::atoi(argv[4]) != 0;
    std::vector<int64_t> edges(boards, 0);
    const auto start = std::chrono::steady_clock::now();
    std::vector<std::thread> threads;
    for (int64_t& e : edges)
    {
        threads.emplace_back(
            [&]
            {
                for (int i = 0; i < times && e >= 0; ++i)
                {
                    e = run(image, pins);
                }
            });
    }
    for (std::thread& t : threads)
    {
        t.join();
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    for (const int64_t e : edges)
    {
        if (e < 0 || e != edges[0])
        {
            std::fprintf(stderr, "bench_mcs51_boards: %s was not run to its halt on every board\n", argv[1]);
            return 1;
        }
    }
    std::printf("edges %lld seconds %.6f\n", static_cast<long long>(edges[0]), seconds.count());
    return 0;
}
