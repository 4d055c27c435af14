/// \file   net_listeners.cpp
/// \brief  See net_listeners.hpp. SPDX-License-Identifier: MIT
#include "net_listeners.hpp"

namespace libins
{
namespace
{

constexpr emu_time_t ms = 1'000'000'000;

} // namespace

int CodesListener::octet(uint8_t octet, bool framing_ok, emu_time_t at)
{
    // A UART hands no octet on without its stop bit.
    return framing_ok ? navigator.octet(octet, at, board_->run().scans, board_->run().motion().get()) : -1;
}

BlocksListener::BlocksListener()
{
    ins_nav_input_config_t config;
    ins_nav_input_config_default(&config);
    ins_nav_input_init(&input_, &config);
}

void BlocksListener::tick(emu_time_t at)
{
    ins_nav_input_tick(&input_, static_cast<uint64_t>(at / ms));
}

int BlocksListener::octet(uint8_t octet, bool framing_ok, emu_time_t at)
{
    int reply = -1;
    ins_nav_solution_t solution;
    tick(at);
    if (framing_ok && ins_nav_input_octet(&input_, octet, static_cast<uint64_t>(at / ms), &reply, &solution) == 1)
    {
        solutions_.push_back({at, solution});
    }
    return reply;
}

} // namespace libins
