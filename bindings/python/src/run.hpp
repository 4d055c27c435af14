/// \file   run.hpp
/// \brief  One deterministic run: motion -> gyros -> acquisition board with firmware -> serial line -> receiver and navigator -> score.
///
/// The rooms meet here: the board's ADC calls the truth's gyro model, the board's UART is wired to a serial end that feeds the host's
/// handshake and navigator in virtual time (or hands the octets out, when somebody outside plays the host).
/// SPDX-License-Identifier: MIT
#pragma once
#include "debug.hpp"
#include "emu/serial.h"
#include "emu_8051/acq_board.h"
#include "faults.hpp"
#include "front_end.hpp"
#include "ins_truth/accel.h"
#include "ins_truth/front_end.h"
#include "ins_truth/gyro.h"
#include "knobs.hpp"
#include "navigator.hpp"
#include "observers.hpp"
#include "octet.hpp"
#include "program.hpp"
#include "report.hpp"
#include "scans.hpp"
#include "signal.hpp"
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace libins
{

/// A row of what Python gets.
struct Edge
{
    int64_t at;
    int64_t wire; ///< index into Run::traced
    int64_t level;
};

struct Segment
{
    uint16_t address;
    std::string octets;
};

struct RunConfig
{
    mcs51_part_t part = MCS51_AT89S51;
    uint32_t code_octets = 0; ///< as in mcs51_config_t
    uint32_t xdata_octets = 0;
    uint64_t crystal_hz = 11059200;
    uint64_t seed = 1;
    std::vector<Segment> image;
    double baud = 9600.0; ///< of the host
    double bit_error = 0.0;
    double octet_loss = 0.0;
    std::vector<std::array<double, 2>> cuts_s;
    std::optional<ins_nav_config_t> nav; ///< nothing: the outside plays the host
    bool start_at_truth = true;          ///< the navigator gets the truth at its first sample
    bool trace = false;
    std::map<unsigned, Signal> signals;       ///< by channel; the others have the gyros, or
    std::optional<ins_accel_config_t> accels; ///< accelerometers on the track
    std::shared_ptr<ins_track_t> track;
    std::optional<ins_front_end_channel_t> front_end; ///< its rails are the sensors'
    std::optional<SixConfig> six_nav;                 ///< with nav: their navigator
    bool six = false;                                 ///< the board of acq_board_six_config()
    bool listen = false;   ///< keep the octets that the host receives, also where the navigator takes them
    size_t scans_kept = 0; ///< the newest that are there at any time; 0: all
    bool outside = false;  ///< what is beyond the host's wires is somebody else's, the transmitter too
    bool seen =
        false; ///< keep the converter's samples and the edges of all pins, for take_samples() and take_pin_edges()
};

/// One sample of the converter: `at` is the end of its acquisition.
struct Sample
{
    emu_time_t at;
    unsigned channel;
    uint16_t code;
    double volts;
};

class Run
{
  public:
    /// Names of the wires in a trace, by Edge::wire.
    static constexpr std::array<const char*, 7> traced = {"EOC", "I/O CLOCK", "DATA IN", "DATA OUT",
                                                          "/CS", "TXD",       "RXD"};

    static constexpr unsigned pins = 32;

    /// Throws std::invalid_argument with the reason.
    Run(const RunConfig& config, std::shared_ptr<ins_motion_t> motion, const ins_gyro_config_t& gyro);
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

    /// Run to t. \return whether t was reached; false: something stopped the run before, and running again goes on.
    bool until(emu_time_t t);
    /// As until(), but no further than the first octet that the host receives.
    bool until_octet(emu_time_t t);
    Observers& observers() { return *observers_; }
    /// See program.hpp; anew each time.
    void watch_program(bool console, std::optional<uint16_t> end)
    {
        program_.emplace(cpu(), *observers_, console, end);
    }
    std::optional<Program>& program() { return program_; }
    /// Nothing more will happen: the firmware jumps to itself with interrupts off.
    bool halted() const { return halted_; }
    /// Of a wire of `traced`, now.
    bool level(size_t wire) const { return acq_board_wire(board_.get(), traced.at(wire))->level; }
    /// From now on that many volts on an analogue input, whatever the motion says, until they are cleared.
    void set_volts(unsigned channel, double volts) { volts_[channel] = volts; }
    void clear_volts(unsigned channel) { volts_.erase(channel); }
    Faults& faults() { return *faults_; }
    /// Of a debugger; made when first asked for.
    Watcher& watcher() { return watcher_ ? *watcher_ : watcher_.emplace(board_.get(), *observers_); }
    /// From this instant on; keep: with what was done by hand.
    void set_motion(std::shared_ptr<ins_motion_t> motion, bool keep);
    /// At knob.at, or now where that has passed. Throws std::invalid_argument with the reason.
    void add_knob(const Knob& knob);
    /// What the hand's knobs say now.
    const std::array<double, 3>* hand_rate() const { return motion_.rate(); }
    const std::map<unsigned, double>& held_volts() const { return volts_; }
    const ins_gyro_config_t& gyro() const { return gyro_.config; }
    /// Octets from the outside; \return how many the transmitter took.
    size_t send(const std::string& octets);

    /// All of the run as octets, for a run made with the same configuration; see run_state.cpp.
    std::string save();
    /// Throws std::invalid_argument when they are not of such a run or were changed; the run is then as it was. States, edges and octets
    /// that were not taken are dropped.
    void restore(const std::string& octets);

    emu_time_t now() const { return sched_.now; }
    emu_sched_t& sched() { return sched_; }
    emu_wire_t& host_rxd() { return host_rxd_; }
    emu_wire_t& host_txd() { return host_txd_; }
    acq_board_t* board() const { return board_.get(); }
    const RunConfig& config() const { return config_; }
    /// Of a scan: 6 with accelerometers, else 3.
    unsigned channels() const { return config_.accels ? INS_NAV_CHANNELS : 3; }
    mcs51_t* cpu() const { return acq_board_cpu(board_.get()); }
    /// What is at the converter's input at instant t.
    double volts(unsigned channel, emu_time_t t) { return on_volts(this, channel, t); }
    std::vector<Scored> take_states() { return navigator_.take_states(); }
    std::vector<Edge> take_edges() { return std::exchange(edges_, {}); }
    /// Of every pin, Edge::wire being 8 * port + bit.
    std::vector<Edge> take_pin_edges() { return std::exchange(pin_edges_, {}); }
    std::vector<Sample> take_samples() { return std::exchange(samples_, {}); }
    std::vector<Octet> take_octets() { return std::exchange(octets_, {}); }
    /// What the host's end was given to send, kept where config.seen and config.listen are on; `at` is when it was.
    std::vector<Octet> take_sent() { return std::exchange(sent_, {}); }

    Scans scans;
    std::vector<Report> reports;
    const std::shared_ptr<ins_motion_t>& motion() const { return motion_.get(); }
    uint64_t corrupt_accepted() const { return navigator_.corrupt_accepted; }
    ins_nav_counts_t counts() const { return navigator_.link.counts; }
    const emu_serial_end_t& host_end() const { return end_; }
    std::array<uint64_t, 2> slots_inverted() const { return {lines_[0].slots_inverted, lines_[1].slots_inverted}; }
    std::array<uint64_t, 2> octets_swallowed() const
    {
        return {lines_[0].octets_swallowed, lines_[1].octets_swallowed};
    }

  private:
    struct Tap
    {
        Run* run;
        unsigned wire;
    };
    void open_sensors(ins_gyro_config_t gyro);
    static double on_sensors(void* ctx, unsigned channel, int64_t t);
    static double on_volts(void* ctx, unsigned channel, int64_t t);
    static void on_sample(void* ctx, unsigned channel, uint16_t code, double volts, emu_time_t at);
    static void on_outcome(void* ctx, unsigned channel, emu_time_t at, tlc2543_outcome_t* outcome);
    bool transmit(uint8_t octet);
    void act(const Knob& knob);
    void set_gyro(const ins_gyro_config_t& config);
    static void on_octet(void* ctx, uint8_t octet, bool framing_ok, emu_time_t at);
    static void on_edge(void* ctx, bool level, emu_time_t at);
    static void on_pin_edge(void* ctx, bool level, emu_time_t at);
    static void on_report(void* ctx, emu_report_kind_t kind, const char* text, uint32_t detail, emu_time_t at);
    void wire_up();
    void walk(emu_state_t* io);
    std::string walked();

    struct BoardDeleter
    {
        void operator()(acq_board_t* board) const { acq_board_destroy(board); }
    };

    RunConfig config_;
    HandMotion motion_;
    ins_gyro_t gyro_{};
    ins_accels_t accels_{};
    FrontEnd front_end_;
    std::map<unsigned, double> volts_; ///< set by hand
    emu_sched_t sched_{};
    std::unique_ptr<acq_board_t, BoardDeleter> board_;
    std::optional<Observers> observers_;
    std::optional<Program> program_;
    bool halted_ = false;
    std::optional<Watcher> watcher_;
    emu_wire_t host_rxd_{}, host_txd_{};
    std::array<emu_serial_line_t, 2> lines_{};
    std::vector<emu_serial_cut_t> cuts_;
    emu_serial_end_t end_{};
    std::optional<Faults> faults_;
    Knobs knobs_;
    Navigator navigator_;
    Scan pending_{};
    unsigned pending_channels_ = 0;
    std::array<Tap, traced.size()> taps_{};
    std::array<Tap, pins> pin_taps_{};
    std::vector<Edge> edges_;
    std::vector<Octet> octets_, sent_;
    bool stop_at_octet_ = false;
    std::vector<Edge> pin_edges_;
    std::vector<Sample> samples_;
};

} // namespace libins
