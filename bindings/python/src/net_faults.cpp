/// \file   net_faults.cpp
/// \brief  See net_faults.hpp. SPDX-License-Identifier: MIT
#include "net_faults.hpp"
#include <algorithm>
#include <stdexcept>

namespace libins
{

double baud_with(const Fault& fault, double baud, const std::string& whose)
{
    if (fault.kind != FaultKind::baud)
    {
        throw std::invalid_argument("kind: " + whose + " has a baud that may be off, and no other faults of its own");
    }
    const double off = baud * (1.0 + fault.value * 1e-6);
    if (!(off >= EMU_BAUD_MIN && off <= EMU_BAUD_MAX))
    {
        throw std::invalid_argument("ppm: the baud would be outside 50 .. 4e6");
    }
    return off;
}

void FaultList::add(const Fault& fault, emu_time_t now)
{
    Entry entry{fault, fault.from, EMU_TIME_MAX, false, fault.seed, 0};
    if (fault.rate_hz > 0.0)
    {
        entry.begins = fault_drawn(entry.random, fault, std::max(fault.from, now));
    }
    entries_.push_back(entry);
}

emu_time_t FaultList::next() const
{
    emu_time_t next = EMU_TIME_MAX;
    for (const Entry& entry : entries_)
    {
        next = std::min({next, entry.begins, entry.ends});
    }
    return next;
}

void FaultList::apply(emu_time_t now, const std::function<void(const Entry& entry)>& act)
{
    for (Entry& entry : entries_)
    {
        const Fault& fault = entry.fault;
        if (entry.ends <= now)
        {
            entry.ends = entry.begins = EMU_TIME_MAX;
            entry.on = false;
            if (fault.rate_hz > 0.0)
            {
                entry.begins = fault_drawn(entry.random, fault, now);
            }
            act(entry);
        }
        if (entry.begins <= now)
        {
            const bool drifts = fault.kind == FaultKind::crystal && fault.drift != 0.0;
            entry.hits += !entry.on;
            entry.ends = fault.lasts > 0 ? now + fault.lasts : fault.to;
            entry.begins = drifts ? now + fault_drift_step : EMU_TIME_MAX;
            entry.on = true;
            act(entry);
        }
    }
}

} // namespace libins
