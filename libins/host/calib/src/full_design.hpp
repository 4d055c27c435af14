/// \file   full_design.hpp
/// \brief  What poses can show of the accelerometers of ins_calib/full.h, before anything is read. Frame: b.
/// SPDX-License-Identifier: MIT
#ifndef INS_CALIB_FULL_DESIGN_HPP_INCLUDED
#define INS_CALIB_FULL_DESIGN_HPP_INCLUDED
#include "ins/accelfit.h"
#include "ins_calib/full.h"
#include <string>
#include <vector>

namespace ins_calib
{
/// Indices of the parameters that are estimated.
std::vector<int> estimated(unsigned fixed);
/// What the fixture does at the body's origin in a pose.
ins_accelfit_motion_t motion_of(const ins_calib_pose_t& pose, double g);
/// Empty when each accelerometer's poses have full rank at the nominal geometry; otherwise what is not fixed, and what would fix it.
/// \param[out] condition  [sensors].
std::string unfixed(const ins_calib_full_t& in, double* condition);
/// Combinations of all accelerometers' unknowns that vanish when the attitudes are free.
unsigned from_prior(const ins_calib_full_t& in);
} // namespace ins_calib
#endif // INS_CALIB_FULL_DESIGN_HPP_INCLUDED
