/// \file   net_host.hpp
/// \brief  A host on a line: octets at its own baud, for somebody outside, or for a listener that answers.
/// SPDX-License-Identifier: MIT
#pragma once
#include "emu/serial.h"
#include "net_station.hpp"
#include "octet.hpp"
#include <functional>

namespace libins
{

/// What answers a host's octets in virtual time.
class Listener
{
  public:
    virtual ~Listener() = default;
    /// \return the octet to send back; -1: none.
    virtual int octet(uint8_t octet, bool framing_ok, emu_time_t at) = 0;
    /// Time passes.
    virtual void tick(emu_time_t at) = 0;
};

class HostStation final : public LocalStation
{
  public:
    /// Throws std::invalid_argument for a baud that cannot be.
    HostStation(std::string name, double baud, std::unique_ptr<Listener> listener);

    emu_time_t now() const override { return sched_.now; }
    emu_time_t silent_until() const override { return emu_sched_next(&sched_); }
    /// Nothing is answered before a start bit and eight data bits, at the least.
    emu_time_t reaction() const override;
    bool light() const override { return true; }
    void begin(emu_time_t goal) override;
    bool stopped() const override { return stopped_; }
    void add_fault(const Fault& fault) override;

    /// \return how many the transmitter took.
    size_t send(const std::string& octets);
    void stop_at_octet(bool on) { stop_at_octet_ = on; }
    std::vector<Octet> take_octets() { return std::exchange(octets_, {}); }
    const emu_serial_end_t& end() const { return end_; }
    Listener* listener() const { return listener_.get(); }

  protected:
    emu_wire_t* wire(const std::string& name) override;
    void act(const FaultList::Entry& entry) override;

  private:
    static void on_octet(void* ctx, uint8_t octet, bool framing_ok, emu_time_t at);

    emu_sched_t sched_{};
    emu_wire_t txd_{}, rxd_{};
    double baud_;
    emu_serial_end_t end_{};
    std::unique_ptr<Listener> listener_;
    bool stop_at_octet_ = false, stopped_ = false;
    std::vector<Octet> octets_;
};

} // namespace libins
