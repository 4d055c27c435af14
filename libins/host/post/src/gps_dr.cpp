/// \file   gps_dr.cpp
/// \brief  ins_post/gps_dr.hpp: events to ins/gps_dr.h and ins/gps_dr_paper.h. SPDX-License-Identifier: MIT
#include "ins_post/gps_dr.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace ins_post
{
namespace
{
constexpr double PAST_S = 1.5;     // more than a fix may be old
constexpr double FIX_TASK_S = 1.0; // the paper's
constexpr double LATE_S = 0.05;    // a task that has not run by then had no fix
constexpr unsigned SATS_UNKNOWN = 4;
constexpr double NOTHING = std::numeric_limits<double>::quiet_NaN();
} // namespace

GpsDr::GpsDr(const ins_gps_dr_config_t& config, const GpsDrOptions& options)
    : options_(options), ours_(), paper_(), plane_(), due_(std::numeric_limits<double>::infinity())
{
    ins_gps_dr_paper_config_t paper;
    ins_gps_dr_paper_config_default(&paper, options.kind == GpsDrKind::PAPER_PRINTED ? INS_GPS_DR_PAPER_PRINTED
                                                                                     : INS_GPS_DR_PAPER_CORRECTED);
    if (ins_gps_dr_init(&ours_, &config) != INS_OK || ins_gps_dr_paper_init(&paper_, &paper) != INS_OK ||
        !(options.uere > 0.0))
    {
        throw std::invalid_argument("GpsDr: a figure of the configuration is out of its range");
    }
}

bool GpsDr::is_ours() const
{
    return options_.kind == GpsDrKind::OURS;
}

bool GpsDr::started() const
{
    return (is_ours() ? ins_gps_dr_source(&ours_) : ins_gps_dr_paper_source(&paper_)) != INS_GPS_DR_NONE;
}

void GpsDr::increment(double, const Increment&) {}

GpsDr::Instant GpsDr::now() const
{
    Instant at{};
    ins_real x[6];
    ins_real P[36];
    at.t = t_;
    if (is_ours())
    {
        (void)ins_gps_dr_state(&ours_, x, P); // asked only when it has started
        at.heading = x[INS_UNICYCLE_HEADING];
        at.sigma_heading = std::sqrt(P[7 * INS_UNICYCLE_HEADING]);
        at.bias = x[INS_UNICYCLE_BIAS];
        at.sigma_bias = std::sqrt(P[7 * INS_UNICYCLE_BIAS]);
        at.v_n = {x[INS_UNICYCLE_SPEED] * std::cos(at.heading), x[INS_UNICYCLE_SPEED] * std::sin(at.heading), 0.0};
        at.variance = {P[7 * INS_UNICYCLE_NORTH], P[7 * INS_UNICYCLE_EAST], NOTHING};
    }
    else
    {
        (void)ins_gps_dr_paper_state(&paper_, x, P);
        at.heading = std::atan2(x[2], x[3]);
        at.sigma_heading = at.bias = at.sigma_bias = NOTHING;
        at.v_n = {x[3], x[2], 0.0};
        at.variance = {P[1], P[0], NOTHING};
    }
    at.ned = {x[1], x[0], 0.0};
    return at;
}

/// On the way from instant to instant; before the first one and after the last it goes on straight.
GpsDr::Instant GpsDr::recall(double t) const
{
    const auto later = std::find_if(past_.begin(), past_.end(), [&](const Instant& at) { return at.t >= t; });
    if (later == past_.begin() || later == past_.end())
    {
        Instant at = past_.empty() ? now() : later == past_.end() ? past_.back() : past_.front();
        for (size_t i = 0; i < 2; i++)
        {
            at.ned[i] += (t - at.t) * at.v_n[i];
        }
        return at;
    }
    const Instant& before = *(later - 1);
    Instant at = *later;
    const double share = (t - before.t) / (at.t - before.t);
    for (size_t i = 0; i < 2; i++)
    {
        at.ned[i] = before.ned[i] + share * (at.ned[i] - before.ned[i]);
        at.v_n[i] = before.v_n[i] + share * (at.v_n[i] - before.v_n[i]);
    }
    return at;
}

Vec3 GpsDr::on_plane(const Vec3& llh) const
{
    const ins_real flat[3] = {llh[0], llh[1], 0.0};
    ins_real xyz[3];
    Vec3 ned;
    (void)ins_geodesy_to_ecef(&ins_wgs84, flat, xyz); // a recording's places are on the Earth
    ins_local_from_ecef(&plane_, xyz, ned.data());
    return ned;
}

/// That of 1 s. \return whether the filter took it.
bool GpsDr::task(double t, const Fix& fix)
{
    ins_gps_dr_fix_t f{};
    const Vec3 ned = on_plane(fix.position);
    f.valid = 1;
    f.east = ned[1];
    f.north = ned[0];
    f.sigma = std::sqrt((fix.sigma_p[0] * fix.sigma_p[0] + fix.sigma_p[1] * fix.sigma_p[1]) / 2.0);
    f.age = t - fix.t;
    f.hdop = fix.hdop > 0.0 ? fix.hdop : f.sigma / options_.uere;
    f.sats = static_cast<uint_least8_t>(std::min(fix.sats > 0 ? fix.sats : SATS_UNKNOWN, 255U));
    f.has_course = fix.sigma_v[0] > 0.0;
    f.course = std::atan2(fix.v_n[1], fix.v_n[0]);
    f.speed = std::hypot(fix.v_n[0], fix.v_n[1]);
    aided_ = (is_ours() ? ins_gps_dr_fix(&ours_, &f) : ins_gps_dr_paper_fix(&paper_, &f)) == INS_OK;
    height_ = aided_ ? fix.position[2] : height_;
    due_ = t + FIX_TASK_S;
    counts_.fixes++;
    counts_.refused += aided_ ? 0 : 1;
    return aided_;
}

void GpsDr::wheels(double t, const Wheels& wheels)
{
    if (t > due_ + LATE_S)
    {
        const ins_gps_dr_fix_t none{};
        (void)(is_ours() ? ins_gps_dr_fix(&ours_, &none) : ins_gps_dr_paper_fix(&paper_, &none));
        aided_ = false;
        counts_.no_fixes++;
        due_ += FIX_TASK_S;
    }
    t_ = t;
    const double distance = wheels.speed * wheels.period;
    (void)(is_ours() ? ins_gps_dr_step(&ours_, wheels.period, wheels.yaw_rate, distance)
                     : ins_gps_dr_paper_step(&paper_, wheels.yaw_rate, distance));
    if (started())
    {
        past_.push_back(now());
        while (past_.front().t < t - PAST_S)
        {
            past_.pop_front();
        }
    }
}

Check GpsDr::fix(double t, const Fix& fix)
{
    Check check{};
    check.nis.fill(NOTHING);
    check.sigma.fill(NOTHING);
    check.dp_before = check.dp_after = check.dv_before = check.dv_after = {NOTHING, NOTHING, NOTHING};
    if (!fix.withheld && !placed_)
    {
        const ins_real origin[3] = {fix.position[0], fix.position[1], 0.0};
        placed_ = ins_local_init(&plane_, &ins_wgs84, origin) == INS_OK;
    }
    if (!started())
    {
        if (!fix.withheld)
        {
            t_ = t;
            (void)task(t, fix);
        }
        return check;
    }
    const Instant then = recall(fix.t);
    const Instant then_v = recall(fix.t_v);
    const Instant before = now();
    const Vec3 given = on_plane(fix.position);
    if (!fix.withheld)
    {
        check.refused = task(t, fix) ? 0U : 7U;
    }
    const Instant after = started() ? now() : before;
    for (size_t i = 0; i < 2; i++)
    {
        check.dp_before[i] = then.ned[i] - given[i];
        check.dp_after[i] = check.dp_before[i] + after.ned[i] - before.ned[i];
        if (fix.sigma_v[i] > 0.0)
        {
            check.dv_before[i] = then_v.v_n[i] - fix.v_n[i];
            check.dv_after[i] = check.dv_before[i] + after.v_n[i] - before.v_n[i];
        }
        check.sigma[i] = std::sqrt(before.variance[i] + fix.sigma_p[i] * fix.sigma_p[i]);
        if (!fix.withheld)
        {
            check.nis[i] = check.dp_before[i] * check.dp_before[i] / (check.sigma[i] * check.sigma[i]);
        }
    }
    return check;
}

State GpsDr::state() const
{
    const Instant at = now();
    const ins_real ned[3] = {at.ned[0], at.ned[1], 0.0};
    ins_real xyz[3];
    ins_real llh[3];
    State s{};
    ins_local_to_ecef(&plane_, ned, xyz);
    (void)ins_geodesy_from_ecef(&ins_wgs84, xyz, llh);
    s.t = t_;
    s.position = {llh[0], llh[1], height_};
    s.v_n = at.v_n;
    s.q_nb = {std::cos(at.heading / 2.0), 0.0, 0.0, std::sin(at.heading / 2.0)};
    s.bias_g = {NOTHING, NOTHING, at.bias};
    s.bias_a = s.sigma_bias_a = s.sigma_v = {NOTHING, NOTHING, NOTHING};
    s.sigma_phi = {NOTHING, NOTHING, at.sigma_heading};
    s.sigma_p = {std::sqrt(at.variance[0]), std::sqrt(at.variance[1]), NOTHING};
    s.sigma_bias_g = {NOTHING, NOTHING, at.sigma_bias};
    s.aided = aided_;
    return s;
}

} // namespace ins_post
