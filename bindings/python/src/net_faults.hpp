/// \file   net_faults.hpp
/// \brief  When the declared faults of a station or a line begin and end; who has them does what they are.
/// SPDX-License-Identifier: MIT
#pragma once
#include "faults.hpp"
#include <functional>
#include <string>
#include <vector>

namespace libins
{

/// The baud of an end at which this fault is on. Throws std::invalid_argument for another kind or one that cannot be.
double baud_with(const Fault& fault, double baud, const std::string& whose);

class FaultList
{
  public:
    struct Entry
    {
        Fault fault;
        emu_time_t begins, ends = EMU_TIME_MAX; ///< next
        bool on = false;
        uint64_t random, hits = 0;
    };

    void add(const Fault& fault, emu_time_t now);
    /// The instant at which apply() has something to do; EMU_TIME_MAX: never.
    emu_time_t next() const;
    /// Begin and end what is due; `act` is told of each, and of a drifting crystal again and again while it is on.
    void apply(emu_time_t now, const std::function<void(const Entry& entry)>& act);
    const std::vector<Entry>& entries() const { return entries_; }

  private:
    std::vector<Entry> entries_;
};

} // namespace libins
