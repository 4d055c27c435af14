/// \file   net.hpp
/// \brief  Several boards and hosts on serial lines, in one virtual time.
///
/// Conservative simulation in parallel (Chandy and Misra 1979; Bryant 1977): a line has a delay, so what a station does now reaches no
/// other before that. Each goes on alone up to the first instant at which something not yet known could reach it, board programs at the
/// same time in their processes. No edge is moved or rounded, and no result depends on how far anyone went at a time.
/// SPDX-License-Identifier: MIT
#pragma once
#include "net_acq.hpp"
#include "net_f2812.hpp"
#include "net_host.hpp"
#include "net_line.hpp"

namespace libins
{

class Net
{
  public:
    /// All stations meet at multiples of it: none goes further ahead of the others, and a program that hangs is found by then.
    static constexpr emu_time_t window_most = EMU_PS_PER_S / 10;

    explicit Net(uint64_t seed) : seed_(seed) {}
    Net(const Net&) = delete;
    Net& operator=(const Net&) = delete;

    /// A station with a name of its own. Before time goes on. Throws std::invalid_argument.
    template <typename T> T& add(std::unique_ptr<T> station)
    {
        T& made = *station;
        adopt(std::move(station));
        return made;
    }
    /// Throws std::invalid_argument when there is none, or it is of another kind.
    template <typename T> T& get(const std::string& name)
    {
        T* const found = dynamic_cast<T*>(&station(name));
        if (found == nullptr)
        {
            throw std::invalid_argument(name + ": is a station of another kind");
        }
        return *found;
    }
    Station& station(const std::string& name);

    /// Between "station.PORT" and "station.PORT", or "station" where that has one port only; each end's TXD to the other's RXD, as far as
    /// both are there. Before time goes on. \return the line's number. Throws std::invalid_argument.
    size_t line(const std::string& a, const std::string& b, const LineConfig& config);
    /// Edges of a station's wire from now on. \return number of the trace, as in TracedEdge.
    int64_t trace(const std::string& station, const std::string& wire);
    /// A fault of a station, or of a line at one of its pins (fault.net). Throws std::invalid_argument.
    void add_fault(const std::string& station, const Fault& fault);

    /// All stations to instant t. \return false: one stopped before, see stopped(); calling again goes on.
    bool until(emu_time_t t);
    /// As until(), but the host stops at the first octet that it receives.
    bool until_octet(const std::string& host, emu_time_t t);
    /// The station that stopped; NULL: none.
    const Station* stopped() const { return stopped_; }
    /// Where the last of them is.
    emu_time_t now() const;
    /// Edges of all traces, by instant and trace, up to where no station has more to tell.
    std::vector<TracedEdge> take_edges();
    /// Kind of each fault and how often it has acted, in the order they were added; station: of its own alone, empty: of all.
    std::vector<std::pair<const char*, uint64_t>> fault_hits(const std::string& station);
    /// Bits inverted and octets swallowed on a line, both ways.
    std::array<uint64_t, 2> line_counts(size_t line) const;
    void set_patience(double seconds);

    uint64_t rounds = 0;  ///< of letting time go on
    uint64_t windows = 0; ///< of board programs

  private:
    struct End
    {
        size_t station, port;
    };
    struct Way
    {
        std::unique_ptr<Channel> channel;
        size_t source, destination, line;
    };

    /// A fault, as one of a list; an acquisition board keeps its own.
    struct Added
    {
        Station* station;
        const FaultList* list; ///< NULL: the board's
        size_t index;
    };

    void adopt(std::unique_ptr<Station> station);
    End end_of(const std::string& name) const;
    void connect(End from, End to, const LineConfig& config, size_t line);
    void spread(size_t silent);
    void find_earliest(size_t silent);
    emu_time_t alone_until(size_t station) const;
    emu_time_t answer_least(size_t station) const;
    void find_goals(emu_time_t t);
    void carry();
    bool go(bool light, emu_time_t t);
    Channel* channel_at(const Station& station, const std::string& pin, bool& at_source);

    uint64_t seed_;
    std::vector<std::unique_ptr<Station>> stations_;
    std::vector<Way> ways_;
    size_t lines_ = 0;
    int64_t traces_ = 0;
    std::vector<Added> faults_;
    std::vector<emu_time_t> earliest_; ///< by station: nothing leaves before
    std::vector<emu_time_t> goals_;    ///< by station
    std::vector<TracedEdge> edges_;
    const Station* stopped_ = nullptr;
    std::string broken_; ///< what an exception said: the net cannot go on
};

} // namespace libins
