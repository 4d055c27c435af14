/// \file   observe.hpp
/// \brief  What a set of rows does not show: rank, condition, names of the unseen, and rows that would show them.
/// SPDX-License-Identifier: MIT
#ifndef INS_CALIB_OBSERVE_HPP_INCLUDED
#define INS_CALIB_OBSERVE_HPP_INCLUDED
#include <Eigen/Dense>
#include <string>
#include <vector>

namespace ins_calib
{
constexpr double RANK_TOLERANCE = 1e-9; ///< of the largest singular value; exact geometry leaves some 1e-15

/// A pose that could be added: its name, and the row that it would bring to each sensor.
struct Candidate
{
    std::string name;
    std::vector<Eigen::VectorXd> rows;
};

struct Observed
{
    Eigen::Index rank = 0;
    double condition = 0; ///< largest over smallest singular value, columns scaled to unit length; inf below full rank
    Eigen::MatrixXd unseen; ///< columns: orthonormal combinations of the unknowns (scaled) that no row sees
    Eigen::VectorXd scale;  ///< length of each column, 1 where it is zero
};

/// By the singular values of the matrix with its columns scaled to unit length.
Observed observe(const Eigen::MatrixXd& rows);
/// Which unknowns are in what is unseen, "r_x", or "r_x with r_y" for a combination.
std::string unseen_names(const Observed& seen, const std::vector<std::string>& names);
/// Candidates after which no sensor has anything unseen, one by one, each the one that shows most; empty when all do not suffice.
std::vector<std::string> remedies(const std::vector<Observed>& sensors, const std::vector<Candidate>& candidates);
/// "a, b and c".
std::string listed(const std::vector<std::string>& words);
} // namespace ins_calib
#endif // INS_CALIB_OBSERVE_HPP_INCLUDED
