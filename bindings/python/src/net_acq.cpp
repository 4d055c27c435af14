/// \file   net_acq.cpp
/// \brief  See net_acq.hpp. SPDX-License-Identifier: MIT
#include "net_acq.hpp"
#include <stdexcept>

namespace libins
{
namespace
{

/// The longest instruction and an interrupt, in periods of the crystal: (4 + 3) machine cycles, and one in progress.
constexpr emu_time_t overshoot_periods = 8 * 12;

RunConfig outside(RunConfig config)
{
    if (config.nav)
    {
        throw std::invalid_argument("the board's host is on its line: give the station no navigator");
    }
    config.outside = true;
    return config;
}

} // namespace

AcqStation::AcqStation(std::string name, RunConfig config, std::shared_ptr<ins_motion_t> motion,
                       const ins_gyro_config_t& gyro)
    : LocalStation(std::move(name), {{"UART", "HOST RXD", "HOST TXD", {}, {}, false}}),
      run_(std::make_unique<Run>(outside(std::move(config)), std::move(motion), gyro))
{
    attach(&run_->sched(), 0, &run_->host_rxd(), &run_->host_txd());
}

emu_time_t AcqStation::overshoot() const
{
    return overshoot_periods * EMU_PS_PER_S / static_cast<emu_time_t>(run_->config().crystal_hz);
}

emu_wire_t* AcqStation::wire(const std::string& name)
{
    return name == "HOST RXD"   ? &run_->host_rxd()
           : name == "HOST TXD" ? &run_->host_txd()
                                : acq_board_wire(run_->board(), name.c_str());
}

void AcqStation::begin(emu_time_t goal)
{
    arm(goal + overshoot());
    stopped_ = !run_->until(goal);
}

} // namespace libins
