/// \file   navigation.c
/// \brief  Sculling, strapdown, the Earth, six accelerometers, alignment, GIMU scaling. No libm but sqrt: the same bits everywhere.
/// SPDX-License-Identifier: MIT
#include "report.h"

#define RHO_M INS_C(0.1)

static const ins_real level[4] = {1, 0, 0, 0};

static void random_increment(ins_increment_t* out)
{
    random_reals(INS_C(0.05), out->theta_b, 3);
    random_reals(INS_C(0.2), out->v_b, 3);
    out->v_b[2] -= INS_C(0.0980665);
}

static void sculling(void)
{
    same_begin("sculling");
    for (int form = 0; form < INS_CONING_FORM_COUNT; form++)
    {
        ins_increment_t block[INS_CONING_SAMPLES_MAX];
        ins_sculling_t self;
        ins_real dv[3];
        for (int i = 0; i < INS_CONING_SAMPLES_MAX; i++)
        {
            random_increment(&block[i]);
        }
        same_integer((uint32_t)ins_sculling_dv(form, block, dv));
        same_reals(dv, 3);
        if (ins_sculling_init(&self, form, level) != INS_OK)
        {
            continue;
        }
        for (int k = 0; k < STEPS; k++)
        {
            random_increment(&block[0]);
            same_integer((uint32_t)ins_sculling_step(&self, &block[0], dv));
            same_reals(self.q_nb, 4);
            same_reals(dv, 3);
        }
    }
    same_end();
}

static void same_position(const ins_position_t* position)
{
    same_reals(position->anchor, 3);
    same_reals(position->offset, 3);
}

static void strapdown(void)
{
    static const ins_real velocity[3] = {100, 50, -1};
    static const ins_real lever[3] = {2, INS_C(-0.5), 1};
    const ins_position_t start = {{INS_C(0.43), INS_C(2.11), 100}, {0, 0, 0}};
    ins_strapdown_t self;
    ins_position_t antenna;
    ins_real w[3];
    ins_real v[3];
    same_begin("strapdown");
    same_integer((uint32_t)ins_strapdown_init(&self, INS_CONING_HIST2_OPT, INS_C(0.01), level, velocity, &start));
    for (int k = 0; k < 2 * STEPS; k++)
    {
        ins_increment_t increment;
        random_increment(&increment);
        same_integer((uint32_t)ins_strapdown_step(&self, &increment));
        same_reals(self.sculling.q_nb, 4);
        same_reals(self.v_n, 3);
        same_position(&self.position);
    }
    random_reals(1, w, 3);
    ins_strapdown_point(&self, lever, w, v, &antenna);
    same_reals(v, 3);
    same_position(&antenna);
    ins_position_difference(&start, &antenna, v);
    same_reals(v, 3);
    same_end();
}

static void earth(void)
{
    same_begin("earth");
    for (int k = 0; k < STEPS; k++)
    {
        const ins_real s = random_real(INS_C(0.99));
        const ins_real c = ins_sqrt(1 - s * s);
        const ins_real height = random_real(INS_C(1e4));
        ins_real v[3];
        ins_real out[3];
        random_reals(300, v, 3);
        ins_earth_radii(s, out);
        same_reals(out, 2);
        same_real(ins_earth_gravity(s, height));
        ins_earth_rate(s, c, out);
        same_reals(out, 3);
        ins_earth_transport_rate(s, c, height, v, out);
        same_reals(out, 3);
    }
    same_end();
}

static void sixacc(void)
{
    ins_accel_t accels[6];
    ins_sixacc_t self;
    ins_linfit_t fit;
    same_begin("sixacc");
    ins_sixacc_paper(RHO_M, accels);
    same_integer((uint32_t)ins_sixacc_init(&self, 6, accels, INS_C(0.01)));
    same_integer((uint32_t)ins_linfit_init(&fit, 6));
    for (int k = 0; k < STEPS; k++)
    {
        ins_real readings[6];
        ins_real f[3];
        ins_increment_t increment;
        random_reals(20, readings, 6);
        random_reals(INS_C(9.8), f, 3);
        same_integer((uint32_t)ins_sixacc_step(&self, readings, &increment));
        same_reals(increment.theta_b, 3);
        same_reals(increment.v_b, 3);
        same_integer((uint32_t)ins_linfit_add(&fit, f, readings));
    }
    for (unsigned i = 0; i < 6; i++)
    {
        ins_real map[4];
        same_integer((uint32_t)ins_linfit_solve(&fit, i, map));
        same_reals(map, 4);
    }
    same_end();
}

static void accelfit(void)
{
    static const ins_real axes[3][3] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    static const ins_real guess[INS_ACCELFIT_N] = {INS_C(0.1), 1, 0, 0, 0, 0, 0, 0};
    ins_accelfit_t self;
    same_begin("accelfit");
    same_integer((uint32_t)ins_accelfit_init(&self, axes[0], axes[1], axes[2], guess));
    for (int pass = 0; pass < 2; pass++)
    {
        ins_real deviation[INS_ACCELFIT_N];
        ins_real largest = 0;
        for (int k = 0; k < STEPS; k++)
        {
            ins_accelfit_motion_t motion;
            random_reals(10, motion.f_b, 3);
            random_reals(5, motion.w_ib_b, 3);
            random_reals(20, motion.wd_ib_b, 3);
            const ins_real reading = motion.f_b[2] + random_real(INS_C(0.1));
            same_integer((uint32_t)ins_accelfit_add(&self, &motion, reading));
        }
        same_integer((uint32_t)ins_accelfit_deviation(&self, INS_C(0.01), deviation));
        same_reals(deviation, INS_ACCELFIT_N);
        same_integer((uint32_t)ins_accelfit_step(&self, &largest));
        same_real(largest);
        same_reals(self.p, INS_ACCELFIT_N);
    }
    same_end();
}

static void alignment(void)
{
    static const ins_real down[3] = {0, 0, 1};
    ins_mean_t null;
    ins_real mean[3];
    ins_real error[3];
    same_begin("align");
    same_integer((uint32_t)ins_mean_init(&null, 1));
    for (int k = 0; k < STEPS; k++)
    {
        ins_real a[3];
        ins_real b[3];
        ins_real q[4];
        random_reals(10, a, 3);
        random_reals(1, b, 3);
        same_integer((uint32_t)ins_mean_add(&null, a));
        same_integer((uint32_t)ins_align_level(a, b[0], q));
        same_reals(q, 4);
        same_integer((uint32_t)ins_align_triad(a, b, down, level, q));
        same_reals(q, 4);
    }
    same_integer((uint32_t)ins_mean_get(&null, mean, error));
    same_reals(mean, 3);
    same_reals(error, 3);
    same_end();
}

static void gimu_scaling(void)
{
    same_begin("gimu_scale");
    for (int k = 0; k < STEPS; k++)
    {
        ins_gimu_scale_t scale;
        uint16_t raw[6];
        ins_real dtheta[3];
        ins_real dv[3];
        (k % 2 ? ins_gimu_scale_thesis : ins_gimu_scale_nominal)(&scale);
        for (int i = 0; i < 6; i++)
        {
            raw[i] = (uint16_t)(random_bits() & 0xFFFu);
        }
        ins_gimu_increments(&scale, raw, INS_C(1.0) / 6, dtheta, dv);
        same_reals(dtheta, 3);
        same_reals(dv, 3);
    }
    same_end();
}

void run_navigation(void)
{
    sculling();
    strapdown();
    earth();
    sixacc();
    accelfit();
    alignment();
    gimu_scaling();
}
