/// \file   navigator.hpp
/// \brief  The host of the acquisition board inside a run: its octets to attitude, and that beside the truth at the same sample.
/// SPDX-License-Identifier: MIT
#pragma once
#include "emu/time.h"
#include "ins_nav/nav.h"
#include "ins_truth/motion.h"
#include "scans.hpp"
#include "six_navigator.hpp"
#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace libins
{

/// A navigation state beside the truth at its own sample's instant.
struct Scored
{
    ins_nav_state_t state{};
    uint64_t scan = 0;             ///< number of the board's scan it came from
    double t_s = 0.0;              ///< instant of that scan
    double age_s = 0.0;            ///< from the scan's instant to the state
    std::array<double, 4> q_nb{};  ///< truth
    std::array<double, 3> euler{}; ///< truth: roll, pitch, yaw
    std::array<double, 3> estimate{};
    std::array<double, 3> error{}; ///< estimate - truth, wrapped to +-pi
    std::vector<double> more;      ///< of six accelerometers: SixNavigator::columns
};

struct Navigator
{
    /// Throws std::invalid_argument with the reason. start_at_truth: the navigator gets the truth at its first sample.
    void begin(const ins_nav_config_t& config, bool start_at_truth);
    /// The same for six accelerometers on a track.
    void begin(const SixConfig& config, std::shared_ptr<ins_track_t> track);
    /// Time-outs are looked for.
    void tick(emu_time_t at);
    /// An octet came; scans and motion are the board's. \return the octet to send back; -1: none.
    int octet(uint8_t octet, emu_time_t at, const Scans& scans, const ins_motion_t* motion);
    std::vector<Scored> take_states() { return std::exchange(states, {}); }

    ins_nav_config_t config{};
    bool start_at_truth = true;
    ins_nav_link_t link{};
    ins_nav_solver_t solver{};
    std::optional<SixNavigator> six; ///< in the place of the solver
    bool started = false;
    size_t first_scan = 0;         ///< the scan of the first sample
    size_t last_scan = 0;          ///< the scan of the last
    uint64_t corrupt_accepted = 0; ///< accepted blocks that no scan of the board's equals
    std::vector<Scored> states;

  private:
    void navigate(const ins_nav_sample_t& sample, emu_time_t at, const Scans& scans, const ins_motion_t* motion);
    /// \return false: the sample could not be used.
    bool solve(const ins_nav_sample_t& sample, double t, const ins_motion_t* motion, Scored& scored);
    std::optional<size_t> origin_of(const ins_nav_sample_t& sample, const Scans& scans, size_t count) const;
};

} // namespace libins
