// Tracks: specific force, velocity, position, rate and attitude belong together; each shape is what its name says; refusals.
// SPDX-License-Identifier: MIT
#include "ins/earth.h"
#include "ins/geodesy.h"
#include "track_kit.hpp"
#include <cstring>

namespace
{
constexpr double end_s = 55.0;
constexpr double panel_s = 0.25;
constexpr double velocity_tol = 1e-9; // [m/s]
constexpr double position_tol = 1e-9; // [m]
constexpr double attitude_tol = 1e-9; // [rad]

/// Gravity at p_n by the core's geodesy and gravity, in the site's n.
Vec core_gravity(const ins_track_site_t& site, const double p_n[3])
{
    const double llh0[3] = {site.latitude, site.longitude, site.height};
    ins_local_t origin;
    ins_local_t here;
    double xyz[3];
    double llh[3];
    ins_local_init(&origin, &ins_wgs84, llh0);
    ins_local_to_ecef(&origin, p_n, xyz);
    ins_geodesy_from_ecef(&ins_wgs84, xyz, llh);
    ins_local_init(&here, &ins_wgs84, llh);
    const double g = ins_earth_gravity(std::sin(llh[0]), llh[2]);
    Vec out;
    for (std::size_t i = 0; i < 3; i++)
    {
        out[i] = g * (origin.C_ne[3 * i] * here.C_ne[6] + origin.C_ne[3 * i + 1] * here.C_ne[7] +
                      origin.C_ne[3 * i + 2] * here.C_ne[8]);
    }
    return out;
}

Vec earth_rate_n(const ins_track_site_t& site)
{
    Vec w = {0, 0, 0};
    if (site.rotating)
    {
        ins_earth_rate(std::sin(site.latitude), std::cos(site.latitude), w.data());
    }
    return w;
}

/// dv/dt as an inertial navigator on the Earth computes it from the specific force.
Vec navigated(const ins_track_site_t& site, const Track& track, double t)
{
    const ins_track_state_t s = at(track, t);
    const Vec f_n = turn(s.q_nb, s.f_b);
    const Vec coriolis = cross(earth_rate_n(site), {s.v_n[0], s.v_n[1], s.v_n[2]});
    const Vec g = site.gravity == INS_TRACK_G_THESIS ? Vec{0, 0, 9.8} : core_gravity(site, s.p_n);
    return {f_n[0] - 2 * coriolis[0] + g[0], f_n[1] - 2 * coriolis[1] + g[1], f_n[2] - 2 * coriolis[2] + g[2]};
}

/// dq/dt = q (0, w_nb_b) / 2.
void quat_slope(const ins_track_site_t& site, const Track& track, double t, const double q[4], double slope[4])
{
    const ins_track_state_t s = at(track, t);
    const Vec w_ie_b = turn(s.q_nb, earth_rate_n(site).data(), -1);
    const double w[3] = {s.w_ib_b[0] - w_ie_b[0], s.w_ib_b[1] - w_ie_b[1], s.w_ib_b[2] - w_ie_b[2]};
    slope[0] = 0.5 * (-q[1] * w[0] - q[2] * w[1] - q[3] * w[2]);
    slope[1] = 0.5 * (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]);
    slope[2] = 0.5 * (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]);
    slope[3] = 0.5 * (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]);
}

/// Runge and Kutta, 4th order.
void quat_step(const ins_track_site_t& site, const Track& track, double t, double h, double q[4])
{
    double k[4][4];
    double moved[4];
    constexpr double c[4] = {0.0, 0.5, 0.5, 1.0};
    for (int i = 0; i < 4; i++)
    {
        for (int j = 0; j < 4; j++)
        {
            moved[j] = q[j] + (i == 0 ? 0.0 : c[i] * h * k[i - 1][j]);
        }
        quat_slope(site, track, t + c[i] * h, moved, k[i]);
    }
    for (int j = 0; j < 4; j++)
    {
        q[j] += h / 6.0 * (k[0][j] + 2 * k[1][j] + 2 * k[2][j] + k[3][j]);
    }
}

void record(const char* name, double worst)
{
    testing::Test::RecordProperty(name, std::to_string(worst * 1e15) + "e-15");
}

struct Case
{
    const char* name;
    ins_track_site_t site;
    bool given; ///< attitude from a motion
};
constexpr Case cases[] = {{"flat, along the path", flat_site, false},
                          {"flat, attitude given", flat_site, true},
                          {"round, along the path", round_site, false},
                          {"round, attitude given", round_site, true}};
} // namespace

TEST(track, specific_force_integrates_to_the_velocity)
{
    const Motion motion = swing();
    double worst = 0.0;
    for (const Case& c : cases)
    {
        for (const Named& n : every_track(c.site, c.given ? motion.get() : nullptr))
        {
            const auto slope = [&](double t) { return navigated(c.site, n.track, t); };
            const Vec dv = integral(slope, 0.0, end_s, n.breaks, panel_s);
            const ins_track_state_t a = at(n.track, 0.0);
            const ins_track_state_t b = at(n.track, end_s);
            const double want[3] = {b.v_n[0] - a.v_n[0], b.v_n[1] - a.v_n[1], b.v_n[2] - a.v_n[2]};
            const double error = max_difference(dv.data(), want, 3);
            EXPECT_LE(error, velocity_tol) << n.name << ", " << c.name;
            worst = larger(worst, error);
        }
    }
    record("worst_m_s", worst);
}

TEST(track, velocity_integrates_to_the_position)
{
    double worst = 0.0;
    for (const Named& n : every_track(flat_site, nullptr))
    {
        for (double t : {3.0, 6.5, 24.0, end_s})
        {
            const auto slope = [&](double u)
            {
                const ins_track_state_t s = at(n.track, u);
                return Vec{s.v_n[0], s.v_n[1], s.v_n[2]};
            };
            const Vec dp = integral(slope, 0.0, t, n.breaks, panel_s);
            const ins_track_state_t a = at(n.track, 0.0);
            const ins_track_state_t b = at(n.track, t);
            const double want[3] = {b.p_n[0] - a.p_n[0], b.p_n[1] - a.p_n[1], b.p_n[2] - a.p_n[2]};
            const double error = max_difference(dp.data(), want, 3);
            EXPECT_LE(error, position_tol) << n.name << " to " << t;
            worst = larger(worst, error);
        }
    }
    record("worst_m", worst);
}

TEST(track, rate_integrates_to_the_attitude)
{
    const Motion motion = swing();
    constexpr int steps = 4000; // from one break to the next
    double worst = 0.0;
    for (const Case& c : cases)
    {
        for (const Named& n : every_track(c.site, c.given ? motion.get() : nullptr))
        {
            double q[4];
            double t = 0.0;
            std::memcpy(q, at(n.track, t).q_nb, sizeof q);
            std::vector<double> stops = n.breaks;
            stops.push_back(end_s);
            for (double stop : stops)
            {
                const double h = (stop - t) / steps;
                for (int k = 0; k < steps; k++)
                {
                    quat_step(c.site, n.track, t + k * h, h, q);
                }
                t = stop;
            }
            const ins_track_state_t b = at(n.track, end_s);
            const double dot = q[0] * b.q_nb[0] + q[1] * b.q_nb[1] + q[2] * b.q_nb[2] + q[3] * b.q_nb[3];
            for (double& x : q)
            {
                x = dot < 0.0 ? -x : x;
            }
            const double error = 2.0 * max_difference(q, b.q_nb, 4);
            EXPECT_LE(error, attitude_tol) << n.name << ", " << c.name;
            worst = larger(worst, error);
        }
    }
    record("worst_rad", worst);
}

TEST(track, nothing_jumps)
{
    constexpr double eps = 1e-9;
    for (const Named& n : every_track(round_site, nullptr))
    {
        for (double t : n.breaks)
        {
            const ins_track_state_t a = at(n.track, t - eps);
            const ins_track_state_t b = at(n.track, t + eps);
            EXPECT_LE(max_difference(a.f_b, b.f_b, 3), 1e-6) << n.name << " at " << t;
            EXPECT_LE(max_difference(a.w_ib_b, b.w_ib_b, 3), 1e-6) << n.name << " at " << t;
        }
    }
}

TEST(track, at_rest_the_sensors_see_gravity_and_the_earth_alone)
{
    const Track flat(ins_track_create_still(&flat_site, nullptr, nullptr, 0), ins_track_destroy);
    const double up[3] = {0.0, 0.0, -9.8};
    const double none[3] = {0.0, 0.0, 0.0};
    const ins_track_state_t a = at(flat, 17.0);
    EXPECT_EQ(max_difference(a.f_b, up, 3), 0.0);
    EXPECT_EQ(max_difference(a.w_ib_b, none, 3), 0.0);
    const Track round(ins_track_create_still(&round_site, nullptr, nullptr, 0), ins_track_destroy);
    const ins_track_state_t b = at(round, 17.0);
    const double g[3] = {0.0, 0.0, -ins_earth_gravity(std::sin(round_site.latitude), round_site.height)};
    EXPECT_LE(max_difference(b.f_b, g, 3), 1e-14);
    EXPECT_LE(max_difference(b.w_ib_b, earth_rate_n(round_site).data(), 3), 1e-19);
}

TEST(track, shapes_are_what_they_are_called)
{
    const ins_track_speed_t ever = {12.0, -100.0, 10.0, infinity, 1.0};
    const Track circle(ins_track_create_circle(&flat_site, 0.0, 50.0, &ever, nullptr, nullptr, 0), ins_track_destroy);
    const Track eight(ins_track_create_eight(&flat_site, 0.0, 200.0, 60.0, &ever, nullptr, nullptr, 0),
                      ins_track_destroy);
    const Track line(ins_track_create_line(&flat_site, 90.0 * deg, 0.1, &town, nullptr, nullptr, 0), ins_track_destroy);
    double north = 0.0;
    double east = 0.0;
    double fastest = 0.0;
    for (int k = 0; k < 4000; k++)
    {
        const ins_track_state_t c = at(circle, 0.01 * k);
        EXPECT_NEAR(std::hypot(c.p_n[0], c.p_n[1] - 50.0), 50.0, 1e-11);
        EXPECT_NEAR(c.w_ib_b[2], 12.0 / 50.0, 1e-14);
        EXPECT_NEAR(c.f_b[1], 12.0 * 12.0 / 50.0, 1e-13) << "centripetal, to the right";
        EXPECT_NEAR(c.f_b[0], 0.0, 1e-13);
        const ins_track_state_t e = at(eight, 0.01 * k);
        const double v = std::hypot(e.v_n[0], e.v_n[1]);
        const Vec ahead = turn(e.q_nb, e.v_n, -1);
        EXPECT_NEAR(ahead[0], v, 1e-12) << "the nose follows the path";
        north = std::max(north, std::fabs(e.p_n[0]));
        east = std::max(east, std::fabs(e.p_n[1]));
        fastest = std::max(fastest, v);
    }
    EXPECT_NEAR(north, 100.0, 1e-2);
    EXPECT_NEAR(east, 30.0, 1e-2);
    EXPECT_NEAR(fastest, 12.0, 1e-2);
    // 15 m/s: half of it while starting and braking.
    const double way = 15.0 * (0.5 * 4.0 + 30.0 + 0.5 * 3.0);
    const ins_track_state_t stopped = at(line, 1000.0);
    EXPECT_NEAR(stopped.p_n[1], way * std::cos(0.1), 1e-11);
    EXPECT_NEAR(stopped.p_n[2], -way * std::sin(0.1), 1e-11);
    EXPECT_EQ(stopped.v_n[1], 0.0);
    const ins_track_speed_t odd = {13.7, 5.1, 4.3, 30.9, 3.3};
    const Track parked(ins_track_create_line(&flat_site, 1.0, 0.0, &odd, nullptr, nullptr, 0), ins_track_destroy);
    EXPECT_EQ(max_difference(at(parked, 9e8).p_n, at(parked, 100.0).p_n, 3), 0.0) << "to the bit";
    EXPECT_EQ(at(line, 0.0).p_n[1], 0.0);
    const double q[4] = {std::cos(45 * deg) * std::cos(0.05), -std::sin(45 * deg) * std::sin(0.05),
                         std::cos(45 * deg) * std::sin(0.05), std::sin(45 * deg) * std::cos(0.05)};
    EXPECT_LE(max_difference(stopped.q_nb, q, 4), 1e-15) << "heading and climb are kept at a standstill";
}

TEST(track, waypoints_are_passed_at_their_times)
{
    const std::vector<Named> all = every_track(flat_site, nullptr);
    const Track& track = all.back().track;
    for (std::size_t k = 0; k < waypoint_t.size(); k++)
    {
        const ins_track_state_t s = at(track, waypoint_t[k]);
        const double want[3] = {waypoint_north[k], waypoint_east[k], -waypoint_up[k]};
        EXPECT_LE(max_difference(s.p_n, want, 3), 1e-12) << waypoint_t[k];
    }
    const ins_track_state_t last = at(track, 55.0);
    const ins_track_state_t later = at(track, 65.0);
    for (int i = 0; i < 3; i++)
    {
        EXPECT_NEAR(later.p_n[i], last.p_n[i] + 10.0 * last.v_n[i], 1e-11);
    }
}

TEST(track, geodetic_agrees_with_the_core)
{
    const Motion motion = swing();
    const double llh0[3] = {round_site.latitude, round_site.longitude, round_site.height};
    ins_local_t origin;
    ins_local_init(&origin, &ins_wgs84, llh0);
    double angle = 0.0;
    double height = 0.0;
    for (const Named& n : every_track(round_site, motion.get()))
    {
        for (double t : {0.0, 11.0, 33.0, 900.0}) // 900 s: waypoints have gone some 8 km
        {
            const ins_track_state_t s = at(n.track, t);
            ins_track_geodetic_t g;
            ins_track_geodetic(n.track.get(), t, &g);
            double xyz[3];
            double llh[3];
            ins_local_to_ecef(&origin, s.p_n, xyz);
            ins_geodesy_from_ecef(&ins_wgs84, xyz, llh);
            EXPECT_LE(max_difference(g.llh, llh, 2), 1e-15) << n.name << t;
            EXPECT_NEAR(g.llh[2], llh[2], 1e-8) << n.name << t;
            angle = larger(angle, max_difference(g.llh, llh, 2));
            height = larger(height, std::fabs(g.llh[2] - llh[2]));
            ins_local_t here;
            ins_local_init(&here, &ins_wgs84, llh);
            for (int i = 0; i < 3; i++)
            {
                Vec column; // the body's axis i in the frame there, by matrices
                const double unit[3] = {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
                const Vec axis_n = turn(s.q_nb, unit);
                double axis_e[3];
                double velocity_e[3];
                for (std::size_t j = 0; j < 3; j++)
                {
                    axis_e[j] = velocity_e[j] = 0.0;
                    for (std::size_t m = 0; m < 3; m++)
                    {
                        axis_e[j] += origin.C_ne[3 * m + j] * axis_n[m];
                        velocity_e[j] += origin.C_ne[3 * m + j] * s.v_n[m];
                    }
                }
                Vec velocity;
                for (std::size_t j = 0; j < 3; j++)
                {
                    column[j] = velocity[j] = 0.0;
                    for (std::size_t m = 0; m < 3; m++)
                    {
                        column[j] += here.C_ne[3 * j + m] * axis_e[m];
                        velocity[j] += here.C_ne[3 * j + m] * velocity_e[m];
                    }
                }
                EXPECT_LE(max_difference(turn(g.q_nb, unit).data(), column.data(), 3), 1e-14) << n.name << t;
                EXPECT_LE(max_difference(g.v_n, velocity.data(), 3), 1e-13) << n.name << t;
            }
        }
    }
    record("worst_latitude_rad", angle);
    record("worst_height_m", height);
}

TEST(track, motion_input_is_the_same_at_picoseconds)
{
    const std::vector<Named> all = every_track(round_site, nullptr);
    double rate[3];
    double force[3];
    ins_track_motion(all[3].track.get(), 12345678901234, rate, force);
    const ins_track_state_t s = at(all[3].track, 12.345678901234);
    EXPECT_EQ(max_difference(rate, s.w_ib_b, 3), 0.0);
    EXPECT_EQ(max_difference(force, s.f_b, 3), 0.0);
}

TEST(track, keeps_its_bits)
{
    std::uint64_t sum = 0;
    for (const Named& n : every_track(round_site, nullptr))
    {
        for (unsigned k = 0; k < 500; k++)
        {
            const ins_track_state_t s = at(n.track, 0.11999 * k);
            ins_track_geodetic_t g;
            ins_track_geodetic(n.track.get(), 0.11999 * k, &g);
            for (double v : {s.f_b[0], s.f_b[1], s.f_b[2], s.w_ib_b[2], g.llh[0], g.llh[2], g.q_nb[3]})
            {
                std::uint64_t b;
                std::memcpy(&b, &v, sizeof b);
                sum = sum * 3u + b;
            }
        }
    }
    // The same on every x86-64 machine, compiler and optimisation level; a change here changes every recorded run.
    EXPECT_EQ(sum, 660190368063339025u);
}

TEST(track, beyond_the_known_times_nothing_is_a_number)
{
    for (const Named& n : every_track(round_site, nullptr))
    {
        for (double t : {1.1e9, -1.1e9, not_a_number})
        {
            ins_track_geodetic_t g;
            ins_track_geodetic(n.track.get(), t, &g);
            const ins_track_state_t s = at(n.track, t);
            for (double v : {s.p_n[0], s.v_n[1], s.a_n[2], s.q_nb[3], s.w_ib_b[0], s.f_b[2], g.llh[0], g.v_n[1]})
            {
                EXPECT_TRUE(std::isnan(v)) << n.name;
            }
        }
    }
}

TEST(track, refuses_bad_parameters_by_name)
{
    char why[200];
    const auto refused = [&](ins_track_t* track, const std::string& place)
    {
        EXPECT_EQ(track, nullptr) << place;
        EXPECT_NE(std::string(why).find(place), std::string::npos) << "want: " << place << ", got: " << why;
        ins_track_destroy(track);
    };
    ins_track_site_t site = flat_site;
    site.latitude = 2.0;
    refused(ins_track_create_still(&site, nullptr, why, sizeof why), "site: latitude is 2");
    site = flat_site;
    std::memset(&site.gravity, 7, sizeof site.gravity);
    refused(ins_track_create_still(&site, nullptr, why, sizeof why), "site: gravity is 117901063");
    ins_track_speed_t speed = town;
    speed.accelerate_s = 0.0;
    refused(ins_track_create_line(&flat_site, 0, 0, &speed, nullptr, why, sizeof why), "speed: accelerate_s is 0");
    speed = town;
    speed.cruise_s = -1.0;
    refused(ins_track_create_line(&flat_site, 0, 0, &speed, nullptr, why, sizeof why), "cruise_s (or infinity) is -1");
    refused(ins_track_create_line(&flat_site, 0, 1.6, &town, nullptr, why, sizeof why), "climb is 1.6");
    refused(ins_track_create_circle(&flat_site, 0, 0.0, &town, nullptr, why, sizeof why), "|radius| is 0");
    refused(ins_track_create_eight(&flat_site, 0, 10.0, not_a_number, &town, nullptr, why, sizeof why), "width is nan");
    std::vector<double> north = waypoint_north;
    const auto waypoints = [&](std::size_t rows)
    {
        return ins_track_create_waypoints(&flat_site, rows, waypoint_t.data(), north.data(), waypoint_east.data(),
                                          waypoint_up.data(), nullptr, why, sizeof why);
    };
    refused(waypoints(3), "3 rows, give 4");
    north[4] = 2e6;
    refused(waypoints(8), "row 5: north is 2000000, give metres within +-1e+06");
    const double t[4] = {0, 10, 20, 30};
    const double there_and_back[4] = {0, 100, 100, 0};
    const double zero[4] = {0, 0, 0, 0};
    refused(ins_track_create_waypoints(&flat_site, 4, t, there_and_back, zero, zero, nullptr, why, sizeof why),
            "rows 2 and 3: the horizontal speed falls below 0.01 m/s");
    const double turns_late[4] = {0, 100, 110, 0}; // about 14 s, not half way between rows
    refused(ins_track_create_waypoints(&flat_site, 4, t, turns_late, zero, zero, nullptr, why, sizeof why),
            "rows 2 and 3: the horizontal speed falls below 0.01 m/s");
    const Motion motion = swing();
    const Track given(
        ins_track_create_waypoints(&flat_site, 4, t, there_and_back, zero, zero, motion.get(), why, sizeof why),
        ins_track_destroy);
    EXPECT_NE(given, nullptr) << "with an attitude it may stand and turn back: " << why;
}
