/// \file   paper.cpp
/// \brief  The orientation calibration of Hung, Fang, Wang and Lee: model (13), (14), estimator (21) to (25). Frame: b.
///
/// Of accelerometer i, with its nominal axis c_i and small turns of it t_ik (the partial derivatives of (14) by its two angles),
/// the difference of a pair of opposite attitudes is D = 2 SF T (c_i . f + a1 t_i1 . f + a2 t_i2 . f). Three pairs fix SF, SF a1
/// and SF a2; (21) and (23) are the first row of the inverse of that 3 x 3. (22) to (25) is least squares with that SF.
/// SPDX-License-Identifier: MIT
#include "ins_calib/calib.h"
#include "why.hpp"
#include <Eigen/Dense>

using namespace ins_calib;

namespace
{
using Matrix3 = Eigen::Matrix3d;
using Attitudes = Eigen::Matrix<double, 6, 3, Eigen::RowMajor>;

const double HALF = std::sqrt(0.5);
/// (15): rows are the nominal axes of #2, #3, #5 and of #1, #4, #6 (table 1).
const Matrix3 AXES[2] = {(Matrix3() << 1, 0, 1, 0, 1, 1, -1, 0, 1).finished() * HALF,
                         (Matrix3() << 1, 1, 0, 0, -1, 1, -1, 1, 0).finished() * HALF};
/// Tables 3 and 4: the first of each opposite pair.
const Matrix3 PAIRS[2] = {(Matrix3() << -1, 0, 1, 1, 0, 1, 0, 1, 1).finished() * HALF,
                          (Matrix3() << 0, -1, 1, 1, 1, 0, -1, 1, 0).finished() * HALF};

/// (14): the entry of each angle (xy, xz, yx, yz, zx, zy) and its sign. xz turns x towards y, and so on.
struct Entry
{
    int row, column;
    double sign;
};
constexpr Entry ENTRIES[6] = {{0, 2, -1}, {0, 1, 1}, {1, 2, 1}, {1, 0, -1}, {2, 1, -1}, {2, 0, 1}};

Attitudes attitudes(ins_calib_group_t group, double g)
{
    Attitudes f;
    for (int pair = 0; pair < 3; pair++)
    {
        f.row(2 * pair) = g * PAIRS[group].row(pair);
        f.row(2 * pair + 1) = -f.row(2 * pair);
    }
    return f;
}

/// (13): the printed product. Each row carries its own angle, so the factors are not rotations.
Matrix3 product(const double angle[6])
{
    const double xy = angle[0], xz = angle[1], yx = angle[2], yz = angle[3], zx = angle[4], zy = angle[5];
    Matrix3 by_z;
    Matrix3 by_y;
    Matrix3 by_x;
    by_z << std::cos(xz), std::sin(xz), 0, -std::sin(yz), std::cos(yz), 0, 0, 0, 1;
    by_y << std::cos(xy), 0, -std::sin(xy), 0, 1, 0, std::sin(zy), 0, std::cos(zy);
    by_x << 1, 0, 0, 0, std::cos(yx), std::sin(yx), 0, -std::sin(zx), std::cos(zx);
    return by_z * by_y * by_x;
}

Matrix3 first_order(const double angle[6])
{
    Matrix3 turn = Matrix3::Identity();
    for (int k = 0; k < 6; k++)
    {
        turn(ENTRIES[k].row, ENTRIES[k].column) = ENTRIES[k].sign * angle[k];
    }
    return turn;
}
} // namespace

void ins_calib_paper_attitudes(ins_calib_group_t group, double g, double f_b[18])
{
    Eigen::Map<Attitudes>{f_b} = attitudes(group, g);
}

void ins_calib_paper_axes(ins_calib_group_t group, const double angle[6], int exact, double axes[9])
{
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{axes} =
        (exact != 0 ? product(angle) : first_order(angle)) * AXES[group];
}

int ins_calib_paper(ins_calib_group_t group, double g, double T, const double readings[INS_CALIB_PAPER_ROWS],
                    ins_calib_paper_t* out, char* text, size_t size)
{
    const Why why{text, size};
    const Eigen::Map<const Eigen::Matrix<double, 3, 6, Eigen::RowMajor>> P(readings);
    if (!(g > 0) || !(T > 0) || !std::isfinite(g) || !std::isfinite(T))
    {
        return why.say(INS_CALIB_E_INPUT, "g is " + number(g) + " m/s^2, T " + number(T) + " s: both must be above 0");
    }
    if (!P.allFinite())
    {
        return why.say(INS_CALIB_E_INPUT, "a reading is not a number");
    }
    const Attitudes f = attitudes(group, g);
    const Eigen::Matrix<double, 6, 3> seen = f * AXES[group].transpose(); // c_i . f, the axes' readings
    Eigen::Matrix<double, INS_CALIB_PAPER_ROWS, 9, Eigen::RowMajor> H;
    Eigen::Matrix<double, INS_CALIB_PAPER_ROWS, 1> z;
    H.setZero();
    for (int i = 0; i < 3; i++)
    {
        Eigen::Matrix<double, 6, 3> parts; // by SF, and by the two angles of this row
        parts.col(0) = seen.col(i);
        for (int side = 0; side < 2; side++)
        {
            const int k = 2 * i + side;
            parts.col(1 + side) = ENTRIES[k].sign * seen.col(ENTRIES[k].column);
            H.block<6, 1>(6 * i, 3 + k) = parts.col(1 + side);
        }
        Matrix3 pairs;
        Eigen::Vector3d differences;
        for (int pair = 0; pair < 3; pair++)
        {
            pairs.row(pair) = 2 * T * parts.row(2 * pair);
            differences(pair) = P(i, 2 * pair) - P(i, 2 * pair + 1);
        }
        const double sf = pairs.inverse().row(0) * differences;
        if (!(std::fabs(sf) > 0))
        {
            return why.say(INS_CALIB_E_RANK, "accelerometer " + std::to_string(i + 1) +
                                                 " of the group has scale factor 0: its readings do not change");
        }
        out->sf[i] = sf;
        H.block<6, 1>(6 * i, i).setOnes();
        z.segment<6>(6 * i) = P.row(i).transpose() / (sf * T) - seen.col(i);
    }
    const Eigen::Matrix<double, 9, 1> x = H.householderQr().solve(z);
    Eigen::Map<Eigen::Vector3d>{out->bias} = x.head<3>();
    Eigen::Map<Eigen::Matrix<double, 6, 1>>{out->angle} = x.tail<6>();
    Eigen::Map<decltype(H)>{out->H} = H;
    const Matrix3 axes = first_order(out->angle) * AXES[group];
    for (int i = 0; i < 3; i++)
    {
        out->map[i][0] = out->sf[i] * out->bias[i];
        Eigen::Map<Eigen::RowVector3d>{out->map[i] + 1} = out->sf[i] * axes.row(i);
        for (int k = 0; k < 6; k++)
        {
            out->residual[6 * i + k] = P(i, k) / T - out->sf[i] * (out->bias[i] + axes.row(i).dot(f.row(k)));
        }
    }
    return INS_CALIB_OK;
}
