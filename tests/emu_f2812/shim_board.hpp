/// \file   shim_board.hpp
/// \brief  A board with compiled firmware on it, in this process, and hosts on its lines.
/// SPDX-License-Identifier: MIT
#ifndef F2812_SHIM_BOARD_HPP_INCLUDED
#define F2812_SHIM_BOARD_HPP_INCLUDED
#include "emu/random.h"
#include "emu/serial.h"
#include "firmware/cases.h"
#include "rig.hpp"
#include "shim.h"
#include <string>
#include <vector>

extern "C" const f2812_program_t f2812_program_cases, f2812_program_echo, f2812_program_loopback_fifo,
    f2812_program_autobaud, f2812_program_modem;

/// A host that sends and receives octets at its own baud.
struct host
{
    emu_serial_end_t end;
    std::string octets;
    unsigned wrong = 0;
    host(rig& board, const char* to, const char* from, double baud)
    {
        const int status = emu_serial_end_init(
            &end, &board.sched, f2812_wire(board.dsp, to), f2812_wire(board.dsp, from), baud,
            [](void* ctx, uint8_t octet, bool framing_ok, emu_time_t)
            {
                auto* const self = static_cast<host*>(ctx);
                self->octets += static_cast<char>(octet);
                self->wrong += framing_ok ? 0 : 1;
            },
            this);
        EXPECT_EQ(status, 0);
    }
    void send(const std::string& text)
    {
        for (const char c : text)
        {
            EXPECT_TRUE(emu_serial_end_send(&end, static_cast<uint8_t>(c)));
        }
    }
};

struct shim_board : rig
{
    static constexpr uint16_t RESULT = 0x0C0A; ///< TIMER1PRD, where cases.c tells its results
    static constexpr uint16_t CHOICE = 0x0C0B; ///< TIMER1PRDH, where it reads its case
    struct access
    {
        uint16_t address, value;
        bool write;
        emu_time_t at;
        bool operator==(const access& other) const
        {
            return address == other.address && value == other.value && write == other.write && at == other.at;
        }
    };
    f2812_shim_t* shim;
    std::vector<access> writes;
    std::vector<unsigned> results;
    std::vector<unsigned> vectors;
    std::vector<emu_time_t> entered, left; ///< interrupts
    uint16_t break_at = 0;

    explicit shim_board(const f2812_program_t& program, bool skip = true, bool observed = true)
    {
        const emu_report_t to_here{
            [](void* ctx, emu_report_kind_t kind, const char* text, uint32_t detail, emu_time_t at) {
                static_cast<rig*>(ctx)->reports.push_back({kind, text, detail, at});
            },
            this};
        shim = f2812_shim_create(dsp, &sched, &program, &to_here);
        f2812_shim_set_skip(shim, skip);
        const f2812_observer_t observer{this,
                                        [](void* ctx, uint16_t address, uint16_t value, bool write, emu_time_t at)
                                        { static_cast<shim_board*>(ctx)->accessed(address, value, write, at); },
                                        [](void* ctx, unsigned vector, bool enter, emu_time_t at)
                                        {
                                            auto* const self = static_cast<shim_board*>(ctx);
                                            (enter ? self->entered : self->left).push_back(at);
                                            if (enter)
                                            {
                                                self->vectors.push_back(vector);
                                            }
                                        }};
        f2812_observe(dsp, observed ? &observer : nullptr);
    }
    ~shim_board() { f2812_shim_destroy(shim); }
    shim_board(const shim_board&) = delete;
    shim_board& operator=(const shim_board&) = delete;

    void accessed(uint16_t address, uint16_t value, bool write, emu_time_t at)
    {
        if (write)
        {
            writes.push_back({address, value, write, at});
            if (address == RESULT)
            {
                results.push_back(value);
            }
        }
        if (break_at != 0 && address == break_at)
        {
            f2812_shim_break(shim);
        }
    }
    f2812_stop_t run(emu_time_t duration) { return f2812_shim_run(shim, sched.now + duration); }
    std::string end() const
    {
        const char* const text = f2812_shim_end(shim);
        return text != nullptr ? text : "";
    }
};

/// A case of cases.c, up to its end or for `duration`.
struct case_board : shim_board
{
    explicit case_board(int which, bool skip = true, emu_time_t duration = EMU_PS_PER_S / 10)
        : shim_board(f2812_program_cases, skip)
    {
        f2812_write(dsp, CHOICE, static_cast<uint16_t>(which));
        if (duration > 0)
        {
            run(duration);
        }
    }
};

#endif // F2812_SHIM_BOARD_HPP_INCLUDED
