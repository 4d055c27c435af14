/// \file   six_navigator.cpp
/// \brief  See six_navigator.hpp. SPDX-License-Identifier: MIT
#include "six_navigator.hpp"
#include "emu/random.h"
#include "ins/earth.h"
#include "ins/quat.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace libins
{
namespace
{

constexpr uint64_t START_STREAM = 0x5158; ///< keeps the draws apart from those of the line with the same seed

/// Rotation vector from b to a, both q_nb: a = q(phi) b.
std::array<double, 3> rotation(const double a[4], const double b[4])
{
    double back[4];
    double dq[4];
    ins_quat_conj(b, back);
    ins_quat_mul(a, back, dq);
    const double sine = std::sqrt(dq[1] * dq[1] + dq[2] * dq[2] + dq[3] * dq[3]);
    const double angle = 2.0 * std::atan2(sine, std::fabs(dq[0])) * (dq[0] < 0.0 ? -1.0 : 1.0);
    const double scale = sine > 0.0 ? angle / sine : 0.0;
    return {scale * dq[1], scale * dq[2], scale * dq[3]};
}

} // namespace

SixNavigator::SixNavigator(const SixConfig& config, std::shared_ptr<ins_track_t> track)
    : config_(config), track_(std::move(track))
{
    std::array<char, 256> why{};
    if (config_.gps && !ins_gps_init(&gps_, &*config_.gps, track_.get(), why.data(), why.size()))
    {
        throw std::invalid_argument(std::string("gps: ") + why.data());
    }
    start(0.0);
}

/// The truth at t with an error drawn from what the filter is told.
void SixNavigator::start(double t)
{
    ins_nav_six_config_t cfg = config_.nav;
    uint64_t random = config_.seed ^ START_STREAM;
    const auto draw = [&](double sigma) { return sigma * emu_random_normal(&random); };
    ins_track_geodetic_t truth;
    ins_track_geodetic(track_.get(), t, &truth);
    double phi[3];
    double dq[4];
    double radii[2];
    double dp[3];
    for (int i = 0; i < 3; i++)
    {
        phi[i] = draw(cfg.filter.attitude[i]);
        cfg.v_n[i] = truth.v_n[i] + draw(cfg.filter.velocity);
        dp[i] = draw(cfg.filter.position);
    }
    ins_earth_radii(std::sin(truth.llh[0]), radii);
    cfg.lat_lon_height[0] = truth.llh[0] + dp[0] / (radii[0] + truth.llh[2]);
    cfg.lat_lon_height[1] = truth.llh[1] + dp[1] / ((radii[1] + truth.llh[2]) * std::cos(truth.llh[0]));
    cfg.lat_lon_height[2] = truth.llh[2] - dp[2];
    if (ins_quat_from_rotvec(phi, dq) != INS_OK)
    {
        throw std::invalid_argument("gyro_free: attitude_rad: below pi is needed");
    }
    ins_quat_mul(dq, truth.q_nb, cfg.link.q_nb);
    if (ins_nav_six_init(&solver, &cfg) != INS_OK)
    {
        throw std::invalid_argument(
            "gyro_free: the filter refuses its figures, or the six accelerometers do not see all of a motion");
    }
}

void SixNavigator::take_fix(double t)
{
    ins_gps_fix_t fix;
    const auto t_ps = static_cast<int64_t>(std::floor(t * 1e12 + 0.5));
    if (!config_.gps || !ins_gps_fix(&gps_, t_ps, &fix) || fix.number == last_fix)
    {
        return;
    }
    last_fix = fix.number;
    (void)ins_nav_six_fix(&solver, fix.llh, t - static_cast<double>(fix.of_ps) * 1e-12,
                          config_.gps_sigma_m.data()); // refused: counted
}

bool SixNavigator::step(const ins_nav_sample_t& sample, double t, bool first, ins_nav_state_t& state,
                        std::array<double, 4>& true_q_nb, std::vector<double>& more)
{
    ins_nav_six_state_t six;
    ins_track_state_t site;
    ins_track_geodetic_t truth;
    if (first)
    {
        start(t);
    }
    if (ins_nav_six_step(&solver, &sample, &six) < 0)
    {
        return false;
    }
    take_fix(t);
    ins_track_at(track_.get(), t, &site);
    ins_track_geodetic(track_.get(), t, &truth);
    std::copy_n(truth.q_nb, 4, true_q_nb.begin());
    state = six.nav;
    const ins_position_t at = {{truth.llh[0], truth.llh[1], truth.llh[2]}, {0.0, 0.0, 0.0}};
    const ins_position_t here = {{six.lat_lon_height[0], six.lat_lon_height[1], six.lat_lon_height[2]},
                                 {0.0, 0.0, 0.0}};
    std::array<double, 3> dp;
    ins_position_difference(&here, &at, dp.data());
    const std::array<double, 3> phi = rotation(truth.q_nb, state.q_nb);
    more.assign(six.v_n, six.v_n + 3);
    more.insert(more.end(), six.lat_lon_height, six.lat_lon_height + 3);
    more.insert(more.end(), phi.begin(), phi.end());
    for (int i = 0; i < 3; i++)
    {
        more.push_back(truth.v_n[i] - six.v_n[i]);
    }
    more.insert(more.end(), dp.begin(), dp.end());
    for (int i = 0; i < 3; i++)
    {
        more.push_back(site.w_ib_b[i] - state.w_ib_b[i]);
    }
    more.insert(more.end(), six.sigma, six.sigma + INS_GYRO_FREE_N);
    more.push_back(static_cast<double>(six.fixes));
    more.push_back(static_cast<double>(six.refused));
    return true;
}

} // namespace libins
