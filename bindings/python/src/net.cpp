/// \file   net.cpp
/// \brief  See net.hpp. SPDX-License-Identifier: MIT
#include "net.hpp"
#include "emu/random.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace libins
{

void Net::adopt(std::unique_ptr<Station> station)
{
    const std::string& name = station->name();
    const bool plain = !name.empty() && name.find('.') == std::string::npos;
    const bool taken =
        std::any_of(stations_.begin(), stations_.end(), [&](const auto& s) { return s->name() == name; });
    if (!plain || taken)
    {
        throw std::invalid_argument("name: found '" + name + "', but a station needs one of its own, without a dot");
    }
    if (now() != 0)
    {
        throw std::invalid_argument(name + ": time has gone on; stations come before that");
    }
    stations_.push_back(std::move(station));
}

Station& Net::station(const std::string& name)
{
    for (const auto& station : stations_)
    {
        if (station->name() == name)
        {
            return *station;
        }
    }
    throw std::invalid_argument(name + ": no such station");
}

Net::End Net::end_of(const std::string& name) const
{
    const size_t dot = name.find('.');
    const std::string port = dot == std::string::npos ? "" : name.substr(dot + 1);
    for (size_t i = 0; i < stations_.size(); i++)
    {
        if (stations_[i]->name() != name.substr(0, dot))
        {
            continue;
        }
        const std::vector<Port>& ports = stations_[i]->ports();
        std::string known;
        for (size_t p = 0; p < ports.size(); p++)
        {
            if (ports[p].name == port || (dot == std::string::npos && ports.size() == 1))
            {
                return {i, p};
            }
            known += (known.empty() ? "" : ", ") + stations_[i]->name() + "." + ports[p].name;
        }
        throw std::invalid_argument("line: found '" + name + "', but the station has " + known);
    }
    throw std::invalid_argument("line: found '" + name + "', but there is no such station");
}

size_t Net::line(const std::string& a, const std::string& b, const LineConfig& config)
{
    const End left = end_of(a), right = end_of(b);
    LineConfig made = config;
    if (!(made.baud >= EMU_BAUD_MIN && made.baud <= EMU_BAUD_MAX))
    {
        throw std::invalid_argument("baud: 50 .. 4e6 is needed");
    }
    if (made.delay == 0)
    {
        made.delay = static_cast<emu_time_t>(std::floor(1e12 / made.baud + 0.5));
    }
    if (now() != 0)
    {
        throw std::invalid_argument("line: time has gone on; lines come before that");
    }
    for (const End& end : {left, right})
    {
        Port& port = stations_[end.station]->ports()[end.port];
        const emu_time_t least = stations_[end.station]->overshoot();
        if (port.lined || left.station == right.station)
        {
            throw std::invalid_argument("line: " + stations_[end.station]->name() + "." + port.name +
                                        " has a line already, or both ends are one station");
        }
        if (made.delay <= least)
        {
            throw std::invalid_argument("delay_s: more than " + std::to_string(static_cast<double>(least) * 1e-12) +
                                        " s are needed, since " + stations_[end.station]->name() +
                                        " does not stop within an instruction");
        }
    }
    connect(left, right, made, lines_);
    connect(right, left, made, lines_);
    for (const End& end : {left, right})
    {
        stations_[end.station]->ports()[end.port].lined = true;
        if (auto* const board = dynamic_cast<F2812Station*>(stations_[end.station].get()))
        {
            board->open_port(end.port);
        }
    }
    return lines_++;
}

void Net::connect(End from, End to, const LineConfig& config, size_t line)
{
    Station& source = *stations_[from.station];
    Station& destination = *stations_[to.station];
    if (source.ports()[from.port].txd.empty() || destination.ports()[to.port].rxd.empty())
    {
        return;
    }
    uint64_t state = seed_;
    state = emu_random(&state) + ways_.size();
    ways_.push_back({std::make_unique<Channel>(source, from.port, destination, to.port, config, emu_random(&state)),
                     from.station, to.station, line});
}

int64_t Net::trace(const std::string& station, const std::string& wire)
{
    this->station(station).trace(wire, traces_);
    return traces_++;
}

emu_time_t Net::now() const
{
    emu_time_t least = stations_.empty() ? 0 : EMU_TIME_MAX;
    for (const auto& station : stations_)
    {
        least = std::min(least, station->now());
    }
    return least;
}

void Net::carry()
{
    for (const Way& way : ways_)
    {
        way.channel->carry();
    }
}

/// \return whether any of those went on.
bool Net::go(bool light, emu_time_t t)
{
    find_goals(t);
    std::vector<Station*> gone;
    for (const bool programs : {true, false}) // these go on by themselves meanwhile
    {
        for (size_t i = 0; i < stations_.size(); i++)
        {
            Station& s = *stations_[i];
            const bool program = dynamic_cast<F2812Station*>(&s) != nullptr;
            if (s.light() == light && program == programs && s.now() < goals_[i])
            {
                s.begin(goals_[i]);
                gone.push_back(&s);
                windows += program;
            }
        }
    }
    for (Station* const s : gone)
    {
        s->finish();
        stopped_ = s->stopped() ? s : stopped_;
        std::vector<TracedEdge>& edges = s->edges();
        edges_.insert(edges_.end(), edges.begin(), edges.end());
        edges.clear();
    }
    carry();
    rounds += !gone.empty();
    return !gone.empty();
}

bool Net::until(emu_time_t t)
{
    if (!broken_.empty())
    {
        throw ProgramError(broken_);
    }
    stopped_ = nullptr;
    try
    {
        carry(); // what somebody sent between two calls
        while (stopped_ == nullptr && (go(true, t) || go(false, t)))
        {
        }
    }
    catch (const std::exception& error)
    {
        broken_ = error.what();
        throw;
    }
    return stopped_ == nullptr;
}

bool Net::until_octet(const std::string& host, emu_time_t t)
{
    HostStation& station = get<HostStation>(host);
    station.stop_at_octet(true);
    bool reached = false;
    try
    {
        reached = until(t);
    }
    catch (...)
    {
        station.stop_at_octet(false);
        throw;
    }
    station.stop_at_octet(false);
    return reached;
}

std::vector<TracedEdge> Net::take_edges()
{
    const auto before = [](const TracedEdge& a, const TracedEdge& b)
    { return a.at < b.at || (a.at == b.at && a.wire < b.wire); };
    std::stable_sort(edges_.begin(), edges_.end(), before);
    emu_time_t here = EMU_TIME_MAX;
    for (const auto& station : stations_)
    {
        here = std::min(here, station->told_until());
    }
    const auto later =
        std::partition_point(edges_.begin(), edges_.end(), [&](const TracedEdge& e) { return e.at <= here; });
    std::vector<TracedEdge> taken(edges_.begin(), later);
    edges_.erase(edges_.begin(), later);
    return taken;
}

Channel* Net::channel_at(const Station& station, const std::string& pin, bool& at_source)
{
    for (const Way& way : ways_)
    {
        Channel& c = *way.channel;
        at_source = &c.source() == &station && c.from().txd == pin;
        if (at_source || (&c.destination() == &station && c.to().rxd == pin))
        {
            return &c;
        }
    }
    return nullptr;
}

void Net::add_fault(const std::string& name, const Fault& fault)
{
    Station& s = station(name);
    const bool shorts = fault.kind == FaultKind::wire_short || fault.kind == FaultKind::line_break;
    bool at_source = false;
    Channel* const channel =
        shorts || fault.kind == FaultKind::wire_cut ? channel_at(s, fault.net, at_source) : nullptr;
    if (channel == nullptr)
    {
        if ((shorts || fault.kind == FaultKind::wire_cut) && dynamic_cast<AcqStation*>(&s) == nullptr)
        {
            std::string pins;
            for (const Port& port : s.ports())
            {
                pins += port.lined ? " " + port.txd + " " + port.rxd : "";
            }
            throw std::invalid_argument("net: found '" + fault.net + "', but a pin of " + name +
                                        " with a line is needed:" + (pins.empty() ? " there is none" : pins));
        }
        s.add_fault(fault);
        auto* const acq = dynamic_cast<AcqStation*>(&s);
        const FaultList* const list = acq == nullptr ? &s.faults() : nullptr;
        faults_.push_back(
            {&s, list, (acq != nullptr ? acq->run().faults().hits().size() : list->entries().size()) - 1});
        return;
    }
    if (shorts && fault.other != "gnd" && fault.other != "vcc")
    {
        throw std::invalid_argument("to: found '" + fault.other +
                                    "', but a line between boards is shorted to gnd or vcc");
    }
    channel->add_fault(fault, at_source);
    faults_.push_back({&s, &channel->faults(), channel->faults().entries().size() - 1});
}

std::vector<std::pair<const char*, uint64_t>> Net::fault_hits(const std::string& name)
{
    std::vector<std::pair<const char*, uint64_t>> hits;
    for (const Added& added : faults_)
    {
        if (!name.empty() && added.station->name() != name)
        {
            continue;
        }
        if (added.list == nullptr)
        {
            hits.push_back(dynamic_cast<AcqStation&>(*added.station).run().faults().hits()[added.index]);
            continue;
        }
        const FaultList::Entry& entry = added.list->entries()[added.index];
        hits.emplace_back(fault_kinds[static_cast<size_t>(entry.fault.kind)], entry.hits);
    }
    return hits;
}

std::array<uint64_t, 2> Net::line_counts(size_t line) const
{
    std::array<uint64_t, 2> counts{};
    for (const Way& way : ways_)
    {
        counts[0] += way.line == line ? way.channel->line().slots_inverted : 0;
        counts[1] += way.line == line ? way.channel->line().octets_swallowed : 0;
    }
    return counts;
}

void Net::set_patience(double seconds)
{
    for (const auto& station : stations_)
    {
        if (auto* const board = dynamic_cast<F2812Station*>(station.get()))
        {
            board->process().set_patience(seconds);
        }
    }
}

} // namespace libins
