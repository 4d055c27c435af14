/// \file   gps_ins_watch.c
/// \brief  What can be wrong with IMU samples: their time, dead axes; and rest, which they show. Frame: b. SI, rad.
/// SPDX-License-Identifier: MIT
#include "gps_ins_internal.h"
#include "ins/ins_math.h"

#define CLOCK_SAMPLES 8 ///< in a row, each a period after the one before, show that it is the clock that has stepped
#define SAME          (8 * INS_EPSILON) ///< two rates this near, relatively, are one value

ins_status_t ins_gps_ins_follow(ins_gps_ins_t* self, int64_t t_ns, ins_real dt, ins_real* gap)
{
    if (t_ns > INS_GNSS_TIME_MAX_NS || t_ns < -INS_GNSS_TIME_MAX_NS)
    {
        self->count.imu_time++;
        return INS_E_RANGE;
    }
    const int64_t ahead = t_ns - self->t_ns;
    const ins_real missing = (ins_real)ahead * NS_TO_S - dt;
    *gap = missing > dt / 2 ? missing : 0;
    if (ahead <= 0 || missing > self->cfg.gap_max)
    {
        const ins_real since = (ins_real)(t_ns - self->odd_t_ns) * NS_TO_S;
        self->odd = self->odd > 0 && since > dt / 2 && since < dt + dt / 2 ? (uint16_t)(self->odd + 1) : 1;
        self->odd_t_ns = t_ns;
        if (self->odd < CLOCK_SAMPLES)
        {
            self->count.imu_time++;
            return INS_E_RANGE;
        }
        *gap = (CLOCK_SAMPLES - 1) * dt;
        if (ahead > 0 || *gap > self->cfg.gap_max)
        {
            self->lost = 1;
            return INS_E_STATE;
        }
        self->count.imu_clock++;
        self->held = 0;
    }
    self->odd = 0;
    self->t_ns = t_ns;
    return INS_OK;
}

/// Bits of the three axes from `first` that repeat one value while another of them lives.
static unsigned dead(const ins_gps_ins_t* self, unsigned first)
{
    unsigned bits = 0;
    unsigned alive = 0;
    for (unsigned i = first; i < first + 3; i++)
    {
        alive |= self->same[i] < self->cfg.stuck / 2;
        bits |= self->same[i] >= self->cfg.stuck ? 1u << i : 0;
    }
    return alive ? bits : 0;
}

static void watch_axes(ins_gps_ins_t* self, const ins_increment_t* raw)
{
    int repeats = 0;
    for (unsigned i = 0; i < 6; i++)
    {
        const ins_real x = (i < 3 ? raw->theta_b[i] : raw->v_b[i - 3]) / self->dt;
        if (!(ins_fabs(x - self->value[i]) <= SAME * ins_fabs(x)))
        {
            self->same[i] = 0;
        }
        else
        {
            repeats = 1;
            self->same[i] = (uint16_t)(self->same[i] + (self->same[i] < self->cfg.stuck));
        }
        self->value[i] = x;
    }
    const unsigned now = repeats ? dead(self, 0) | dead(self, 3) : 0;
    for (unsigned fresh = now & ~(unsigned)self->stuck; fresh > 0; fresh &= fresh - 1)
    {
        self->count.imu_stuck++;
    }
    self->stuck = (uint_least8_t)now;
}

void ins_gps_ins_watch(ins_gps_ins_t* self, const ins_increment_t* raw, const ins_increment_t* x)
{
    if (self->cfg.stuck > 0)
    {
        watch_axes(self, raw);
    }
    if (!ins_still_add(&self->still, self->dt, x))
    {
        return;
    }
    if (ins_gps_ins_zupt(self) != INS_OK)
    {
        self->count.rest_refused++;
        return;
    }
    self->count.rests++;
    if (self->stuck & GPS_INS_GYROS)
    {
        return;
    }
    const ins_real w[3] = {self->still.rate[0] + self->gyro_bias[0], self->still.rate[1] + self->gyro_bias[1],
                           self->still.rate[2] + self->gyro_bias[2]};
    (void)ins_gps_ins_zaru(self, w);
}
