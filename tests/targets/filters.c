/// \file   filters.c
/// \brief  Kalman (Joseph and UD), P-V-A, Gauss-Markov, fusion, GPS/DR switch. No libm: the same bits everywhere.
/// SPDX-License-Identifier: MIT
#include "report.h"

#define N 4

static void random_model(ins_real Phi[N * N], ins_real Q[N * N])
{
    random_reals(INS_C(0.2), Phi, N * N);
    for (unsigned i = 0; i < N; i++)
    {
        Phi[i * N + i] += INS_C(0.9);
        for (unsigned j = 0; j < N; j++)
        {
            Q[i * N + j] = i == j ? INS_C(0.02) + random_real(INS_C(0.01)) : 0;
        }
    }
}

static void identity(ins_real P[N * N], ins_real scale)
{
    for (unsigned i = 0; i < N * N; i++)
    {
        P[i] = i % (N + 1) == 0 ? scale : 0;
    }
}

static void kalman(void)
{
    ins_real x[N] = {1, -1, 2, 0};
    ins_real P[N * N];
    ins_real x_ud[N] = {1, -1, 2, 0};
    ins_real UD[INS_UD_SIZE(N)];
    ins_real work[INS_UD_WORK(N)];
    same_begin("kalman");
    identity(P, 10);
    same_integer((uint32_t)ins_ud_factor(N, P, UD, work));
    for (int k = 0; k < STEPS; k++)
    {
        ins_real Phi[N * N];
        ins_real Q[N * N];
        ins_real Q_ud[INS_UD_SIZE(N)];
        ins_real h[N];
        random_model(Phi, Q);
        random_reals(1, h, N);
        const ins_real r = INS_C(1.5) + random_real(1);
        ins_innovation_t z = {random_real(3), r, INS_KALMAN_GATE_99, 0};
        ins_innovation_t z_ud = z;
        ins_kalman_predict(N, x, P, Phi, Q, work);
        same_integer((uint32_t)ins_kalman_update(N, x, P, h, &z, work));
        same_real(z.nis);
        same_reals(x, N);
        same_reals(P, N * N);
        same_integer((uint32_t)ins_ud_factor(N, Q, Q_ud, work));
        ins_ud_predict(N, x_ud, UD, Phi, Q_ud, work);
        same_integer((uint32_t)ins_ud_update(N, x_ud, UD, h, &z_ud, work));
        same_real(z_ud.nis);
        same_reals(x_ud, N);
        same_reals(UD, INS_UD_SIZE(N));
    }
    ins_ud_covariance(N, UD, P);
    same_reals(P, N * N);
    same_end();
}

/// Both forms over a strapdown that turns and accelerates.
static void kf15(void)
{
    static ins_kf15_t f; // not on the stack of a small machine
    static ins_kf15_ud_t f_ud;
    static ins_strapdown_t s;
    static ins_kf15_model_t m;
    static const ins_real q_nb[4] = {1, 0, 0, 0};
    static const ins_real v[3] = {30, -20, 1};
    static const ins_position_t at = {{INS_C(0.4), 2, 100}, {0, 0, 0}};
    static const ins_kf15_sensors_t sensors = {INS_C(1e-4), INS_C(1e-3), INS_C(1e-4), 300, INS_C(1e-2), 200};
    ins_real sigma[INS_KF15_N];
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        sigma[i] = INS_C(0.1);
    }
    same_begin("kf15");
    same_integer((uint32_t)ins_strapdown_init(&s, INS_CONING_HIST2_OPT, INS_C(0.01), q_nb, v, &at));
    same_integer((uint32_t)ins_kf15_model_init(&m, INS_C(0.01), &sensors));
    same_integer((uint32_t)ins_kf15_init(&f, sigma));
    same_integer((uint32_t)ins_kf15_ud_init(&f_ud, sigma));
    for (unsigned k = 0; k < STEPS; k++)
    {
        ins_increment_t x;
        ins_real h[INS_KF15_N];
        random_reals(INS_C(0.01), x.theta_b, 3);
        random_reals(INS_C(0.2), x.v_b, 3);
        random_reals(1, h, INS_KF15_N);
        (void)ins_strapdown_step(&s, &x);
        ins_kf15_model(&m, &s, x.v_b);
        ins_kf15_propagate(&f, &m);
        ins_kf15_ud_propagate(&f_ud, &m);
        ins_innovation_t z = {random_real(1), 1, INS_KALMAN_GATE_99, 0};
        ins_innovation_t z_ud = z;
        if (k % 2 == 0)
        {
            same_integer((uint32_t)ins_kf15_update(&f, h, &z));
            same_integer((uint32_t)ins_kf15_ud_update(&f_ud, h, &z_ud));
        }
        else
        {
            same_integer((uint32_t)ins_kf15_update_state(&f, k % INS_KF15_N, &z));
            same_integer((uint32_t)ins_kf15_ud_update_state(&f_ud, k % INS_KF15_N, &z_ud));
        }
        same_real(z.nis);
        same_real(z_ud.nis);
        same_reals(f.K, INS_KF15_N);
        same_reals(f_ud.K, INS_KF15_N);
    }
    same_reals(f.P, INS_KF15_N * INS_KF15_ROW);
    ins_kf15_ud_covariance(&f_ud, f.P);
    same_reals(f.P, INS_KF15_N * INS_KF15_ROW);
    same_end();
}

static void pva(void)
{
    static const ins_real var[3] = {100, 10, 1};
    ins_pva_t self;
    same_begin("pva");
    same_integer((uint32_t)ins_pva_init(&self, var));
    for (int k = 0; k < STEPS; k++)
    {
        ins_innovation_t z = {random_real(2) - self.x[0], 1, INS_KALMAN_GATE_999, 0};
        same_integer((uint32_t)ins_pva_predict(&self, INS_C(0.05), 1));
        same_integer((uint32_t)ins_pva_update(&self, k % 3, &z));
        same_real(z.nis);
        same_reals(self.x, 3);
        same_reals(self.P, 9);
        same_reals(self.K, 3);
    }
    same_end();
}

static void markov(void)
{
    same_begin("markov");
    for (int k = 0; k < STEPS; k++)
    {
        ins_markov_t self = {0, 0};
        const ins_real dt = INS_C(20.0) + random_real(20);
        same_integer((uint32_t)ins_markov_init(&self, dt, INS_C(11.0) + random_real(10), INS_MARKOV_STRAPDOWN_SIGMA));
        same_real(self.phi);
        same_real(self.q);
    }
    same_end();
}

static void fusion(void)
{
    ins_real info[N * N];
    ins_real y[N];
    ins_real x[N];
    ins_real P[N * N];
    ins_real work[N * N];
    same_begin("fusion");
    ins_fusion_clear(N, info, y);
    for (int k = 0; k < STEPS; k++)
    {
        random_reals(10, x, N);
        identity(P, 3);
        for (unsigned i = 0; i + 1 < N; i++)
        {
            P[i * N + i + 1] = random_real(1);
            P[(i + 1) * N + i] = P[i * N + i + 1];
        }
        same_integer((uint32_t)ins_fusion_add(N, info, y, x, P, work));
        same_integer((uint32_t)ins_fusion_solve(N, info, y, x, P));
        same_reals(x, N);
        same_integer((uint32_t)ins_fusion_share(N, P, INS_C(0.3), work));
        same_reals(work, N * N);
    }
    same_end();
}

static void choice(void)
{
    const ins_switch_config_t cfg = {4, INS_KALMAN_GATE2_99, 4, INS_SWITCH_BACK_GOOD};
    ins_switch_t self;
    same_begin("switch");
    same_integer((uint32_t)ins_switch_init(&self, &cfg));
    for (int k = 0; k < 4 * STEPS; k++)
    {
        const unsigned bits = (unsigned)(random_bits() & 0xFFu);
        const ins_real hdop = INS_C(2.5) + random_real(2);
        same_integer((uint32_t)ins_switch_epoch(&self, bits % 8 != 0, bits / 16, hdop, INS_C(5.) + random_real(5)));
        same_integer(self.run);
    }
    same_end();
}

void run_filters(void)
{
    kalman();
    kf15();
    pva();
    markov();
    fusion();
    choice();
}
