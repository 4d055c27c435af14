/// \file   net_listeners.hpp
/// \brief  What a host on a line of a net does with octets: the navigator of the acquisition board, or the input of a navigating one.
/// SPDX-License-Identifier: MIT
#pragma once
#include "ins_nav/nav_input.h"
#include "navigator.hpp"
#include "net_acq.hpp"
#include "net_host.hpp"

namespace libins
{

/// Codes of an acquisition board to attitude, scored against what that board was fed with.
class CodesListener final : public Listener
{
  public:
    /// Throws std::invalid_argument.
    CodesListener(const ins_nav_config_t& config, bool start_at_truth, AcqStation& board) : board_(&board)
    {
        navigator.begin(config, start_at_truth);
    }
    int octet(uint8_t octet, bool framing_ok, emu_time_t at) override;
    void tick(emu_time_t at) override { navigator.tick(at); }

    Navigator navigator;

  private:
    AcqStation* board_;
};

/// A solution, and when its block was in.
struct Solved
{
    emu_time_t at;
    ins_nav_solution_t solution;
};

/// Blocks of a navigating board (ins/nav_block.h).
class BlocksListener final : public Listener
{
  public:
    BlocksListener();
    int octet(uint8_t octet, bool framing_ok, emu_time_t at) override;
    void tick(emu_time_t at) override;
    std::vector<Solved> take_solutions() { return std::exchange(solutions_, {}); }
    const ins_nav_counts_t& counts() const { return input_.counts; }

  private:
    ins_nav_input_t input_{};
    std::vector<Solved> solutions_;
};

} // namespace libins
