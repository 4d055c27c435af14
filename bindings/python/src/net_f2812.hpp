/// \file   net_f2812.hpp
/// \brief  An F2812 with a board program as a station: a process of its own, driven by windows of time.
/// SPDX-License-Identifier: MIT
#pragma once
#include "net_station.hpp"
#include "process.hpp"
#include "report.hpp"
#include <array>
#include <map>

namespace libins
{

class F2812Station final : public Station
{
  public:
    using Switches = std::map<std::string, std::string>;

    /// Throws ProgramError, and std::invalid_argument for a switch or a crystal that cannot be.
    F2812Station(std::string name, const std::string& program, uint64_t oscclk_hz, const Switches& switches);

    emu_time_t now() const override { return now_; }
    emu_time_t silent_until() const override { return silent_until_; }
    bool stops_for_answers() const override { return true; }
    void begin(emu_time_t goal) override;
    void finish() override;
    bool stopped() const override { return why_ == F2812_WHY_BREAK; }
    void trace(const std::string& wire, int64_t number) override;
    void add_fault(const Fault& fault) override;

    /// Of any wire of the station's ports the line needs: opened when the line is made.
    void open_port(size_t port);
    std::vector<uint16_t> peek(uint16_t address, unsigned count);
    /// Stop at such an access; see f2812_link_access_t.
    void set_break(const f2812_link_access_t& access);
    /// The access that stopped it last.
    const f2812_link_access_t& broken_at() const { return access_; }
    void record(bool accesses, bool interrupts);
    std::vector<f2812_link_record_t> take_records() { return std::exchange(records_, {}); }
    std::vector<std::pair<std::string, uint64_t>> statistics();
    const std::vector<Report>& reports() const { return reports_; }
    /// How the firmware ended; empty: it has not.
    const std::string& end() const { return end_; }
    Process& process() { return process_; }

  private:
    struct Wire
    {
        std::string name;
        bool driven;
        bool answered;
        int port = -1; ///< whose `left` gets its edges, or whose `coming` drives it
        std::vector<int64_t> traces;
    };

    size_t open_wire(const std::string& name, bool driven, bool answered);
    /// Send message_, wait for the answer. \return it. Throws std::invalid_argument with its reason when it was refused.
    const f2812_link_t& ask(f2812_link_kind_t kind, f2812_link_kind_t answer);
    void act(const FaultList::Entry& entry) override;
    void take_edges(unsigned count, const f2812_link_edge_t* edges);
    void take_report();

    Process process_;
    std::unique_ptr<f2812_link_t> message_ = std::make_unique<f2812_link_t>();
    std::vector<Wire> wires_;
    emu_time_t now_ = 0, goal_ = 0, silent_until_ = 1;
    uint8_t why_ = F2812_WHY_REACHED;
    f2812_link_access_t access_{};
    std::string end_;
    std::vector<f2812_link_record_t> records_;
    std::vector<Report> reports_;
};

} // namespace libins
