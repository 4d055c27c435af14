// Motions integrated by CVODE: against closed forms and known tracks, events, what drives them, refusals.
// SPDX-License-Identifier: MIT
#include "ins_truth/body.h"
#include "ins_truth/drive.h"
#include "ins_truth/exact.h"
#include "track_kit.hpp"
#include <cstdio>
#include <cstring>

namespace
{
constexpr double end_s = 60.0;
constexpr double attitude_tol = 1e-10; // [rad], the issue's
constexpr double level[4] = {1.0, 0.0, 0.0, 0.0};

/// Rate of a motion; specific force of a body that rests in n.
bool by_motion(void* motion, double t, const ins_track_state_t* state, double w_ib_b[3], double f_b[3])
{
    const double up[3] = {0.0, 0.0, -INS_TRACK_G};
    ins_motion_rate(static_cast<const ins_motion_t*>(motion), t, w_ib_b);
    const Vec f = turn(state->q_nb, up, -1);
    std::memcpy(f_b, f.data(), sizeof f);
    return true;
}

double angle_between(const double p[4], const double q[4])
{
    const double x = p[0] * q[1] - p[1] * q[0] - p[2] * q[3] + p[3] * q[2];
    const double y = p[0] * q[2] + p[1] * q[3] - p[2] * q[0] - p[3] * q[1];
    const double z = p[0] * q[3] - p[1] * q[2] + p[2] * q[1] - p[3] * q[0];
    return 2.0 * std::sqrt(x * x + y * y + z * z);
}

ins_body_config_t at_rest(double tolerance)
{
    ins_body_config_t c = {};
    c.site = flat_site;
    std::memcpy(c.q_nb, level, sizeof level);
    c.end_s = end_s;
    c.tolerance = tolerance;
    return c;
}

Track integrated(const ins_body_config_t& c, const ins_body_input_t& input,
                 const std::vector<ins_body_event_t>& events = {})
{
    char why[200] = "";
    ins_track_t* const track = ins_track_create_body(&c, &input, events.data(), events.size(), why, sizeof why);
    EXPECT_NE(track, nullptr) << why;
    return {track, ins_track_destroy};
}

struct Worst
{
    double attitude = 0.0, velocity = 0.0, position = 0.0;
};

/// What an existing track feels. \param[in] named  a Named
bool by_track(void* named, double t, const ins_track_state_t*, double w_ib_b[3], double f_b[3])
{
    const ins_track_state_t s = at(static_cast<const Named*>(named)->track, t);
    std::memcpy(w_ib_b, s.w_ib_b, sizeof s.w_ib_b);
    std::memcpy(f_b, s.f_b, sizeof s.f_b);
    return true;
}

double track_break(void* named, double t)
{
    for (double b : static_cast<const Named*>(named)->breaks)
    {
        if (b > t)
        {
            return b;
        }
    }
    return infinity;
}

ins_body_config_t start_of(const ins_track_site_t& site, const Track& track, double tolerance)
{
    const ins_track_state_t s = at(track, 0.0);
    ins_body_config_t c = at_rest(tolerance);
    c.site = site;
    c.end_s = 55.0;
    std::memcpy(c.q_nb, s.q_nb, sizeof s.q_nb);
    std::memcpy(c.v_n, s.v_n, sizeof s.v_n);
    std::memcpy(c.p_n, s.p_n, sizeof s.p_n);
    return c;
}

/// Of a body turned by the motion, against the motion, at instants that are no steps.
Worst against(const Motion& motion, double tolerance)
{
    ins_body_config_t c = at_rest(tolerance);
    ins_motion_attitude(motion.get(), 0.0, c.q_nb);
    const Track track = integrated(c, {by_motion, nullptr, motion.get()});
    Worst worst;
    for (int k = 0; k <= 9973; k++)
    {
        const double t = end_s * k / 9973.0;
        const ins_track_state_t s = at(track, t);
        double q[4];
        ins_motion_attitude(motion.get(), t, q);
        worst.attitude = larger(worst.attitude, angle_between(s.q_nb, q));
        for (int i = 0; i < 3; i++)
        {
            worst.velocity = larger(worst.velocity, std::fabs(s.v_n[i]));
            worst.position = larger(worst.position, std::fabs(s.p_n[i]));
        }
    }
    return worst;
}

Motion cone(double half_angle, double frequency_hz)
{
    return {ins_motion_create_coning(half_angle, frequency_hz, 0.0, nullptr, 0), ins_motion_destroy};
}

Motion sinusoids(double frequency_hz, double amplitude)
{
    const ins_motion_sines_t sines = {{0.2, amplitude, frequency_hz, 0.3},
                                      {-0.1, 0.7 * amplitude, 0.8 * frequency_hz, 1.0},
                                      {0.1, 0.9 * amplitude, 0.9 * frequency_hz, -2.0}};
    return {ins_motion_create_euler(&sines, 0.0, nullptr, 0), ins_motion_destroy};
}

void record(const char* name, double worst)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.1e", worst);
    testing::Test::RecordProperty(name, text);
}
} // namespace

TEST(body, attitude_is_the_closed_form_of_coning_and_sinusoids_to_1e_10)
{
    double coning = 0.0;
    for (double frequency_hz : {1.0, 4.17, 8.33})
    {
        for (double half_angle : {1.0 * deg, 5.0 * deg})
        {
            const Worst w = against(cone(half_angle, frequency_hz), INS_BODY_TIGHTEST);
            EXPECT_LE(w.attitude, attitude_tol) << "cone " << half_angle / deg << " deg, " << frequency_hz << " Hz";
            coning = larger(coning, w.attitude);
        }
    }
    record("coning_rad", coning);
    double worst = 0.0;
    for (double frequency_hz : {0.2, 1.0, 8.33})
    {
        const Worst w = against(sinusoids(frequency_hz, frequency_hz > 1.0 ? 5.0 * deg : 0.5), INS_BODY_TIGHTEST);
        EXPECT_LE(w.attitude, attitude_tol) << "sinusoids " << frequency_hz << " Hz";
        worst = larger(worst, w.attitude);
    }
    record("sinusoids_rad", worst);
}

TEST(body, an_error_falls_with_the_tolerance)
{
    const Motion motion = sinusoids(1.0, 0.5);
    double before = infinity;
    for (double tolerance : {1e-5, 1e-8, 1e-11})
    {
        const double error = against(motion, tolerance).attitude;
        EXPECT_LE(error, 2000.0 * tolerance) << tolerance;
        EXPECT_LT(error, 0.1 * before) << tolerance;
        before = error;
    }
}

TEST(body, what_a_track_feels_leads_along_that_track)
{
    const Motion motion = swing();
    Worst worst;
    for (const ins_track_site_t& site : {flat_site, round_site})
    {
        for (Named& n : every_track(site, motion.get()))
        {
            const Track got = integrated(start_of(site, n.track, INS_BODY_TIGHTEST), {by_track, track_break, &n});
            for (int k = 0; k <= 997; k++)
            {
                const double t = 55.0 * k / 997.0;
                const ins_track_state_t a = at(got, t);
                const ins_track_state_t b = at(n.track, t);
                worst.attitude = larger(worst.attitude, angle_between(a.q_nb, b.q_nb));
                worst.velocity = larger(worst.velocity, max_difference(a.v_n, b.v_n, 3));
                worst.position = larger(worst.position, max_difference(a.p_n, b.p_n, 3));
                EXPECT_LE(max_difference(a.a_n, b.a_n, 3), 1e-9) << n.name;
            }
        }
    }
    EXPECT_LE(worst.attitude, 1e-11);
    EXPECT_LE(worst.velocity, 1e-9);
    EXPECT_LE(worst.position, 1e-8);
    record("attitude_rad", worst.attitude);
    record("velocity_m_s", worst.velocity);
    record("position_m", worst.position);
}

TEST(body, its_increments_are_those_of_what_drives_it)
{
    const Motion motion = cone(5.0 * deg, 8.33);
    ins_body_config_t c = at_rest(1e-12);
    ins_motion_attitude(motion.get(), 0.0, c.q_nb);
    const Track track = integrated(c, {by_motion, nullptr, motion.get()});
    for (const std::array<double, 2>& span : {std::array<double, 2>{0.0, 0.01}, std::array<double, 2>{3.0, 58.7}})
    {
        double theta[3];
        double v[3];
        double want[3];
        ins_truth_increment(track.get(), span[0], span[1], theta, v);
        ins_motion_increment(motion.get(), span[0], span[1], want);
        EXPECT_LE(max_difference(theta, want, 3), 1e-12) << span[1];
    }
}

TEST(body, a_fall_ends_on_the_ground_at_its_instant)
{
    const auto weightless = [](void*, double, const ins_track_state_t*, double w_ib_b[3], double f_b[3])
    {
        for (int i = 0; i < 3; i++)
        {
            w_ib_b[i] = f_b[i] = 0.0;
        }
        return true;
    };
    const auto down = [](void* offset, double, const ins_track_state_t* s, double* value)
    {
        *value = s->p_n[2] - *static_cast<double*>(offset);
        return true;
    };
    double half_way = -50.0;
    double ground = 0.0;
    ins_body_config_t c = at_rest(1e-12);
    c.p_n[2] = -100.0;
    c.v_n[0] = 3.0;
    const Track track =
        integrated(c, {weightless, nullptr, nullptr},
                   {{down, &half_way, -1, false}, {down, &ground, 1, true}, {down, &half_way, 0, false}});
    const ins_body_happening_t* happened;
    ASSERT_EQ(ins_track_happenings(track.get(), &happened), 2u) << "falling alone never happens";
    EXPECT_EQ(happened[0].event, 2u);
    EXPECT_EQ(happened[0].direction, 1);
    EXPECT_NEAR(happened[0].t, std::sqrt(2 * 50 / INS_TRACK_G), 1e-10);
    EXPECT_EQ(happened[1].event, 1u);
    const double end = std::sqrt(2 * 100 / INS_TRACK_G);
    EXPECT_NEAR(happened[1].t, end, 1e-10);
    EXPECT_NEAR(at(track, happened[1].t).p_n[0], 3.0 * end, 1e-9);
    EXPECT_TRUE(std::isnan(at(track, end + 1e-6).p_n[0])) << "it ends there";
    EXPECT_TRUE(std::isnan(at(track, -1e-6).p_n[0])) << "nor is it known before";
}

TEST(body, manoeuvres_turn_by_their_amount_and_keep_the_velocity_ahead)
{
    const ins_manoeuvre_t plan[] = {
        {INS_MANOEUVRE_ACCELERATE, 4.0, 20.0}, {INS_MANOEUVRE_TURN, 6.0, 0.5 * INS_TRUTH_PI},
        {INS_MANOEUVRE_ROLL, 2.0, 0.4},        {INS_MANOEUVRE_HOLD, 1.0, 0.0},
        {INS_MANOEUVRE_ROLL, 2.0, -0.4},       {INS_MANOEUVRE_PITCH, 10.0, 2.0 * INS_TRUTH_PI},
        {INS_MANOEUVRE_YAW, 5.0, -0.25},       {INS_MANOEUVRE_ACCELERATE, 3.0, -12.0}};
    for (const ins_track_site_t& site : {flat_site, round_site})
    {
        char why[200] = "";
        ins_drive_t* const drive =
            ins_drive_create_manoeuvres(&site, plan, std::size(plan), 1.0, 10.0, why, sizeof why);
        ASSERT_NE(drive, nullptr) << why;
        ins_body_input_t input;
        ins_drive_input(drive, &input);
        ins_body_config_t c = at_rest(1e-13);
        c.site = site;
        c.v_n[0] = 10.0;
        const Track track = integrated(c, input);
        const auto heading = [&](double t, double want)
        {
            const double q[4] = {std::cos(0.5 * want), 0.0, 0.0, std::sin(0.5 * want)};
            EXPECT_LE(angle_between(at(track, t).q_nb, q), 1e-11) << t;
        };
        heading(5.0, 0.0);
        heading(11.0, 0.5 * INS_TRUTH_PI);
        heading(16.0, 0.5 * INS_TRUTH_PI);
        heading(26.0, 0.5 * INS_TRUTH_PI);
        heading(60.0, 0.5 * INS_TRUTH_PI - 0.25);
        for (double t = 0.0; t <= end_s; t += 0.37)
        {
            const ins_track_state_t s = at(track, t);
            const Vec v_b = turn(s.q_nb, s.v_n, -1);
            const double speed = t <= 1 ? 10.0 : t >= 34 ? 18.0 : t >= 5 && t <= 31 ? 30.0 : v_b[0];
            const double want[3] = {speed, 0.0, 0.0};
            EXPECT_LE(max_difference(v_b.data(), want, 3), 1e-10) << t;
        }
        // In the loop: 30 m/s turning at w about y, upside down half way; the seat pushes with 30 w - g there.
        const ins_track_state_t top = at(track, 21.0);
        const double w = 2.0 * INS_TRUTH_PI * 1.875 / 10.0;
        EXPECT_NEAR(-top.f_b[2], 30.0 * w - INS_TRACK_G, site.rotating ? 0.05 : 1e-9);
        ins_drive_destroy(drive);
    }
}

TEST(body, rows_of_what_a_track_feels_lead_along_that_track)
{
    const Motion motion = swing();
    const std::vector<Named> tracks = every_track(round_site, motion.get());
    const Named& circle = tracks[2];
    double before = infinity;
    for (double step_s : {0.1, 0.05})
    {
        std::vector<double> t;
        std::vector<double> w;
        std::vector<double> f;
        for (double now = -1.0; now <= 56.0; now += step_s)
        {
            const ins_track_state_t s = at(circle.track, now);
            t.push_back(now);
            w.insert(w.end(), s.w_ib_b, s.w_ib_b + 3);
            f.insert(f.end(), s.f_b, s.f_b + 3);
        }
        char why[200] = "";
        ins_drive_t* const drive = ins_drive_create_table(t.size(), t.data(), w.data(), f.data(), why, sizeof why);
        ASSERT_NE(drive, nullptr) << why;
        ins_body_input_t input;
        ins_drive_input(drive, &input);
        const Track track = integrated(start_of(round_site, circle.track, 1e-12), input);
        const double error = max_difference(at(track, 55.0).p_n, at(circle.track, 55.0).p_n, 3);
        EXPECT_LE(error, 0.05);
        EXPECT_LE(error, 0.2 * before) << "an error of the spline";
        before = error;
        ins_drive_destroy(drive);
    }
}

TEST(body, a_refusal_says_what_and_why)
{
    const Motion motion = swing();
    const auto refusal = [&](const std::function<void(ins_body_config_t&)>& spoil, const ins_body_input_t& input)
    {
        char why[200] = "";
        ins_body_config_t c = at_rest(1e-9);
        spoil(c);
        EXPECT_EQ(ins_track_create_body(&c, &input, nullptr, 0, why, sizeof why), nullptr);
        return std::string(why);
    };
    const ins_body_input_t good = {by_motion, nullptr, motion.get()};
    EXPECT_EQ(refusal([](ins_body_config_t& c) { c.tolerance = 1e-15; }, good),
              "tolerance is 1e-15, give 1e-14 to 0.001");
    EXPECT_EQ(refusal([](ins_body_config_t& c) { c.end_s = 0.0; }, good),
              "end_s (after start_s) is 0, give 4.94065646e-324 to 1e+09");
    EXPECT_EQ(refusal([](ins_body_config_t& c) { c.q_nb[1] = 1.0; }, good),
              "the length of q_nb is 1.41421356, give 0.999999 to 1.000001");
    EXPECT_EQ(refusal([](ins_body_config_t& c) { c.site.latitude = 2.0; }, good),
              "site: latitude is 2, give -1.57079633 to 1.57079633");
    const double t[4] = {0, 1, 2, 3};
    const double zeros[12] = {0};
    ins_drive_t* const drive = ins_drive_create_table(4, t, zeros, zeros, nullptr, 0);
    ins_body_input_t input;
    ins_drive_input(drive, &input);
    EXPECT_NE(refusal([](ins_body_config_t&) {}, input).find("a drive or an event refused"), std::string::npos)
        << "the rows end at 3 s";
    ins_drive_destroy(drive);
    const auto ends_at_7 = [](void*, double when, const ins_track_state_t*, double w_ib_b[3], double f_b[3])
    {
        for (int i = 0; i < 3; i++)
        {
            w_ib_b[i] = f_b[i] = when > 7.0 ? not_a_number : 0.0;
        }
        return true;
    };
    const std::string said = refusal([](ins_body_config_t&) {}, {ends_at_7, nullptr, nullptr});
    EXPECT_NE(said.find("refused, or is not a finite number"), std::string::npos) << said;
    char why[200] = "";
    const ins_manoeuvre_t plan = {INS_MANOEUVRE_TURN, 0.0, 1.0};
    EXPECT_EQ(ins_drive_create_manoeuvres(&flat_site, &plan, 1, 0.0, 1.0, why, sizeof why), nullptr);
    EXPECT_NE(std::string(why).find("manoeuvre 1: kind 2, 0 s"), std::string::npos) << why;
    EXPECT_EQ(ins_drive_create_manoeuvres(&flat_site, &plan, 0, 0.0, 1.0, why, sizeof why), nullptr);
    const double backwards[4] = {0, 2, 1, 3};
    EXPECT_EQ(ins_drive_create_table(4, backwards, zeros, zeros, why, sizeof why), nullptr);
    EXPECT_NE(std::string(why).find("row 3"), std::string::npos) << why;
}
