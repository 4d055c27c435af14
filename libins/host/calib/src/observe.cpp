/// \file   observe.cpp
/// \brief  Rank, condition and remedies by singular values.
/// SPDX-License-Identifier: MIT
#include "observe.hpp"
#include <algorithm>
#include <limits>

namespace ins_calib
{
namespace
{

constexpr double NAMED = 0.1;  ///< share of an unknown in a combination from which it is named
constexpr double SHOWN = 1e-3; ///< share of the unseen that a candidate's row must see
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

namespace
{
/// What a row says about combinations not seen so far: its scaled part along them, nothing where it is rounding.
Eigen::VectorXd shown(const Eigen::MatrixXd& left, const Observed& seen, const Eigen::VectorXd& row)
{
    const Eigen::VectorXd scaled = row.cwiseQuotient(seen.scale);
    const Eigen::VectorXd part = left.transpose() * scaled;
    const double length = scaled.norm();
    return part.norm() > SHOWN * length ? Eigen::VectorXd(part / length) : Eigen::VectorXd::Zero(part.size());
}
} // namespace

std::vector<std::string> remedies(const std::vector<Observed>& sensors, const std::vector<Candidate>& candidates)
{
    std::vector<std::string> chosen;
    std::vector<Eigen::MatrixXd> left;
    for (const Observed& seen : sensors)
    {
        left.push_back(seen.unseen);
    }
    const auto unseen = [](const Eigen::MatrixXd& m) { return m.cols() > 0; };
    while (std::any_of(left.begin(), left.end(), unseen))
    {
        const Candidate* best = nullptr;
        double most = 0;
        for (const Candidate& candidate : candidates)
        {
            double sum = 0;
            for (size_t j = 0; j < sensors.size(); j++)
            {
                sum += shown(left[j], sensors[j], candidate.rows[j]).norm();
            }
            if (sum > most * (1 + RANK_TOLERANCE)) // of equals the first
            {
                best = &candidate;
                most = sum;
            }
        }
        if (best == nullptr)
        {
            return {};
        }
        chosen.push_back(best->name);
        for (size_t j = 0; j < sensors.size(); j++)
        {
            const Eigen::VectorXd part = shown(left[j], sensors[j], best->rows[j]);
            if (part.norm() > 0) // what is left is orthogonal to what the new row sees
            {
                const Eigen::HouseholderQR<Eigen::MatrixXd> turn(part);
                const Eigen::MatrixXd basis = turn.householderQ();
                left[j] = (left[j] * basis).rightCols(left[j].cols() - 1).eval();
            }
        }
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
