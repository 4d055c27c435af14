/// \file   truth_body.hpp
/// \brief  Bodies integrated from body rate and specific force, for Python. SPDX-License-Identifier: MIT
#pragma once
#include <nanobind/nanobind.h>

namespace libins
{

/// Adds Drive, track_body and happenings. After Track.
void bind_bodies(nanobind::module_& m);

} // namespace libins
