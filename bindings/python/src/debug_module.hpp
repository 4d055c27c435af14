/// \file   debug_module.hpp
/// \brief  The debugger's view of a run for Python. SPDX-License-Identifier: MIT
#pragma once
#include "run.hpp"
#include <nanobind/nanobind.h>

namespace libins
{

void bind_debug(nanobind::module_& m, nanobind::class_<Run>& run);

} // namespace libins
