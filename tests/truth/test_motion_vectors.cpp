// Motions against the reference vectors (tests/data/vectors, or INS_VECTOR_DIR): attitude_motion.json and coning.json.
// SPDX-License-Identifier: MIT
#include "ins_truth/elementary.h"
#include "ins_truth/motion.h"
#include "near.hpp"
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
using Motion = std::unique_ptr<ins_motion_t, decltype(&ins_motion_destroy)>;
using Row = std::vector<double>;
constexpr double tolerance = 1e-13; // absolute: rad, rad/s, or of a unit quaternion

nlohmann::json load(const char* name)
{
    const char* const directory = std::getenv("INS_VECTOR_DIR");
    const std::string path =
        (directory != nullptr ? directory : std::string(INS_TEST_DATA) + "/vectors") + ("/" + std::string(name));
    std::ifstream file(path);
    if (!file)
    {
        throw std::runtime_error("cannot open " + path);
    }
    return nlohmann::json::parse(file);
}

void expect_rows(const std::vector<Row>& want, const char* what, const std::function<void(int, double*)>& compute)
{
    ASSERT_FALSE(want.empty()) << what;
    double worst = 0.0;
    for (std::size_t k = 0; k < want.size(); k++)
    {
        double got[4];
        compute(static_cast<int>(k), got);
        worst = larger(worst, max_difference(got, want[k].data(), static_cast<int>(want[k].size())));
    }
    testing::Test::RecordProperty(what, std::to_string(worst * 1e16) + "e-16");
    EXPECT_LE(worst, tolerance) << what;
}

/// Increments from t0 on, `pre` before it (oldest first).
void expect_increments(const ins_motion_t* m, const nlohmann::json& c, double t0, double T)
{
    const auto increment = [&](int k, double* out) { ins_motion_increment(m, t0 + k * T, t0 + (k + 1) * T, out); };
    const auto pre = c.at("pre").get<std::vector<Row>>();
    const int before = static_cast<int>(pre.size());
    expect_rows(c.at("incs").get<std::vector<Row>>(), "incs", increment);
    expect_rows(pre, "pre", [&](int k, double* out) { increment(k - before, out); });
}

ins_motion_sine_t sine(const nlohmann::json& p)
{
    return {p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>(), p.at(3).get<double>()};
}
} // namespace

TEST(motion_vector, attitude_motion)
{
    const nlohmann::json file = load("attitude_motion.json");
    ASSERT_FALSE(file.at("cases").empty());
    for (const auto& c : file.at("cases"))
    {
        SCOPED_TRACE(c.at("motion").dump());
        const auto& p = c.at("motion");
        const ins_motion_sines_t sines = {sine(p.at("yaw")), sine(p.at("pitch")), sine(p.at("roll"))};
        const double T = c.at("T");
        const int first = c.at("rates_first_k");
        char why[160] = "";
        const Motion m(ins_motion_create_euler(&sines, 0.0, why, sizeof why), ins_motion_destroy);
        ASSERT_NE(m, nullptr) << why;
        expect_increments(m.get(), c, 0.0, T);
        expect_rows(c.at("q_true"), "q_true", [&](int k, double* q) { ins_motion_attitude(m.get(), k * T, q); });
        expect_rows(c.at("euler"), "euler", [&](int k, double* rpy) { ins_motion_euler(m.get(), k * T, rpy); });
        expect_rows(c.at("rates"), "rates", [&](int k, double* w) { ins_motion_rate(m.get(), (k + first) * T, w); });
    }
}

TEST(motion_vector, coning)
{
    const nlohmann::json file = load("coning.json");
    ASSERT_FALSE(file.at("cases").empty());
    for (const auto& c : file.at("cases"))
    {
        const double half_angle = c.at("half_angle_deg").get<double>() * (INS_TRUTH_PI / 180.0);
        const double h = c.at("h");
        const double t0 = c.at("t0");
        const double omega = c.at("omega");
        SCOPED_TRACE(testing::Message() << "half angle " << half_angle << " rad, omega " << omega << " rad/s");
        char why[160] = "";
        const Motion m(ins_motion_create_coning(half_angle, omega / (2.0 * INS_TRUTH_PI), 0.0, why, sizeof why),
                       ins_motion_destroy);
        ASSERT_NE(m, nullptr) << why;
        expect_increments(m.get(), c, t0, h);
        expect_rows(c.at("q_true"), "q_true", [&](int k, double* q) { ins_motion_attitude(m.get(), t0 + k * h, q); });
        expect_rows(c.at("rates_half_step"), "rates_half_step",
                    [&](int k, double* w) { ins_motion_rate(m.get(), t0 + k * (0.5 * h), w); });
    }
}
