/// \file   gyro_free_map.cpp
/// \brief  How well six accelerometers and GPS positions hold the attitude: over arm, noise, sigma and rate of the fixes. SI, degrees.
///
///     figures_gyro_free          # every cell: RUNS drawn flights each
///     figures_gyro_free few      # one cell, as many flights: what a test repeats
///
/// A flight is 5 s of rest and an eight of 60 m by 40 m crossed at 8 m/s, to 60 s, sampled at 100 Hz. Of each from 20 s on: the largest
/// deviation of the worst axis, times 1.96, of which the median of the flights; and the errors of the worst axis, of which 95 %.
/// SPDX-License-Identifier: MIT
#include "figures.hpp"
#include "gyro_free_runs.h"
#include <algorithm>
#include <cstring>
#include <sstream>

namespace
{
using namespace gyro_free;

constexpr unsigned RUNS = 5;
constexpr double REST_S = 5, SETTLED_S = 20, END_S = 60, LOOK_S = 0.5;
constexpr double BIAS = 2e-4, STILL_M_S = 1e-3, STILL_RAD_S = 1e-3, SURE = 1.96, SHARE = 0.95;
constexpr double NOISES[] = {1e-3, 5.6e-3}; ///< the latter 0.58 codes of +-2 g over 4096

struct Receiver
{
    double sigma_m, rate_hz;
};
constexpr Receiver RECEIVERS[] = {{0.02, 5}, {0.1, 5}, {1, 5}, {1, 1}, {3, 5}, {3, 1}};

struct Cell
{
    double rho, noise;
    Receiver receiver;
};

double quantile(std::vector<double> values, double share)
{
    std::sort(values.begin(), values.end());
    return values[size_t(share * double(values.size() - 1) + 0.5)];
}

/// One flight. \return the largest deviation of an axis; errors of the worst axis are added.
double fly(const Track& track, const Cell& cell, unsigned seed, std::vector<double>& errors)
{
    const ins_gyro_free_config_t config = {cell.noise, BIAS, 0, {0.01, 0.01, 0.02}, 0.05, 0.5, 0.002, 0};
    Flight flight(track, config, cell.rho, seed);
    Error x{};
    std::array<double, 6> bias{};
    for (size_t i = 0; i < 3; i++)
    {
        x[i] = config.attitude[i] * flight.draw();
    }
    for (double& b : bias)
    {
        b = BIAS * flight.draw();
    }
    flight.begin(x, bias);
    const int each = int(1.0 / (cell.receiver.rate_hz * PERIOD_S) + 0.5);
    const int look = int(LOOK_S / PERIOD_S + 0.5);
    double largest = 0;
    for (int k = 0; k <= int(END_S / PERIOD_S); k++)
    {
        flight.step(cell.noise);
        if (flight.t_s < REST_S)
        {
            EXPECT_EQ(ins_gyro_free_still(&flight.filter, STILL_M_S, STILL_RAD_S), INS_OK);
        }
        if (k > 0 && k % each == 0)
        {
            EXPECT_EQ(flight.fix(cell.receiver.sigma_m), INS_OK);
        }
        if (flight.t_s >= SETTLED_S && k % look == 0)
        {
            ins_real sigma[INS_GYRO_FREE_N];
            ins_gyro_free_sigma(&flight.filter, sigma);
            const Error error = flight.error();
            largest = std::max({largest, sigma[0], sigma[1], sigma[2]});
            errors.push_back(std::max({std::fabs(error[0]), std::fabs(error[1]), std::fabs(error[2])}) / DEG);
        }
    }
    return largest / DEG;
}

/// \param[in] column  of the table.
void tell(const Track& track, const Cell& cell, size_t column)
{
    std::ostringstream row, curve;
    std::vector<double> said, errors;
    for (unsigned run = 0; run < RUNS; run++)
    {
        said.push_back(SURE * fly(track, cell, run + 1, errors));
    }
    const double median = quantile(said, 0.5);
    row << cell.rho << " m, " << cell.noise;
    figures::point("table_gyro_free_said", row.str(), double(column), median);
    figures::point("table_gyro_free_found", row.str(), double(column), quantile(errors, SHARE));
    curve << cell.noise << " m/s², " << cell.receiver.sigma_m << " m at " << cell.receiver.rate_hz << " Hz";
    figures::point("gyro_free_map", curve.str(), cell.rho, median);
}
} // namespace

int main(int argc, char** argv)
{
    const Track track = eight(REST_S);
    if (argc > 1 && std::strcmp(argv[1], "few") == 0)
    {
        tell(track, {1, NOISES[0], RECEIVERS[1]}, 1);
        return testing::UnitTest::GetInstance()->Failed() ? 1 : 0;
    }
    for (const double rho : {0.1, 0.3, 1.0})
    {
        for (const double noise : NOISES)
        {
            for (size_t i = 0; i < sizeof RECEIVERS / sizeof RECEIVERS[0]; i++)
            {
                tell(track, {rho, noise, RECEIVERS[i]}, i);
            }
        }
    }
    return testing::UnitTest::GetInstance()->Failed() ? 1 : 0;
}
