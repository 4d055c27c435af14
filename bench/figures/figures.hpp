/// \file   figures.hpp
/// \brief  Points of the figures in docs: each is one run of the core against a known answer. Units are in make.py's axis labels.
/// SPDX-License-Identifier: MIT
#ifndef INS_BENCH_FIGURES_HPP
#define INS_BENCH_FIGURES_HPP
#include <string>

namespace figures
{
/// One line of output.
void point(const std::string& figure, const std::string& curve, double x, double y);

void coning();
void attitude();
void navigation();
void filters();
} // namespace figures

#endif // INS_BENCH_FIGURES_HPP
