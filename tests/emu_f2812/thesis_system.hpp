/// \file   thesis_system.hpp
/// \brief  The thesis's system in one process: the GIMU on SCI-A of an F2812 that runs the thesis's firmware, a PC on its SCI-B.
///
/// Everything is on wires: the GIMU's octets and the handshake's are bits at 19200 Bd. Units: s, rad, m.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_THESIS_SYSTEM_HPP
#define INS_TESTS_THESIS_SYSTEM_HPP
#include "emu/serial.h"
#include "emu_f2812/gimu_part.h"
#include "ins/quat.h"
#include "ins_nav/nav_input.h"
#include "shim.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <vector>

extern "C" const f2812_program_t f2812_program_thesis;

namespace thesis
{
constexpr double DEG = 3.14159265358979323846 / 180;
constexpr double CALIBRATED_S = 31; ///< the firmware's 180 packets, and what comes before them
constexpr double COMMAND_S = 0.1;   ///< when the PC sends its commands

class System
{
  public:
    /// \param[in] commands  octets that the PC sends at first. \param[in] cuts  of the GIMU's line
    System(const gimu_config_t& gimu, const std::string& commands, std::vector<emu_serial_cut_t> cuts = {})
        : commands_(commands), cuts_(std::move(cuts))
    {
        emu_sched_init(&sched_);
        f2812_config_t config;
        f2812_default_config(&config);
        config.report = {reported, this};
        device_ = f2812_create(&config, &sched_);
        shim_ = f2812_shim_create(device_, &sched_, &f2812_program_thesis, &config.report);
        emu_wire_init(&t_, "T", true);
        char why[200] = "";
        EXPECT_TRUE(gimu_init(&gimu_, &gimu, &sched_, &t_, nullptr, why, sizeof why)) << why;
        emu_serial_faults_t faults = {};
        faults.cuts = cuts_.data();
        faults.cut_count = static_cast<unsigned>(cuts_.size());
        EXPECT_EQ(emu_serial_line_init(&line_, &sched_, &t_, f2812_wire(device_, "SCIRXDA"), &faults), 0);
        EXPECT_EQ(emu_serial_end_init(&pc_, &sched_, f2812_wire(device_, "SCIRXDB"), f2812_wire(device_, "SCITXDB"),
                                      19200, heard, this),
                  0);
        ins_nav_input_config_t input;
        ins_nav_input_config_default(&input);
        EXPECT_EQ(ins_nav_input_init(&input_, &input), INS_OK);
    }
    ~System()
    {
        f2812_shim_destroy(shim_);
        f2812_destroy(device_);
    }
    System(const System&) = delete;
    System& operator=(const System&) = delete;

    /// To `t`; `seen` gets each solution as it arrives.
    void run(
        double t, const std::function<void(const ins_nav_solution_t&)>& seen = [](const ins_nav_solution_t&) {})
    {
        const auto end = static_cast<emu_time_t>(t * 1e12);
        seen_ = seen;
        while (sched_.now < end)
        {
            const bool before = sched_.now < static_cast<emu_time_t>(COMMAND_S * 1e12);
            ASSERT_EQ(f2812_shim_run(shim_, std::min(end, sched_.now + STEP)), F2812_REACHED) << f2812_shim_end(shim_);
            if (before && sched_.now >= static_cast<emu_time_t>(COMMAND_S * 1e12))
            {
                send(commands_);
            }
            tick_if_silent();
        }
    }
    void send(const std::string& text)
    {
        for (const char c : text)
        {
            EXPECT_TRUE(emu_serial_end_send(&pc_, static_cast<uint8_t>(c)));
        }
    }
    double now_s() const { return static_cast<double>(sched_.now) * 1e-12; }
    f2812_t* device() { return device_; }
    const f2812_shim_stats_t& stats() const { return *f2812_shim_stats(shim_); }
    const ins_nav_input_t& input() const { return input_; }
    const gimu_t& gimu() const { return gimu_; }

    long reports = 0;
    bool mute = false;                       ///< the PC does not answer
    std::array<double, 3> angle = {0, 0, 0}; ///< integrals of the rates about x, y, z since the alignment
    ins_nav_solution_t last = {};
    std::string octets; ///< all that the board sent

  private:
    static constexpr emu_time_t STEP = EMU_PS_PER_S / 20;

    static void reported(void* ctx, emu_report_kind_t, const char* text, uint32_t detail, emu_time_t at)
    {
        static_cast<System*>(ctx)->reports++;
        ADD_FAILURE() << text << " " << detail << " at " << at << " ps";
    }
    static void heard(void* ctx, uint8_t octet, bool, emu_time_t at)
    {
        auto* const self = static_cast<System*>(ctx);
        ins_nav_solution_t solution;
        int reply;
        self->octets.push_back(static_cast<char>(octet));
        self->heard_at_ = at;
        const auto now_ms = static_cast<uint64_t>(at / (EMU_PS_PER_S / 1000));
        if (ins_nav_input_octet(&self->input_, octet, now_ms, &reply, &solution) == 1)
        {
            self->take(solution);
        }
        if (reply >= 0 && !self->mute)
        {
            (void)emu_serial_end_send(&self->pc_, static_cast<uint8_t>(reply));
        }
    }
    void tick_if_silent()
    {
        if (sched_.now - heard_at_ > EMU_PS_PER_S / 20)
        {
            ins_nav_input_tick(&input_, static_cast<uint64_t>(sched_.now / (EMU_PS_PER_S / 1000)));
        }
    }
    /// The angles of section 4.5 are the sums of the rotations from block to block.
    void take(const ins_nav_solution_t& solution)
    {
        const bool both = (last.status & solution.status & INS_NAV_BLOCK_ALIGNED) != 0;
        double back[4], turn[4];
        ins_quat_conj(last.q_nb, back);
        ins_quat_mul(back, solution.q_nb, turn);
        const double s = std::sqrt(turn[1] * turn[1] + turn[2] * turn[2] + turn[3] * turn[3]);
        const double k = s > 0 ? 2 * std::atan2(s, std::fabs(turn[0])) / s * (turn[0] < 0 ? -1 : 1) : 0;
        for (size_t i = 0; i < 3; i++)
        {
            angle[i] = both ? angle[i] + k * turn[i + 1] : 0;
        }
        last = solution;
        seen_(solution);
    }

    std::string commands_;
    std::vector<emu_serial_cut_t> cuts_;
    emu_sched_t sched_;
    f2812_t* device_;
    f2812_shim_t* shim_;
    emu_wire_t t_;
    gimu_t gimu_;
    emu_serial_line_t line_;
    emu_serial_end_t pc_;
    ins_nav_input_t input_;
    emu_time_t heard_at_ = 0;
    std::function<void(const ins_nav_solution_t&)> seen_;
};
} // namespace thesis

#endif // INS_TESTS_THESIS_SYSTEM_HPP
