/// \file   navigator.cpp
/// \brief  See navigator.hpp. SPDX-License-Identifier: MIT
#include "navigator.hpp"
#include "ins_truth/elementary.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace libins
{
namespace
{

constexpr emu_time_t ms = 1'000'000'000;
constexpr double pi = 3.14159265358979323846;
/// A block is looked for among the scans of this many periods before it was accepted: the board sends its newest scan, and gives a
/// block up long before.
constexpr size_t origin_window = 64;

double wrapped(double angle)
{
    return angle - 2.0 * pi * std::floor((angle + pi) / (2.0 * pi));
}

/// Roll, pitch, yaw (ZYX) without libm, so that a score has the same bits everywhere.
std::array<double, 3> euler_of(const double q[4])
{
    const double sine = std::clamp(2.0 * (q[0] * q[2] - q[1] * q[3]), -1.0, 1.0);
    return {ins_truth_atan2(2.0 * (q[2] * q[3] + q[0] * q[1]), q[0] * q[0] - q[1] * q[1] - q[2] * q[2] + q[3] * q[3]),
            ins_truth_atan2(sine, std::sqrt(1.0 - sine * sine)),
            ins_truth_atan2(2.0 * (q[1] * q[2] + q[0] * q[3]), q[0] * q[0] + q[1] * q[1] - q[2] * q[2] - q[3] * q[3])};
}

} // namespace

void Navigator::begin(const ins_nav_config_t& cfg, bool truth)
{
    if (const char* problem = ins_nav_config_problem(&cfg))
    {
        throw std::invalid_argument(problem);
    }
    config = cfg;
    start_at_truth = truth;
    ins_nav_link_init(&link, &config);
}

void Navigator::begin(const SixConfig& cfg, std::shared_ptr<ins_track_t> track)
{
    begin(cfg.nav.link, true);
    six.emplace(cfg, std::move(track));
}

void Navigator::tick(emu_time_t at)
{
    ins_nav_link_tick(&link, static_cast<uint64_t>(at / ms));
}

int Navigator::octet(uint8_t octet, emu_time_t at, const Scans& scans, const ins_motion_t* motion)
{
    int reply = -1;
    ins_nav_sample_t sample;
    // A time-out shows in what it makes of the next octet: it is looked for then, and not each millisecond.
    tick(at);
    if (ins_nav_link_octet(&link, octet, static_cast<uint64_t>(at / ms), &reply, &sample) == 1)
    {
        navigate(sample, at, scans, motion);
    }
    return reply;
}

/// The scan a block came from: the one its sequence number says, else the newest with the same codes. Nothing if there is none: the
/// block was changed on the way and its sum did not show it.
std::optional<size_t> Navigator::origin_of(const ins_nav_sample_t& sample, const Scans& scans, size_t count) const
{
    const auto same = [&](size_t i) { return std::equal(scans[i].code.begin(), scans[i].code.end(), sample.code); };
    const size_t numbered = first_scan + sample.index;
    if (started && config.seq != 0 && numbered >= scans.gone && numbered < count && same(numbered))
    {
        return numbered;
    }
    const size_t oldest = std::max({last_scan, scans.gone, count > origin_window ? count - origin_window : 0});
    for (size_t i = count; i-- > oldest;)
    {
        if (same(i))
        {
            return i;
        }
    }
    return std::nullopt;
}

bool Navigator::solve(const ins_nav_sample_t& sample, double t, const ins_motion_t* motion, Scored& scored)
{
    if (six)
    {
        const bool usable = six->step(sample, t, !started, scored.state, scored.q_nb, scored.more);
        scored.euler = euler_of(scored.q_nb.data());
        return usable;
    }
    if (!started)
    {
        ins_nav_config_t cfg = config;
        if (start_at_truth)
        {
            ins_motion_attitude(motion, t, cfg.q_nb);
        }
        ins_nav_solver_init(&solver, &cfg);
    }
    ins_motion_attitude(motion, t, scored.q_nb.data());
    ins_motion_euler(motion, t, scored.euler.data());
    return ins_nav_solver_step(&solver, &sample, &scored.state) >= 0;
}

void Navigator::navigate(const ins_nav_sample_t& sample, emu_time_t at, const Scans& scans, const ins_motion_t* motion)
{
    // A board whose time is ahead has scans already that this host cannot know of.
    const size_t last = config.channels - 1u;
    const auto made = [=](const Scan& scan) { return scan.at[last] <= at; };
    const auto known = std::partition_point(scans.kept.begin(), scans.kept.end(), made) - scans.kept.begin();
    const size_t count = scans.gone + static_cast<size_t>(known);
    const std::optional<size_t> origin = origin_of(sample, scans, count);
    corrupt_accepted += origin ? 0 : 1;
    if (!origin && known == 0)
    {
        return;
    }
    const size_t scan = origin.value_or(count - 1);
    last_scan = scan;
    const double t = static_cast<double>(scans[scan].at[0]) * 1e-12;
    Scored scored;
    const bool usable = solve(sample, t, motion, scored);
    first_scan = started ? first_scan : scan;
    started = true;
    if (!usable)
    {
        return;
    }
    scored.scan = scan;
    scored.t_s = t;
    scored.age_s = static_cast<double>(at) * 1e-12 - t;
    scored.estimate = euler_of(scored.state.q_nb);
    for (size_t i = 0; i < 3; i++)
    {
        scored.error[i] = wrapped(scored.estimate[i] - scored.euler[i]);
    }
    states.push_back(scored);
}

} // namespace libins
