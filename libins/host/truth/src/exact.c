/// \file   exact.c
/// \brief  Integrals of body rate and specific force of a track by adaptive Gauss-Legendre. Frame b; rad, m/s.
/// SPDX-License-Identifier: MIT
#include "ins_truth/exact.h"
#include "gauss_internal.h"
#include "track_internal.h"
#include <math.h>

#define COMPONENTS   6     ///< w_ib_b, f_b
#define AGREE        1e-11 ///< whole and halves, relative: the halves' error is 2^20 times smaller
#define AGREE_RATE   1e-15 ///< below it a rate is rounding [rad/s]
#define AGREE_FORCE  1e-14 ///< likewise [m/s^2]
#define HALVINGS_MAX 30

static void sensed_at(const void* track, double t, double value[])
{
    ins_track_state_t s;
    ins_track_at(track, t, &s);
    for (int i = 0; i < 3; i++)
    {
        value[i] = s.w_ib_b[i];
        value[i + 3] = s.f_b[i];
    }
}

static double largest(const double x[3])
{
    const double a = fabs(x[0]);
    const double b = fabs(x[1]);
    const double c = fabs(x[2]);
    const double ab = a > b ? a : b;
    return ab > c ? ab : c;
}

static bool agree(const double whole[3], const double halves[3], double floor_of_sum)
{
    const double difference[3] = {whole[0] - halves[0], whole[1] - halves[1], whole[2] - halves[2]};
    return !(largest(difference) > AGREE * largest(halves) + floor_of_sum);
}

static void add_interval(const ins_track_t* track, double a, double b, const double whole[COMPONENTS], int halvings,
                         double sum[COMPONENTS])
{
    const double middle = 0.5 * (a + b);
    double first[COMPONENTS] = {0.0};
    double second[COMPONENTS] = {0.0};
    double halves[COMPONENTS];
    ins_gauss_add(sensed_at, track, a, middle, COMPONENTS, first);
    ins_gauss_add(sensed_at, track, middle, b, COMPONENTS, second);
    for (int i = 0; i < COMPONENTS; i++)
    {
        halves[i] = first[i] + second[i];
    }
    if (halvings == 0 ||
        (agree(whole, halves, AGREE_RATE * (b - a)) && agree(whole + 3, halves + 3, AGREE_FORCE * (b - a))))
    {
        for (int i = 0; i < COMPONENTS; i++)
        {
            sum[i] += halves[i];
        }
        return;
    }
    add_interval(track, a, middle, first, halvings - 1, sum);
    add_interval(track, middle, b, second, halvings - 1, sum);
}

void ins_truth_increment(const ins_track_t* track, double t0, double t1, double theta[3], double v[3])
{
    const double sense = t1 < t0 ? -1.0 : 1.0;
    const double end = t1 < t0 ? t0 : t1;
    const double panel_s = ins_track_panel(track);
    double t = t1 < t0 ? t1 : t0;
    double sum[COMPONENTS] = {0.0};
    if (!(fabs(t0) <= INS_TRACK_TIME_MAX_S) || !(fabs(t1) <= INS_TRACK_TIME_MAX_S))
    {
        theta[0] = theta[1] = theta[2] = v[0] = v[1] = v[2] = (double)NAN;
        return;
    }
    while (t < end)
    {
        const double next = ins_track_next_break(track, t);
        const double stop = next < end ? next : end;
        const double panels = floor((stop - t) / panel_s) + 1.0;
        const double width = (stop - t) / panels;
        for (double k = 0.0; k < panels; k += 1.0)
        {
            double whole[COMPONENTS] = {0.0};
            ins_gauss_add(sensed_at, track, t + k * width, t + (k + 1.0) * width, COMPONENTS, whole);
            add_interval(track, t + k * width, t + (k + 1.0) * width, whole, HALVINGS_MAX, sum);
        }
        t = stop;
    }
    for (int i = 0; i < 3; i++)
    {
        theta[i] = sense * sum[i];
        v[i] = sense * sum[i + 3];
    }
}
