/// \file   net_acq.hpp
/// \brief  The acquisition board of class Run as a station: its host's end of the line is the line.
/// SPDX-License-Identifier: MIT
#pragma once
#include "net_station.hpp"
#include "run.hpp"
#include <algorithm>

namespace libins
{

class AcqStation final : public LocalStation
{
  public:
    /// Throws std::invalid_argument. config.nav: nothing; the line's other end is the host.
    AcqStation(std::string name, RunConfig config, std::shared_ptr<ins_motion_t> motion, const ins_gyro_config_t& gyro);

    emu_time_t now() const override { return run_->now(); }
    /// What happened within the last instruction comes with the next.
    emu_time_t told_until() const override { return std::max<emu_time_t>(0, now() - overshoot()); }
    /// An instruction is not broken off.
    emu_time_t overshoot() const override;
    void begin(emu_time_t goal) override;
    bool stopped() const override { return stopped_; }
    /// Those of the board; see Faults::add().
    void add_fault(const Fault& fault) override { run_->faults().add(fault); }
    Run& run() { return *run_; }

  protected:
    emu_wire_t* wire(const std::string& name) override;
    void act(const FaultList::Entry&) override {} ///< the board has its own

  private:
    std::unique_ptr<Run> run_;
    bool stopped_ = false;
};

} // namespace libins
