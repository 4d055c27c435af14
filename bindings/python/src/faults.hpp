/// \file   faults.hpp
/// \brief  Declared faults of a run: what breaks, when, and how often, each with a random stream of its own.
///
/// A fault begins and ends between two instructions, at the first boundary at or after its instant; those of conversions and volts act
/// in each that falls within. docs/faults.md says what each parameter means.
/// SPDX-License-Identifier: MIT
#pragma once
#include "emu/serial.h"
#include "emu_8051/acq_board.h"
#include <array>
#include <string>
#include <vector>

namespace libins
{

enum class FaultKind : uint8_t
{
    adc_stuck,
    adc_flip,
    adc_noise,
    adc_offset,
    eoc_late,
    eoc_missing,
    volts_stuck,
    volts_offset,
    volts_noise,
    wire_cut,
    wire_short,
    line_break,
    baud,
    crystal,
    reset,
    power,
    brown_out,
    iram_flip,
    sfr_flip,
    xdata_flip,
    code_flip
};

constexpr std::array<const char*, 21> fault_kinds = {
    "adc_stuck",    "adc_flip",    "adc_noise", "adc_offset", "eoc_late", "eoc_missing", "volts_stuck",
    "volts_offset", "volts_noise", "wire_cut",  "wire_short", "break",    "baud",        "crystal",
    "reset",        "power",       "brown_out", "iram_flip",  "sfr_flip", "xdata_flip",  "code_flip"};

struct Fault
{
    FaultKind kind = FaultKind::adc_stuck;
    emu_time_t from = 0, to = EMU_TIME_MAX;
    double rate_hz = 0.0;     ///< 0: once, at `from`; else so often on average, at random instants in from .. to
    emu_time_t lasts = 0;     ///< of a reset, power, brown_out
    double probability = 1.0; ///< of adc_flip, eoc_late, eoc_missing, in each conversion
    double value = 0.0;       ///< LSB, V, s, ppm, or the level a bit is stuck at
    double drift = 0.0;       ///< of a crystal [ppm/s]
    int32_t channel = -1;     ///< -1: all
    int32_t address = -1;     ///< -1: at random
    int32_t bit = -1;         ///< -1: at random
    std::string net, other;   ///< other: "gnd", "vcc" or a net
    uint64_t seed = 0;
};

constexpr emu_time_t fault_drift_step = EMU_PS_PER_S / 100; ///< a drifting crystal is set anew so often

/// The next of events that come at random instants; EMU_TIME_MAX: not before fault.to.
emu_time_t fault_drawn(uint64_t& random, const Fault& fault, emu_time_t after);
/// Error of a crystal with this fault.
int32_t fault_ppb(const Fault& fault, emu_time_t now);

/// The faults of one run, on its board and on the host's end of its line.
class Faults
{
  public:
    struct Target
    {
        acq_board_t* board;
        emu_sched_t* sched;
        emu_serial_end_t* host;
        emu_wire_t* host_rxd;
        double baud; ///< of the host
        uint32_t iram_octets, xdata_octets, code_octets;
    };

    explicit Faults(const Target& target) : target_(target) {}

    /// Throws std::invalid_argument with key, value and remedy for a net or memory that there is not.
    void add(const Fault& fault);
    /// As if the fault had been declared to end then, in the future. Throws std::invalid_argument.
    void end_at(size_t place, emu_time_t at);
    /// The instant at which apply() has something to do; EMU_TIME_MAX: never.
    emu_time_t next() const;
    /// Begin and end what is due. Between runs of the board.
    void apply();
    double volts(unsigned channel, double volts, emu_time_t at);
    void outcome(unsigned channel, emu_time_t at, tlc2543_outcome_t* outcome);
    /// How often each has acted: begun, a conversion or volts changed, a bit flipped.
    std::vector<std::pair<const char*, uint64_t>> hits() const;
    /// First and last instant at which it may act.
    std::vector<std::pair<emu_time_t, emu_time_t>> windows() const;
    /// Definitions and states. After those of the board and the wires.
    void state(emu_state_t* io);

  private:
    struct Active
    {
        Fault fault;
        emu_time_t begins = 0, ends = EMU_TIME_MAX; ///< next
        bool on = false;
        uint64_t random = 0, hits = 0;
    };

    emu_wire_t* wire(const std::string& name) const;
    std::string problem(const Fault& fault) const;
    void begin(Active& active);
    void end(Active& active);
    void flip(Active& active);
    void set_crystal(Active& active);
    void connect(const Fault& fault, bool on);
    void set_shorts(bool on);
    static void state(Active& active, emu_state_t* io);

    Target target_;
    std::vector<Active> faults_;
};

} // namespace libins
