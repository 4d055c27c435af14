/// \file   vectors_navigation.c
/// \brief  sculling.json, sixacc.json, calib_linear.json and geodesy.json on the target.
/// SPDX-License-Identifier: MIT
#include "tape.h"

#define PERIOD_S INS_C(0.02) // not used by what is compared

static void sculling(void)
{
    static const int forms[] = {INS_CONING_ONE, INS_CONING_HIST1, INS_CONING_HIST2_OPT};
    for (unsigned cases = tape_section("sculling", INS_TOL(INS_C(1e-12), INS_C(3e-7))); cases > 0; cases--)
    {
        ins_increment_t recent[3]; // oldest first
        const unsigned rows = (unsigned)tape_integer();
        tape_reals(recent[1].theta_b, 3);
        tape_reals(recent[1].v_b, 3);
        tape_reals(recent[2].theta_b, 3);
        tape_reals(recent[2].v_b, 3);
        for (unsigned k = 0; k < rows; k++)
        {
            recent[0] = recent[1];
            recent[1] = recent[2];
            tape_reals(recent[2].theta_b, 3);
            tape_reals(recent[2].v_b, 3);
            for (int i = 0; i < 3; i++)
            {
                ins_real dv[3];
                check_true(ins_sculling_dv(forms[i], recent + 3 - ins_coning_samples(forms[i]), dv) == INS_OK);
                check_together(dv, 3, 0);
            }
        }
    }
    check_end();
}

static void sixacc(void)
{
    for (unsigned cases = tape_section("sixacc", INS_TOL(INS_C(1e-12), INS_C(1e-6))); cases > 0; cases--)
    {
        const ins_real rho = tape_real();
        ins_accel_t accels[6];
        ins_sixacc_t self;
        ins_sixacc_paper(rho, accels);
        check_true(ins_sixacc_init(&self, 6, accels, PERIOD_S) == INS_OK);
        for (unsigned rows = (unsigned)tape_integer(); rows > 0; rows--)
        {
            ins_real readings[6];
            ins_real w[3];
            ins_real wd[3];
            ins_real f[3];
            ins_real largest = 0;
            tape_reals(readings, 6);
            tape_reals(w, 3);
            ins_sixacc_resolve(&self, readings, w, wd, f);
            for (int i = 0; i < 6; i++)
            {
                largest = ins_fabs(readings[i]) > largest ? ins_fabs(readings[i]) : largest;
            }
            for (int i = 0; i < 3; i++)
            {
                check(wd[i], tape_real(), largest / rho);
            }
            for (int i = 0; i < 3; i++)
            {
                check(f[i], tape_real(), largest);
            }
        }
    }
    check_end();
}

static void linear_maps(void)
{
    for (unsigned cases = tape_section("calib_linear", INS_TOL(INS_C(1e-12), INS_C(2e-6))); cases > 0; cases--)
    {
        ins_linfit_t fit;
        check_true(ins_linfit_init(&fit, 3) == INS_OK);
        for (unsigned attitudes = (unsigned)tape_integer(); attitudes > 0; attitudes--)
        {
            ins_real f[3];
            ins_real readings[3];
            tape_reals(f, 3);
            tape_reals(readings, 3);
            check_true(ins_linfit_add(&fit, f, readings) == INS_OK);
        }
        for (unsigned i = 0; i < 3; i++)
        {
            ins_real map[4] = {0, 0, 0, 0};
            check_true(ins_linfit_solve(&fit, i, map) == INS_OK);
            check_reals(map, 4);
        }
    }
    check_end();
}

static void ecef(void)
{
    for (unsigned cases = tape_section("geodesy.ecef", INS_TOL(INS_C(1e-8), INS_C(6.0))); cases > 0; cases--)
    {
        ins_real llh[3];
        ins_real xyz[3];
        ins_real want[3];
        tape_reals(llh, 3);
        tape_reals(want, 3);
        check_true(ins_geodesy_to_ecef(&ins_grs80, llh, xyz) == INS_OK);
        for (int i = 0; i < 3; i++)
        {
            check(xyz[i], want[i], 1);
        }
        check_true(ins_geodesy_from_ecef(&ins_grs80, want, xyz) == INS_OK);
        check(xyz[2], llh[2], 1);
    }
    check_end();
}

static void grid(void)
{
    for (unsigned cases = tape_section("geodesy.twd97", INS_TOL(INS_C(1e-6), INS_C(2.0))); cases > 0; cases--)
    {
        ins_tm_t tm;
        ins_real en[2];
        check_true(ins_tm_init_twd97(&tm, (int)tape_integer()) == INS_OK);
        const ins_real lat = tape_real();
        const ins_real lon = tape_real();
        check_true(ins_tm_forward(&tm, lat, lon, en, 0) == INS_OK);
        check(en[0], tape_real(), 1);
        check(en[1], tape_real(), 1);
    }
    check_end();
}

void check_navigation(void)
{
    sculling();
    sixacc();
    linear_maps();
    ecef();
    grid();
}
