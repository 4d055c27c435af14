/// \file   ins_post/replay.hpp
/// \brief  A recorded drive, event by event, through a filter. Frames: b (x forward, y right, z down), n (NED). SI, rad.
///
///     ins_post::Replay replay(filter, events, 0.1);
///     while (!replay.done()) { replay.run(replay.time() + 10.0); }     // what came out: replay.states(), replay.checks()
///
/// Events are in order of time, those of one instant in the order in which they are to be used. Times are seconds of one time base
/// from an epoch of the caller's. A fix that is withheld is compared and not used: so an outage is simulated and its truth is kept.
/// SPDX-License-Identifier: MIT
#ifndef INS_POST_REPLAY_HPP_INCLUDED
#define INS_POST_REPLAY_HPP_INCLUDED
#include <array>
#include <cstddef>
#include <variant>
#include <vector>

namespace ins_post
{

using Vec3 = std::array<double, 3>;

/// Integrals of angular rate and specific force over the period that ends now.
struct Increment
{
    double period; ///< [s]
    Vec3 theta_b;  ///< [rad]
    Vec3 v_b;      ///< [m/s]
};

/// What a receiver says of its antenna. A standard deviation of 0: this figure is not known, and not used.
struct Fix
{
    double t;      ///< of which it is, not later than its event [s]
    double t_v;    ///< of which its velocity is, not later than t [s]
    Vec3 position; ///< latitude, longitude [rad], height above the ellipsoid [m]
    Vec3 sigma_p;  ///< north, east, down [m]
    Vec3 v_n;      ///< [m/s]
    Vec3 sigma_v;  ///< [m/s]
    double hdop;   ///< 0: not said
    unsigned sats; ///< 0: not said
    bool withheld; ///< compare only
};

/// Of a vehicle, over the period that ends now. NaN: not measured.
struct Wheels
{
    double period;   ///< [s]
    double speed;    ///< forward, its mean [m/s]
    double yaw_rate; ///< right turn positive [rad/s]
};

/// When a filter gets to know of it.
struct Event
{
    double t; ///< [s]
    std::variant<Increment, Fix, Wheels> what;
};

/// Where a filter believes to be, and how sure it is.
struct State
{
    double t;
    Vec3 position; ///< of the filter's own point, an IMU for example: latitude, longitude [rad], height [m]
    Vec3 v_n;      ///< [m/s]
    std::array<double, 4> q_nb;
    Vec3 bias_g, bias_a;              ///< [rad/s], [m/s^2]
    Vec3 sigma_phi, sigma_v, sigma_p; ///< standard deviations in n [rad], [m/s], [m]
    Vec3 sigma_bias_g, sigma_bias_a;
    /// Upper triangle, row by row, of the covariance of attitude, velocity and position errors, each north, east, down; 0: not known.
    std::array<double, 45> P;
    bool aided; ///< the last fix was used
};

/// A fix beside what the filter said of the antenna just before and just after it.
struct Check
{
    double t;
    Vec3 dp_before, dp_after; ///< filter - fix: north, east, down [m]
    Vec3 dv_before, dv_after; ///< [m/s]
    /// Expected deviation of dp_before and dv_before: what the filter takes for the fix's and its own; NaN: not known.
    std::array<double, 6> sigma;
    std::array<double, 6> nis; ///< of the three positions, the three velocities; NaN: not used
    unsigned refused;          ///< bit i: component i was outside the gate, or not a number
    bool withheld;
};

class Filter
{
  public:
    virtual ~Filter() = default;
    /// It knows where it is: state() may be asked.
    virtual bool started() const = 0;
    virtual void increment(double t, const Increment& increment) = 0;
    virtual void wheels(double t, const Wheels& wheels) = 0;
    /// \return the comparison; t and withheld are filled in by the caller.
    virtual Check fix(double t, const Fix& fix) = 0;
    virtual State state() const = 0;
};

class Replay
{
  public:
    /// \param output_s  time between states kept [s]. Throws std::invalid_argument: events that are not in order.
    Replay(Filter& filter, std::vector<Event> events, double output_s);
    /// Everything before t.
    void run(double t);
    bool done() const { return next_ == events_.size(); }
    double time() const; ///< of the next event, or of the last
    const std::vector<State>& states() const { return states_; }
    const std::vector<Check>& checks() const { return checks_; }

  private:
    Filter& filter_;
    std::vector<Event> events_;
    double output_s_;
    double due_;
    size_t next_ = 0;
    std::vector<State> states_;
    std::vector<Check> checks_;
};

} // namespace ins_post
#endif // INS_POST_REPLAY_HPP_INCLUDED
