/// \file   rig.hpp
/// \brief  One F2812 with nothing on its pins but the test, which is its program.
/// SPDX-License-Identifier: MIT
#ifndef F2812_RIG_HPP_INCLUDED
#define F2812_RIG_HPP_INCLUDED
#include "emu_f2812/f2812.h"
#include "emu_f2812/registers.h"
#include <gtest/gtest.h>
#include <string>
#include <vector>

/// n / hz seconds in ps, rounded down.
inline emu_time_t exact(uint64_t n, uint64_t hz)
{
    const emu_clock_t clock{hz, 1};
    return emu_clock_time(&clock, n);
}

struct rig
{
    struct report
    {
        emu_report_kind_t kind;
        std::string text;
        uint32_t address;
        emu_time_t at;
    };

    static constexpr uint64_t OSC_HZ = 30000000;
    static constexpr size_t INTERRUPTS_MAX = 100; ///< that serve() takes at once
    emu_sched_t sched;
    std::vector<report> reports;
    f2812_t* dsp;

    explicit rig(const f2812_switches_t& switches = {}, uint64_t osc_hz = OSC_HZ)
    {
        emu_sched_init(&sched);
        f2812_config_t config;
        f2812_default_config(&config);
        config.oscclk_hz = osc_hz;
        config.switches = switches;
        config.report.ctx = this;
        config.report.put = [](void* ctx, emu_report_kind_t kind, const char* text, uint32_t detail, emu_time_t at) {
            static_cast<rig*>(ctx)->reports.push_back({kind, text, detail, at});
        };
        dsp = f2812_create(&config, &sched);
    }
    ~rig() { f2812_destroy(dsp); }
    rig(const rig&) = delete;
    rig& operator=(const rig&) = delete;

    static uint16_t at(const char* name)
    {
        const int address = f2812_register_address(name);
        EXPECT_GE(address, 0) << name;
        return static_cast<uint16_t>(address);
    }
    unsigned get(const char* name) { return f2812_read(dsp, at(name)); }
    void put(const char* name, unsigned value) { f2812_write(dsp, at(name), static_cast<uint16_t>(value)); }
    /// Between EALLOW and EDIS.
    void put_guarded(const char* name, unsigned value)
    {
        f2812_set_eallow(dsp, true);
        put(name, value);
        f2812_set_eallow(dsp, false);
    }
    /// No watchdog, as programs begin.
    void quiet() { put_guarded("WDCR", 0x68); }
    void pass(uint64_t cycles)
    {
        for (; cycles > UINT32_MAX; cycles -= UINT32_MAX)
        {
            f2812_advance(dsp, UINT32_MAX);
        }
        f2812_advance(dsp, static_cast<uint32_t>(cycles));
    }
    void pass_until(emu_time_t t)
    {
        while (f2812_now(dsp) < t)
        {
            f2812_skip(dsp, t);
        }
    }
    /// PIE on, all of IER, INTM off.
    void listen()
    {
        put("PIECTRL", 1);
        f2812_set_ier(dsp, 0x3FFF);
        f2812_set_intm(dsp, false);
    }
    int take()
    {
        f2812_context_t saved;
        return f2812_take_interrupt(dsp, &saved);
    }
    /// Handlers of all that is pending run and return, acknowledging their group. \return their vectors.
    std::vector<int> serve()
    {
        std::vector<int> vectors;
        f2812_context_t saved;
        while (f2812_interrupt_pending(dsp))
        {
            if (vectors.size() == INTERRUPTS_MAX)
            {
                ADD_FAILURE() << "interrupts without end";
                break;
            }
            vectors.push_back(f2812_take_interrupt(dsp, &saved));
            if (vectors.back() >= F2812_VECTOR_PIE)
            {
                put("PIEACK", 1u << (vectors.back() - F2812_VECTOR_PIE) / 8);
            }
            f2812_iret(dsp, &saved);
        }
        return vectors;
    }
};

#endif // F2812_RIG_HPP_INCLUDED
