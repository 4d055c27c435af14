/// \file   sixacc_module.hpp
/// \brief  Six accelerometers on the acquisition board, for Python. SPDX-License-Identifier: MIT
#pragma once
#include "run.hpp"
#include <nanobind/nanobind.h>

namespace libins
{

/// Adds Accels, and to RunConfig what makes a board of six. After Track.
void bind_sixacc(nanobind::module_& module, nanobind::class_<RunConfig>& config);

} // namespace libins
