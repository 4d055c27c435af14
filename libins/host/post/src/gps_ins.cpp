/// \file   gps_ins.cpp
/// \brief  ins_post/gps_ins.hpp: events to ins/gps_ins.h. SPDX-License-Identifier: MIT
#include "ins_post/gps_ins.hpp"
#include "ins/quat.h"
#include "post_internal.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace ins_post
{
namespace
{
constexpr double NS_PER_S = 1e9;
constexpr double PAST_S = 0.5;      // of the antenna
constexpr double SCALE_TAU_S = 1e6; // of scale factors: all but constant
constexpr double NOTHING = std::numeric_limits<double>::quiet_NaN();

int64_t nanoseconds(double t)
{
    return std::llround(t * NS_PER_S);
}

ins_position_t place(const Vec3& llh)
{
    return {{llh[0], llh[1], llh[2]}, {0.0, 0.0, 0.0}};
}
} // namespace

GpsIns::GpsIns(const ins_gps_ins_config_t& config, const ins_gps_ins_start_t& start, const GpsInsOptions& options)
    : n_(), options_(options), start_ns_(start.t_ns)
{
    const ins_kf15_scale_sensors_t scales = {options.scale_g, options.scale_a, SCALE_TAU_S, SCALE_TAU_S};
    scaled_ = options.scale_g != 0.0 || options.scale_a != 0.0;
    if ((scaled_ ? ins_gps_ins_scale_init(&n_, &config, &scales, &start)
                 : ins_gps_ins_init(&n_.base, &config, &start)) != INS_OK)
    {
        throw std::invalid_argument("GpsIns: a figure of the configuration or of the start is out of its range");
    }
    if (scaled_ && options.node_period > 0.0)
    {
        throw std::invalid_argument("GpsIns: the smoother knows no scale factors; take nodes or them");
    }
    t_ = static_cast<double>(start.t_ns) / NS_PER_S;
    nhc_due_ = node_due_ = t_;
    Phi_ = identity();
}

void GpsIns::keep_before(double t, const ins_gps_ins_t& predicted)
{
    if (options_.node_period > 0.0 && (nodes_.empty() || nodes_.back().t < t))
    {
        nodes_.push_back({t, nominal(predicted), {}, square(predicted.kf), {}, Phi_});
        Phi_ = identity();
        node_due_ = t + options_.node_period;
    }
}

void GpsIns::keep_after()
{
    if (options_.node_period > 0.0)
    {
        nodes_.back().after = nominal(n_.base);
        nodes_.back().P_after = square(n_.base.kf);
    }
}

void GpsIns::aid(double t, ins_status_t (*how)(ins_gps_ins_t*))
{
    keep_before(t, n_.base);
    (void)how(&n_.base); // refusals are in n_.base.count
    keep_after();
}

void GpsIns::increment(double t, const Increment& increment)
{
    if (nanoseconds(t) <= start_ns_)
    {
        return;
    }
    started_ = true;
    const ins_increment_t in = {{increment.theta_b[0], increment.theta_b[1], increment.theta_b[2]},
                                {increment.v_b[0], increment.v_b[1], increment.v_b[2]}};
    const ins_gps_ins_scale_t before = n_;
    if (ins_gps_ins_step(&n_.base, nanoseconds(t), increment.period, &in) < 0)
    {
        return;
    }
    t_ = t;
    for (size_t i = 0; i < w_ib_b_.size(); i++)
    {
        w_ib_b_[i] = increment.theta_b[i] / increment.period - n_.base.gyro_bias[i];
    }
    past_.push_back(antenna());
    while (past_.front().t < t - PAST_S)
    {
        past_.pop_front();
    }
    if (options_.node_period > 0.0)
    {
        Phi_ = product(transition(n_.base.model), Phi_);
        if (n_.base.count.rests != before.base.count.rests)
        {
            ins_gps_ins_t predicted = before.base; // no scale factors where nodes are kept
            predicted.cfg.still.samples = predicted.still.cfg.samples = 0;
            (void)ins_gps_ins_step(&predicted, nanoseconds(t), increment.period, &in);
            keep_before(t, predicted);
            keep_after();
        }
    }
    if (options_.nhc_period > 0.0 && t >= nhc_due_)
    {
        nhc_due_ = t + options_.nhc_period;
        aid(t, ins_gps_ins_nhc);
    }
    if (options_.node_period > 0.0 && t >= node_due_)
    {
        keep_before(t, n_.base);
        keep_after();
    }
}

void GpsIns::wheels(double t, const Wheels& wheels)
{
    if (!started_)
    {
        return;
    }
    keep_before(t, n_.base);
    if (std::isfinite(wheels.speed))
    {
        (void)ins_gps_ins_odometer(&n_.base, wheels.speed, options_.wheels_sigma);
    }
    if (std::isfinite(wheels.yaw_rate))
    {
        (void)ins_gps_ins_yaw_rate(&n_.base, wheels.yaw_rate, options_.yaw_rate_sigma);
    }
    keep_after();
}

Instant GpsIns::antenna() const
{
    Instant now{};
    now.t = t_;
    ins_strapdown_point(&n_.base.nav, n_.base.cfg.antenna_b, w_ib_b_.data(), now.v_n.data(), &now.position);
    return now;
}

Instant GpsIns::recall(double t) const
{
    const auto later = std::find_if(past_.begin(), past_.end(), [&](const Instant& at) { return at.t >= t; });
    if (later == past_.begin() || later == past_.end())
    {
        return later == past_.end() ? past_.back() : past_.front();
    }
    const Instant& a = *(later - 1);
    const Instant& b = *later;
    const double share = (t - a.t) / (b.t - a.t);
    Instant at = a;
    Vec3 step;
    ins_position_difference(&a.position, &b.position, step.data());
    for (size_t i = 0; i < step.size(); i++)
    {
        step[i] *= share;
        at.v_n[i] += share * (b.v_n[i] - a.v_n[i]);
    }
    move(at.position, step);
    return at;
}

/// Of the innovations: H P H' + R with H = [-u x, 0, I] for the antenna's position at the lever arm u, in n, and [0, I, 0] for its
/// velocity. Of P all is in ins/kf15.h's order.
std::array<double, 6> GpsIns::expected(const Fix& fix) const
{
    const Square P = square(n_.base.kf);
    const auto at = [&](size_t i, size_t j) { return P[INS_KF15_N * i + j]; };
    ins_real u[3];
    ins_quat_rotate(nominal(n_.base).q_nb.data(), n_.base.cfg.antenna_b, u);
    std::array<double, 6> sigma;
    sigma.fill(NOTHING);
    for (size_t i = 0; i < 3; i++)
    {
        const size_t j = (i + 1) % 3;
        const size_t k = (i + 2) % 3; // the error i is p_i + u_k phi_j - u_j phi_k
        const size_t p = INS_KF15_P + i;
        const double variance = at(p, p) + u[k] * u[k] * at(j, j) + u[j] * u[j] * at(k, k) +
                                2.0 * (u[k] * at(p, j) - u[j] * at(p, k) - u[j] * u[k] * at(j, k));
        sigma[i] = fix.sigma_p[i] > 0.0 ? std::sqrt(variance + fix.sigma_p[i] * fix.sigma_p[i]) : NOTHING;
        const double of_velocity = at(INS_KF15_V + i, INS_KF15_V + i);
        sigma[3 + i] = fix.sigma_v[i] > 0.0 ? std::sqrt(of_velocity + fix.sigma_v[i] * fix.sigma_v[i]) : NOTHING;
    }
    return sigma;
}

Check GpsIns::fix(double t, const Fix& fix)
{
    Check check{};
    check.nis.fill(NOTHING);
    check.sigma.fill(NOTHING);
    if (!started_)
    {
        return check;
    }
    const Instant then = recall(fix.t);
    const Instant earlier = recall(fix.t_v);
    const Instant before = antenna();
    const ins_position_t given = place(fix.position);
    ins_position_difference(&given, &then.position, check.dp_before.data());
    Vec3 v_n;
    for (size_t i = 0; i < v_n.size(); i++)
    {
        v_n[i] = fix.v_n[i] + then.v_n[i] - earlier.v_n[i]; // brought to fix.t by the IMU
        check.dv_before[i] = then.v_n[i] - v_n[i];
    }
    check.sigma = expected(fix);
    aided_ = false;
    if (!fix.withheld)
    {
        ins_gnss_fix_t in{};
        in.t_ns = nanoseconds(fix.t);
        in.position = place(fix.position);
        std::copy(v_n.begin(), v_n.end(), in.v_n);
        std::copy(fix.sigma_p.begin(), fix.sigma_p.end(), in.sigma_p);
        std::copy(fix.sigma_v.begin(), fix.sigma_v.end(), in.sigma_v);
        const ins_gps_ins_count_t counted = n_.base.count;
        keep_before(t, n_.base);
        const ins_status_t status = ins_gps_ins_gnss(&n_.base, &in);
        keep_after();
        aided_ = status == INS_OK;
        const unsigned position = status == INS_E_RANGE || n_.base.count.fix_position != counted.fix_position ? 7U : 0U;
        const unsigned velocity = status == INS_E_RANGE || n_.base.count.fix_velocity != counted.fix_velocity ? 7U : 0U;
        check.refused = position | velocity << 3;
        for (size_t i = 0; i < check.nis.size() && status != INS_E_RANGE; i++)
        {
            const double sigma = i < 3 ? fix.sigma_p[i] : fix.sigma_v[i - 3];
            check.nis[i] = sigma > 0.0 ? n_.base.check.nis[i] : NOTHING;
        }
    }
    const Instant after = antenna();
    Vec3 moved;
    ins_position_difference(&before.position, &after.position, moved.data());
    for (size_t i = 0; i < moved.size(); i++)
    {
        check.dp_after[i] = check.dp_before[i] + moved[i];
        check.dv_after[i] = check.dv_before[i] + after.v_n[i] - before.v_n[i];
        if (!(fix.sigma_p[i] > 0.0))
        {
            check.dp_before[i] = check.dp_after[i] = NOTHING;
        }
        if (!(fix.sigma_v[i] > 0.0))
        {
            check.dv_before[i] = check.dv_after[i] = NOTHING;
        }
    }
    return check;
}

std::vector<Node> GpsIns::nodes() const
{
    std::vector<Node> kept = nodes_;
    if (!kept.empty() && kept.back().t < t_)
    {
        kept.push_back({t_, nominal(n_.base), nominal(n_.base), square(n_.base.kf), square(n_.base.kf), Phi_});
    }
    return kept;
}

std::optional<Scales> GpsIns::scales() const
{
    if (!scaled_)
    {
        return std::nullopt;
    }
    Scales out{};
    for (size_t i = 0; i < 3; i++)
    {
        out.gyro[i] = n_.gyro[i];
        out.accel[i] = n_.accel[i];
        out.sigma_gyro[i] = std::sqrt(n_.kf.B[(INS_KF15_N + i) * INS_KF15_SCALE_N + i]);
        out.sigma_accel[i] = std::sqrt(n_.kf.B[(INS_KF15_N + 3 + i) * INS_KF15_SCALE_N + 3 + i]);
    }
    return out;
}

State GpsIns::state() const
{
    State state = described(t_, nominal(n_.base), square(n_.base.kf));
    state.aided = aided_;
    return state;
}

} // namespace ins_post
