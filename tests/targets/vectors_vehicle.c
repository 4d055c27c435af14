/// \file   vectors_vehicle.c
/// \brief  Dead reckoning, its extended filter and the unicycle of gps_dr.json on the target.
/// SPDX-License-Identifier: MIT
#include "tape.h"

#define TURN    INS_C(6.28318530717958648)
#define RUN_TOL INS_TOL(INS_C(1e-11), INS_C(2e-3))

/// The same angle within half a turn of `near`.
static ins_real beside(ins_real angle, ins_real near)
{
    return angle - near > TURN / 2 ? angle - TURN : near - angle > TURN / 2 ? angle + TURN : angle;
}

static void check_state(const ins_real x[6], const ins_real P[36], int heading)
{
    ins_real want[6];
    tape_reals(want, 6);
    for (int i = 0; i < 6; i++)
    {
        const ins_real got = i == heading ? beside(x[i], want[i]) : x[i];
        check(got, want[i], ins_fabs(want[i]) > 1 ? ins_fabs(want[i]) : 1);
    }
    for (int i = 0; i < 6; i++)
    {
        check_reals(&P[7 * i], 1);
    }
}

static void dead_reckoning(void)
{
    for (unsigned cases = tape_section("gps_dr.dead_reckoning", INS_TOL(INS_C(1e-15), INS_C(1e-6))); cases > 0; cases--)
    {
        ins_real pose[3];
        tape_reals(pose, 3);
        const ins_real distance = tape_real();
        check_true(ins_dead_reckoning_step(pose, distance, tape_real()) == INS_OK);
        check(pose[0], tape_real(), 100);
        check(pose[1], tape_real(), 100);
        const ins_real want = tape_real();
        check(beside(pose[2], want), want, 1);
    }
    check_end();
}

static void filter(void)
{
    for (unsigned cases = tape_section("gps_dr.dr", RUN_TOL); cases > 0; cases--)
    {
        ins_real cfg[9];
        ins_real x[6];
        ins_real var[6];
        ins_dr_ekf_t self;
        tape_reals(cfg, 9);
        tape_reals(x, 6);
        tape_reals(var, 6);
        const ins_dr_ekf_config_t config = {cfg[0], {cfg[1], cfg[2]}, {cfg[3], cfg[4]}, cfg[5],
                                            cfg[6], cfg[7],           cfg[8],           0};
        check_true(ins_dr_ekf_init(&self, &config, x, var) == INS_OK);
        for (unsigned steps = (unsigned)tape_integer(); steps > 0; steps--)
        {
            const ins_real rate = tape_real();
            check_true(ins_dr_ekf_step(&self, rate, tape_real()) == INS_OK);
            if (tape_integer())
            {
                check_state(self.x, self.P, -1);
            }
        }
    }
    check_end();
}

static void unicycle(void)
{
    for (unsigned cases = tape_section("gps_dr.unicycle", RUN_TOL); cases > 0; cases--)
    {
        ins_real cfg[7];
        ins_real x[6];
        ins_real var[6];
        ins_unicycle_t self;
        tape_reals(cfg, 7); // T, then the five noises, then the variance of a fix
        tape_reals(x, 6);
        tape_reals(var, 6);
        const ins_unicycle_config_t config = {cfg[1], cfg[2], cfg[3], cfg[4], cfg[5], 0, 0};
        check_true(ins_unicycle_init(&self, &config, x, var) == INS_OK);
        for (unsigned steps = (unsigned)tape_integer(); steps > 0; steps--)
        {
            const ins_real rate = tape_real();
            check_true(ins_unicycle_odometer(&self, cfg[0], tape_real(), 0) == INS_OK);
            check_true(ins_unicycle_predict(&self, cfg[0], rate) == INS_OK);
            if (tape_integer())
            {
                const ins_real east = tape_real();
                check_true(ins_unicycle_gps(&self, east, tape_real(), cfg[6], 0) == INS_OK);
            }
            if (tape_integer())
            {
                check_state(self.x, self.P, INS_UNICYCLE_HEADING);
            }
        }
    }
    check_end();
}

void check_vehicle(void)
{
    dead_reckoning();
    filter();
    unicycle();
}
