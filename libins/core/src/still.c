/// \file   still.c
/// \brief  Detector of rest over blocks of samples. Frame: b. SI, rad.
/// SPDX-License-Identifier: MIT
#include "ins/still.h"
#include "ins/ins_math.h"

#define AXES 6

ins_status_t ins_still_init(ins_still_t* self, const ins_still_config_t* cfg)
{
    static const ins_still_t zero; // all 0
    if (cfg->samples == 1 ||
        (cfg->samples > 0 && (!(cfg->rate_sigma > 0) || !(cfg->force_sigma > 0) || !(cfg->rate_mean > 0))))
    {
        return INS_E_RANGE;
    }
    *self = zero;
    self->cfg = *cfg;
    return INS_OK;
}

void ins_still_restart(ins_still_t* self)
{
    self->count = 0;
}

/// Judges the block that is full.
static int is_still(ins_still_t* self)
{
    const ins_real n = self->cfg.samples;
    for (unsigned i = 0; i < AXES; i++)
    {
        const ins_real bound = i < 3 ? self->cfg.rate_sigma : self->cfg.force_sigma;
        const ins_real mean = self->sum[i] / n;
        if (!(self->squares[i] - mean * self->sum[i] <= bound * bound * (n - 1)) ||
            (i < 3 && !(ins_fabs(self->first[i] + mean) <= self->cfg.rate_mean)))
        {
            return 0;
        }
    }
    for (unsigned i = 0; i < 3; i++)
    {
        self->rate[i] = self->first[i] + self->sum[i] / n;
        self->force[i] = self->first[3 + i] + self->sum[3 + i] / n;
    }
    return 1;
}

int ins_still_add(ins_still_t* self, ins_real dt, const ins_increment_t* increment)
{
    const ins_real per_s = 1 / dt;
    if (self->cfg.samples == 0)
    {
        return 0;
    }
    for (unsigned i = 0; i < AXES; i++)
    {
        const ins_real x = per_s * (i < 3 ? increment->theta_b[i] : increment->v_b[i - 3]);
        if (self->count == 0)
        {
            self->first[i] = x;
            self->sum[i] = 0;
            self->squares[i] = 0;
        }
        const ins_real d = x - self->first[i];
        self->sum[i] += d;
        self->squares[i] += d * d;
    }
    self->count++;
    if (self->count < self->cfg.samples)
    {
        return 0;
    }
    self->count = 0;
    return is_still(self);
}
