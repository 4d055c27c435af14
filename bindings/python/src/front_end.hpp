/// \file   front_end.hpp
/// \brief  What lies between a run's sensors and its converter, where a scenario says so. SPDX-License-Identifier: MIT
#pragma once
#include "emu/state.h"
#include "ins_truth/front_end.h"
#include <memory>

namespace libins
{

class FrontEnd
{
  public:
    /// Of so many channels with the same stages. Throws std::invalid_argument, also where the build has no SUNDIALS.
    void open(const ins_front_end_config_t& config);
    bool is_open() const { return handle_ != nullptr; }
    /// Channels that are not there read the low rail.
    double volts(unsigned channel, int64_t t_ps);
    /// Of a snapshot.
    void state(emu_state_t* io);

  private:
    std::shared_ptr<ins_front_end_t> handle_;
    unsigned channels_ = 0;
    double rail_low_v_ = 0.0;
};

} // namespace libins
