/// \file   test_cpp.cpp
/// \brief  The C++ headers against the reference files whose formula they wrap. SI, rad.
/// SPDX-License-Identifier: MIT
#include "cpp_test.hpp"
using namespace cpp_test;

namespace
{
const double TOL_QUAT = INS_TOL(1e-12, 4e-7);   // component, one step
const double TOL_CONING = INS_TOL(1e-12, 3e-7); // component, after 36 steps
const double TOL_MOTION = INS_TOL(1e-12, 4e-6); // component, after 300 steps
const double TOL_REL = INS_TOL(1e-12, 1e-6);
const double TOL_ECEF_M = INS_TOL(1e-8, 6.0);
const double TOL_ANGLE_RAD = INS_TOL(1e-13, 5e-7);
const double TOL_TM_M = INS_TOL(1e-6, 2.0);
const double TOL_FIT = INS_TOL(1e-7, 2e-5);
} // namespace

TEST(cpp, abi_and_texts)
{
    EXPECT_EQ(ins::abi_check(), ins::Status::Ok);
    EXPECT_STREQ(ins::text(ins::Status::Gate), ins_status_text(INS_E_GATE));
    EXPECT_TRUE(ins::ok(ins::Status::Start));
    EXPECT_FALSE(ins::ok(ins::Status::Range));
}

TEST(cpp_vector_coning, rotation_vector_and_attitude)
{
    const json file = load("coning.json");
    Worst phi;
    Worst quats;
    for (const json& c : file["cases"])
    {
        for (const Form& f : forms())
        {
            if (!c["q_final"].contains(f.name))
            {
                continue;
            }
            const auto n = static_cast<size_t>(ins_coning_samples(f.form));
            if (ins_coning_is_block(f.form))
            {
                const auto got = ins::coning_phi(f.form, columns(c["incs"], 0, n));
                ASSERT_TRUE(got);
                take(phi, got.value, c["phi_first"][f.name], norm(c["phi_first"][f.name].get<Vec>()), f.name);
                continue;
            }
            ins::Attitude a;
            ASSERT_EQ(a.init(f.form, quaternion(c["q_true"][0])), ins::Status::Ok);
            const ins_attitude_t start = a.raw;
            Attitudes q(4, 3);
            ASSERT_TRUE(a.run(columns(c["pre"], c["pre"].size() - 3, 3), q));
            std::copy_n(start.q_nb, 4, a.raw.q_nb);
            const Columns incs = columns(c["incs"], 0, c["incs"].size());
            q.resize(4, incs.cols());
            const auto done = a.run(incs, q);
            ASSERT_EQ(done.value, incs.cols());
            ASSERT_EQ(done.status, ins::Status::Ok);
            take(quats, Eigen::Map<const ins::Quaternion>(q.col(incs.cols() - 1).data()), c["q_final"][f.name], f.name);
            if (f.form == INS_CONING_HIST2_OPT)
            {
                ins::Hist2 lean;
                Attitudes same(4, incs.cols());
                ASSERT_EQ(lean.init(quaternion(c["q_true"][0])), ins::Status::Ok);
                ASSERT_TRUE(lean.run(columns(c["pre"], c["pre"].size() - 3, 3), same.leftCols(3)));
                std::copy_n(start.q_nb, 4, lean.raw.q_nb);
                ASSERT_EQ(lean.run(incs, same).value, incs.cols());
                EXPECT_EQ(same, q) << "the general form's bits";
            }
        }
    }
    expect_within(phi, TOL_REL, "coning phi, relative");
    expect_within(quats, TOL_CONING, "coning q_final");
}

TEST(cpp_vector_attitude_motion, sampled_rates_in_one_call)
{
    const json file = load("attitude_motion.json");
    Worst worst;
    for (const json& c : file["cases"])
    {
        const auto lead = static_cast<Eigen::Index>(-c["rates_first_k"].get<int>());
        const Columns w = columns(c["rates"], 0, c["rates"].size());
        Columns theta(3, w.cols());
        ins::Rates rates;
        ASSERT_EQ(rates.init(4, number(c["T"])), ins::Status::Ok);
        ASSERT_EQ(rates.run(w, theta).value, w.cols());
        ins::Attitude a;
        ASSERT_EQ(a.init(INS_CONING_HIST2_OPT, quaternion(c["q_true"][0])), ins::Status::Ok);
        const ins_attitude_t start = a.raw;
        Attitudes q(4, w.cols());
        ASSERT_TRUE(a.run(theta.leftCols(lead + 1).rightCols(3), q.leftCols(3)));
        std::copy_n(start.q_nb, 4, a.raw.q_nb);
        ASSERT_TRUE(a.run(theta.rightCols(w.cols() - lead - 1), q.rightCols(w.cols() - lead - 1)));
        take(worst, a.q_nb(), c["results"]["rates_am4+hist2_opt"]["q_final"], "rates_am4+hist2_opt");

        ins::Thesis t;
        ins::Fiter f;
        ASSERT_EQ(t.init(quaternion(c["q_true"][0])), ins::Status::Ok);
        ASSERT_EQ(f.init(INS_FITER_HIST2, 1, quaternion(c["q_true"][0])), ins::Status::Ok);
        for (const json& before : c["pre"])
        {
            ASSERT_TRUE(ins::ok(t.step(vector<3>(before))) && ins::ok(f.step(vector<3>(before))));
        }
        std::copy_n(start.q_nb, 4, t.raw.q_nb);
        std::copy_n(start.q_nb, 4, f.raw.q_nb);
        ins::Reuse r;
        ASSERT_EQ(r.init(INS_CONING_BLOCK3_OPT, quaternion(c["q_true"][0]), quaternion(c["q_true"][1]),
                         quaternion(c["q_true"][2])),
                  ins::Status::Ok);
        ins::Quaternion chained;
        for (const json& x : c["incs"])
        {
            ASSERT_TRUE(ins::ok(t.step(vector<3>(x))) && ins::ok(f.step(vector<3>(x))));
            const auto reused = r.step(vector<3>(x));
            ASSERT_TRUE(reused);
            chained = reused.value;
        }
        take(worst, t.q_nb(), c["results"]["thesis2"]["q_final"], "thesis2");
        take(worst, f.q_nb(), c["results"]["fhist2"]["q_final"], "fhist2");
        take(worst, chained, c["results"]["reuse_interleaved_opt"]["q_final"], "reuse");
        ins::ThesisRk4 rk4;
        ASSERT_EQ(rk4.init(0, 2 * number(c["T"]), quaternion(c["q_true"][0]), w.col(lead)), ins::Status::Ok);
        for (Eigen::Index k = lead; k + 2 < w.cols(); k += 2)
        {
            ASSERT_EQ(rk4.step(w.col(k + 1), w.col(k + 2)), ins::Status::Ok);
            ASSERT_EQ(ins_quat_normalise(rk4.raw.q_nb), INS_OK);
        }
        take(worst, rk4.q_nb(), c["results"]["rk4_2T"]["q_final"], "rk4_2T");
    }
    expect_within(worst, TOL_MOTION, "attitude_motion q_final");
}

TEST(cpp_vector_quaternion, conversions)
{
    const json file = load("quaternion.json");
    Worst worst;
    for (const json& c : file["euler"])
    {
        const ins::Quaternion q = quaternion(c["q"]);
        take(worst, ins::from_euler({number(c["roll"]), number(c["pitch"]), number(c["yaw"])}), c["q"], "from_euler");
        take(worst, ins::from_euler(ins::to_euler(q)), c["q"], "to_euler and back");
        const ins::Matrix3 C = ins::to_dcm(q);
        for (Eigen::Index i = 0; i < 3; i++)
        {
            take(worst, C.row(i), c["C_bn"][static_cast<size_t>(i)], 1, "C_bn");
        }
        // Eigen's own convention is ours: the same matrix turns the same vector.
        EXPECT_LT(static_cast<double>((C - q.toRotationMatrix()).norm()), 5e-6);
        const auto back = ins::from_dcm(C);
        ASSERT_TRUE(back);
        take(worst, back.value, c["q"], "from_dcm");
    }
    for (const json& c : file["products"])
    {
        const auto q = ins::from_rotvec(vector<3>(c["rv"]));
        ASSERT_TRUE(q);
        take(worst, q.value, c["q_rv"], "from_rotvec");
    }
    for (const json& c : file["zxz"])
    {
        const ins::Matrix3 R = ins::thesis_zxz({number(c["alpha"]), number(c["beta"]), number(c["gamma"])});
        for (Eigen::Index i = 0; i < 3; i++)
        {
            take(worst, R.row(i), c["R"][static_cast<size_t>(i)], 1, "zxz");
        }
    }
    expect_within(worst, TOL_QUAT, "quaternion conversions");
}

TEST(cpp_vector_sculling, rows)
{
    const json file = load("sculling.json");
    Worst worst;
    for (const json& c : file["cases"])
    {
        const json& rows = c["rows"];
        for (size_t k = 2; k < rows.size(); k++)
        {
            Columns theta(3, 3);
            Columns v(3, 3);
            for (Eigen::Index i = 0; i < 3; i++)
            {
                theta.col(i) = vector<3>(rows[k - 2 + static_cast<size_t>(i)]["theta"]);
                v.col(i) = vector<3>(rows[k - 2 + static_cast<size_t>(i)]["v"]);
            }
            const auto dv = ins::sculling_dv(INS_CONING_HIST2_OPT, theta, v);
            ASSERT_TRUE(dv);
            take(worst, dv.value, rows[k]["hist2_opt"], norm(rows[k]["hist2_opt"].get<Vec>()), "dv");
        }
    }
    expect_within(worst, TOL_REL, "sculling dv, relative");
}

TEST(cpp_vector_sixacc, rows_and_linear_maps)
{
    Worst worst;
    const json list = load("sixacc.json")["cases"];
    for (const json& c : list)
    {
        ins_accel_t accels[6];
        ins_sixacc_paper(number(c["rho"]), accels);
        ins::SixAcc<> six;
        ASSERT_EQ(six.init(accels, INS_C(0.02)), ins::Status::Ok);
        for (const json& row : c["rows"])
        {
            ins::Vector<6> f;
            f << vector<3>(row["f"]), number(row["f"][3]), number(row["f"][4]), number(row["f"][5]);
            const auto motion = six.resolve(f, vector<3>(row["w"]));
            const auto largest = static_cast<double>(f.cwiseAbs().maxCoeff());
            take(worst, motion.wd_ib_b, row["wd"], largest / c["rho"].get<double>(), "wd");
            take(worst, motion.f_b, row["f_centre"], largest, "f");
        }
    }
    expect_within(worst, TOL_REL, "six accelerometers, relative");
    const json file = load("calib_linear.json");
    Worst maps;
    for (const json& c : file["cases"])
    {
        ins::LinFit<3> fit;
        const json& attitudes = file["attitudes"][c["group"].get<std::string>()];
        for (size_t k = 0; k < attitudes.size(); k++)
        {
            const ins::Vector3 readings(number(c["P"][0][k]), number(c["P"][1][k]), number(c["P"][2][k]));
            ASSERT_EQ(fit.add(vector<3>(attitudes[k]) * number(c["g"]), readings / number(c["T"])), ins::Status::Ok);
        }
        for (unsigned j = 0; j < 3; j++)
        {
            const auto map = fit.solve(j);
            ASSERT_TRUE(map);
            take(maps, map.value.tail<3>(), c["true_map"][j], 1, "axis");
        }
    }
    expect_within(maps, INS_TOL(1e-12, 2e-6), "linear maps");
}

TEST(cpp_vector_geodesy, ecef_and_tm)
{
    Worst metres;
    Worst angles;
    Worst grid;
    const json list = load("geodesy.json")["points"];
    for (const json& p : list)
    {
        const double rad = PI / 180;
        const json llh = {p["lat_deg"].get<double>() * rad, p["lon_deg"].get<double>() * rad, p["h"]};
        const json xyz = {p["X"], p["Y"], p["Z"]};
        const auto there = ins::geodesy_to_ecef(ins_grs80, vector<3>(llh));
        const auto back = ins::geodesy_from_ecef(ins_grs80, vector<3>(xyz));
        ASSERT_TRUE(there && back);
        take(metres, there.value, xyz, 1, "ECEF");
        take(angles, back.value.head<2>(), {llh[0], llh[1]}, 1, "llh");
        ins::Tm tm;
        ASSERT_EQ(tm.init_twd97(p["epsg"] == 3826 ? 121 : 119), ins::Status::Ok);
        const auto en = tm.forward(vector<3>(llh).head<2>());
        const auto ll = tm.inverse({number(p["E"]), number(p["N"])});
        ASSERT_TRUE(en && ll);
        take(grid, en.value, {p["E"], p["N"]}, 1, "EN");
        take(angles, ll.value, {llh[0], llh[1]}, 1, "lat, lon");
        ins::Local local;
        ASSERT_EQ(local.init(ins_grs80, vector<3>(llh)), ins::Status::Ok);
        const ins::Vector3 ned(3, -4, 5);
        take(metres, local.from_ecef(local.to_ecef(ned)), {3, -4, 5}, 1, "NED");
    }
    expect_within(metres, TOL_ECEF_M, "ECEF [m]");
    expect_within(angles, TOL_ANGLE_RAD, "latitude, longitude [rad]");
    expect_within(grid, TOL_TM_M, "TM2 [m]");
}

TEST(cpp_vector_calib_full, least_squares)
{
    const json file = load("calib_full.json");
    const ins_real g = number(file["g"]);
    Worst parameters;
    Worst readings;
    Worst deviations;
    for (const json& a : file["acc"])
    {
        const std::string name = "accelerometer " + a["acc"].dump();
        ins::AccelFit fit;
        ins::AccelFit truth;
        const auto u0 = vector<3>(a["u0"]);
        const auto e1 = vector<3>(a["e1"]);
        const auto e2 = vector<3>(a["e2"]);
        ASSERT_EQ(fit.init(u0, e1, e2, vector<8>(a["p0"])), ins::Status::Ok);
        ASSERT_EQ(truth.init(u0, e1, e2, vector<8>(a["p_true"])), ins::Status::Ok);
        ASSERT_EQ(fit.step().status, ins::Status::State) << "without rows";
        const auto pass = [&]
        {
            for (size_t k = 0; k < file["meas"].size(); k++)
            {
                const auto m = vector<9>(file["meas"][k]);
                const ins::AccelFit::Motion motion = {g * m.head<3>(), m.segment<3>(3), m.tail<3>()};
                ASSERT_EQ(fit.add(motion, number(a["y_noisy"][k])), ins::Status::Ok);
                readings.take(static_cast<double>(truth.predict(motion).reading), a["y_clean"][k], 1, name);
            }
        };
        for (int passes = 0; passes < 5; passes++)
        {
            pass();
            ASSERT_TRUE(fit.step());
        }
        take(parameters, fit.p(), a["p_est_noisy"], 1, name);
        pass();
        const auto sd = fit.deviation(number(a["p_true"][1]) * INS_C(1e-3)); // the file's noise: 1 mm/s^2
        ASSERT_TRUE(sd);
        for (Eigen::Index i = 0; i < 8; i++)
        {
            const double want = a["sd"][static_cast<size_t>(i)];
            deviations.take(static_cast<double>(sd.value(i)), want, want, name);
        }
    }
    expect_within(parameters, TOL_FIT, "parameters with noise");
    expect_within(readings, INS_TOL(1e-13, 1e-5), "readings, m/s^2");
    expect_within(deviations, INS_TOL(1e-5, 1e-3), "standard deviations, relative");
}
