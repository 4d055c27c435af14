/// \file   ins_post/gps_ins.hpp
/// \brief  The GPS/INS of ins/gps_ins.h behind the replay's events, and what a smoother needs of its run.
///
///     ins_post::GpsIns filter(config, start, {0.1, true});
///     ins_post::Replay(filter, events, 0.1).run(end);
///     std::vector<ins_post::State> smoothed = ins_post::smooth(filter.nodes());
///
/// SPDX-License-Identifier: MIT
#ifndef INS_POST_GPS_INS_HPP_INCLUDED
#define INS_POST_GPS_INS_HPP_INCLUDED
#include "ins/gps_ins.h"
#include "ins_post/replay.hpp"
#include <cstdint>
#include <deque>
#include <optional>

namespace ins_post
{

/// What the errors of ins/kf15.h are added to.
struct Nominal
{
    std::array<double, 4> q_nb;
    Vec3 v_n;
    ins_position_t position;
    Vec3 bias_g, bias_a;
};

using Square = std::array<double, INS_KF15_N * INS_KF15_N>; ///< row-major

/// An instant of a run: before and after what was measured then, and how errors came there from the node before.
struct Node
{
    double t;
    Nominal before, after;
    Square P_before, P_after;
    Square Phi; ///< errors after the node before, to errors before this one
};

/// Fixed-interval smoother over all nodes: the last is as the filter left it.
/// Source: H. E. Rauch, F. Tung, C. T. Striebel, AIAA J. 3(8), 1965, 1445-1450, on errors of the nominal states.
/// Throws std::invalid_argument: no nodes, or a covariance that is not positive definite.
std::vector<State> smooth(const std::vector<Node>& nodes);

struct GpsInsOptions
{
    double nhc_period;     ///< of the non-holonomic constraint [s]; 0: none
    double wheels_sigma;   ///< of a speed [m/s]
    double yaw_rate_sigma; ///< [rad/s]
    double node_period;    ///< of nodes kept for a smoother [s], besides those of measurements; 0: none are kept
    double scale_g = 0.0, scale_a = 0.0; ///< standard deviations of scale factors: 0.01 is a hundredth; both 0: none
};

/// Of gyros and accelerometers, and how sure: 0.01 reads a hundredth high.
struct Scales
{
    Vec3 gyro, accel;
    Vec3 sigma_gyro, sigma_accel;
};

/// The antenna.
struct Instant
{
    double t;
    Vec3 v_n;
    ins_position_t position;
};

class GpsIns : public Filter
{
  public:
    /// Throws std::invalid_argument: what ins_gps_ins_init and ins_gps_ins_scale_init refuse, or nodes with scale factors. Events
    /// before start.t_ns are passed over.
    GpsIns(const ins_gps_ins_config_t& config, const ins_gps_ins_start_t& start, const GpsInsOptions& options);
    bool started() const override { return started_; }
    void increment(double t, const Increment& increment) override;
    void wheels(double t, const Wheels& wheels) override;
    Check fix(double t, const Fix& fix) override;
    State state() const override;

    const ins_gps_ins_count_t& count() const { return n_.base.count; }
    /// If there are any.
    std::optional<Scales> scales() const;
    /// Those kept, and now.
    std::vector<Node> nodes() const;

  private:
    Instant antenna() const;
    Instant recall(double t) const;
    std::array<double, 6> expected(const Fix& fix) const;
    void keep_before(double t, const ins_gps_ins_t& predicted);
    void keep_after();
    void aid(double t, ins_status_t (*how)(ins_gps_ins_t*));

    ins_gps_ins_scale_t n_; ///< base alone without scale factors
    bool scaled_ = false;
    GpsInsOptions options_;
    bool started_ = false;
    bool aided_ = false;
    int64_t start_ns_;
    double t_ = 0.0;
    Vec3 w_ib_b_{};
    double nhc_due_ = 0.0, node_due_ = 0.0;
    Square Phi_{};
    std::deque<Instant> past_;
    std::vector<Node> nodes_;
};

} // namespace ins_post
#endif // INS_POST_GPS_INS_HPP_INCLUDED
