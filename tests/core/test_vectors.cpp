/// \file   test_vectors.cpp
/// \brief  Every entry of the reference files coning, attitude_motion and quaternion whose formula the core has.
///
/// Left to other modules: functional iteration, rate fit, RK4, the thesis's update and its ZXZ angles. Readings of the paper's sample
/// reuse that rotate three times too far, and the rectangle rule, are in the files as warnings and are not built.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
using namespace core_test;

namespace
{
// Double: rounding of 1e-12 relative to 1 rad or to a unit quaternion. Float: measured, see the figures printed, times about 2.
const double TOL_QUAT_ONE_STEP = INS_TOL(1e-12, 4e-7); // component
const double TOL_PHI_REL = INS_TOL(1e-12, 5e-7);       // of |phi|
const double TOL_CONING_QUAT = INS_TOL(1e-12, 3e-7);   // component, after 36 steps
const double TOL_CONING_RAD = INS_TOL(1e-12, 3e-7);    // rad, after 36 steps
const double TOL_MOTION_QUAT = INS_TOL(1e-12, 3e-6);   // component, after 300 steps
const double TOL_MOTION_RAD = INS_TOL(1e-12, 6e-6);    // rad, over 300 steps
const double TOL_EULER_RAD = INS_TOL(1e-12, 5e-7);     // rad, away from the poles
const double TOL_COEFFICIENT = INS_TOL(1e-15, 1e-7);
const double TOL_DRIFT_RAD_S = 2e-15; // double only; the noise of 1e-16 a step over the cycles run
const double TOL_DRIFT_REL = 2e-5;    // the files' "measured" holds a transient of some 1e-6

int form_named(const std::string& name)
{
    for (const Form& f : forms())
    {
        if (name == f.name)
        {
            return f.form;
        }
    }
    return -1;
}

void take_quat(Worst& worst, const Quat& got, const Quat& want, const std::string& place)
{
    double dot = 0;
    for (size_t i = 0; i < 4; i++)
    {
        dot += got[i] * want[i];
    }
    for (size_t i = 0; i < 4; i++)
    {
        worst.take(dot < 0 ? -got[i] : got[i], want[i], 1, place);
    }
}

void take_vec(Worst& worst, const Vec& got, const Vec& want, double scale, const std::string& place)
{
    for (size_t i = 0; i < 3; i++)
    {
        worst.take(got[i], want[i], scale, place);
    }
}

/// Newest `count` of the exact increments before the start.
std::vector<Vec> tail(const std::vector<Vec>& pre, size_t count)
{
    EXPECT_GE(pre.size(), count);
    return {pre.end() - static_cast<long>(count), pre.end()};
}

Track run_named(const std::string& name, const std::vector<Vec>& pre, const std::vector<Vec>& incs,
                const std::vector<Quat>& truth)
{
    if (name == "reuse_interleaved_poly" || name == "reuse_interleaved_opt")
    {
        const int form = name == "reuse_interleaved_poly" ? INS_CONING_BLOCK3_FIT : INS_CONING_BLOCK3_OPT;
        return run_reuse(form, {truth[0], truth[1], truth[2]}, incs);
    }
    const int form = form_named(name);
    return form < 0 ? Track() : run_form(form, truth[0], tail(pre, 3), incs);
}
} // namespace

TEST(core_test, no_number_is_the_largest_error)
{
    Worst worst;
    for (const double got : {1.0, std::nan(""), 0.0})
    {
        worst.take(got, 0, 1, "here");
    }
    EXPECT_TRUE(std::isnan(worst.error));
    EXPECT_TRUE(std::isnan(larger(larger(0, std::nan("")), 1)));
    EXPECT_EQ(larger(1, 2), 2);
    EXPECT_EQ(larger(2, 1), 2);
}

TEST(vector_coning, coefficients)
{
    const json file = load("coning.json");
    Worst worst;
    for (const auto& [name, rows] : file["coefficients"].items())
    {
        const int form = form_named(name);
        ASSERT_GE(form, 0) << name;
        const int n = ins_coning_samples(form);
        for (int i = 1; i <= n; i++)
        {
            for (int j = i + 1; j <= n; j++)
            {
                double want = 0;
                for (const json& row : rows)
                {
                    if (row[0] == i && row[1] == j)
                    {
                        want = row[2].get<double>() / row[3].get<double>();
                    }
                }
                // theta_i along x and theta_j along y: the z of phi is the coefficient.
                ins_real theta[3 * INS_CONING_SAMPLES_MAX] = {0};
                theta[3 * (i - 1)] = 1;
                theta[3 * (j - 1) + 1] = 1;
                ins_real phi[3];
                ASSERT_EQ(ins_coning_phi(form, theta, phi), INS_OK);
                worst.take(static_cast<double>(phi[2]), want, 1, name);
                const bool block = ins_coning_is_block(form) == 1;
                EXPECT_EQ(phi[0], block || i == n ? 1 : 0) << name;
                EXPECT_EQ(phi[1], block || j == n ? 1 : 0) << name;
            }
        }
    }
    expect_within(worst, TOL_COEFFICIENT, "coning coefficients");
}

TEST(vector_coning, rotation_vector_of_the_first_interval)
{
    const json file = load("coning.json");
    Worst worst;
    for (const json& c : file["cases"])
    {
        const auto pre = c["pre"].get<std::vector<Vec>>();
        const auto incs = c["incs"].get<std::vector<Vec>>();
        for (const auto& [name, want] : c["phi_first"].items())
        {
            const int form = form_named(name);
            if (form < 0)
            {
                EXPECT_EQ(name, "thesis_P_unnormalised");
                continue;
            }
            const size_t n = static_cast<size_t>(ins_coning_samples(form));
            std::vector<Vec> read = tail(pre, ins_coning_is_block(form) ? 0 : n - 1);
            read.insert(read.end(), incs.begin(), incs.begin() + static_cast<long>(n - read.size()));
            std::vector<ins_real> theta;
            for (const Vec& v : read)
            {
                const auto x = real(v);
                theta.insert(theta.end(), x.begin(), x.end());
            }
            ins_real phi[3];
            ASSERT_EQ(ins_coning_phi(form, theta.data(), phi), INS_OK);
            take_vec(worst, vec(phi), want.get<Vec>(), norm(want.get<Vec>()), name);
        }
    }
    expect_within(worst, TOL_PHI_REL, "coning phi, relative to |phi|");
}

TEST(vector_coning, attitude_after_the_increments)
{
    const json file = load("coning.json");
    Worst quats;
    Worst errors;
    for (const json& c : file["cases"])
    {
        const auto truth = c["q_true"].get<std::vector<Quat>>();
        for (const auto& [name, want] : c["q_final"].items())
        {
            const Track track =
                run_named(name, c["pre"].get<std::vector<Vec>>(), c["incs"].get<std::vector<Vec>>(), truth);
            if (track.empty())
            {
                EXPECT_TRUE(name == "thesis2" || name == "reuse_naive") << name;
                continue;
            }
            take_quat(quats, track.back().second, want.get<Quat>(), name);
            take_vec(errors, rotation_between(track.back().second, truth.back()), c["att_err_final"][name].get<Vec>(),
                     1, name);
        }
    }
    expect_within(quats, TOL_CONING_QUAT, "coning q_final");
    expect_within(errors, TOL_CONING_RAD, "coning att_err_final [rad]");
}

#ifndef INS_REAL_FLOAT
TEST(vector_coning, drift_over_whole_cycles)
{
    const int cycles = 12;
    const json file = load("coning.json");
    for (const json& c : file["cases"])
    {
        const double a = c["half_angle_deg"].get<double>() * PI / 180;
        const double h = c["h"];
        const double omega = c["omega"];
        const double t0 = c["t0"];
        const size_t per_cycle = c["increments_per_cycle"];
        const auto increment = [&](long k)
        {
            const double from = omega * (t0 + static_cast<double>(k) * h);
            const double to = from + omega * h;
            // Differences of cosines and sines as products: no cancellation.
            const double chord = 2 * std::sin(a) * std::sin(omega * h / 2);
            return Vec{-2 * omega * h * std::sin(a / 2) * std::sin(a / 2), -chord * std::sin((from + to) / 2),
                       chord * std::cos((from + to) / 2)};
        };
        for (const auto& [name, want] : c["drift_x"].items())
        {
            const int form = form_named(name);
            if (form < 0)
            {
                continue; // thesis2, and the chains, whose drift is that of their block form
            }
            std::vector<Vec> pre;
            std::vector<Vec> incs;
            for (long k = -3; k < static_cast<long>(cycles * per_cycle); k++)
            {
                (k < 0 ? pre : incs).push_back(increment(k));
            }
            const Quat start = c["q_true"][0].get<Quat>();
            const Track track = run_form(form, start, pre, incs);
            ASSERT_EQ(track.back().first, incs.size()) << name;
            const double drift =
                rotation_between(track.back().second, start)[0] / (static_cast<double>(incs.size()) * h);
            const double measured = want["measured"];
            EXPECT_NEAR(drift, measured, TOL_DRIFT_RAD_S + TOL_DRIFT_REL * std::fabs(measured))
                << name << ", half angle " << c["half_angle_deg"] << " deg, " << per_cycle << " increments a cycle";
        }
    }
}
#endif

TEST(vector_attitude_motion, increments)
{
    const json file = load("attitude_motion.json");
    Worst quats;
    Worst errors;
    for (const json& c : file["cases"])
    {
        const auto truth = c["q_true"].get<std::vector<Quat>>();
        const auto incs = c["incs"].get<std::vector<Vec>>();
        for (const auto& [name, want] : c["results"].items())
        {
            const Track track = run_named(name, c["pre"].get<std::vector<Vec>>(), incs, truth);
            if (track.empty())
            {
                continue;
            }
            ASSERT_EQ(track.back().first, want["k_final"].get<size_t>()) << name;
            take_quat(quats, track.back().second, want["q_final"].get<Quat>(), name);
            double max = 0;
            double sum2 = 0;
            double yaw[2] = {0, 0};
            double pitch[2] = {0, 0};
            for (const auto& [k, q] : track)
            {
                const double e = angle_between(q, truth[k]);
                max = std::max(max, e);
                sum2 += e * e;
                const Vec got = euler_of(q);
                const Vec exact = euler_of(truth[k]);
                const double dyaw = std::remainder(got[2] - exact[2], 2 * PI);
                yaw[0] = std::min(yaw[0], dyaw);
                yaw[1] = std::max(yaw[1], dyaw);
                pitch[0] = std::min(pitch[0], got[1] - exact[1]);
                pitch[1] = std::max(pitch[1], got[1] - exact[1]);
            }
            errors.take(max, want["max_err"], 1, name + " max_err");
            errors.take(std::sqrt(sum2 / static_cast<double>(track.size())), want["rms_err"], 1, name + " rms_err");
            errors.take(yaw[0], want["yaw_err_min"], 1, name + " yaw_err_min");
            errors.take(yaw[1], want["yaw_err_max"], 1, name + " yaw_err_max");
            errors.take(pitch[0], want["pitch_err_min"], 1, name + " pitch_err_min");
            errors.take(pitch[1], want["pitch_err_max"], 1, name + " pitch_err_max");
        }
    }
    expect_within(quats, TOL_MOTION_QUAT, "attitude_motion q_final");
    expect_within(errors, TOL_MOTION_RAD, "attitude_motion errors [rad]");
}

TEST(vector_attitude_motion, point_sampled_rates)
{
    const json file = load("attitude_motion.json");
    Worst quats;
    Worst errors;
    for (const json& c : file["cases"])
    {
        const auto truth = c["q_true"].get<std::vector<Quat>>();
        const auto rates = c["rates"].get<std::vector<Vec>>();
        const size_t lead = static_cast<size_t>(-c["rates_first_k"].get<int>());
        const std::pair<const char*, unsigned> orders[] = {
            {"rates_trap+hist2_opt", 2}, {"rates_am3+hist2_opt", 3}, {"rates_am4+hist2_opt", 4}};
        for (const auto& [name, order] : orders)
        {
            const json& want = c["results"].at(name);
            const Track track = run_rates(order, c["T"], truth[0], rates, lead);
            ASSERT_EQ(track.back().first, want["k_final"].get<size_t>()) << name;
            take_quat(quats, track.back().second, want["q_final"].get<Quat>(), name);
            errors.take(max_error(track, [&](size_t k) { return truth[k]; }), want["max_err"], 1, name);
        }
    }
    expect_within(quats, TOL_MOTION_QUAT, "attitude_motion rates q_final");
    expect_within(errors, TOL_MOTION_RAD, "attitude_motion rates max_err [rad]");
}

TEST(vector_quaternion, euler_and_direction_cosines)
{
    const json file = load("quaternion.json");
    Worst quats;
    Worst dcm;
    Worst angles;
    for (const json& c : file["euler"])
    {
        const Vec euler = {c["roll"], c["pitch"], c["yaw"]};
        const auto want = c["q"].get<Quat>();
        ins_real q[4];
        ins_quat_from_euler(real(euler).data(), q);
        take_quat(quats, quat(q), want, "from_euler");
        const auto q_file = real(want);
        ins_real C[9];
        ins_quat_to_dcm(q_file.data(), C);
        ins_real C_file[9];
        for (size_t i = 0; i < 9; i++)
        {
            dcm.take(static_cast<double>(C[i]), c["C_bn"][i / 3][i % 3], 1, "C_bn");
            C_file[i] = static_cast<ins_real>(c["C_bn"][i / 3][i % 3].get<double>());
        }
        ASSERT_EQ(ins_quat_from_dcm(C_file, q), INS_OK);
        take_quat(quats, quat(q), want, "from_dcm");
        ins_real back[3];
        ins_quat_to_euler(q_file.data(), back);
        const auto euler_back = c["euler_back"].get<Vec>();
        // Within cos(pitch) of a pole roll and yaw are known to the rounding of q over cos(pitch), the file's pitch (an asin) to
        // the root of it; the rotation is known everywhere.
        const double near_pole = std::cos(euler[1]);
        if (near_pole > 1e-3)
        {
            take_vec(angles,
                     {near_pole * std::remainder(static_cast<double>(back[0]) - euler_back[0], 2 * PI),
                      static_cast<double>(back[1]) - euler_back[1],
                      near_pole * std::remainder(static_cast<double>(back[2]) - euler_back[2], 2 * PI)},
                     {0, 0, 0}, 1, "to_euler");
        }
        take_quat(quats, from_euler(vec(back)), want, "to_euler and back");
    }
    expect_within(quats, TOL_QUAT_ONE_STEP, "quaternion from Euler, DCM");
    expect_within(dcm, TOL_QUAT_ONE_STEP, "quaternion C_bn");
    expect_within(angles, TOL_EULER_RAD, "quaternion to Euler [rad]");
}

TEST(vector_quaternion, products_rotations_rotation_vectors)
{
    const json file = load("quaternion.json");
    Worst worst;
    for (const json& c : file["products"])
    {
        const auto a = real(c["a"].get<Quat>());
        const auto b = real(c["b"].get<Quat>());
        ins_real q[4];
        ins_quat_mul(a.data(), b.data(), q);
        take_quat(worst, quat(q), c["ab"].get<Quat>(), "product");
        ins_real v[3];
        const Vec v_b = c["v"].get<Vec>();
        ins_quat_rotate(a.data(), real(v_b).data(), v);
        take_vec(worst, vec(v), c["rot"].get<Vec>(), std::max(1.0, norm(v_b)), "rotate");
        ASSERT_EQ(ins_quat_from_rotvec(real(c["rv"].get<Vec>()).data(), q), INS_OK);
        take_quat(worst, quat(q), c["q_rv"].get<Quat>(), "from_rotvec");
        Quat longer = c["a"].get<Quat>();
        for (double& x : longer)
        {
            x *= 1.001;
        }
        auto approx = real(longer);
        ins_quat_normalise_approx(approx.data());
        take_quat(worst, quat(approx.data()), c["norm_approx"].get<Quat>(), "normalise_approx");
    }
    expect_within(worst, TOL_QUAT_ONE_STEP, "quaternion products");
}
