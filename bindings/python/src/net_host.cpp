/// \file   net_host.cpp
/// \brief  See net_host.hpp. SPDX-License-Identifier: MIT
#include "net_host.hpp"
#include <algorithm>
#include <stdexcept>

namespace libins
{
namespace
{

constexpr double answer_bits = 9.0; ///< of 9.56: emu_serial_end_t decides in the stop bit

} // namespace

HostStation::HostStation(std::string name, double baud, std::unique_ptr<Listener> listener)
    : LocalStation(std::move(name), {{"LINE", "TXD", "RXD", {}, {}, false}}), baud_(baud),
      listener_(std::move(listener))
{
    emu_sched_init(&sched_);
    emu_wire_init(&txd_, "TXD", true);
    emu_wire_init(&rxd_, "RXD", true);
    if (emu_serial_end_init(&end_, &sched_, &txd_, &rxd_, baud, on_octet, this) != 0)
    {
        throw std::invalid_argument(this->name() + ": baud must be 50 .. 4e6");
    }
    attach(&sched_, 0, &txd_, &rxd_);
}

emu_time_t HostStation::reaction() const
{
    return static_cast<emu_time_t>(answer_bits * 1e12 / end_.baud);
}

emu_wire_t* HostStation::wire(const std::string& name)
{
    return name == "TXD" ? &txd_ : name == "RXD" ? &rxd_ : nullptr;
}

void HostStation::act(const FaultList::Entry& entry)
{
    emu_serial_end_set_baud(&end_, entry.on ? baud_with(entry.fault, baud_, name()) : baud_);
}

void HostStation::begin(emu_time_t goal)
{
    stopped_ = false;
    arm(goal);
    while (!stopped_ && emu_sched_next(&sched_) <= goal)
    {
        emu_sched_advance(&sched_, emu_sched_next(&sched_));
    }
    if (!stopped_)
    {
        emu_sched_advance(&sched_, goal);
    }
    if (listener_)
    {
        listener_->tick(now());
    }
}

void HostStation::add_fault(const Fault& fault)
{
    (void)baud_with(fault, baud_, "a host");
    faults_.add(fault, now());
}

size_t HostStation::send(const std::string& octets)
{
    size_t taken = 0;
    while (taken < octets.size() && emu_serial_end_send(&end_, static_cast<uint8_t>(octets[taken])))
    {
        taken++;
    }
    return taken;
}

void HostStation::on_octet(void* ctx, uint8_t octet, bool framing_ok, emu_time_t at)
{
    auto& self = *static_cast<HostStation*>(ctx);
    self.octets_.push_back({at, octet, framing_ok});
    self.stopped_ = self.stop_at_octet_;
    if (!self.listener_)
    {
        return;
    }
    if (const int reply = self.listener_->octet(octet, framing_ok, at); reply >= 0)
    {
        emu_serial_end_send(&self.end_, static_cast<uint8_t>(reply));
    }
}

} // namespace libins
