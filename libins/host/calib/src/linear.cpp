/// \file   linear.cpp
/// \brief  Linear map of accelerometers from readings in known attitudes: least squares on [1, f]. Frame: b.
/// SPDX-License-Identifier: MIT
#include "ins_calib/calib.h"
#include "observe.hpp"
#include "why.hpp"

using namespace ins_calib;

namespace
{
using Rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

/// Why [1, f] has not rank 4, and which attitudes would give it: of the six faces.
std::string unfixed(const Observed& seen, double g)
{
    static const char* const FACES[] = {"+x up", "-x up", "+y up", "-y up", "+z up", "-z up"};
    std::vector<Candidate> candidates;
    for (int face = 0; face < 6; face++)
    {
        Eigen::VectorXd row = Eigen::VectorXd::Unit(4, 0);
        row(1 + face / 2) = face % 2 == 0 ? g : -g;
        candidates.push_back({FACES[face], {row}});
    }
    return "the attitudes have rank " + std::to_string(seen.rank) + " of 4: they do not fix " +
           unseen_names(seen, {"bias", "axis x", "axis y", "axis z"}) + "; add the attitudes " +
           listed(remedies({seen}, candidates));
}
} // namespace

int ins_calib_linear(size_t sensors, size_t poses, const double* f_b, const double* readings, ins_calib_map_t* maps,
                     double* residuals, char* text, size_t size)
{
    const Why why{text, size};
    const auto n = static_cast<Eigen::Index>(poses);
    const Rows f(f_b, n, 3);
    const Rows P(readings, n, static_cast<Eigen::Index>(sensors));
    if (sensors == 0 || poses == 0 || !f.allFinite() || !P.allFinite())
    {
        return why.say(INS_CALIB_E_INPUT, sensors == 0 || poses == 0 ? "no readings: give at least four attitudes"
                                                                     : "a specific force or reading is not a number");
    }
    Eigen::MatrixXd A(n, 4);
    A << Eigen::VectorXd::Ones(n), f;
    const Observed seen = observe(A);
    if (seen.rank < 4)
    {
        return why.say(INS_CALIB_E_RANK, unfixed(seen, f.rowwise().norm().maxCoeff()));
    }
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);
    const Eigen::MatrixXd x = qr.solve(P);
    const Eigen::MatrixXd e = P - A * x;
    const Eigen::MatrixXd inverse =
        qr.matrixQR().topRows(4).triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(4, 4));
    const Eigen::VectorXd spread = inverse.rowwise().norm();
    for (Eigen::Index j = 0; j < P.cols(); j++)
    {
        ins_calib_map_t& map = maps[j];
        const double sum = e.col(j).squaredNorm();
        const double sigma = n > 4 ? std::sqrt(sum / static_cast<double>(n - 4)) : 0;
        for (Eigen::Index i = 0; i < 4; i++)
        {
            map.map[i] = x(i, j);
            map.deviation[i] = sigma * spread(i);
        }
        map.rms = std::sqrt(sum / static_cast<double>(n));
    }
    if (residuals != nullptr)
    {
        Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(residuals, n, P.cols()) = e;
    }
    return INS_CALIB_OK;
}
