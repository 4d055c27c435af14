/// \file   knobs.cpp
/// \brief  See knobs.hpp. SPDX-License-Identifier: MIT
#include "knobs.hpp"
#include "ins_truth/elementary.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace libins
{
namespace
{

constexpr size_t waiting_max = 100'000, turns_max = 1'000'000, octets_max = 4096; ///< a snapshot with more is none

using Quaternion = std::array<double, 4>;

Quaternion product(const Quaternion& p, const Quaternion& q)
{
    return {
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3], p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1], p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

/// Of a turn about one axis of the body.
Quaternion about(unsigned axis, double angle)
{
    Quaternion q{};
    ins_truth_sincos(0.5 * angle, &q[axis + 1], &q[0]);
    return q;
}

/// The rotation vector of q, the short way [rad].
std::array<double, 3> vector_of(const Quaternion& q)
{
    const double sine = std::sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double angle = 2.0 * ins_truth_atan2(sine, std::fabs(q[0]));
    const double k = sine > 0.0 ? (q[0] < 0.0 ? -angle : angle) / sine : 0.0;
    return {k * q[1], k * q[2], k * q[3]};
}

void numbers(emu_state_t* io, std::array<double, 3>& values)
{
    for (double& value : values)
    {
        emu_state_f64(io, &value);
    }
}

/// \return how many there are, or 0 where the octets that are loaded are wrong.
size_t counted(emu_state_t* io, size_t count, size_t most)
{
    uint64_t value = count;
    emu_state_u64(io, &value);
    emu_state_check(io, value <= most);
    return io->bad ? 0 : static_cast<size_t>(value);
}

void each(emu_state_t* io, Knob& knob)
{
    auto kind = static_cast<uint8_t>(knob.kind);
    emu_state_u8(io, &kind);
    emu_state_check(io, kind < knob_kinds.size());
    knob.kind = io->bad ? knob.kind : static_cast<KnobKind>(kind);
    for (emu_time_t* const time : {&knob.at, &knob.lasts})
    {
        emu_state_i64(io, time);
        emu_state_check(io, emu_state_time(*time));
    }
    numbers(io, knob.values);
    emu_state_u32(io, &knob.channel);
    knob.octets.resize(counted(io, knob.octets.size(), octets_max));
    emu_state_octets(io, knob.octets.data(), knob.octets.size());
}

} // namespace

void Knobs::add(const Knob& knob)
{
    const auto later = [](const Knob& a, const Knob& b) { return a.at < b.at; };
    waiting_.insert(std::upper_bound(waiting_.begin(), waiting_.end(), knob, later), knob);
}

Knob Knobs::take()
{
    Knob knob = waiting_.front();
    waiting_.erase(waiting_.begin());
    return knob;
}

void Knobs::state(emu_state_t* io)
{
    std::vector<Knob> walked = waiting_;
    walked.resize(counted(io, waiting_.size(), waiting_max));
    for (Knob& knob : walked)
    {
        each(io, knob);
    }
    waiting_ = io->bad ? waiting_ : walked;
}

void HandMotion::set_base(std::shared_ptr<ins_motion_t> base, bool keep)
{
    const std::vector<Turn> turns = keep ? std::exchange(turns_, {}) : std::vector<Turn>{};
    turns_.clear();
    base_ = std::move(base);
    for (const Turn& turn : turns)
    {
        add(turn.from_s, turn.w_ib_b);
    }
}

void HandMotion::add(double from_s, const std::array<double, 3>& w_ib_b)
{
    std::array<char, 256> why{};
    ins_motion_t* const made = ins_motion_create_onward(get().get(), from_s, w_ib_b.data(), why.data(), why.size());
    if (made == nullptr)
    {
        throw std::invalid_argument(why.data());
    }
    turns_.push_back({from_s, w_ib_b, {made, ins_motion_destroy}});
}

/// What was to come after is given up.
void HandMotion::turn(double from_s, const std::array<double, 3>& w_ib_b)
{
    while (!turns_.empty() && turns_.back().from_s >= from_s)
    {
        turns_.pop_back();
    }
    add(from_s, w_ib_b);
}

void HandMotion::tilt(double from_s, double lasts_s, const std::array<double, 3>& rpy)
{
    Quaternion q{};
    ins_motion_attitude(get().get(), from_s, q.data());
    const Quaternion back = {q[0], -q[1], -q[2], -q[3]};
    const Quaternion goal = product(product(about(2, rpy[2]), about(1, rpy[1])), about(0, rpy[0]));
    std::array<double, 3> w = vector_of(product(back, goal));
    for (double& x : w)
    {
        x /= lasts_s;
    }
    turn(from_s, w);
    add(from_s + lasts_s, {});
}

void HandMotion::state(emu_state_t* io)
{
    std::vector<Turn> walked = turns_;
    walked.resize(counted(io, turns_.size(), turns_max));
    for (Turn& turn : walked)
    {
        emu_state_f64(io, &turn.from_s);
        numbers(io, turn.w_ib_b);
    }
    if (!emu_state_loading(io) || io->bad)
    {
        return;
    }
    size_t same = 0;
    while (same < std::min(turns_.size(), walked.size()) && turns_[same].from_s == walked[same].from_s &&
           turns_[same].w_ib_b == walked[same].w_ib_b)
    {
        same++;
    }
    turns_.resize(same);
    for (; same < walked.size() && !io->bad; same++)
    {
        const std::array<double, 3>& w = walked[same].w_ib_b;
        const bool possible = std::fabs(walked[same].from_s) < 1e9 &&
                              std::all_of(w.begin(), w.end(), [](double x) { return std::fabs(x) < 1e4; });
        emu_state_check(io, possible);
        if (possible)
        {
            add(walked[same].from_s, w);
        }
    }
}

} // namespace libins
