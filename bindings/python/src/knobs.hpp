/// \file   knobs.hpp
/// \brief  What a hand does to a board and its line while it runs: turn or tilt it, set volts, change a gyro, send octets.
///
/// Each acts between two instructions, at the first boundary at or after its instant, in the order of instants and then in that of adding.
/// docs/scenarios.md says what each means.
/// SPDX-License-Identifier: MIT
#pragma once
#include "emu/state.h"
#include "emu/time.h"
#include "ins_truth/motion.h"
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace libins
{

enum class KnobKind : uint8_t
{
    rate,     ///< body rate from here on, from the attitude there is [rad/s]
    attitude, ///< turn to roll, pitch, yaw [rad] in `lasts`, at a constant rate, and rest
    volts,    ///< on an input, whatever the motion says
    release,  ///< the input follows its sensor or signal again
    bias,     ///< of the gyros [rad/s]
    noise,    ///< of the gyros [rad/s/sqrt(Hz)]
    send      ///< octets from the host
};

constexpr std::array<const char*, 7> knob_kinds = {"rate", "attitude", "volts", "release", "bias", "noise", "send"};

struct Knob
{
    KnobKind kind = KnobKind::rate;
    emu_time_t at = 0;
    emu_time_t lasts = 0;
    std::array<double, 3> values{};
    uint32_t channel = 0;
    std::string octets;
};

/// The knobs that are still to act.
class Knobs
{
  public:
    void add(const Knob& knob);
    emu_time_t next() const { return waiting_.empty() ? EMU_TIME_MAX : waiting_.front().at; }
    Knob take();
    void state(emu_state_t* io);

  private:
    std::vector<Knob> waiting_;
};

/// The motion of a board that is turned by hand: the scenario's, and what was done to it.
class HandMotion
{
  public:
    explicit HandMotion(std::shared_ptr<ins_motion_t> base) : base_(std::move(base)) {}
    const std::shared_ptr<ins_motion_t>& get() const { return turns_.empty() ? base_ : turns_.back().motion; }
    /// Another motion in the place of the scenario's; keep: with the turns that were made.
    void set_base(std::shared_ptr<ins_motion_t> base, bool keep);
    /// Throws std::invalid_argument.
    void turn(double from_s, const std::array<double, 3>& w_ib_b);
    void tilt(double from_s, double lasts_s, const std::array<double, 3>& rpy);
    /// The rate that a hand has set last; nothing: none has.
    const std::array<double, 3>* rate() const { return turns_.empty() ? nullptr : &turns_.back().w_ib_b; }
    void state(emu_state_t* io);

  private:
    struct Turn
    {
        double from_s = 0.0;
        std::array<double, 3> w_ib_b{};
        std::shared_ptr<ins_motion_t> motion;
    };
    void add(double from_s, const std::array<double, 3>& w_ib_b);

    std::shared_ptr<ins_motion_t> base_;
    std::vector<Turn> turns_; ///< each goes on from the one before
};

} // namespace libins
