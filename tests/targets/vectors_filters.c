/// \file   vectors_filters.c
/// \brief  kalman_pva.json and the fusion, switch and GPS axis of gps_dr.json on the target.
/// SPDX-License-Identifier: MIT
#include "tape.h"

#define FUSED_MAX 4 // states

static void diagonal(const ins_real* P, unsigned n, ins_real* out)
{
    for (unsigned i = 0; i < n; i++)
    {
        out[i] = P[(n + 1) * i];
    }
}

static void pva(void)
{
    for (unsigned cases = tape_section("kalman_pva", INS_TOL(INS_C(1e-12), INS_C(3e-5))); cases > 0; cases--)
    {
        ins_real var[3];
        ins_real r[2];
        ins_pva_t self;
        const ins_real T = tape_real();
        const ins_real q = tape_real();
        const int rows = (int)tape_integer();
        tape_reals(r, 2);
        tape_reals(var, 3);
        check_true(ins_pva_init(&self, var) == INS_OK);
        for (unsigned epochs = (unsigned)tape_integer(); epochs > 0; epochs--)
        {
            check_true(ins_pva_predict(&self, T, q) == INS_OK);
            for (int row = 0; row < rows; row++)
            {
                ins_innovation_t z = {tape_real() - self.x[row], r[row], 0, 0};
                check_true(ins_pva_update(&self, row, &z) == INS_OK);
            }
            if (tape_integer())
            {
                ins_real P[3];
                diagonal(self.P, 3, P);
                check_together(self.x, 3, INS_C(1e-3));
                check_together(P, 3, INS_C(1e-3));
            }
        }
    }
    check_end();
}

static void gps_axis(void)
{
    for (unsigned cases = tape_section("gps_dr.gps", INS_TOL(INS_C(1e-11), INS_C(2e-3))); cases > 0; cases--)
    {
        ins_real cfg[6];
        ins_real var[4];
        ins_gps_axis_t self;
        tape_reals(cfg, 6);
        tape_reals(var, 4);
        const ins_gps_axis_config_t config = {cfg[0], cfg[1], cfg[2], cfg[3], cfg[4], cfg[5], 0, 0};
        check_true(ins_gps_axis_init(&self, &config, var) == INS_OK);
        for (unsigned epochs = (unsigned)tape_integer(); epochs > 0; epochs--)
        {
            check_true(ins_gps_axis_step(&self, tape_real(), 0) == INS_OK);
            if (tape_integer())
            {
                diagonal(self.P, 4, var);
                check_reals(self.x, 4);
                check_reals(var, 4);
                check_reals(self.K, 4);
            }
        }
    }
    check_end();
}

static void fusion(void)
{
    for (unsigned cases = tape_section("gps_dr.fusion", INS_TOL(INS_C(1e-12), INS_C(2e-5))); cases > 0; cases--)
    {
        const unsigned n = (unsigned)tape_integer();
        ins_real info[FUSED_MAX * FUSED_MAX];
        ins_real y[FUSED_MAX];
        ins_real x[FUSED_MAX];
        ins_real P[FUSED_MAX * FUSED_MAX];
        ins_real work[FUSED_MAX * FUSED_MAX];
        const unsigned estimates = (unsigned)tape_integer();
        if (n > FUSED_MAX)
        {
            check_true(0);
            break;
        }
        ins_fusion_clear(n, info, y);
        for (unsigned i = 0; i < estimates; i++)
        {
            tape_reals(x, n);
            tape_reals(P, n * n);
            check_true(ins_fusion_add(n, info, y, x, P, work) == INS_OK);
        }
        check_true(ins_fusion_solve(n, info, y, x, P) == INS_OK);
        check_reals(x, n);
        check_reals(P, n * n);
    }
    check_end();
}

static void choice(void)
{
    for (unsigned cases = tape_section("gps_dr.switch", 0); cases > 0; cases--)
    {
        const ins_real hdop_max = tape_real();
        const ins_real gate = tape_real();
        const uint_least8_t sats = (uint_least8_t)tape_integer();
        const ins_switch_config_t cfg = {hdop_max, gate, sats, (uint_least8_t)tape_integer()};
        ins_switch_t self;
        check_true(ins_switch_init(&self, &cfg) == INS_OK);
        for (unsigned epochs = (unsigned)tape_integer(); epochs > 0; epochs--)
        {
            const int valid = (int)tape_integer();
            const unsigned seen = (unsigned)tape_integer();
            const ins_real hdop = tape_real();
            const ins_real nis = tape_real();
            check_true(ins_switch_epoch(&self, valid, seen, hdop, nis) == (int)tape_integer());
            check_true(self.good == tape_integer());
        }
    }
    check_end();
}

void check_filters(void)
{
    pva();
    gps_axis();
    fusion();
    choice();
}
