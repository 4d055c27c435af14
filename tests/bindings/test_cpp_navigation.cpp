/// \file   test_cpp_navigation.cpp
/// \brief  The C++ headers of the navigation filters, bit for bit against the C calls: GPS/INS, its covariance, without gyros. SI, rad.
/// SPDX-License-Identifier: MIT
#include "ins/ins.hpp"
#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>

namespace
{
constexpr int64_t PERIOD_NS = 10000000;
constexpr ins_real PERIOD = INS_C(0.01);
const ins::Quaternion LEVEL = ins::Quaternion::Identity();
const ins::Position HOME(ins::Vector3(INS_C(0.9), INS_C(0.2), 100));
constexpr ins_kf15_sensors_t SENSORS = {INS_C(1e-4), INS_C(1e-3), INS_C(1e-4), 300, INS_C(1e-2), 300};
constexpr ins_kf15_scale_sensors_t SCALES = {INS_C(0.01), INS_C(0.02), 1000, 1000};

ins::Increment sample(int k)
{
    const ins_real s = std::sin(INS_C(0.1) * static_cast<ins_real>(k));
    return {ins::Vector3(INS_C(1e-4) * s, INS_C(-2e-4), INS_C(2e-3)),
            ins::Vector3(INS_C(1e-3) * s, INS_C(0.02), INS_C(-0.0981))};
}

ins::Errors15 sigmas()
{
    ins::Errors15 s;
    s << INS_C(.01), INS_C(.01), INS_C(.1), 1, 1, 1, 10, 10, 10, INS_C(1e-4), INS_C(1e-4), INS_C(1e-4), INS_C(.01),
        INS_C(.01), INS_C(.01);
    return s;
}

ins_gps_ins_start_t start()
{
    ins_gps_ins_start_t s = {};
    s.q_nb[0] = 1;
    s.v_n[0] = 10;
    s.position = HOME.raw();
    const ins::Errors15 sigma = sigmas();
    std::copy(sigma.data(), sigma.data() + INS_KF15_N, s.sigma);
    return s;
}

ins_gnss_fix_t fix(int k)
{
    ins_gnss_fix_t f = {};
    f.t_ns = k * PERIOD_NS;
    f.position = HOME.raw();
    f.v_n[0] = 10;
    for (size_t i = 0; i < 3; i++)
    {
        f.sigma_p[i] = 100;
        f.sigma_v[i] = 10;
    }
    return f;
}

template <class Raw> bool same(const Raw& a, const Raw& b)
{
    return std::memcmp(&a, &b, sizeof a) == 0;
}
} // namespace

TEST(cpp_kf15, both_forms_and_scale_factors_have_the_bits_of_c)
{
    ins::Strapdown strapdown;
    ins::Kf15Model model;
    ins::Kf15 p, beside;
    ins::Kf15Ud ud;
    ins::Kf15Scale scale;
    ASSERT_EQ(strapdown.init(INS_CONING_HIST2_OPT, PERIOD, LEVEL, {10, 0, 0}, HOME), ins::Status::Ok);
    ASSERT_EQ(model.init(PERIOD, SENSORS), ins::Status::Ok);
    ASSERT_EQ(p.init(sigmas()), ins::Status::Ok);
    ASSERT_EQ(beside.init(sigmas()), ins::Status::Ok);
    ASSERT_EQ(ud.init(sigmas()), ins::Status::Ok);
    ASSERT_EQ(scale.init(SCALES), ins::Status::Ok);
    ins_kf15_model_t c_model = model.raw;
    ins_kf15_t c_p = p.raw, c_beside = beside.raw;
    ins_kf15_ud_t c_ud = ud.raw;
    ins_kf15_scale_t c_scale = scale.raw;
    ins::Errors15 h = ins::Errors15::Zero();
    h(INS_KF15_V) = 1;
    h(INS_KF15_BG + 2) = INS_C(0.5);
    const ins::Kf15Scale::Scales h_s = ins::Kf15Scale::Scales::Constant(INS_C(0.1));
    for (int k = 0; k < 50; k++)
    {
        const ins::Increment x = sample(k);
        ASSERT_TRUE(ins::ok(strapdown.step(x)));
        model.set(strapdown, x.v_b);
        ins_kf15_model(&c_model, &strapdown.raw, x.v_b.data());
        p.propagate(model);
        ud.propagate(model);
        scale.propagate(beside, model, x);
        ins_kf15_propagate(&c_p, &c_model);
        ins_kf15_ud_propagate(&c_ud, &c_model);
        ins_kf15_scale_propagate(&c_scale, &c_beside, &c_model, x.theta_b.data(), x.v_b.data());
    }
    for (const bool state : {false, true})
    {
        ins_innovation_t z[3] = {{1, INS_C(0.1), 0, 0}, {1, INS_C(0.1), 0, 0}, {1, INS_C(0.1), 0, 0}};
        ins_innovation_t c_z[3] = {z[0], z[1], z[2]};
        ASSERT_EQ(state ? p.update_state(INS_KF15_P, z[0]) : p.update(h, z[0]), ins::Status::Ok);
        ASSERT_EQ(state ? ud.update_state(INS_KF15_P, z[1]) : ud.update(h, z[1]), ins::Status::Ok);
        ASSERT_EQ(scale.update(beside, h, h_s, z[2]), ins::Status::Ok);
        ASSERT_EQ(state ? ins_kf15_update_state(&c_p, INS_KF15_P, &c_z[0]) : ins_kf15_update(&c_p, h.data(), &c_z[0]),
                  INS_OK);
        ASSERT_EQ(state ? ins_kf15_ud_update_state(&c_ud, INS_KF15_P, &c_z[1])
                        : ins_kf15_ud_update(&c_ud, h.data(), &c_z[1]),
                  INS_OK);
        ASSERT_EQ(ins_kf15_scale_update(&c_scale, &c_beside, h.data(), h_s.data(), &c_z[2]), INS_OK);
        EXPECT_EQ(z[0].nis, c_z[0].nis);
        EXPECT_EQ(z[1].nis, c_z[1].nis);
        EXPECT_EQ(z[2].nis, c_z[2].nis);
    }
    EXPECT_TRUE(same(model.raw, c_model));
    EXPECT_TRUE(same(p.raw, c_p));
    EXPECT_TRUE(same(ud.raw, c_ud));
    EXPECT_TRUE(same(beside.raw, c_beside));
    EXPECT_TRUE(same(scale.raw, c_scale));
    EXPECT_EQ(p.P()(3, 11), c_p.P[3 * INS_KF15_ROW + 11]);
    EXPECT_EQ(p.gain()(4), c_p.K[4]);
    EXPECT_LT(static_cast<double>((ud.P() - p.P()).cwiseAbs().maxCoeff()), 1e-3);
    EXPECT_EQ(scale.P()(1, 2), c_scale.B[(INS_KF15_N + 1) * INS_KF15_SCALE_N + 2]);
    EXPECT_EQ(scale.gain()(2), c_scale.K[2]);
    ins_real Phi[INS_KF15_N * INS_KF15_N];
    ins_kf15_transition(&c_model, Phi);
    EXPECT_EQ(model.transition()(0, 11), Phi[11]);
    EXPECT_EQ(p.init(-sigmas()), ins::Status::Range);
}

TEST(cpp_gps_ins, all_forms_have_the_bits_of_c)
{
    ins_gps_ins_config_t cfg;
    ins_gps_ins_config(&cfg);
    const ins_gps_ins_start_t from = start();
    ins::GpsIns nav;
    ins::GpsInsUd ud;
    ins::GpsInsScale scaled;
    ASSERT_EQ(nav.init(cfg, from), ins::Status::Ok);
    ASSERT_EQ(ud.init(cfg, from), ins::Status::Ok);
    ASSERT_EQ(scaled.init(cfg, SCALES, from), ins::Status::Ok);
    ins_gps_ins_t c_nav = nav.raw;
    ins_gps_ins_ud_t c_ud = ud.raw;
    ins_gps_ins_scale_t c_scaled = scaled.raw;
    for (int k = 1; k <= 60; k++)
    {
        const ins::Increment x = sample(k);
        const ins_increment_t in = x.raw();
        ASSERT_EQ(nav.step(k * PERIOD_NS, PERIOD, x), ins::Status::Ok);
        ASSERT_EQ(ud.step(k * PERIOD_NS, PERIOD, x), ins::Status::Ok);
        ASSERT_EQ(scaled.step(k * PERIOD_NS, PERIOD, x), ins::Status::Ok);
        for (ins_gps_ins_t* c : {&c_nav, &c_ud.base, &c_scaled.base})
        {
            ASSERT_EQ(ins_gps_ins_step(c, k * PERIOD_NS, PERIOD, &in), INS_OK);
        }
    }
    const auto use = [](auto& filter)
    {
        EXPECT_EQ(filter.gnss(fix(60)), ins::Status::Ok);
        EXPECT_EQ(filter.odometer(10, 5), ins::Status::Ok);
        EXPECT_EQ(filter.altitude(100, 50), ins::Status::Ok);
        EXPECT_EQ(filter.yaw_rate(INS_C(0.2), INS_C(0.1)), ins::Status::Ok);
        EXPECT_EQ(filter.zaru({INS_C(0.01), 0, 0}), ins::Status::Gate) << "it turns";
        EXPECT_EQ(filter.zupt(), ins::Status::Gate) << "it moves";
        (void)filter.nhc();
        EXPECT_EQ(filter.base().count.fixes, 1u);
    };
    use(nav);
    use(ud);
    use(scaled);
    for (ins_gps_ins_t* c : {&c_nav, &c_ud.base, &c_scaled.base})
    {
        const ins_gnss_fix_t f = fix(60);
        const ins_real w[3] = {INS_C(0.01), 0, 0};
        (void)ins_gps_ins_gnss(c, &f);
        (void)ins_gps_ins_odometer(c, 10, 5);
        (void)ins_gps_ins_altitude(c, 100, 50);
        (void)ins_gps_ins_yaw_rate(c, INS_C(0.2), INS_C(0.1));
        (void)ins_gps_ins_zaru(c, w);
        (void)ins_gps_ins_zupt(c);
        (void)ins_gps_ins_nhc(c);
    }
    EXPECT_TRUE(same(nav.raw, c_nav));
    EXPECT_TRUE(same(ud.raw, c_ud));
    EXPECT_TRUE(same(scaled.raw, c_scaled));
    ins_gps_ins_state_t want;
    ins_gps_ins_state(&c_nav, &want);
    const ins::GpsInsState s = nav.state();
    EXPECT_EQ(s.t_ns, 60 * PERIOD_NS);
    EXPECT_EQ(s.q_nb.z(), want.q_nb[3]);
    EXPECT_EQ(s.v_n.x(), want.v_n[0]);
    EXPECT_EQ(s.position.offset.x(), want.position.offset[0]);
    EXPECT_EQ(s.gyro_bias.z(), want.gyro_bias[2]);
    EXPECT_EQ(s.accel_bias.y(), want.accel_bias[1]);
    EXPECT_EQ(s.P_phi(0, 1), want.P_phi[1]);
    EXPECT_EQ(s.P_v(1, 2), want.P_v[5]);
    EXPECT_EQ(s.P_p(2, 2), want.P_p[8]);
    EXPECT_EQ(s.sigma(14), want.sigma[14]);
    EXPECT_NE(scaled.gyro().z(), 0);
    EXPECT_EQ(scaled.gyro().z(), c_scaled.gyro[2]);
    EXPECT_EQ(scaled.accel().x(), c_scaled.accel[0]);
    EXPECT_EQ(scaled.init(cfg, {1, 0, 1000, 1000}, from), ins::Status::Range);
    EXPECT_TRUE(same(scaled.raw, c_scaled)) << "refused: nothing has changed";
}

TEST(cpp_gps_ins, a_start_at_rest_with_a_known_heading)
{
    ins_gps_ins_config_t cfg;
    ins_gps_ins_config(&cfg);
    cfg.still = {50, INS_C(2e-3), INS_C(0.05), INS_C(0.01)};
    ins_gps_ins_align_config_t how;
    ins_gps_ins_align_config(&how);
    ins::GpsInsAlign align;
    ASSERT_EQ(align.init(cfg, how), ins::Status::Ok);
    ins_gps_ins_start_t found = {};
    ins_gnss_fix_t f = fix(0);
    f.v_n[0] = 0;
    std::fill(f.sigma_p, f.sigma_p + 3, INS_C(1.0));
    std::fill(f.sigma_v, f.sigma_v + 3, INS_C(0.1));
    const ins::Increment rest{ins::Vector3::Zero(), ins::Vector3(0, 0, INS_C(-0.0981))};
    ins::Status status = ins::Status::State;
    for (int k = 1; k <= 300 && status != ins::Status::Ok; k++)
    {
        ASSERT_EQ(align.step(k * PERIOD_NS, PERIOD, rest), ins::Status::Ok);
        if (k == 200)
        {
            ASSERT_EQ(align.heading(1, INS_C(0.05)), ins::Status::Ok);
        }
        if (k % 100 == 0)
        {
            f.t_ns = k * PERIOD_NS;
            status = align.gnss(f, found);
        }
    }
    ASSERT_EQ(status, ins::Status::Ok);
    const ins::Quaternion q(found.q_nb[0], found.q_nb[1], found.q_nb[2], found.q_nb[3]);
    EXPECT_NEAR(static_cast<double>(ins::to_euler(q).z()), 1, 0.01);
    ins::GpsIns nav;
    EXPECT_EQ(nav.init(cfg, found), ins::Status::Ok);
}

TEST(cpp_gyro_free, has_the_bits_of_c)
{
    ins_accel_t accels[6];
    ins_sixacc_paper(INS_C(0.1), accels);
    ins_gyro_free_config_t cfg = {};
    cfg.noise = INS_C(1e-3);
    cfg.bias = INS_C(1e-3);
    cfg.velocity = cfg.position = cfg.rate = INS_C(0.1);
    std::fill(cfg.attitude, cfg.attitude + 3, INS_C(0.01));
    ins::GyroFree<> g;
    ASSERT_EQ(g.init(cfg, accels, PERIOD, LEVEL, ins::Vector3::Zero(), HOME), ins::Status::Ok);
    ins_gyro_free_t c = g.raw;
    ins::Vector<6> readings;
    for (int j = 0; j < 6; j++)
    {
        readings(j) = accels[j].axis[2] * INS_C(-9.81);
    }
    for (int k = 0; k < 20; k++)
    {
        ASSERT_EQ(g.step(readings), k == 0 ? ins::Status::Start : ins::Status::Ok);
        ASSERT_EQ(ins_gyro_free_step(&c, readings.data()), k == 0 ? INS_S_START : INS_OK);
    }
    const ins::Vector3 metre(1, 1, 1), arm(INS_C(0.1), 0, 0);
    const ins_position_t home = HOME.raw();
    const ins_real still[3] = {0, 0, 0};
    ASSERT_EQ(g.fix(HOME, metre, arm), ins::Status::Ok);
    ASSERT_EQ(g.velocity(ins::Vector3::Zero(), metre), ins::Status::Ok);
    ASSERT_EQ(g.still(INS_C(0.1), INS_C(0.01)), ins::Status::Ok);
    ASSERT_EQ(ins_gyro_free_position(&c, &home, metre.data(), arm.data()), INS_OK);
    ASSERT_EQ(ins_gyro_free_velocity(&c, still, metre.data()), INS_OK);
    ASSERT_EQ(ins_gyro_free_still(&c, INS_C(0.1), INS_C(0.01)), INS_OK);
    EXPECT_TRUE(same(g.raw, c));
    ins_real sigma[INS_GYRO_FREE_N];
    ins_gyro_free_sigma(&c, sigma);
    EXPECT_EQ(g.sigma()(INS_GYRO_FREE_BF), sigma[INS_GYRO_FREE_BF]);
    EXPECT_EQ(g.q_nb().w(), c.strapdown.sculling.q_nb[0]);
    EXPECT_EQ(g.v_n().z(), c.strapdown.v_n[2]);
    EXPECT_EQ(g.position().anchor.x(), home.anchor[0]);
    EXPECT_EQ(g.w_ib_b().y(), c.sixacc.w_ib_b[1]);
    EXPECT_EQ(g.fix(HOME, -metre), ins::Status::Range);
}
