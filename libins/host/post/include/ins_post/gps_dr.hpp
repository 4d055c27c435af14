/// \file   ins_post/gps_dr.hpp
/// \brief  GPS and dead reckoning of a vehicle behind the replay's events: ins/gps_dr.h, or the paper's pair of ins/gps_dr_paper.h.
///
///     ins_post::GpsDr filter(config, {ins_post::GpsDrKind::OURS, 5.0});
///     ins_post::Replay(filter, events, 0.1).run(end);
///
/// The paper's two tasks: wheels each 100 ms, the newest fix each second; a second without one is told to the filter by the wheels
/// after it. Positions are of the plane that touches the Earth at the first fix used: 100 km away that is 4 m off. Level: of the
/// attitude only the heading is estimated, of the position no height; what is not estimated has the deviation NaN.
/// SPDX-License-Identifier: MIT
#ifndef INS_POST_GPS_DR_HPP_INCLUDED
#define INS_POST_GPS_DR_HPP_INCLUDED
#include "ins/geodesy.h"
#include "ins/gps_dr.h"
#include "ins/gps_dr_paper.h"
#include "ins_post/replay.hpp"
#include <cstdint>
#include <deque>

namespace ins_post
{

enum class GpsDrKind
{
    OURS,
    PAPER_PRINTED,
    PAPER_CORRECTED
};

struct GpsDrOptions
{
    GpsDrKind kind;
    double uere; ///< deviation of a coordinate per unit of HDOP, of fixes that do not say their HDOP [m]
};

struct GpsDrCounts
{
    uint64_t fixes;    ///< taken
    uint64_t no_fixes; ///< seconds without one
    uint64_t refused;  ///< fixes that the filter did not take
};

class GpsDr : public Filter
{
  public:
    /// Throws std::invalid_argument: what ins_gps_dr_init refuses, or an uere that is not positive.
    GpsDr(const ins_gps_dr_config_t& config, const GpsDrOptions& options);
    bool started() const override;
    /// Not used: nothing of a strapdown is in it.
    void increment(double t, const Increment& increment) override;
    void wheels(double t, const Wheels& wheels) override;
    /// Each that is not withheld is a task of 1 s.
    Check fix(double t, const Fix& fix) override;
    State state() const override;
    const GpsDrCounts& counts() const { return counts_; }

  private:
    /// On the plane.
    struct Instant
    {
        double t;
        Vec3 ned, v_n;
        Vec3 variance; ///< of ned
        double heading, sigma_heading;
        double bias, sigma_bias; ///< of the gyro; NaN: not estimated
    };
    bool is_ours() const;
    Instant now() const;
    Instant recall(double t) const;
    Vec3 on_plane(const Vec3& llh) const;
    bool task(double t, const Fix& fix);

    GpsDrOptions options_;
    ins_gps_dr_t ours_;
    ins_gps_dr_paper_t paper_;
    ins_local_t plane_;
    bool placed_ = false;
    bool aided_ = false;
    double t_ = 0.0;
    double height_ = 0.0; ///< of the newest fix used
    double due_;          ///< of the next task of 1 s
    std::deque<Instant> past_;
    GpsDrCounts counts_{};
};

} // namespace ins_post
#endif // INS_POST_GPS_DR_HPP_INCLUDED
