/// \file   test_cpp_filters.cpp
/// \brief  The C++ headers of the filters against their reference files. SI, rad.
/// SPDX-License-Identifier: MIT
#include "cpp_test.hpp"
using namespace cpp_test;

namespace
{
const double TOL_PVA = INS_TOL(1e-12, 3e-5);

ins_real root(const json& variance)
{
    return static_cast<ins_real>(std::sqrt(variance.get<double>()));
}

/// The steps of which a file has the state and its variances; one state may be an angle.
class Steps
{
  public:
    explicit Steps(const json& list, Eigen::Index angle = -1) : steps(list), wraps(angle) {}
    template <class Filter> void compare(size_t k, const Filter& f)
    {
        if (next >= steps.size() || steps[next]["k"].get<size_t>() != k)
        {
            return;
        }
        const json& want = steps[next++];
        for (Eigen::Index i = 0; i < f.x().size(); i++)
        {
            const double x = want["x"][static_cast<size_t>(i)];
            const double P = want["P_diag"][static_cast<size_t>(i)];
            const auto got = static_cast<double>(f.x()(i));
            const double off = i == wraps ? std::remainder(got - x, 2 * PI) : got - x;
            worst.take(x + off, x, std::max(1.0, std::fabs(x)), "x " + std::to_string(k));
            worst.take(static_cast<double>(f.P()(i, i)), P, std::max(1.0, std::fabs(P)), "P " + std::to_string(k));
        }
    }
    void expect_all(const std::string& what) const
    {
        EXPECT_EQ(next, steps.size()) << what;
        expect_within(worst, TOL_RUN, what);
    }

  private:
    const json& steps;
    Eigen::Index wraps;
    Worst worst;
    size_t next = 0;
};
} // namespace

TEST(cpp_vector_kalman_pva, joseph_and_ud)
{
    const json file = load("kalman_pva.json");
    const auto Phi = square<3>(file["A"]);
    const auto Q = square<3>(file["Q"]);
    const auto Q_ud = ins::Ud<3>::factor(Q);
    ASSERT_TRUE(Q_ud);
    for (const json& run : file["runs"])
    {
        ins::Kalman<3> joseph;
        ins::Ud<3> ud;
        ins::Pva pva;
        joseph.P = square<3>(run["P0"]);
        const auto P0_ud = ins::Ud<3>::factor(joseph.P);
        ASSERT_TRUE(P0_ud);
        ud.UD = P0_ud.value;
        ASSERT_EQ(pva.init(joseph.P.diagonal()), ins::Status::Ok);
        Worst worst;
        size_t next = 0;
        for (size_t k = 0; k < run["z"].size(); k++)
        {
            joseph.predict(Phi, Q);
            ud.predict(Phi, Q_ud.value);
            ASSERT_EQ(pva.predict(number(file["T"]), number(file["q"])), ins::Status::Ok);
            for (size_t row = 0; row < run["H"].size(); row++)
            {
                const auto axis = static_cast<Eigen::Index>(row);
                const ins_real z = number(run["z"][k][row]);
                ins_innovation_t i = {z - joseph.x(axis), number(run["R"][row][row]), 0, 0};
                ins_innovation_t u = {z - ud.x(axis), number(run["R"][row][row]), 0, 0};
                ins_innovation_t p = {z - pva.x()(axis), number(run["R"][row][row]), 0, 0};
                ASSERT_EQ(pva.update(static_cast<int>(row), p), ins::Status::Ok);
                ASSERT_EQ(joseph.update(ins::Vector3::Unit(axis), i), ins::Status::Ok);
                ASSERT_EQ(ud.update(ins::Vector3::Unit(axis), u), ins::Status::Ok);
                EXPECT_LT(static_cast<double>((joseph.gain() - ud.gain()).norm()), TOL_PVA * 10);
                EXPECT_LT(static_cast<double>((joseph.gain() - pva.gain()).norm()), TOL_PVA * 10);
            }
            if (next < run["steps"].size() && run["steps"][next]["k"].get<size_t>() == k)
            {
                const json& want = run["steps"][next++];
                const double size = std::max(1e-3, norm(want["x"].get<Vec>()));
                const double variance = std::max(1e-3, norm(want["P_diag"].get<Vec>()));
                take(worst, joseph.x, want["x"], size, "Joseph x");
                take(worst, ud.x, want["x"], size, "UD x");
                take(worst, pva.x(), want["x"], size, "axis x");
                take(worst, pva.P().diagonal(), want["P_diag"], variance, "axis P");
                take(worst, joseph.P.diagonal(), want["P_diag"], variance, "Joseph P");
                take(worst, ud.covariance().diagonal(), want["P_diag"], variance, "UD P");
            }
        }
        EXPECT_EQ(next, run["steps"].size());
        expect_within(worst, TOL_PVA, "kalman_pva " + run["name"].get<std::string>());
    }
}

TEST(cpp_vector_gps_dr, gps_axis)
{
    const json g = load("gps_dr.json")["gps"];
    const ins_gps_axis_config_t cfg = {number(g["T"]),
                                       number(g["tau_a"]),
                                       number(g["tau_eps"]),
                                       root(g["sigma_a2"]),
                                       root(g["sigma_eps2"]),
                                       number(g["R"]),
                                       0,
                                       0};
    ins::GpsAxis f;
    ASSERT_EQ(f.init(cfg, square<4>(g["P0"]).diagonal()), ins::Status::Ok);
    Worst model;
    for (Eigen::Index i = 0; i < 4; i++)
    {
        take(model, f.Phi().row(i), g["Phi"][static_cast<size_t>(i)], 1, "Phi");
    }
    expect_within(model, TOL_MODEL, "GPS axis Phi");
    Steps steps(g["steps"]);
    for (size_t k = 0; k < g["z"].size(); k++)
    {
        ins_real nis = -1;
        ASSERT_EQ(f.step(number(g["z"][k][0]), &nis), ins::Status::Ok);
        EXPECT_GE(nis, 0);
        steps.compare(k, f);
    }
    steps.expect_all("GPS axis run");
    Worst gain;
    for (int k = 0; k < 2000; k++)
    {
        ASSERT_EQ(f.step(0), ins::Status::Ok);
    }
    for (size_t i = 0; i < 4; i++)
    {
        gain.take(static_cast<double>(f.gain()(static_cast<Eigen::Index>(i))), g["steady"]["K"][i][0], 1, "K");
    }
    expect_within(gain, INS_TOL(1e-7, 1e-3), "GPS axis steady gain");
    const ins::Vector<4> before(4, 3, 2, 1);
    std::copy_n(before.data(), 4, f.raw.x);
    f.predict();
    EXPECT_TRUE(f.x().isApprox(f.Phi() * before, static_cast<ins_real>(TOL_STEP)));
}

TEST(cpp_vector_gps_dr, dead_reckoning_and_the_papers_filter)
{
    const json file = load("gps_dr.json");
    Worst sums;
    for (const json& c : file["dead_reckoning"])
    {
        ins::Vector3 pose(number(c["e"]), number(c["n"]), number(c["heading"]));
        ASSERT_EQ(ins::dead_reckoning_step(pose, number(c["s"]), number(c["dheading"])), ins::Status::Ok);
        sums.take(static_cast<double>(pose.x()), c["out"][0], 100, "east");
        sums.take(static_cast<double>(pose.y()), c["out"][1], 100, "north");
        sums.take(std::remainder(static_cast<double>(pose.z()) - c["out"][2].get<double>(), 2 * PI), 0, 1, "heading");
    }
    expect_within(sums, INS_TOL(1e-15, 1e-6), "dead reckoning");
    const json& d = file["dr"];
    const ins_dr_ekf_config_t cfg = {number(d["T"]),
                                     {number(d["tau_e"]), number(d["tau_n"])},
                                     {root(d["sigma2"][0]), root(d["sigma2"][1])},
                                     number(d["R"][0][0]),
                                     number(d["R"][1][1]),
                                     number(d["vmin"]),
                                     number(d["vzero"]),
                                     0};
    ins::DrEkf f;
    ASSERT_EQ(f.init(cfg, vector<6>(d["x0"]), square<6>(d["P0"]).diagonal()), ins::Status::Ok);
    Steps steps(d["steps"]);
    for (size_t k = 0; k < d["z"].size(); k++)
    {
        ASSERT_EQ(f.step(number(d["z"][k][0]), number(d["z"][k][1])), ins::Status::Ok);
        steps.compare(k + 1, f);
    }
    steps.expect_all("DR filter run");
}

TEST(cpp_vector_gps_dr, unicycle)
{
    const json u = load("gps_dr.json")["dr_unicycle"];
    const ins_unicycle_config_t cfg = {
        number(u["qv"]), number(u["qb"]), number(u["qk"]), number(u["rw"]), number(u["rs"]), 0, 0};
    ins::Unicycle f;
    ASSERT_EQ(f.init(cfg, vector<6>(u["x0"]), square<6>(u["P0"]).diagonal()), ins::Status::Ok);
    Steps steps(u["steps"], INS_UNICYCLE_HEADING);
    for (size_t k = 0; k < u["z"].size(); k++)
    {
        const json& z = u["z"][k];
        ASSERT_EQ(f.odometer(number(u["T"]), number(z[1])), ins::Status::Ok);
        ASSERT_EQ(f.predict(number(u["T"]), number(z[0])), ins::Status::Ok);
        if (!z[2].is_null())
        {
            ASSERT_EQ(f.gps(vector<2>(z[2]), number(u["Rgps"])), ins::Status::Ok);
        }
        steps.compare(k + 1, f);
    }
    steps.expect_all("unicycle run");
    for (int k = 0; k < 100; k++)
    {
        ASSERT_EQ(f.still(INS_C(0.01), INS_C(1e-4)), ins::Status::Ok);
    }
    EXPECT_NEAR(static_cast<double>(f.x()(INS_UNICYCLE_SPEED)), 0, 1e-2);
    ins_real nis = 0;
    f.raw.cfg.gate_gps = INS_KALMAN_GATE2_99;
    EXPECT_EQ(f.gps({INS_C(1e6), 0}, 9, &nis), ins::Status::Gate);
    EXPECT_GT(nis, INS_KALMAN_GATE2_99);
}

TEST(cpp_gps_dr, both_pairs_do_what_their_c_functions_do)
{
    ins_gps_dr_config_t cfg;
    ins_gps_dr_config_default(&cfg);
    ins_gps_dr_paper_config_t paper_cfg;
    ins_gps_dr_paper_config_default(&paper_cfg, INS_GPS_DR_PAPER_PRINTED);
    ins::GpsDr ours;
    ins::GpsDrPaper paper;
    ins_gps_dr_t raw;
    ins::Vector<6> x;
    ins::Square<6> P;
    ins::Vector<4> y;
    ins::Vector<4> var;
    ASSERT_EQ(ours.init(cfg), ins::Status::Ok);
    ASSERT_EQ(paper.init(paper_cfg), ins::Status::Ok);
    ASSERT_EQ(ins_gps_dr_init(&raw, &cfg), INS_OK);
    EXPECT_EQ(ours.state(x, P), ins::Status::State);
    ins_gps_dr_fix_t fix = {};
    fix.sigma = 3;
    fix.valid = fix.has_course = 1;
    fix.sats = 8;
    fix.speed = 8;
    for (int k = 0; k < 50; k++)
    {
        ASSERT_EQ(ours.step(INS_C(0.1), 0, INS_C(0.8)), ins::Status::Ok);
        ASSERT_EQ(paper.step(0, INS_C(0.8)), ins::Status::Ok);
        ASSERT_EQ(ins_gps_dr_step(&raw, INS_C(0.1), 0, INS_C(0.8)), INS_OK);
        fix.north += INS_C(0.8);
        ASSERT_EQ(k % 10 ? ins::Status::Ok : ours.fix(fix), ins::Status::Ok);
        ASSERT_EQ(k % 10 ? ins::Status::Ok : paper.fix(fix), ins::Status::Ok);
        ASSERT_EQ(k % 10 ? INS_OK : ins_gps_dr_fix(&raw, &fix), INS_OK);
    }
    ins_real want[6];
    ASSERT_EQ(ins_gps_dr_state(&raw, want, nullptr), INS_OK);
    ASSERT_EQ(ours.state(x, P), ins::Status::Ok);
    EXPECT_TRUE(std::equal(want, want + 6, x.data()));
    EXPECT_NEAR(static_cast<double>(x(INS_UNICYCLE_NORTH)), 40, 1);
    EXPECT_EQ(ours.source(), INS_GPS_DR_GPS);
    ASSERT_EQ(paper.state(y, var), ins::Status::Ok);
    EXPECT_NEAR(static_cast<double>(y(1)), 40, 5) << "it finds the speed from five fixes";
    EXPECT_EQ(paper.source(), INS_GPS_DR_GPS);
    ins::Unicycle local;
    local.raw = raw.local[0];
    ins_real nis = 0;
    ins_real det = 0;
    EXPECT_EQ(local.judge({x(0), x(1)}, 9, nis, det), ins::Status::Ok);
    EXPECT_NEAR(static_cast<double>(nis), 0, 1e-9);
    EXPECT_EQ(local.course(x(2), INS_C(0.01)), ins::Status::Ok);
    EXPECT_EQ(local.travel(INS_C(0.1), 0, INS_C(0.8)), ins::Status::Ok);
    EXPECT_NEAR(static_cast<double>(local.x()(INS_UNICYCLE_NORTH) - x(INS_UNICYCLE_NORTH)), 0.8, 0.05);
}

TEST(cpp_vector_gps_dr, switch_with_hysteresis)
{
    const json s = load("gps_dr.json")["switch"];
    const json& p = s["params"];
    const ins_switch_config_t cfg = {number(p["hmax"]), number(p["gate"]), p["smin"].get<uint_least8_t>(),
                                     p["n_back"].get<uint_least8_t>()};
    ins_switch_t gps;
    ASSERT_EQ(ins_switch_init(&gps, &cfg), INS_OK);
    for (size_t k = 0; k < s["epochs"].size(); k++)
    {
        const json& e = s["epochs"][k];
        const int mode = ins_switch_epoch(&gps, e["valid"].get<bool>(), e["sats"].get<unsigned>(), number(e["hdop"]),
                                          e["nis"].is_null() ? 0 : number(e["nis"]));
        EXPECT_EQ(mode == INS_SWITCH_GPS ? "GPS" : "DR", s["expected"][k]["mode"].get<std::string>()) << k;
    }
}

TEST(cpp_vector_gps_dr, fusion)
{
    Worst worst;
    const json list = load("gps_dr.json")["fusion"];
    for (const json& c : list)
    {
        ins::Fusion<4> fusion;
        EXPECT_FALSE(fusion.solve());
        for (size_t i = 0; i < c["x"].size(); i++)
        {
            ins::Fusion<4>::Estimate one;
            one.x = vector<4>(c["x"][i]);
            one.P = square<4>(c["P"][i]);
            ASSERT_EQ(fusion.add(one), ins::Status::Ok);
        }
        const auto fused = fusion.solve();
        ASSERT_TRUE(fused);
        take(worst, fused.value.x, c["x_fused"], 1, "x");
        take(worst, fused.value.P.row(1), c["P_fused"][1], 1, "P");
        const auto shared = ins::fusion_share<4>(fused.value.P, number(c["beta"][0]));
        ASSERT_TRUE(shared);
        take(worst, shared.value.row(2), c["P_local_reset"][0][2], 1, "P shared");
    }
    expect_within(worst, TOL_STEP, "fusion");
}
