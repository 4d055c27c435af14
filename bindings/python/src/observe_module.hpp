/// \file   observe_module.hpp
/// \brief  The part of the module libins._run that looks at firmware. SPDX-License-Identifier: MIT
#pragma once
#include <nanobind/nanobind.h>

namespace libins
{

/// Adds Observer, coverage, samples and volts to a module that has Run.
void bind_observer(nanobind::module_& m);

} // namespace libins
