/// \file   net_f2812.cpp
/// \brief  See net_f2812.hpp. SPDX-License-Identifier: MIT
#include "net_f2812.hpp"
#include <algorithm>
#include <stdexcept>
#include <utility>

namespace libins
{
namespace
{

constexpr size_t reset_port = 2; ///< no serial port: what comes there drives /XRS

std::vector<Port> ports_of_f2812()
{
    return {{"SCIA", "SCITXDA", "SCIRXDA", {}, {}, false},
            {"SCIB", "SCITXDB", "SCIRXDB", {}, {}, false},
            {"XRS", "", "XRS", {}, {}, false}};
}

} // namespace

F2812Station::F2812Station(std::string name, const std::string& program, uint64_t oscclk_hz, const Switches& switches)
    : Station(std::move(name), ports_of_f2812()), process_(this->name(), program)
{
    if (switches.size() > F2812_LINK_SWITCHES)
    {
        throw std::invalid_argument(this->name() + ": more switches than there are");
    }
    auto& start = message_->u.start;
    start.oscclk_hz = oscclk_hz;
    start.count = static_cast<uint16_t>(switches.size());
    size_t i = 0;
    for (const auto& [key, value] : switches)
    {
        f2812_link_text(start.switches[i].name, F2812_LINK_NAME, key.c_str());
        f2812_link_text(start.switches[i].value, F2812_LINK_NAME, value.c_str());
        i++;
    }
    ask(F2812_LINK_START, F2812_LINK_READY);
}

const f2812_link_t& F2812Station::ask(f2812_link_kind_t kind, f2812_link_kind_t answer)
{
    message_->kind = static_cast<uint8_t>(kind);
    process_.send(*message_, now_);
    for (;;)
    {
        process_.receive(*message_, now_);
        if (message_->kind == F2812_LINK_REFUSED)
        {
            throw std::invalid_argument(name() + ": " + message_->u.refused.text);
        }
        if (message_->kind == answer)
        {
            return *message_;
        }
        if (message_->kind != F2812_LINK_REPORT)
        {
            throw ProgramError(name() + ": an answer of kind " + std::to_string(message_->kind) +
                               " to a question of kind " + std::to_string(kind) +
                               "; build the program again with this libins");
        }
        take_report();
    }
}

size_t F2812Station::open_wire(const std::string& name, bool driven, bool answered)
{
    for (size_t i = 0; i < wires_.size(); i++)
    {
        if (wires_[i].name == name && wires_[i].driven == driven && wires_[i].answered == answered)
        {
            return i;
        }
    }
    message_->u.wire.driven = driven;
    message_->u.wire.answered = answered;
    f2812_link_text(message_->u.wire.name, F2812_LINK_NAME, name.c_str());
    ask(F2812_LINK_WIRE, F2812_LINK_READY);
    wires_.push_back({name, driven, answered, -1, {}});
    return wires_.size() - 1;
}

void F2812Station::open_port(size_t port)
{
    const Port& p = ports()[port];
    wires_[open_wire(p.rxd, true, false)].port = static_cast<int>(port);
    if (!p.txd.empty())
    {
        wires_[open_wire(p.txd, false, true)].port = static_cast<int>(port);
    }
}

void F2812Station::trace(const std::string& wire, int64_t number)
{
    wires_[open_wire(wire, false, false)].traces.push_back(number);
}

void F2812Station::begin(emu_time_t goal)
{
    auto& run = message_->u.run;
    run.count = 0;
    run.until = goal;
    run.answer = std::min(answer_, EMU_TIME_LOADED_MAX);
    for (size_t i = 0; i < wires_.size(); i++)
    {
        if (!wires_[i].driven)
        {
            continue;
        }
        for (const Level& edge : ports()[static_cast<size_t>(wires_[i].port)].coming)
        {
            if (edge.at > run.until)
            {
                break;
            }
            if (run.count == F2812_LINK_EDGES) // the others come with the next window
            {
                run.until = edge.at - 1;
                break;
            }
            run.edges[run.count++] = {edge.at, static_cast<uint8_t>(i), edge.level};
        }
    }
    std::stable_sort(run.edges, run.edges + run.count,
                     [](const f2812_link_edge_t& a, const f2812_link_edge_t& b) { return a.at < b.at; });
    while (run.count > 0 && run.edges[run.count - 1].at > run.until)
    {
        run.count--;
    }
    goal_ = run.until;
    message_->kind = F2812_LINK_RUN;
    process_.send(*message_, now_);
}

void F2812Station::finish()
{
    for (;;)
    {
        process_.receive(*message_, now_);
        switch (message_->kind)
        {
        case F2812_LINK_REPORT:
            take_report();
            break;
        case F2812_LINK_RECORDS_ARE:
            records_.insert(records_.end(), message_->u.records.records,
                            message_->u.records.records + message_->u.records.count);
            break;
        case F2812_LINK_EDGES_ARE:
            take_edges(message_->u.edges.count, message_->u.edges.edges);
            break;
        case F2812_LINK_DONE:
            take_edges(message_->u.done.count, message_->u.done.edges);
            if (message_->u.done.reached < now_ || message_->u.done.reached > goal_)
            {
                throw ProgramError(name() +
                                   ": a window ended outside itself; build the program again with this libins");
            }
            now_ = message_->u.done.reached;
            silent_until_ = message_->u.done.quiet;
            why_ = message_->u.done.why;
            access_ = message_->u.done.access;
            end_ = message_->u.done.end;
            for (Port& port : ports())
            {
                while (!port.coming.empty() && port.coming.front().at <= now_)
                {
                    port.coming.pop_front();
                }
            }
            return;
        default:
            throw ProgramError(
                name() + ": a window was answered by a message of kind " + std::to_string(message_->kind) +
                (message_->kind == F2812_LINK_REFUSED ? std::string(": ") + message_->u.refused.text : std::string()) +
                "; build the program again with this libins");
        }
    }
}

void F2812Station::take_edges(unsigned count, const f2812_link_edge_t* edges)
{
    for (const f2812_link_edge_t* edge = edges; edge != edges + count; edge++)
    {
        if (edge->wire >= wires_.size() || wires_[edge->wire].driven)
        {
            throw ProgramError(name() + ": an edge of a wire that nobody looks at; build the program again with this "
                                        "libins");
        }
        const Wire& wire = wires_[edge->wire];
        for (const int64_t number : wire.traces)
        {
            this->edges().push_back({edge->at, number, edge->level});
        }
        if (wire.port >= 0 && ports()[static_cast<size_t>(wire.port)].lined)
        {
            ports()[static_cast<size_t>(wire.port)].left.push_back({edge->at, edge->level});
        }
    }
}

void F2812Station::take_report()
{
    const auto& report = message_->u.report;
    add_report(reports_, static_cast<emu_report_kind_t>(report.kind), report.text, report.detail, report.at);
}

void F2812Station::add_fault(const Fault& fault)
{
    if (fault.kind != FaultKind::crystal && fault.kind != FaultKind::reset && fault.kind != FaultKind::power)
    {
        throw std::invalid_argument("kind: found '" + std::string(fault_kinds[static_cast<size_t>(fault.kind)]) +
                                    "', but an F2812 has crystal, reset and power, and its lines wire_cut, wire_short "
                                    "and break; its program is compiled for this machine, so its memory has no faults");
    }
    if (fault.kind != FaultKind::crystal)
    {
        open_port(reset_port);
    }
    faults_.add(fault, now_);
}

void F2812Station::act(const FaultList::Entry& entry)
{
    if (entry.fault.kind == FaultKind::crystal)
    {
        message_->u.clock.ppb = entry.on ? fault_ppb(entry.fault, now_) : 0;
        ask(F2812_LINK_CLOCK, F2812_LINK_READY);
        silent_until_ = now_ + 1; // what was to come may come sooner
        return;
    }
    ports()[reset_port].coming.push_back({now_ + 1, !entry.on});
}

std::vector<uint16_t> F2812Station::peek(uint16_t address, unsigned count)
{
    message_->u.peek.address = address;
    message_->u.peek.count = static_cast<uint16_t>(std::min<unsigned>(count, F2812_LINK_VALUES));
    const f2812_link_t& answer = ask(F2812_LINK_PEEK, F2812_LINK_VALUES_ARE);
    return {answer.u.values.values, answer.u.values.values + answer.u.values.count};
}

void F2812Station::set_break(const f2812_link_access_t& access)
{
    message_->u.at = access;
    ask(F2812_LINK_BREAK, F2812_LINK_READY);
}

void F2812Station::record(bool accesses, bool interrupts)
{
    message_->u.record = {accesses, interrupts};
    ask(F2812_LINK_RECORD, F2812_LINK_READY);
}

std::vector<std::pair<std::string, uint64_t>> F2812Station::statistics()
{
    const f2812_link_t& answer = ask(F2812_LINK_STATISTICS, F2812_LINK_COUNTS_ARE);
    std::vector<std::pair<std::string, uint64_t>> counts;
    for (unsigned i = 0; i < answer.u.counts.count; i++)
    {
        counts.emplace_back(answer.u.counts.counts[i].name, answer.u.counts.counts[i].value);
    }
    return counts;
}

} // namespace libins
