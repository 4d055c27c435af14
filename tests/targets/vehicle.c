/// \file   vehicle.c
/// \brief  GPS axis filter, dead reckoning and its two filters. Sines and cosines are the core's own: the same bits everywhere.
/// SPDX-License-Identifier: MIT
#include "report.h"

#define T_S INS_C(0.1)

static void gps_axis(void)
{
    static const ins_real var[4] = {100, 25, 1, 25};
    for (int current = 0; current < 2; current++)
    {
        const ins_gps_axis_config_t cfg = {1, 20, 100, 1, 5, 9, INS_KALMAN_GATE_999, (ins_real)(3 * current)};
        ins_gps_axis_t self;
        same_begin(current ? "gps_axis_current" : "gps_axis");
        same_integer((uint32_t)ins_gps_axis_init(&self, &cfg, var));
        same_reals(self.Phi, 16);
        same_reals(self.Q, 16);
        for (int k = 0; k < STEPS; k++)
        {
            ins_real nis = 0;
            same_integer((uint32_t)ins_gps_axis_step(&self, random_real(10), &nis));
            same_real(nis);
            same_reals(self.x, 4);
            same_reals(self.P, 16);
            same_reals(self.K, 4);
        }
        ins_gps_axis_predict(&self);
        same_reals(self.x, 4);
        same_end();
    }
}

static void dead_reckoning(void)
{
    ins_real pose[3] = {10, -20, 1};
    same_begin("dead_reckoning");
    for (int k = 0; k < STEPS; k++)
    {
        const ins_real turn = random_real(k % 8 == 7 ? 500 : INS_C(0.3));
        same_integer((uint32_t)ins_dead_reckoning_step(pose, random_real(2), turn));
        same_reals(pose, 3);
    }
    same_end();
}

static void dr_ekf(void)
{
    static const ins_real x[6] = {0, 0, 3, 7, 0, 0};
    static const ins_real var[6] = {9, 9, 4, 4, 1, 1};
    const ins_dr_ekf_config_t cfg = {T_S,           {5, 5},     {1, 1},      INS_C(7.6e-5),
                                     INS_C(0.0025), INS_C(0.5), INS_C(1e-3), INS_KALMAN_GATE_999};
    ins_dr_ekf_t self;
    same_begin("dr_ekf");
    same_integer((uint32_t)ins_dr_ekf_init(&self, &cfg, x, var));
    for (int k = 0; k < STEPS; k++)
    {
        const ins_real rate = random_real(INS_C(0.2));
        same_integer((uint32_t)ins_dr_ekf_step(&self, rate, INS_C(0.8) + random_real(INS_C(0.1))));
        same_integer(self.used);
        same_reals(self.nis, 2);
        same_reals(self.x, 6);
        same_reals(self.P, 36);
    }
    same_end();
}

static void unicycle(void)
{
    static const ins_real x[6] = {0, 0, 1, 8, 0, 1};
    static const ins_real var[6] = {9, 9, INS_C(0.1), 1, INS_C(3e-4), INS_C(1e-4)};
    const ins_unicycle_config_t cfg = {
        4, INS_C(1e-10), INS_C(1e-10), INS_C(7.6e-5), INS_C(0.0025), INS_KALMAN_GATE_999, INS_KALMAN_GATE2_99};
    ins_unicycle_t self;
    same_begin("unicycle");
    same_integer((uint32_t)ins_unicycle_init(&self, &cfg, x, var));
    for (int k = 0; k < STEPS; k++)
    {
        const ins_real distance = INS_C(0.8) + random_real(INS_C(0.1));
        const ins_real rate = random_real(INS_C(0.2));
        ins_real nis = 0;
        same_integer((uint32_t)ins_unicycle_odometer(&self, T_S, distance, &nis));
        same_integer((uint32_t)ins_unicycle_predict(&self, T_S, rate));
        if (k % 8 == 7)
        {
            const ins_real east = self.x[0] + random_real(5);
            const ins_real north = self.x[1] + random_real(5);
            same_integer((uint32_t)ins_unicycle_gps(&self, east, north, 9, &nis));
            same_integer((uint32_t)ins_unicycle_still(&self, rate, 1));
        }
        same_real(nis);
        same_reals(self.x, 6);
        same_reals(self.P, 36);
    }
    same_end();
}

void run_vehicle(void)
{
    gps_axis();
    dead_reckoning();
    dr_ekf();
    unicycle();
}
