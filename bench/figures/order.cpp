/// \file   order.cpp
/// \brief  Order of convergence of the core's attitude algorithms on a motion without a closed form, integrated by CVODE. rad, s.
///
/// Exit code 1 when a run was refused or a point is no number.
/// SPDX-License-Identifier: MIT
#include "attitude_errors.hpp"
#include "figures.hpp"
#include "ins_truth/body.h"
#include "ins_truth/exact.h"
#include <map>

namespace
{
using namespace figures;

constexpr double DURATION_S = 24;
constexpr double BEFORE_S = 1;      ///< for the history
constexpr double FLOOR_RAD = 1e-10; ///< an order is told from errors above it: a hundred times the reference's
constexpr size_t STEPS[] = {300, 600, 1200, 2400, 4800}; ///< of 80 to 5 ms; whole blocks of 2, 3 and 4

/// Rates that no Euler angles swing to: sums of two sines about each axis, the fastest at 1.1 Hz.
bool tumble(void*, double t, const ins_track_state_t*, double w_ib_b[3], double f_b[3])
{
    constexpr double sines[3][2][3] = {{{0.9, 0.31, 0.2}, {0.25, 1.1, 1.0}}, // rad/s, Hz, rad
                                       {{0.7, 0.23, -1.1}, {0.3, 0.9, 2.0}},
                                       {{0.8, 0.4, 0.7}, {0.2, 1.03, -0.4}}};
    for (size_t i = 0; i < 3; i++)
    {
        f_b[i] = 0;
        w_ib_b[i] = 0;
        for (const auto& s : sines[i])
        {
            w_ib_b[i] += s[0] * std::sin(2 * PI * s[1] * t + s[2]);
        }
    }
    return true;
}

class Tumbling
{
  public:
    explicit Tumbling(const ins_track_t* track) : track_(track) {}
    Quat attitude(double t) const
    {
        const ins_track_state_t s = at(t);
        return {s.q_nb[0], s.q_nb[1], s.q_nb[2], s.q_nb[3]};
    }
    Vec rate(double t) const
    {
        const ins_track_state_t s = at(t);
        return {s.w_ib_b[0], s.w_ib_b[1], s.w_ib_b[2]};
    }
    Vec increment(double t0, double t1) const
    {
        const auto [found, is_new] = known_.try_emplace({t0, t1});
        if (is_new)
        {
            double v[3];
            ins_truth_increment(track_, t0, t1, found->second.data(), v);
        }
        return found->second;
    }

  private:
    ins_track_state_t at(double t) const
    {
        ins_track_state_t s;
        ins_track_at(track_, t, &s);
        return s;
    }
    const ins_track_t* track_;
    mutable std::map<std::pair<double, double>, Vec> known_; ///< what 25 algorithms ask for
};

/// Curves of the figure, and what they are called there.
const std::map<std::string, std::string> shown = {{"rectangle", "rates held, HIST2_OPT"},
                                                  {"one", "ONE"},
                                                  {"hist1", "HIST1"},
                                                  {"two", "BLOCK2"},
                                                  {"hist2_opt", "HIST2_OPT"},
                                                  {"hist2_poly", "HIST2_FIT"},
                                                  {"fhist3", "iteration, HIST3"},
                                                  {"fhist4", "iteration, HIST4"}};

using Error = std::function<double(const Tumbling&, double period, size_t steps)>;

std::vector<std::pair<std::string, Error>> algorithms()
{
    std::vector<std::pair<std::string, Error>> all;
    for (const Form& f : forms())
    {
        all.emplace_back(f.name, [f](const Tumbling& m, double T, size_t n) { return named(m, f.name, T, n); });
    }
    for (const char* name : {"AM2", "AM3", "AM4", "AM5"})
    {
        all.emplace_back(name, [name](const Tumbling& m, double T, size_t n) { return named(m, name, T, n); });
    }
    const std::pair<const char*, int> iterations[] = {{"fiter_block3", INS_FITER_BLOCK3}, {"fhist2", INS_FITER_HIST2},
                                                      {"fhist3", INS_FITER_HIST3},        {"fhist4", INS_FITER_HIST4},
                                                      {"rate4", INS_FITER_RATE4},         {"rate5", INS_FITER_RATE5}};
    for (const auto& f : iterations)
    {
        const int form = f.second;
        all.emplace_back(f.first, [form](const Tumbling& m, double T, size_t n) { return fiter(m, form, T, n); });
    }
    all.emplace_back("thesis", [](const Tumbling& m, double T, size_t n) { return thesis(m, T, n); });
    all.emplace_back("rk4_2T", [](const Tumbling& m, double T, size_t n) { return rk4(m, T, n); });
    all.emplace_back("rectangle", [](const Tumbling& m, double T, size_t n) { return rectangle(m, T, n); });
    return all;
}
} // namespace

int main()
{
    ins_body_config_t c = {};
    c.q_nb[0] = 1;
    c.start_s = -BEFORE_S;
    c.end_s = DURATION_S + BEFORE_S;
    c.tolerance = INS_BODY_TIGHTEST;
    const ins_body_input_t input = {tumble, nullptr, nullptr};
    char why[200] = "";
    ins_track_t* const track = ins_track_create_body(&c, &input, nullptr, 0, why, sizeof why);
    if (track == nullptr)
    {
        std::fprintf(stderr, "%s\n", why);
        return 1;
    }
    const Tumbling motion(track);
    for (const auto& [name, error] : algorithms())
    {
        double before = 0;
        double order = 0;
        for (const size_t steps : STEPS)
        {
            const double period = DURATION_S / static_cast<double>(steps);
            const double now = error(motion, period, steps);
            const auto label = shown.find(name);
            if (label != shown.end() && now > FLOOR_RAD)
            {
                point("order_step", label->second, period, now);
            }
            order = before > 0 && now > FLOOR_RAD ? std::log2(before / now) : order;
            before = now;
            if (steps == STEPS[0])
            {
                point("table_order", name, 0, now);
            }
        }
        point("table_order", name, 1, order);
    }
    ins_track_destroy(track);
    return testing::UnitTest::GetInstance()->Failed() ? 1 : 0;
}
