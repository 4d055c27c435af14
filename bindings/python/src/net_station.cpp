/// \file   net_station.cpp
/// \brief  See net_station.hpp. SPDX-License-Identifier: MIT
#include "net_station.hpp"
#include <algorithm>
#include <stdexcept>

namespace libins
{

emu_time_t Station::arrival() const
{
    emu_time_t first = EMU_TIME_MAX;
    for (const Port& port : ports_)
    {
        first = port.coming.empty() ? first : std::min(first, port.coming.front().at);
    }
    return first;
}

void LocalStation::attach(emu_sched_t* sched, size_t port, emu_wire_t* txd, emu_wire_t* rxd)
{
    sched_ = sched;
    event_.fire = on_arrival;
    event_.ctx = this;
    driven_.resize(ports().size());
    if (txd != nullptr)
    {
        taps_.push_back({this, static_cast<int64_t>(port)});
        emu_wire_watch(txd, on_left, &taps_.back());
    }
    if (rxd != nullptr)
    {
        driven_[port] = {rxd, emu_wire_add_driver(rxd)};
        emu_wire_drive(rxd, driven_[port].second, EMU_STRONG1, sched->now);
    }
}

void LocalStation::trace(const std::string& name, int64_t number)
{
    emu_wire_t* const found = wire(name);
    if (found == nullptr)
    {
        throw std::invalid_argument(this->name() + ": it has no wire " + name);
    }
    taps_.push_back({this, number});
    if (emu_wire_watch(found, on_traced, &taps_.back()) != 0)
    {
        throw std::invalid_argument(this->name() + ": too many look at wire " + name);
    }
    if (!found->level)
    {
        on_traced(&taps_.back(), false, now());
    }
}

void LocalStation::on_left(void* ctx, bool level, emu_time_t at)
{
    const Tap& tap = *static_cast<const Tap*>(ctx);
    Port& port = tap.station->ports()[static_cast<size_t>(tap.number)];
    if (port.lined)
    {
        port.left.push_back({at, level});
    }
}

void LocalStation::on_traced(void* ctx, bool level, emu_time_t at)
{
    const Tap& tap = *static_cast<const Tap*>(ctx);
    tap.station->edges().push_back({at, tap.number, level});
}

void LocalStation::arm(emu_time_t goal)
{
    goal_ = goal;
    if (const emu_time_t next = arrival(); next <= goal)
    {
        emu_sched_first(sched_, &event_, next);
    }
}

void LocalStation::on_arrival(void* ctx, emu_time_t at)
{
    auto& self = *static_cast<LocalStation*>(ctx);
    for (size_t i = 0; i < self.ports().size(); i++)
    {
        std::deque<Level>& coming = self.ports()[i].coming;
        while (!coming.empty() && coming.front().at <= at)
        {
            const auto& [wire, driver] = self.driven_[i];
            emu_wire_drive(wire, driver, coming.front().level ? EMU_STRONG1 : EMU_STRONG0, at);
            coming.pop_front();
        }
    }
    self.arm(self.goal_);
}

} // namespace libins
