/// \file   net_goals.cpp
/// \brief  How far each station of a net may go alone; see net.hpp. SPDX-License-Identifier: MIT
#include "net.hpp"
#include <algorithm>

namespace libins
{
namespace
{

emu_time_t plus(emu_time_t a, emu_time_t b)
{
    return a > EMU_TIME_MAX - b ? EMU_TIME_MAX : a + b;
}

} // namespace

/// What leaves the stations at earliest_ reaches others and may be answered: then they send no later than that.
void Net::spread(size_t silent)
{
    for (bool changed = true; changed;)
    {
        changed = false;
        for (const Way& way : ways_)
        {
            const emu_time_t left = std::min(earliest_[way.source], way.channel->silent_until());
            const emu_time_t answer = plus(plus(left, way.channel->delay()), stations_[way.destination]->reaction());
            if (way.destination != silent && answer < earliest_[way.destination])
            {
                earliest_[way.destination] = answer;
                changed = true;
            }
        }
    }
}

/// The earliest instant at which something could leave each station, if that one sends nothing.
void Net::find_earliest(size_t silent)
{
    earliest_.resize(stations_.size());
    for (size_t i = 0; i < stations_.size(); i++)
    {
        Station& s = *stations_[i];
        const emu_time_t changes = std::max(s.told_until() + 1, s.faults().next());
        earliest_[i] =
            i == silent ? EMU_TIME_MAX : std::min({s.silent_until(), changes, plus(s.arrival(), s.reaction())});
    }
    spread(silent);
}

/// How far a station may go then: not to the instant at which something could reach it, since that may be before all else of the instant.
emu_time_t Net::alone_until(size_t station) const
{
    emu_time_t goal = EMU_TIME_MAX;
    for (const Way& way : ways_)
    {
        if (way.destination == station)
        {
            const emu_time_t left = std::min(earliest_[way.source], way.channel->silent_until());
            goal = std::min(goal, plus(left, way.channel->delay()) - 1 - stations_[station]->overshoot());
        }
    }
    return goal;
}

/// The least time from what leaves a station to what comes back because of it.
emu_time_t Net::answer_least(size_t station) const
{
    std::vector<emu_time_t> since(stations_.size(), EMU_TIME_MAX); // to what leaves each of the others
    emu_time_t least = EMU_TIME_MAX;
    for (bool changed = true; changed;)
    {
        changed = false;
        for (const Way& way : ways_)
        {
            const emu_time_t left = way.source == station ? 0 : since[way.source];
            const emu_time_t comes = plus(left, way.channel->delay());
            const emu_time_t answered = plus(comes, stations_[way.destination]->reaction());
            emu_time_t& best = way.destination == station ? least : since[way.destination];
            const emu_time_t found = way.destination == station ? comes : answered;
            changed = changed || found < best;
            best = std::min(best, found);
        }
    }
    return least;
}

void Net::find_goals(emu_time_t t)
{
    const emu_time_t meeting = plus(now() - now() % window_most, window_most);
    for (const auto& station : stations_)
    {
        station->apply_faults();
    }
    goals_.resize(stations_.size());
    find_earliest(stations_.size());
    for (size_t i = 0; i < stations_.size(); i++)
    {
        goals_[i] = std::min({t, meeting, stations_[i]->faults().next(), alone_until(i)});
    }
    for (size_t i = 0; i < stations_.size(); i++)
    {
        if (stations_[i]->stops_for_answers())
        {
            find_earliest(i);
            goals_[i] = std::min({t, meeting, stations_[i]->faults().next(), alone_until(i)});
            stations_[i]->set_answer(answer_least(i) - 1);
        }
    }
}

} // namespace libins
