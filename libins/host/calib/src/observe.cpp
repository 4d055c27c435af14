/// \file   observe.cpp
/// \brief  Rank, condition and remedies by singular values.
/// SPDX-License-Identifier: MIT
#include "observe.hpp"
#include <limits>

namespace ins_calib
{
namespace
{
constexpr double RANK_TOLERANCE = 1e-9; ///< of the largest singular value; exact geometry leaves some 1e-15
constexpr double NAMED = 0.1;           ///< share of an unknown in a combination from which it is named
constexpr double SHOWN = 1e-3;          ///< share of the unseen that a candidate's row must see
} // namespace

Observed observe(const Eigen::MatrixXd& rows)
{
    Observed seen;
    seen.scale = rows.colwise().norm();
    seen.scale = (seen.scale.array() > 0).select(seen.scale, 1.0);
    const Eigen::MatrixXd scaled = rows * seen.scale.cwiseInverse().asDiagonal();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeFullV);
    const Eigen::VectorXd& values = svd.singularValues();
    const double limit = values.size() > 0 ? RANK_TOLERANCE * values(0) : 0;
    while (seen.rank < values.size() && values(seen.rank) > limit)
    {
        seen.rank++;
    }
    const bool full = seen.rank == rows.cols();
    seen.condition = full ? values(0) / values(seen.rank - 1) : std::numeric_limits<double>::infinity();
    seen.unseen = svd.matrixV().rightCols(rows.cols() - seen.rank);
    return seen;
}

std::string unseen_names(const Observed& seen, const std::vector<std::string>& names)
{
    std::vector<std::string> found;
    for (Eigen::Index i = 0; i < seen.unseen.rows(); i++)
    {
        if (seen.unseen.row(i).norm() > NAMED)
        {
            found.push_back(names[static_cast<size_t>(i)]);
        }
    }
    return listed(found);
}

std::vector<std::string> remedies(const Observed& seen, const std::vector<Candidate>& candidates)
{
    std::vector<std::string> chosen;
    Eigen::MatrixXd left = seen.unseen;
    while (left.cols() > 0)
    {
        const Candidate* best = nullptr;
        Eigen::VectorXd best_part;
        double most = SHOWN;
        for (const Candidate& candidate : candidates)
        {
            const Eigen::VectorXd row = candidate.row.cwiseQuotient(seen.scale);
            const Eigen::VectorXd part = left.transpose() * row;
            const double share = row.norm() > 0 ? part.norm() / row.norm() : 0;
            if (share > 1.001 * most) // of equals the first
            {
                best = &candidate;
                best_part = part;
                most = share;
            }
        }
        if (best == nullptr)
        {
            return {};
        }
        chosen.push_back(best->name);
        // What is left is orthogonal to what the new row sees.
        const Eigen::HouseholderQR<Eigen::MatrixXd> turn(best_part);
        const Eigen::MatrixXd basis = turn.householderQ() * Eigen::MatrixXd::Identity(left.cols(), left.cols());
        left = (left * basis).rightCols(left.cols() - 1).eval();
    }
    return chosen;
}

std::string listed(const std::vector<std::string>& words)
{
    std::string text;
    for (size_t i = 0; i < words.size(); i++)
    {
        text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
    }
    return text;
}
} // namespace ins_calib
