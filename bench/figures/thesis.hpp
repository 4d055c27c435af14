/// \file   thesis.hpp
/// \brief  Parts of the program of the thesis's figures. SPDX-License-Identifier: MIT
#ifndef INS_BENCH_FIGURES_THESIS_HPP
#define INS_BENCH_FIGURES_THESIS_HPP

namespace figures
{
/// Section 5.3: the filter in simulation.
void thesis_kalman();
} // namespace figures

#endif // INS_BENCH_FIGURES_THESIS_HPP
