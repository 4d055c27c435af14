/// \file   faults.cpp
/// \brief  See faults.hpp. SPDX-License-Identifier: MIT
#include "faults.hpp"
#include "emu/random.h"
#include "emu/ticker.h"
#include "ins_truth/elementary.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace libins
{
namespace
{

constexpr double code_max = 4095.0;
const std::string host_rxd = "HOST RXD";

/// (0, 1)
double unit(uint64_t& random)
{
    return (static_cast<double>(emu_random(&random) >> 12) + 0.5) * 0x1p-52;
}

/// Standard normal (Box and Muller 1958), the same bits everywhere.
double normal(uint64_t& random)
{
    const double radius = std::sqrt(-2.0 * ins_truth_log(unit(random)));
    double sine = 0.0;
    double cosine = 0.0;
    ins_truth_sincos(2.0 * INS_TRUTH_PI * unit(random), &sine, &cosine);
    return radius * cosine;
}

unsigned below(uint64_t& random, unsigned count)
{
    return static_cast<unsigned>(unit(random) * count);
}

bool in_conversion(FaultKind kind)
{
    return kind <= FaultKind::volts_noise;
}

bool within(const Fault& fault, unsigned channel, emu_time_t at)
{
    return at >= fault.from && at < fault.to && (fault.channel < 0 || static_cast<unsigned>(fault.channel) == channel);
}

uint16_t code_of(double code)
{
    return static_cast<uint16_t>(std::clamp(std::floor(code + 0.5), 0.0, code_max));
}

} // namespace

emu_time_t fault_drawn(uint64_t& random, const Fault& fault, emu_time_t after)
{
    const double gap_ps = -ins_truth_log(unit(random)) / fault.rate_hz * 1e12;
    return gap_ps < static_cast<double>(fault.to - after) ? after + static_cast<emu_time_t>(gap_ps) + 1 : EMU_TIME_MAX;
}

int32_t fault_ppb(const Fault& fault, emu_time_t now)
{
    const double ppb = 1e3 * (fault.value + fault.drift * 1e-12 * static_cast<double>(now - fault.from));
    const double limit = EMU_PPB_MAX;
    return static_cast<int32_t>(std::floor(std::clamp(ppb, -limit, limit) + 0.5));
}

emu_wire_t* Faults::wire(const std::string& name) const
{
    return name == host_rxd ? target_.host_rxd : acq_board_wire(target_.board, name.c_str());
}

std::string Faults::problem(const Fault& fault) const
{
    const bool shorts = fault.kind == FaultKind::wire_short || fault.kind == FaultKind::line_break;
    const bool rail = fault.other == "gnd" || fault.other == "vcc";
    if (fault.kind == FaultKind::wire_cut && acq_board_wire(target_.board, fault.net.c_str()) == nullptr)
    {
        return "net: found '" + fault.net + "', but a net with a pin of the CPU is needed, such as P1.4, EOC or TXD";
    }
    if (shorts && wire(fault.net) == nullptr)
    {
        return "net: found '" + fault.net + "', but a net of the board is needed, such as P1.4, EOC, TXD or " +
               host_rxd;
    }
    if (shorts && !rail && (wire(fault.other) == nullptr || wire(fault.other) == wire(fault.net)))
    {
        return "to: found '" + fault.other + "', but gnd, vcc or another net is needed";
    }
    if (fault.kind == FaultKind::xdata_flip && target_.xdata_octets == 0)
    {
        return "kind: found 'xdata_flip', but this board has no external RAM; give xdata_octets";
    }
    return {};
}

void Faults::add(const Fault& fault)
{
    if (const std::string why = problem(fault); !why.empty())
    {
        throw std::invalid_argument(why);
    }
    Active active{fault};
    active.random = fault.seed;
    active.begins = in_conversion(fault.kind) ? EMU_TIME_MAX
                    : fault.rate_hz > 0.0 ? fault_drawn(active.random, fault, std::max(fault.from, target_.sched->now))
                                          : fault.from;
    faults_.push_back(active);
}

void Faults::end_at(size_t place, emu_time_t at)
{
    if (place >= faults_.size())
    {
        throw std::invalid_argument("fault " + std::to_string(place) + ": there are " + std::to_string(faults_.size()));
    }
    Active& active = faults_[place];
    const bool lasts = active.fault.lasts == 0; // else a reset ends by itself
    active.begins = active.begins >= at ? EMU_TIME_MAX : active.begins;
    active.ends = active.on && lasts ? std::min(active.ends, at) : active.ends;
    active.fault.to = std::min(active.fault.to, at);
}

emu_time_t Faults::next() const
{
    emu_time_t next = EMU_TIME_MAX;
    for (const Active& active : faults_)
    {
        next = std::min({next, active.begins, active.ends});
    }
    return next;
}

void Faults::apply()
{
    for (Active& active : faults_)
    {
        if (active.ends <= target_.sched->now)
        {
            active.ends = EMU_TIME_MAX;
            active.on = false;
            end(active);
        }
        if (active.begins <= target_.sched->now)
        {
            begin(active);
        }
    }
}

void Faults::begin(Active& active)
{
    const Fault& fault = active.fault;
    const emu_time_t now = target_.sched->now;
    const bool again = active.on; // a drifting crystal, or a reset in a reset
    active.begins = fault.rate_hz > 0.0 ? fault_drawn(active.random, fault, now) : EMU_TIME_MAX;
    active.hits += !again;
    switch (fault.kind)
    {
    case FaultKind::iram_flip:
    case FaultKind::sfr_flip:
    case FaultKind::xdata_flip:
    case FaultKind::code_flip:
        flip(active);
        return;
    case FaultKind::reset:
    case FaultKind::power:
    case FaultKind::brown_out:
        active.ends = now + fault.lasts;
        mcs51_hold_reset(acq_board_cpu(target_.board), true);
        break;
    case FaultKind::crystal:
        active.ends = fault.to;
        set_crystal(active);
        break;
    case FaultKind::baud:
        active.ends = fault.to;
        emu_serial_end_set_baud(target_.host, target_.baud * (1.0 + fault.value * 1e-6));
        break;
    default:
        active.ends = fault.to;
        connect(fault, true);
        break;
    }
    active.on = true;
}

void Faults::end(Active& active)
{
    const Fault& fault = active.fault;
    mcs51_t* const cpu = acq_board_cpu(target_.board);
    switch (fault.kind)
    {
    case FaultKind::power:
        mcs51_reset(cpu, true);
        mcs51_hold_reset(cpu, false);
        break;
    case FaultKind::brown_out:
        mcs51_brown_out(cpu, emu_random(&active.random) | 1u);
        mcs51_hold_reset(cpu, false);
        break;
    case FaultKind::reset:
        mcs51_hold_reset(cpu, false);
        break;
    case FaultKind::crystal:
        active.begins = EMU_TIME_MAX;
        acq_board_set_crystal(target_.board, 0);
        break;
    case FaultKind::baud:
        emu_serial_end_set_baud(target_.host, target_.baud);
        break;
    default:
        connect(fault, false);
        break;
    }
}

void Faults::flip(Active& active)
{
    const Fault& fault = active.fault;
    mcs51_t* const cpu = acq_board_cpu(target_.board);
    const auto address = [&](unsigned first, unsigned count)
    { return fault.address >= 0 ? static_cast<unsigned>(fault.address) : first + below(active.random, count); };
    const unsigned bit = fault.bit >= 0 ? static_cast<unsigned>(fault.bit) : below(active.random, 8);
    const auto flipped = [&](uint8_t value) { return static_cast<uint8_t>(value ^ 1u << bit); };
    if (fault.kind == FaultKind::iram_flip)
    {
        const auto at = static_cast<uint8_t>(address(0, target_.iram_octets));
        mcs51_set_iram(cpu, at, flipped(mcs51_iram(cpu, at)));
    }
    else if (fault.kind == FaultKind::sfr_flip)
    {
        const auto at = static_cast<uint8_t>(address(0x80, 0x80));
        mcs51_set_sfr(cpu, at, flipped(mcs51_sfr(cpu, at)));
    }
    else if (fault.kind == FaultKind::xdata_flip)
    {
        const auto at = static_cast<uint16_t>(address(0, target_.xdata_octets));
        mcs51_set_xdata(cpu, at, flipped(mcs51_xdata(cpu, at)));
    }
    else
    {
        const auto at = static_cast<uint16_t>(address(0, target_.code_octets));
        mcs51_set_code(cpu, at, flipped(mcs51_code(cpu, at)));
    }
}

void Faults::set_crystal(Active& active)
{
    const Fault& fault = active.fault;
    const emu_time_t now = target_.sched->now;
    acq_board_set_crystal(target_.board, fault_ppb(fault, now));
    active.begins = fault.drift != 0.0 ? now + fault_drift_step : EMU_TIME_MAX;
}

void Faults::connect(const Fault& fault, bool on)
{
    const emu_time_t now = target_.sched->now;
    if (fault.kind == FaultKind::wire_cut)
    {
        acq_board_cut(target_.board, fault.net.c_str(), on);
    }
    else if (fault.other == "gnd" || fault.other == "vcc")
    {
        const emu_rail_t rail = fault.other == "gnd" ? EMU_RAIL_GND : EMU_RAIL_VCC;
        emu_wire_short(wire(fault.net), on ? rail : EMU_RAIL_NONE, now);
    }
    else if (on)
    {
        emu_wire_bridge(wire(fault.net), wire(fault.other), now);
    }
    else
    {
        emu_wire_unbridge(wire(fault.net), now);
    }
}

double Faults::volts(unsigned channel, double volts, emu_time_t at)
{
    for (Active& active : faults_)
    {
        const Fault& fault = active.fault;
        const bool stuck = fault.kind == FaultKind::volts_stuck, offset = fault.kind == FaultKind::volts_offset;
        if ((stuck || offset || fault.kind == FaultKind::volts_noise) && within(fault, channel, at))
        {
            const double noise = stuck || offset ? 0.0 : fault.value * normal(active.random);
            volts = stuck ? fault.value : volts + (offset ? fault.value : noise);
            active.hits++;
        }
    }
    return volts;
}

void Faults::outcome(unsigned channel, emu_time_t at, tlc2543_outcome_t* outcome)
{
    for (Active& active : faults_)
    {
        const Fault& fault = active.fault;
        if (fault.kind > FaultKind::eoc_missing || !within(fault, channel, at) ||
            !(unit(active.random) < fault.probability))
        {
            continue;
        }
        const auto mask =
            static_cast<uint16_t>(1u << (fault.bit >= 0 ? static_cast<unsigned>(fault.bit) : below(active.random, 12)));
        const tlc2543_outcome_t before = *outcome;
        switch (fault.kind)
        {
        case FaultKind::adc_stuck:
            outcome->code = static_cast<uint16_t>(fault.value != 0.0 ? outcome->code | mask : outcome->code & ~mask);
            break;
        case FaultKind::adc_flip:
            outcome->code ^= mask;
            break;
        case FaultKind::adc_noise:
            outcome->code = code_of(outcome->code + fault.value * normal(active.random));
            break;
        case FaultKind::adc_offset:
            outcome->code = code_of(outcome->code + fault.value);
            break;
        case FaultKind::eoc_late:
            outcome->t_conv += static_cast<emu_time_t>(fault.value * 1e12);
            break;
        default:
            outcome->eoc_missing = true;
            break;
        }
        active.hits += before.code != outcome->code || before.t_conv != outcome->t_conv ||
                       before.eoc_missing != outcome->eoc_missing;
    }
}

std::vector<std::pair<const char*, uint64_t>> Faults::hits() const
{
    std::vector<std::pair<const char*, uint64_t>> hits;
    for (const Active& active : faults_)
    {
        hits.emplace_back(fault_kinds[static_cast<size_t>(active.fault.kind)], active.hits);
    }
    return hits;
}

std::vector<std::pair<emu_time_t, emu_time_t>> Faults::windows() const
{
    std::vector<std::pair<emu_time_t, emu_time_t>> windows;
    for (const Active& active : faults_)
    {
        const bool instant = !in_conversion(active.fault.kind) && active.fault.rate_hz == 0.0 &&
                             (active.fault.lasts != 0 || active.fault.kind >= FaultKind::iram_flip);
        windows.emplace_back(active.fault.from, instant && active.hits != 0 ? active.fault.from : active.fault.to);
    }
    return windows;
}

} // namespace libins
