/// \file   gimu_sense.c
/// \brief  MMA7260Q, IDG-1004 and the 12-bit converter: input -> low-pass -> volts -> code. SI, V.
///
/// The converter's 4095 steps span 0 .. Vcc, as the thesis reckons (4 mV * 4095 / 3300).
/// SPDX-License-Identifier: MIT
#include "emu/random.h"
#include "gimu_internal.h"
#include <math.h>

static void input_at(const gimu_config_t* config, int64_t t_ps, double input[GIMU_CHANNELS])
{
    if (config->motion == NULL)
    {
        static const double at_rest[GIMU_CHANNELS] = {0.0, 0.0, 0.0, 0.0, 0.0, -9.8};
        for (int i = 0; i < GIMU_CHANNELS; i++)
        {
            input[i] = at_rest[i];
        }
        return;
    }
    config->motion(config->motion_ctx, t_ps, input, input + GIMU_GYROS);
}

/// What channel i is sensitive to.
static double along_axis(const gimu_config_t* config, int i, int64_t t_ps)
{
    const double* const axis = config->channel[i].axis;
    double input[GIMU_CHANNELS];
    input_at(config, t_ps, input);
    const double* const x = input + (i < GIMU_GYROS ? 0 : GIMU_GYROS);
    return axis[0] * x[0] + axis[1] * x[1] + axis[2] * x[2];
}

/// Integral of exp(-s) x(t - s tau) ds; Abramowitz and Stegun 1964, table 25.9 with n = 8.
static double low_pass(const gimu_config_t* config, int i, int64_t t_ps)
{
    static const double node[8][2] = {
        {0.170279632305101, 0.3691885893416375},     {0.9037017767993799, 0.41878678081434295},
        {2.2510866298661307, 0.1757949866371718},    {4.266700170287659, 0.03334349226121565},
        {7.0459054023934655, 0.0027945362352256725}, {10.758516010180996, 9.076508773358213e-05},
        {15.740678641278004, 8.485746716272531e-07}, {22.863131736889265, 1.0480011748715104e-09}};
    const double tau_ps = 0.5e12 / (GIMU_PI * config->channel[i].bandwidth_hz);
    double sum = 0.0;
    for (int k = 7; k >= 0; k--)
    {
        sum += node[k][1] * along_axis(config, i, t_ps - (int64_t)(node[k][0] * tau_ps + 0.5));
    }
    return sum;
}

static uint16_t convert(gimu_t* self, double volts)
{
    const double code = floor(volts * GIMU_FULL_CODE / self->config.vcc_v + 0.5);
    self->clipped += !(volts > 0.0 && volts < self->config.vcc_v);
    return (uint16_t)(code > GIMU_FULL_CODE ? GIMU_FULL_CODE : (code > 0.0 ? code : 0.0));
}

void gimu_sample(gimu_t* self, emu_time_t at, uint16_t raw[GIMU_CHANNELS])
{
    const double on_s = (double)(at - self->begun) * 1e-12;
    for (int i = 0; i < GIMU_CHANNELS; i++)
    {
        const gimu_channel_t* const c = &self->config.channel[i];
        const double x = c->bandwidth_hz > 0.0 ? low_pass(&self->config, i, at) : along_axis(&self->config, i, at);
        const double noise = self->noise_v[i] * emu_random_normal(&self->rng); // drawn even if it counts for nothing
        raw[i] = convert(self, c->null_v + c->drift_v_s * on_s + c->sensitivity * (1.0 + c->scale_error) * x + noise);
    }
}
