/// \file   states.hpp
/// \brief  Navigation states as Python takes them. SPDX-License-Identifier: MIT
#pragma once
#include "navigator.hpp"
#include <nanobind/nanobind.h>

namespace libins
{

/// One row each (STATE_COLUMNS), and each as the octets of an ins_nav_state_t, for a publisher.
nanobind::tuple states_table(const std::vector<Scored>& states);
/// What the link counted, into d.
void put_counts(nanobind::dict& d, const ins_nav_counts_t& counts);

} // namespace libins
