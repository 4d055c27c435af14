/// \file   six_navigator.hpp
/// \brief  The host of a board with six accelerometers inside a run: samples and GPS fixes to a state beside the truth. SI, rad.
/// SPDX-License-Identifier: MIT
#pragma once
#include "ins_nav/six.h"
#include "ins_truth/gps.h"
#include "ins_truth/track.h"
#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace libins
{

struct SixConfig
{
    ins_nav_six_config_t nav{};
    std::optional<ins_gps_config_t> gps; ///< nothing: no aiding
    std::array<double, 3> gps_sigma_m{}; ///< what the filter takes its fixes for; north, east, down
    uint64_t seed = 1;                   ///< of the errors at the start, drawn from the filter's deviations
};

class SixNavigator
{
  public:
    /// Of what step() adds to a row: v_n, place; errors (truth less estimate) of phi, v, p, w; their deviations; fixes, refused.
    static constexpr std::array<const char*, 38> columns = {"v_n_m_s",
                                                            "v_e_m_s",
                                                            "v_d_m_s",
                                                            "lat_rad",
                                                            "lon_rad",
                                                            "height_m",
                                                            "error_phi_n_rad",
                                                            "error_phi_e_rad",
                                                            "error_phi_d_rad",
                                                            "error_v_n_m_s",
                                                            "error_v_e_m_s",
                                                            "error_v_d_m_s",
                                                            "error_p_n_m",
                                                            "error_p_e_m",
                                                            "error_p_d_m",
                                                            "error_w_x_rad_s",
                                                            "error_w_y_rad_s",
                                                            "error_w_z_rad_s",
                                                            "sigma_phi_n_rad",
                                                            "sigma_phi_e_rad",
                                                            "sigma_phi_d_rad",
                                                            "sigma_v_n_m_s",
                                                            "sigma_v_e_m_s",
                                                            "sigma_v_d_m_s",
                                                            "sigma_p_n_m",
                                                            "sigma_p_e_m",
                                                            "sigma_p_d_m",
                                                            "sigma_w_x_rad_s",
                                                            "sigma_w_y_rad_s",
                                                            "sigma_w_z_rad_s",
                                                            "sigma_wd_x_rad_s2",
                                                            "sigma_wd_y_rad_s2",
                                                            "sigma_wd_z_rad_s2",
                                                            "sigma_f_x_m_s2",
                                                            "sigma_f_y_m_s2",
                                                            "sigma_f_z_m_s2",
                                                            "fixes",
                                                            "refused"};

    /// Throws std::invalid_argument with the reason.
    SixNavigator(const SixConfig& config, std::shared_ptr<ins_track_t> track);
    /// A sample of instant t; before the first one the state is the truth with errors drawn. \return false: it could not be used.
    bool step(const ins_nav_sample_t& sample, double t, bool first, ins_nav_state_t& state,
              std::array<double, 4>& true_q_nb, std::vector<double>& more);

    ins_nav_six_t solver{};
    int64_t last_fix = -1; ///< number

  private:
    void start(double t);
    void take_fix(double t);

    SixConfig config_;
    std::shared_ptr<ins_track_t> track_;
    ins_gps_t gps_{};
};

} // namespace libins
