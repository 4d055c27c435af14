/// \file   net_module.hpp
/// \brief  Nets for Python. SPDX-License-Identifier: MIT
#pragma once
#include "report.hpp"
#include <nanobind/nanobind.h>

namespace libins
{

/// Adds Net. After Run and Fault.
void bind_net(nanobind::module_& module);
/// As rows of a report, for Python.
nanobind::list reports_list(const std::vector<Report>& reports);

} // namespace libins
