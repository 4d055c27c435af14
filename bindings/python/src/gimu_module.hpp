/// \file   gimu_module.hpp
/// \brief  Trajectories, GPS receivers and the GIMU for Python. SPDX-License-Identifier: MIT
#pragma once
#include "net.hpp"
#include <nanobind/nanobind.h>

namespace libins
{

/// Adds Site, Track, Gps and Gimu. After Motion.
void bind_truth(nanobind::module_& module);
/// Adds the GIMU as a station.
void bind_gimu(nanobind::class_<Net>& net);

} // namespace libins
