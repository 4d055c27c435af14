/// \file   replay.cpp
/// \brief  ins_post/replay.hpp: the loop over events. SPDX-License-Identifier: MIT
#include "ins_post/replay.hpp"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace ins_post
{
namespace
{
constexpr double SAME = 1e-6; // of the time between states: instants are sums of periods, and rounded
}

Replay::Replay(Filter& filter, std::vector<Event> events, double output_s)
    : filter_(filter), events_(std::move(events)), output_s_(output_s), due_(0.0)
{
    const auto ordered = [](const Event& a, const Event& b) { return !(a.t <= b.t); };
    if (std::adjacent_find(events_.begin(), events_.end(), ordered) != events_.end() || !(output_s_ > 0.0))
    {
        throw std::invalid_argument("events are not in order of time, or the time between states is not positive");
    }
    due_ = events_.empty() ? 0.0 : events_.front().t;
}

double Replay::time() const
{
    return events_.empty() ? 0.0 : events_[std::min(next_, events_.size() - 1)].t;
}

void Replay::run(double t)
{
    for (; next_ < events_.size() && events_[next_].t < t; next_++)
    {
        const Event& event = events_[next_];
        if (const auto* increment = std::get_if<Increment>(&event.what))
        {
            filter_.increment(event.t, *increment);
        }
        else if (const auto* wheels = std::get_if<Wheels>(&event.what))
        {
            filter_.wheels(event.t, *wheels);
        }
        else
        {
            const Fix& fix = std::get<Fix>(event.what);
            const bool started = filter_.started();
            Check check = filter_.fix(event.t, fix);
            check.t = event.t;
            check.withheld = fix.withheld;
            if (started)
            {
                checks_.push_back(check);
            }
        }
        const bool last_of_instant = next_ + 1 == events_.size() || events_[next_ + 1].t > event.t;
        if (last_of_instant && event.t >= due_ - SAME * output_s_ && filter_.started())
        {
            states_.push_back(filter_.state());
            due_ += (std::floor((event.t - due_) / output_s_ + SAME) + 1.0) * output_s_;
        }
    }
}

} // namespace ins_post
