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
    pva();
    markov();
    fusion();
    choice();
}
