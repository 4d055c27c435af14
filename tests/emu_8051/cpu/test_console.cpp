/// \file   test_console.cpp
/// \brief  Firmware of others by the C API alone: console from SBUF, end at a read of external RAM, exit code from RAM (console.c).
/// SPDX-License-Identifier: MIT
#include "bare_cpu.hpp"
#include <cmath>
#include <cstdio>

namespace
{

constexpr uint16_t END = 0xFFFF;
constexpr uint8_t EXIT_CODE = 0x7F, SBUF = 0x99;
constexpr uint64_t LIMIT = 200'000'000; ///< cycles
constexpr unsigned FLASH = 8192;

struct console
{
    mcs51_t* cpu = nullptr;
    std::string text;

    static void access(void* ctx, mcs51_space_t space, uint16_t address, uint8_t value, bool write, uint64_t)
    {
        auto* self = static_cast<console*>(ctx);
        if (space == MCS51_SFR && address == SBUF && write)
        {
            self->text.push_back(static_cast<char>(value));
        }
        if (space == MCS51_XDATA && address == END && !write)
        {
            mcs51_stop(self->cpu);
        }
    }
};

/// The integer lines as this machine computes them.
std::string expected()
{
    uint32_t state = 1;
    unsigned crc = 0xFFFF;
    for (int i = 0; i < 12000; ++i)
    {
        state = state * 1103515245u + 12345u;
        crc ^= (state >> 16 & 0xFFu) << 8;
        for (int bit = 0; bit < 8; ++bit)
        {
            crc = (crc & 0x8000u ? crc << 1 ^ 0x1021u : crc << 1) & 0xFFFFu;
        }
    }
    unsigned sum = 0;
    for (unsigned i = 0; i < 100; ++i)
    {
        sum = (sum * 3 + (i * 7 & 0xFFu)) & 0xFFu;
    }
    char lines[80];
    std::snprintf(lines, sizeof lines, "crc %04x\nidata %u\ngcd %d\n", crc, sum, 13 * 17);
    return lines;
}

TEST(console, a_program_of_the_large_model_runs_to_its_own_end)
{
    double sum = 0;
    for (int i = 1; i <= 50; ++i)
    {
        sum += std::sqrt(i) + std::sin(i / 10.0) + std::pow(i, 0.25);
    }
    for (const char* image : {"console_0.bin", "console_1.bin"})
    {
        mcs51_config_t config{};
        config.part = MCS51_AT89S52;
        config.code_octets = 65536;
        config.xdata_octets = 65536;
        bare_cpu b(config);
        console c;
        c.cpu = b.cpu;
        b.load_file(std::string(MCS51_IMAGES) + "/" + image);
        unsigned beyond = 0;
        for (unsigned address = FLASH; address < 65536; ++address)
        {
            beyond += mcs51_code(b.cpu, static_cast<uint16_t>(address)) != 0xFF;
        }
        EXPECT_GT(beyond, 1000u);
        mcs51_observer_t observer{};
        observer.ctx = &c;
        observer.access = console::access;
        mcs51_observe(b.cpu, &observer);
        ASSERT_EQ(b.run(LIMIT), MCS51_STOPPED) << c.text;
        EXPECT_EQ(mcs51_iram(b.cpu, EXIT_CODE), 42);
        const std::string lines = expected();
        ASSERT_EQ(c.text.substr(0, lines.size()), lines) << image;
        int thousandths = 0, end = 0;
        ASSERT_EQ(std::sscanf(c.text.c_str() + lines.size(), "float %d\n%n", &thousandths, &end), 1) << c.text;
        EXPECT_NEAR(thousandths, 1000 * sum, 3.0); // 24-bit mantissa, 150 sums
        EXPECT_EQ(c.text.substr(lines.size() + static_cast<size_t>(end)), "eight bits -12345 !\n");
        EXPECT_TRUE(b.reports.empty()) << b.reports[0].text << ' ' << b.reports[0].detail;
    }
}

} // namespace
