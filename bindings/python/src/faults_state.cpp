/// \file   faults_state.cpp
/// \brief  Snapshot and restore of faults: what they are and where they are in it. SPDX-License-Identifier: MIT
#include "faults.hpp"

namespace libins
{
namespace
{

constexpr size_t faults_max = 1000, name_max = 32; ///< a snapshot with more is none

void text(emu_state_t* io, std::string& value)
{
    uint32_t length = static_cast<uint32_t>(value.size());
    emu_state_u32(io, &length);
    emu_state_check(io, length <= name_max);
    if (!io->bad)
    {
        value.resize(length);
        emu_state_octets(io, value.data(), length);
    }
}

void integer(emu_state_t* io, int32_t& value)
{
    auto bits = static_cast<uint32_t>(value);
    emu_state_u32(io, &bits);
    value = static_cast<int32_t>(bits);
}

/// As it was when the level that is there was resolved: nobody is told.
void set_short(emu_wire_t* net, emu_rail_t rail, emu_wire_t* bridge)
{
    net->rail = static_cast<uint8_t>(rail);
    net->bridge = bridge;
    net->shorted = rail != EMU_RAIL_NONE || bridge != nullptr;
}

} // namespace

void Faults::state(Active& active, emu_state_t* io)
{
    Fault& fault = active.fault;
    auto kind = static_cast<uint8_t>(fault.kind);
    emu_state_u8(io, &kind);
    emu_state_check(io, kind < fault_kinds.size());
    fault.kind = io->bad ? fault.kind : static_cast<FaultKind>(kind);
    for (emu_time_t* const time : {&fault.from, &fault.to, &fault.lasts, &active.begins, &active.ends})
    {
        emu_state_i64(io, time);
        emu_state_check(io, *time == EMU_TIME_MAX || emu_state_time(*time));
    }
    for (double* const number : {&fault.rate_hz, &fault.probability, &fault.value, &fault.drift})
    {
        emu_state_f64(io, number);
    }
    for (int32_t* const number : {&fault.channel, &fault.address, &fault.bit})
    {
        integer(io, *number);
    }
    text(io, fault.net);
    text(io, fault.other);
    emu_state_u64(io, &fault.seed);
    emu_state_bool(io, &active.on);
    emu_state_u64(io, &active.random);
    emu_state_u64(io, &active.hits);
}

void Faults::set_shorts(bool on)
{
    for (const Active& active : faults_)
    {
        const Fault& fault = active.fault;
        if (!active.on || (fault.kind != FaultKind::wire_short && fault.kind != FaultKind::line_break))
        {
            continue;
        }
        emu_wire_t* const net = wire(fault.net);
        if (fault.other == "gnd" || fault.other == "vcc")
        {
            set_short(net, !on ? EMU_RAIL_NONE : fault.other == "gnd" ? EMU_RAIL_GND : EMU_RAIL_VCC, net->bridge);
            continue;
        }
        emu_wire_t* const other = wire(fault.other);
        set_short(net, static_cast<emu_rail_t>(net->rail), on ? other : nullptr);
        set_short(other, static_cast<emu_rail_t>(other->rail), on ? net : nullptr);
    }
}

void Faults::state(emu_state_t* io)
{
    emu_state_tag(io, "FALT", 1);
    auto count = static_cast<uint32_t>(faults_.size());
    emu_state_u32(io, &count);
    emu_state_check(io, count <= faults_max);
    std::vector<Active> walked = faults_;
    walked.resize(io->bad ? 0 : count);
    for (Active& active : walked)
    {
        state(active, io);
        if (emu_state_loading(io) && !io->bad)
        {
            emu_state_check(io, problem(active.fault).empty());
        }
    }
    if (emu_state_loading(io) && !io->bad)
    {
        set_shorts(false);
        faults_ = walked;
        set_shorts(true);
    }
}

} // namespace libins
