/// \file   board_module.hpp
/// \brief  What Python reads and pokes on the board of a run. SPDX-License-Identifier: MIT
#pragma once
#include "run.hpp"
#include "truth_bind.hpp"
#include <nanobind/nanobind.h>
#include <string>

namespace libins
{

const char* part_name(mcs51_part_t part);
/// Throws std::invalid_argument.
mcs51_part_t part_of(const std::string& name);
void bind_board(nanobind::class_<Run>& run);
void bind_knobs(nanobind::module_& module, nanobind::class_<Run>& run);
void bind_faults(nanobind::module_& module, nanobind::class_<Run>& run);

} // namespace libins
