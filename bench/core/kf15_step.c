/// \file   kf15_step.c
/// \brief  A load for callgrind: N steps of a strapdown with the covariance of its 15 errors, and six scalars after each. As strapdown_step.c.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#include <stdio.h>
#include <stdlib.h>

#define SAMPLES 16
#define PERIOD  INS_C(0.01)
#define SCALARS 6

typedef struct load_t
{
    ins_strapdown_t strapdown;
    ins_kf15_model_t model;
    ins_kf15_t filter;
    ins_kf15_ud_t factors;
} load_t;

/// What callgrind counts: a strapdown step, its model, and the covariance in either form; then six scalars.
int bench_kf15_propagate(load_t* self, const ins_increment_t* increment);
int bench_kf15_ud_propagate(load_t* self, const ins_increment_t* increment);
int bench_kf15_update6(load_t* self);
int bench_kf15_ud_update6(load_t* self);
int bench_kf15_lever6(load_t* self);

int bench_kf15_propagate(load_t* self, const ins_increment_t* increment)
{
    const ins_status_t status = ins_strapdown_step(&self->strapdown, increment);
    ins_kf15_model(&self->model, &self->strapdown, increment->v_b);
    ins_kf15_propagate(&self->filter, &self->model);
    return status;
}

int bench_kf15_ud_propagate(load_t* self, const ins_increment_t* increment)
{
    const ins_status_t status = ins_strapdown_step(&self->strapdown, increment);
    ins_kf15_model(&self->model, &self->strapdown, increment->v_b);
    ins_kf15_ud_propagate(&self->factors, &self->model);
    return status;
}

int bench_kf15_update6(load_t* self)
{
    for (unsigned i = 0; i < SCALARS; i++)
    {
        ins_innovation_t z = {INS_C(0.1), INS_C(0.01), 0, 0};
        if (ins_kf15_update_state(&self->filter, INS_KF15_V + i, &z) != INS_OK)
        {
            return 1;
        }
    }
    return 0;
}

int bench_kf15_lever6(load_t* self)
{
    // Velocity and position of an antenna: three and two attitude errors, three gyro biases beside its own.
    static const ins_real h[SCALARS][INS_KF15_N] = {
        {0, INS_C(.1), INS_C(-.2), 1, 0, 0, 0, 0, 0, 1, INS_C(-2.0), INS_C(.5)},
        {INS_C(-.1), 0, INS_C(.3), 0, 1, 0, 0, 0, 0, INS_C(.3), 1, INS_C(-1.0)},
        {INS_C(.2), INS_C(-.3), 0, 0, 0, 1, 0, 0, 0, INS_C(-1.0), 2, INS_C(.1)},
        {0, 2, INS_C(.5), 0, 0, 0, 1},
        {INS_C(-2.0), 0, 1, 0, 0, 0, 0, 1},
        {INS_C(-.5), -1, 0, 0, 0, 0, 0, 0, 1}};
    for (unsigned i = 0; i < SCALARS; i++)
    {
        ins_innovation_t z = {INS_C(0.1), INS_C(0.01), 0, 0};
        if (ins_kf15_update(&self->filter, h[i], &z) != INS_OK)
        {
            return 1;
        }
    }
    return 0;
}

int bench_kf15_ud_update6(load_t* self)
{
    for (unsigned i = 0; i < SCALARS; i++)
    {
        ins_innovation_t z = {INS_C(0.1), INS_C(0.01), 0, 0};
        if (ins_kf15_ud_update_state(&self->factors, INS_KF15_V + i, &z) != INS_OK)
        {
            return 1;
        }
    }
    return 0;
}

int main(int argc, char** argv)
{
    const unsigned long steps = argc > 1 ? strtoul(argv[1], NULL, 10) : 1000;
    const ins_real level[4] = {1, 0, 0, 0};
    const ins_real velocity[3] = {100, 50, -1};
    const ins_position_t start = {{INS_C(0.4), 2, 100}, {0, 0, 0}};
    const ins_kf15_sensors_t sensors = {INS_C(1e-4), INS_C(1e-3), INS_C(1e-4), 300, INS_C(1e-2), 300};
    const ins_real sigma[INS_KF15_N] = {INS_C(.01),  INS_C(.01),  INS_C(.1),  1,          1,
                                        1,           10,          10,         10,         INS_C(1e-4),
                                        INS_C(1e-4), INS_C(1e-4), INS_C(.01), INS_C(.01), INS_C(.01)};
    ins_increment_t increment[SAMPLES];
    for (int i = 0; i < SAMPLES; i++)
    {
        for (int axis = 0; axis < 3; axis++)
        {
            increment[i].theta_b[axis] = (ins_real)(i % (5 + axis) - 2) * INS_C(0.01);
            increment[i].v_b[axis] = (ins_real)(i % (7 - axis) - 3) * INS_C(0.02);
        }
    }
    static load_t load;
    if (ins_strapdown_init(&load.strapdown, INS_CONING_HIST2_OPT, PERIOD, level, velocity, &start) != INS_OK ||
        ins_kf15_model_init(&load.model, PERIOD, &sensors) != INS_OK || ins_kf15_init(&load.filter, sigma) != INS_OK ||
        ins_kf15_ud_init(&load.factors, sigma) != INS_OK)
    {
        return 1;
    }
    for (unsigned long k = 0; k < steps; k++)
    {
        if (bench_kf15_propagate(&load, &increment[2 * k % SAMPLES]) < 0 ||
            bench_kf15_ud_propagate(&load, &increment[(2 * k + 1) % SAMPLES]) < 0 || bench_kf15_update6(&load) ||
            bench_kf15_ud_update6(&load) || bench_kf15_lever6(&load))
        {
            return 1;
        }
    }
    printf("%.9g %.9g\n", (double)load.filter.P[0], (double)load.factors.D[0]);
    return 0;
}
