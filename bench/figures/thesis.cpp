/// \file   thesis.cpp
/// \brief  Sections 4.5 and 5.4 of the thesis on the emulated system: GIMU on a table and in a car, the firmware on the DSP, a PC.
///
/// What is measured is what arrives at the PC (tests/emu_f2812/thesis_system.hpp). Units: rad, m, s; degrees where a figure shows them.
/// The thesis's numbers are beside these in docs/experiments_thesis.md.
/// SPDX-License-Identifier: MIT
#include "thesis.hpp"
#include "figures.hpp"
#include "ins/thesis.h"
#include "thesis_system.hpp"
#include <random>

using figures::point;
using thesis::DEG;

namespace
{
constexpr double DRIVE_S = 120;
constexpr double LAT0 = 24.8 * DEG, LON0 = 121.0 * DEG;            ///< Hsinchu
constexpr double EAST_M = 6378137.0 * 0.9089, NORTH_M = 6346600.0; ///< of a radian there, to 1e-3
constexpr double FIX_M = 1.5;                                      ///< white error of a fix, each axis

struct Moment
{
    double rate[3];
    double f[3];
    double east, north;
};
using Motion = std::function<Moment(double t)>; ///< t: since the calibration's end, 0 before

Moment still(double)
{
    return {{0, 0, 0}, {0, 0, -9.8}, 0, 0};
}

/// What the GIMU feels, and its GPS: a fix of each whole second.
class World
{
  public:
    World(Motion motion, uint64_t seed) : motion_(std::move(motion)), random_(seed), seed_(seed) {}
    gimu_config_t gimu()
    {
        gimu_config_t c;
        gimu_thesis_config(&c);
        c.seed = seed_;
        c.motion_ctx = c.fix_ctx = this;
        c.motion = [](void* ctx, int64_t t_ps, double rate[3], double f[3])
        {
            const Moment m = static_cast<World*>(ctx)->at(static_cast<double>(t_ps) * 1e-12);
            std::copy(m.rate, m.rate + 3, rate);
            std::copy(m.f, m.f + 3, f);
        };
        c.fix = [](void* ctx, int64_t t_ps, gimu_fix_t* fix)
        {
            static_cast<World*>(ctx)->fix_of(t_ps - t_ps % EMU_PS_PER_S, fix);
            return true;
        };
        return c;
    }
    Moment at(double t) const { return motion_(std::max(t - thesis::CALIBRATED_S, 0.0)); }

  private:
    void fix_of(int64_t of_ps, gimu_fix_t* fix)
    {
        std::normal_distribution<double> white(0, FIX_M);
        const Moment m = at(static_cast<double>(of_ps) * 1e-12);
        *fix = {};
        fix->of_ps = of_ps;
        fix->longitude = LON0 + (m.east + white(random_)) / EAST_M;
        fix->latitude = LAT0 + (m.north + white(random_)) / NORTH_M;
        fix->sats = 8;
    }

    Motion motion_;
    std::mt19937_64 random_;
    uint64_t seed_;
};

const std::pair<const char*, const char*> NULLS[] = {
    {"n", "null 2047"}, {"i", "integer null"}, {"f", "fractional null"}};

/// 4.5.2: 60 s at rest.
void at_rest()
{
    for (const auto& [command, name] : NULLS)
    {
        World world(still, 1);
        thesis::System board(world.gimu(), std::string("lk") + command);
        double begin = -1;
        for (int s = 0; s <= 60; s++)
        {
            board.run(thesis::CALIBRATED_S + s,
                      [&](const ins_nav_solution_t& x)
                      {
                          if ((x.status & INS_NAV_BLOCK_ALIGNED) != 0 && begin < 0)
                          {
                              begin = x.t_s;
                          }
                      });
            double largest = 0;
            for (size_t i = 0; i < 3; i++)
            {
                largest = std::max(largest, std::fabs(board.angle[i]) / DEG);
                if (s == 60)
                {
                    point("table_thesis_rest", name, static_cast<double>(i), board.angle[i] / DEG);
                }
            }
            if (s > 0 && s % 2 == 0)
            {
                point("thesis_rest", name, s, largest);
            }
        }
    }
}

/// Angle of a turn of 90 degrees in 4 s, with neither jump nor corner in its rate, and the rate.
double turned(double t)
{
    const double x = std::clamp(t / 4, 0.0, 1.0);
    return 90 * DEG * x * x * x * (10 - 15 * x + 6 * x * x);
}
double turning(double t)
{
    const double x = std::clamp(t / 4, 0.0, 1.0);
    return 90 * DEG * 30 * x * x * (1 - x) * (1 - x) / 4;
}

/// 4.5.4: 0, +90, 0, -90, 0 about one axis, a second's rest after each; the four stops' (S1, S2, S3).
void turns()
{
    static const char axis_name[] = "PQR";
    for (int axis = 0; axis < 3; axis++)
    {
        const auto motion = [axis](double t)
        {
            static const double sign[] = {1, -1, -1, 1};
            Moment m = still(t);
            double angle = 0;
            for (int k = 0; k < 4; k++)
            {
                m.rate[axis] += sign[k] * turning(t - 5 * k);
                angle += sign[k] * turned(t - 5 * k);
            }
            if (axis == 0)
            {
                m.f[1] = -9.8 * std::sin(angle);
            }
            m.f[0] = axis == 1 ? 9.8 * std::sin(angle) : 0;
            m.f[2] = axis == 2 ? -9.8 : -9.8 * std::cos(angle);
            return m;
        };
        World world(motion, 2);
        thesis::System board(world.gimu(), "lk");
        for (int stop = 0; stop < 4; stop++)
        {
            board.run(thesis::CALIBRATED_S + 5 * (stop + 1));
            double R[9];
            ins_thesis_zxz(board.angle.data(), R);
            static const char* const name[] = {"+90", "back", "-90", "back again"};
            const std::string row = std::string(1, axis_name[axis]) + " " + name[stop];
            for (int i = 0; i < 3; i++)
            {
                point("table_thesis_turns", row, i, R[i]);
            }
            const double want = stop == 0 ? 90 : stop == 2 ? -90 : 0;
            point("table_thesis_turns", row, 3, board.angle[static_cast<size_t>(axis)] / DEG - want);
        }
    }
}

/// A car on a circle of 100 m: 20 s at rest, then up to 10 m/s in 20 s.
Moment drive(double t)
{
    const double r = 100, v = 10, begin = 20, ramp = 20;
    const double x = std::clamp((t - begin) / ramp, 0.0, 1.0);
    const double speed = v * x * x * (3 - 2 * x);
    const double along = x < 1 ? v * 6 * x * (1 - x) / ramp : 0;
    const double way = v * ramp * x * x * x * (1 - x / 2) + std::max(t - begin - ramp, 0.0) * v;
    const double heading = way / r;
    return {{0, 0, speed / r}, {along, speed * speed / r, -9.8}, r * (1 - std::cos(heading)), r * std::sin(heading)};
}

/// 5.4: dead reckoning, the filter, and the filter that levels the attitude.
void with_gps()
{
    const std::pair<const char*, Motion> runs[] = {{"rest", still}, {"circle", drive}};
    const std::pair<const char*, const char*> kinds[] = {
        {"lk", ", dead reckoning"}, {"l", ", filter"}, {"", ", filter that levels"}};
    for (const auto& [where, motion] : runs)
    {
        for (const auto& [commands, kind] : kinds)
        {
            const std::string curve = where + std::string(kind);
            World world(motion, 3);
            thesis::System board(world.gimu(), commands);
            double origin[2] = {0, 0};
            double sum = 0, largest = 0, off = 0;
            long count = 0;
            const auto seen = [&](const ins_nav_solution_t& x)
            {
                if ((x.status & INS_NAV_BLOCK_POSITION) == 0)
                {
                    return;
                }
                const Moment m = world.at(x.t_s);
                const double e = x.en_m[0] - m.east, n = x.en_m[1] - m.north;
                if (count++ == 0) // the error of the first fix is common to all
                {
                    origin[0] = e;
                    origin[1] = n;
                }
                off = std::hypot(e - origin[0], n - origin[1]);
                sum += off * off;
                largest = std::max(largest, off);
            };
            for (int s = 4; s <= DRIVE_S; s += 4)
            {
                board.run(thesis::CALIBRATED_S + s, seen);
                point("thesis_drive", curve, s, std::max(off, 0.1));
            }
            point("table_thesis_drive", curve, 0, std::sqrt(sum / static_cast<double>(count)));
            point("table_thesis_drive", curve, 1, largest);
        }
    }
}
} // namespace

int main()
{
    at_rest();
    turns();
    with_gps();
    figures::thesis_kalman();
    return testing::UnitTest::GetInstance()->Failed() ? 1 : 0;
}
