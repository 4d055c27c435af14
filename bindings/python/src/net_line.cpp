/// \file   net_line.cpp
/// \brief  See net_line.hpp. SPDX-License-Identifier: MIT
#include "net_line.hpp"
#include <algorithm>
#include <stdexcept>
#include <utility>

namespace libins
{

Channel::Channel(Station& source, size_t from, Station& destination, size_t to, const LineConfig& config, uint64_t seed)
    : source_(&source), destination_(&destination), from_port_(from), to_port_(to), config_(config)
{
    emu_sched_init(&sched_);
    emu_wire_init(&from_, "line from", true);
    emu_wire_init(&to_, "line to", true);
    driver_ = emu_wire_add_driver(&from_);
    emu_wire_drive(&from_, driver_, EMU_STRONG1, 0);
    emu_serial_faults_t faults{};
    faults.baud = config_.baud;
    faults.bit_error = config_.bit_error;
    faults.octet_loss = config_.octet_loss;
    faults.cuts = config_.cuts.data();
    faults.cut_count = static_cast<unsigned>(config_.cuts.size());
    faults.seed = seed;
    if (emu_serial_line_init(&line_, &sched_, &from_, &to_, &faults) != 0 || emu_wire_watch(&to_, on_level, this) != 0)
    {
        throw std::invalid_argument("the line from " + source.name() + " to " + destination.name() +
                                    " could not be made: bit_error and octet_loss are 0 .. 0.5, baud is 50 .. 4e6, and "
                                    "cuts are sorted and do not overlap");
    }
    fault_event_.fire = on_fault;
    fault_event_.ctx = this;
}

void Channel::carry()
{
    for (const Level& edge : std::exchange(source_->ports()[from_port_].left, {}))
    {
        emu_sched_advance(&sched_, edge.at);
        emu_wire_drive(&from_, driver_, edge.level ? EMU_STRONG1 : EMU_STRONG0, edge.at);
    }
    emu_sched_advance(&sched_, source_->told_until());
    if (late_) // not thrown where it is found: C is in between
    {
        throw std::logic_error("an edge from " + source_->name() + " came to " + destination_->name() +
                               " after its time; please report this");
    }
}

void Channel::on_level(void* ctx, bool level, emu_time_t at)
{
    auto& self = *static_cast<Channel*>(ctx);
    const emu_time_t arrives = at + self.config_.delay;
    self.late_ = self.late_ || arrives <= self.destination_->now();
    self.destination_->ports()[self.to_port_].coming.push_back({arrives, level});
}

void Channel::add_fault(const Fault& fault, bool at_source)
{
    faults_.add(fault, sched_.now);
    at_source_.push_back(at_source);
    emu_sched_at(&sched_, &fault_event_, faults_.next());
}

void Channel::on_fault(void* ctx, emu_time_t at)
{
    auto& self = *static_cast<Channel*>(ctx);
    self.faults_.apply(at, [](const FaultList::Entry&) {});
    self.settle(at);
    if (const emu_time_t next = self.faults_.next(); next != EMU_TIME_MAX)
    {
        emu_sched_at(&self.sched_, &self.fault_event_, next);
    }
}

/// Ground wins over a supply; the end of a wire that is cut is idle.
void Channel::settle(emu_time_t at)
{
    std::array<emu_rail_t, 2> rails{EMU_RAIL_NONE, EMU_RAIL_NONE};
    for (size_t i = 0; i < at_source_.size(); i++)
    {
        const FaultList::Entry& entry = faults_.entries()[i];
        if (!entry.on)
        {
            continue;
        }
        const bool cut = entry.fault.kind == FaultKind::wire_cut;
        emu_rail_t& rail = rails[at_source_[i] && !cut ? 0 : 1];
        const bool ground = !cut && entry.fault.other == "gnd";
        rail = ground || rail == EMU_RAIL_GND ? EMU_RAIL_GND : EMU_RAIL_VCC;
    }
    emu_wire_short(&from_, rails[0], at);
    emu_wire_short(&to_, rails[1], at);
}

} // namespace libins
