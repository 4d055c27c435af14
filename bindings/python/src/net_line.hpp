/// \file   net_line.hpp
/// \brief  One direction of a line between two stations: an edge arrives exactly its delay after it left, with the line's faults.
///
/// It follows its source: what left up to the source's instant is played through emu_serial_line_t, and what comes out of that is on its
/// way to the destination. So the source may be ahead or behind, and the edges are the same.
/// SPDX-License-Identifier: MIT
#pragma once
#include "emu/serial.h"
#include "net_station.hpp"
#include <vector>

namespace libins
{

struct LineConfig
{
    double baud = 0.0;    ///< of a bit slot, and of the delay where there is none
    emu_time_t delay = 0; ///< 0: one bit
    double bit_error = 0.0;
    double octet_loss = 0.0;
    std::vector<emu_serial_cut_t> cuts;
};

class Channel
{
  public:
    /// Throws std::invalid_argument.
    Channel(Station& source, size_t from, Station& destination, size_t to, const LineConfig& config, uint64_t seed);
    Channel(const Channel&) = delete;
    Channel& operator=(const Channel&) = delete;

    /// Up to what the source has told.
    void carry();
    Station& source() const { return *source_; }
    Station& destination() const { return *destination_; }
    emu_time_t delay() const { return config_.delay; }
    /// The line itself changes nothing before.
    emu_time_t silent_until() const { return emu_sched_next(&sched_); }
    const Port& from() const { return source_->ports()[from_port_]; }
    const Port& to() const { return destination_->ports()[to_port_]; }
    /// A wire fault at one of its ends.
    void add_fault(const Fault& fault, bool at_source);
    const FaultList& faults() const { return faults_; }
    const emu_serial_line_t& line() const { return line_; }

  private:
    static void on_level(void* ctx, bool level, emu_time_t at);
    static void on_fault(void* ctx, emu_time_t at);
    void settle(emu_time_t at);

    Station* source_;
    Station* destination_;
    size_t from_port_, to_port_;
    LineConfig config_;
    emu_sched_t sched_{};
    emu_wire_t from_{}, to_{};
    int driver_ = 0;
    emu_serial_line_t line_{};
    bool late_ = false;
    emu_event_t fault_event_{};
    FaultList faults_;
    std::vector<bool> at_source_; ///< of each fault
};

} // namespace libins
