/// \file   accels.hpp
/// \brief  Accelerometers from the arrays that Sixacc and GyroFree take. SPDX-License-Identifier: MIT
#ifndef LIBINS_PY_ACCELS_HPP
#define LIBINS_PY_ACCELS_HPP
#include "arrays.hpp"
#include <vector>

namespace libins
{
/// bias: (n,); axis, r: (n, 3).
std::vector<ins_accel_t> accels_of(const Call& call, const Given& bias, const Given& axis, const Given& r);
} // namespace libins

#endif // LIBINS_PY_ACCELS_HPP
