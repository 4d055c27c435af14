/// \file   bare_cpu.hpp
/// \brief  One part, an AT89S51 unless the test asks for another, with nothing on its pins but the test.
/// SPDX-License-Identifier: MIT
#ifndef BARE_CPU_HPP_INCLUDED
#define BARE_CPU_HPP_INCLUDED
#include "emu_8051/mcs51.h"
#include <fstream>
#include <gtest/gtest.h>
#include <initializer_list>
#include <iterator>
#include <string>
#include <vector>

namespace sfr
{
constexpr uint8_t P0 = 0x80, SP = 0x81, DPL = 0x82, DPH = 0x83, DP1L = 0x84, DP1H = 0x85, PCON = 0x87, TCON = 0x88,
                  TMOD = 0x89, TL0 = 0x8A, TL1 = 0x8B, TH0 = 0x8C, TH1 = 0x8D, AUXR = 0x8E, P1 = 0x90, SCON = 0x98,
                  SBUF = 0x99, P2 = 0xA0, AUXR1 = 0xA2, WDTRST = 0xA6, IE = 0xA8, P3 = 0xB0, IP = 0xB8, T2CON = 0xC8,
                  T2MOD = 0xC9, RCAP2L = 0xCA, RCAP2H = 0xCB, TL2 = 0xCC, TH2 = 0xCD, PSW = 0xD0, ACC = 0xE0, B = 0xF0;
}

struct bare_cpu
{
    struct edge
    {
        unsigned port;
        uint8_t out, changed;
        uint64_t cycle;
    };
    struct report
    {
        emu_report_kind_t kind;
        std::string text;
        uint32_t detail;
        emu_time_t at;
    };

    std::vector<edge> edges;
    std::vector<report> reports;
    mcs51_t* cpu;

    /// `config`: part, memory and choices; the callbacks are this rig's.
    explicit bare_cpu(mcs51_config_t config = {})
    {
        config.clock = {11059200, 12};
        config.ctx = this;
        config.port = [](void* ctx, unsigned port, uint8_t out, uint8_t changed, uint64_t cycle) {
            static_cast<bare_cpu*>(ctx)->edges.push_back({port, out, changed, cycle});
        };
        config.report.ctx = this;
        config.report.put = [](void* ctx, emu_report_kind_t kind, const char* text, uint32_t detail, emu_time_t at) {
            static_cast<bare_cpu*>(ctx)->reports.push_back({kind, text, detail, at});
        };
        cpu = mcs51_create(&config);
    }
    ~bare_cpu() { mcs51_destroy(cpu); }
    bare_cpu(const bare_cpu&) = delete;
    bare_cpu& operator=(const bare_cpu&) = delete;

    void load(uint16_t at, std::initializer_list<int> octets)
    {
        const std::vector<uint8_t> image(octets.begin(), octets.end());
        ASSERT_EQ(mcs51_load(cpu, at, image.data(), image.size()), 0);
    }
    void load_file(const std::string& path)
    {
        std::ifstream file(path, std::ios::binary);
        const std::vector<char> image((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
        ASSERT_FALSE(image.empty()) << path;
        ASSERT_EQ(mcs51_load(cpu, 0, reinterpret_cast<const uint8_t*>(image.data()), image.size()), 0);
    }
    uint64_t now() const { return mcs51_cycle(cpu); }
    uint16_t pc() const { return mcs51_pc(cpu); }
    uint8_t get(uint8_t address) { return mcs51_sfr(cpu, address); }
    void set(uint8_t address, int value) { mcs51_set_sfr(cpu, address, static_cast<uint8_t>(value)); }
    uint8_t ram(uint8_t address) const { return mcs51_iram(cpu, address); }
    void set_ram(uint8_t address, int value) { mcs51_set_iram(cpu, address, static_cast<uint8_t>(value)); }
    mcs51_stop_t run(uint64_t until) { return mcs51_run(cpu, until); }
    /// One instruction, or the interrupt that comes in its place and the first of its handler.
    void step() { mcs51_run(cpu, now() + 1); }
    /// Execute octets as one instruction or more from address `at`, with PSW, A, B as they are.
    void execute(uint16_t at, std::initializer_list<int> octets, unsigned instructions = 1)
    {
        load(at, octets);
        mcs51_set_pc(cpu, at);
        for (unsigned i = 0; i < instructions; ++i)
        {
            step();
        }
    }
    /// Step until the program counter is at `address`. \return the cycle, or 0 if it did not come within `limit` instructions.
    uint64_t reach(uint16_t address, unsigned limit = 1000)
    {
        for (unsigned i = 0; i < limit; ++i)
        {
            if (pc() == address)
            {
                return now();
            }
            step();
        }
        return 0;
    }
};

#endif // BARE_CPU_HPP_INCLUDED
