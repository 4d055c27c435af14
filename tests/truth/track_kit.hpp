// Tracks of every kind for the tests, and quadrature that is independent of libins_truth and the core.
// SPDX-License-Identifier: MIT
#pragma once
#include "ins_truth/elementary.h"
#include "ins_truth/track.h"
#include "near.hpp"
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

using Motion = std::unique_ptr<ins_motion_t, decltype(&ins_motion_destroy)>;
using Track = std::unique_ptr<ins_track_t, decltype(&ins_track_destroy)>;
using Vec = std::array<double, 3>;

constexpr double deg = INS_TRUTH_PI / 180.0;
/// Chung Hua University, Hsinchu.
constexpr ins_track_site_t flat_site = {24.757 * deg, 120.951 * deg, 60.0, INS_TRACK_G_THESIS, false};
constexpr ins_track_site_t round_site = {24.757 * deg, 120.951 * deg, 60.0, INS_TRACK_G_NORMAL, true};
constexpr ins_track_speed_t town = {15.0, 5.0, 4.0, 30.0, 3.0};

struct Named
{
    std::string name;
    Track track;
    std::vector<double> breaks; ///< instants at which a derivative of the acceleration jumps
};

inline Motion swing()
{
    const ins_motion_sines_t sines = {{0.3, 1.0, 0.02, 0.3}, {0.1, 0.4, 0.03, -1.0}, {-0.2, 0.7, 0.05, 2.0}};
    return {ins_motion_create_euler(&sines, 0.0, nullptr, 0), ins_motion_destroy};
}

inline const std::vector<double> waypoint_t = {0, 7, 15, 21, 30, 38, 46, 55};
inline const std::vector<double> waypoint_north = {0, 60, 140, 190, 160, 90, 70, 150};
inline const std::vector<double> waypoint_east = {0, 5, 30, 100, 180, 220, 300, 340};
inline const std::vector<double> waypoint_up = {0, 1, 4, 5, 3, 8, 12, 9};

/// Every kind of track with the attitude given; nullptr: along the path.
inline std::vector<Named> every_track(const ins_track_site_t& site, const ins_motion_t* attitude)
{
    char why[200] = "";
    const std::vector<double> town_breaks = {5, 9, 39, 42};
    std::vector<Named> all;
    const auto add = [&](const char* name, ins_track_t* track, const std::vector<double>& breaks)
    {
        EXPECT_NE(track, nullptr) << name << ": " << why;
        all.push_back({name, {track, ins_track_destroy}, breaks});
    };
    add("still", ins_track_create_still(&site, attitude, why, sizeof why), {});
    add("line", ins_track_create_line(&site, 2.1, 0.08, &town, attitude, why, sizeof why), town_breaks);
    add("circle", ins_track_create_circle(&site, -1.0, -40.0, &town, attitude, why, sizeof why), town_breaks);
    add("eight", ins_track_create_eight(&site, 0.6, 200.0, 80.0, &town, attitude, why, sizeof why), town_breaks);
    add("waypoints",
        ins_track_create_waypoints(&site, waypoint_t.size(), waypoint_t.data(), waypoint_north.data(),
                                   waypoint_east.data(), waypoint_up.data(), attitude, why, sizeof why),
        waypoint_t);
    return all;
}

inline ins_track_state_t at(const Track& track, double t)
{
    ins_track_state_t state;
    ins_track_at(track.get(), t, &state);
    return state;
}

inline Vec cross(const Vec& a, const Vec& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// C(q) v by q v conj(q) written out as a matrix; sense -1: its transpose.
inline Vec turn(const double q[4], const double v[3], int sense = 1)
{
    const double w = sense * q[0];
    const double x = q[1];
    const double y = q[2];
    const double z = q[3];
    return {(w * w + x * x - y * y - z * z) * v[0] + 2 * (x * y - w * z) * v[1] + 2 * (x * z + w * y) * v[2],
            2 * (x * y + w * z) * v[0] + (w * w - x * x + y * y - z * z) * v[1] + 2 * (y * z - w * x) * v[2],
            2 * (x * z - w * y) * v[0] + 2 * (y * z + w * x) * v[1] + (w * w - x * x - y * y + z * z) * v[2]};
}

/// Integral from a to b by Gauss and Legendre, 5 nodes on panels of at most panel_s that end at the breaks.
inline Vec integral(const std::function<Vec(double)>& f, double a, double b, std::vector<double> breaks, double panel_s)
{
    constexpr double node[3] = {0.0, 0.53846931010568309, 0.90617984593866399};
    constexpr double weight[3] = {0.56888888888888889, 0.47862867049936647, 0.23692688505618909};
    breaks.push_back(b);
    Vec sum = {0, 0, 0};
    double from = a;
    for (double end : breaks)
    {
        if (end <= from || end > b)
        {
            continue;
        }
        const int panels = static_cast<int>((end - from) / panel_s) + 1;
        const double half = 0.5 * (end - from) / panels;
        for (int k = 0; k < panels; k++)
        {
            const double middle = from + (2 * k + 1) * half;
            for (int j = -2; j <= 2; j++)
            {
                const Vec v = f(middle + (j < 0 ? -1 : 1) * half * node[j < 0 ? -j : j]);
                for (std::size_t i = 0; i < 3; i++)
                {
                    sum[i] += half * weight[j < 0 ? -j : j] * v[i];
                }
            }
        }
        from = end;
    }
    return sum;
}
