/// \file   net_station.hpp
/// \brief  What takes part in a run of several boards: a station with serial ports, a time of its own, and a promise of when it is silent.
///
/// Stations share no queue of events. Each goes on alone up to an instant before which nothing can reach it, and tells what left; how far
/// that is follows from the delay of the lines and from what the others promise (net.cpp).
/// SPDX-License-Identifier: MIT
#pragma once
#include "emu/sched.h"
#include "emu/wire.h"
#include "net_faults.hpp"
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace libins
{

/// A level that a wire takes.
struct Level
{
    emu_time_t at;
    bool level;
};

/// One serial port of a station. Its line takes `left` and fills `coming`.
struct Port
{
    std::string name;         ///< "SCIA"
    std::string txd, rxd;     ///< its pins; empty: it has none
    std::vector<Level> left;  ///< since the line took them
    std::deque<Level> coming; ///< on the way to the station
    bool lined = false;
};

/// An edge of a traced wire; wire: number of its trace in the net.
struct TracedEdge
{
    emu_time_t at;
    int64_t wire;
    bool level;
};

class Station
{
  public:
    Station(std::string name, std::vector<Port> ports) : name_(std::move(name)), ports_(std::move(ports)) {}
    virtual ~Station() = default;
    Station(const Station&) = delete;
    Station& operator=(const Station&) = delete;

    virtual emu_time_t now() const = 0;
    /// All that left up to then is in the ports' `left`, and in edges().
    virtual emu_time_t told_until() const { return now(); }
    /// Nothing else leaves before that instant, unless something comes in or a fault begins.
    virtual emu_time_t silent_until() const { return told_until() + 1; }
    /// The least time from what comes in to what leaves because of it.
    virtual emu_time_t reaction() const { return 0; }
    /// How far beyond its goal it may come.
    virtual emu_time_t overshoot() const { return 0; }
    /// It costs next to nothing to let its time go on.
    virtual bool light() const { return false; }
    /// It stops by itself when something may come back that it sent; set_answer() says the least time that takes.
    virtual bool stops_for_answers() const { return false; }
    void set_answer(emu_time_t answer) { answer_ = answer; }
    /// Let time go on to `goal`, with all that is coming up to then; a process goes on by itself until finish().
    virtual void begin(emu_time_t goal) = 0;
    /// The goal is reached, or, if stopped(), not.
    virtual void finish() {}
    /// Something that the outside wants to see stopped it before its goal; the next begin() goes on.
    virtual bool stopped() const { return false; }
    /// Tell this wire's edges as `number` from now on. Throws std::invalid_argument.
    virtual void trace(const std::string& wire, int64_t number) = 0;
    /// Begin and end the faults that are due. Before a goal is looked for, since they change what is coming.
    void apply_faults()
    {
        if (faults_.next() <= now())
        {
            faults_.apply(now(), [this](const FaultList::Entry& entry) { act(entry); });
        }
    }
    /// Throws std::invalid_argument for one that the station cannot have.
    virtual void add_fault(const Fault& fault) = 0;

    const std::string& name() const { return name_; }
    std::vector<Port>& ports() { return ports_; }
    const std::vector<Port>& ports() const { return ports_; }
    /// The first instant at which something comes; EMU_TIME_MAX: nothing is on the way.
    emu_time_t arrival() const;
    std::vector<TracedEdge>& edges() { return edges_; }
    FaultList& faults() { return faults_; }

  protected:
    /// A fault begins, goes on changing, or ends.
    virtual void act(const FaultList::Entry& entry) = 0;
    FaultList faults_;
    emu_time_t answer_ = EMU_TIME_LOADED_MAX;

  private:
    std::string name_;
    std::vector<Port> ports_;
    std::vector<TracedEdge> edges_;
};

/// A station of this process, with a queue of events.
class LocalStation : public Station
{
  public:
    using Station::Station;
    void trace(const std::string& wire, int64_t number) override;

  protected:
    /// Edges of txd leave by the port, what comes drives rxd; either may be NULL.
    void attach(emu_sched_t* sched, size_t port, emu_wire_t* txd, emu_wire_t* rxd);
    /// What is coming up to `goal` will come.
    void arm(emu_time_t goal);
    virtual emu_wire_t* wire(const std::string& name) = 0;

  private:
    struct Tap
    {
        LocalStation* station;
        int64_t number; ///< of a port or a trace
    };
    static void on_left(void* ctx, bool level, emu_time_t at);
    static void on_traced(void* ctx, bool level, emu_time_t at);
    static void on_arrival(void* ctx, emu_time_t at);

    emu_sched_t* sched_ = nullptr;
    emu_event_t event_{};
    emu_time_t goal_ = 0;
    std::vector<std::pair<emu_wire_t*, int>> driven_; ///< by port
    std::deque<Tap> taps_;                            ///< stay where they are
};

} // namespace libins
