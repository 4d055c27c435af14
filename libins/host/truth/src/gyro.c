/// \file   gyro.c
/// \brief  Rate gyros and amplifiers: rate -> volts, as a pure function of channel and time. Frame b; rad/s, V.
/// SPDX-License-Identifier: MIT
#include "ins_truth/gyro.h"
#include "ins_truth/elementary.h"
#include "noise_internal.h"
#include "why_internal.h"
#include <math.h>

#define PS_PER_S 1e12
#define DEG      (INS_TRUTH_PI / 180.0)

static const char* const where[INS_GYRO_CHANNELS] = {"channel X: ", "channel Y: ", "channel Z: "};

/// All three channels alike, each along its own axis.
static void fill(ins_gyro_config_t* config, double sensitivity, double gain, double bandwidth_hz, double noise_density,
                 double drift)
{
    for (int i = 0; i < INS_GYRO_CHANNELS; i++)
    {
        config->channel[i] = (ins_gyro_channel_t){.axis = {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0},
                                                  .sensitivity = sensitivity,
                                                  .gain = gain,
                                                  .null_v = 2048.0 * 5.0 / 4096.0,
                                                  .bandwidth_hz = bandwidth_hz,
                                                  .noise_density = noise_density,
                                                  .drift = drift};
    }
    config->rail_low_v = 0.0;
    config->rail_high_v = 5.0;
    config->noise_bandwidth_hz = 500.0;
    config->seed = 1;
}

void ins_gyro_default_config(ins_gyro_config_t* config)
{
    fill(config, 5.0 / (180.0 * DEG), 1.0, 0.0, 0.0, 0.0);
}

void ins_gyro_cgl53_config(ins_gyro_config_t* config)
{
    // Assumptions, all of them; no text of a CG-L53 data sheet was found.
    const double sensitivity = 0.67e-3 / DEG; // Murata ENC-03R: 0.67 mV/(deg/s)
    const double gain = 40.0;                 // chosen: +-93 deg/s over 0 .. 5 V
    const double bandwidth_hz = 50.0;         // chosen: a common figure for small ceramic gyros
    const double noise_density = 0.02 * DEG;  // chosen, of the order of vibrating ceramic gyros
    const double drift = 0.001 * DEG;         // chosen: 3.6 deg/s in an hour of warming up
    fill(config, sensitivity, gain, bandwidth_hz, noise_density, drift);
    config->noise_bandwidth_hz = 0.5 * INS_TRUTH_PI * bandwidth_hz; // what a first-order 50 Hz low-pass lets through
    // The sensor's own null (ENC-03R: 1.35 V) does not appear: the amplifier is taken to be trimmed to 2.5 V at rest,
    // scale error to 0.
}

static bool check_channel(const ins_gyro_channel_t* c, const char* place, const ins_why_t* why)
{
    const double length = sqrt(c->axis[0] * c->axis[0] + c->axis[1] * c->axis[1] + c->axis[2] * c->axis[2]);
    if (!ins_why_range(why, place, "the length of axis", length, 0.999, 1.001) ||
        !ins_why_range(why, place, "|sensitivity|", fabs(c->sensitivity), 1e-9, 1e6) ||
        !ins_why_range(why, place, "|gain|", fabs(c->gain), 1e-6, 1e6) ||
        !ins_why_range(why, place, "null_v", c->null_v, -1e3, 1e3) ||
        !ins_why_range(why, place, "noise_density", c->noise_density, 0.0, 1e3) ||
        !ins_why_range(why, place, "bias", c->bias, -1e3, 1e3) ||
        !ins_why_range(why, place, "drift", c->drift, -1e3, 1e3) ||
        !ins_why_range(why, place, "scale_error", c->scale_error, -1.0, 1e3))
    {
        return false;
    }
    return c->bandwidth_hz == 0.0 ||
           ins_why_range(why, place, "bandwidth_hz (0 = unlimited)", c->bandwidth_hz, 1e-3, 1e9);
}

bool ins_gyro_init(ins_gyro_t* self, const ins_gyro_config_t* config, const ins_motion_t* motion, char* text,
                   size_t size)
{
    const ins_why_t why = {text, size};
    for (int i = 0; i < INS_GYRO_CHANNELS; i++)
    {
        if (!check_channel(&config->channel[i], where[i], &why))
        {
            return false;
        }
    }
    if (!ins_why_range(&why, "", "rail_low_v", config->rail_low_v, -1e3, 1e3) ||
        !ins_why_range(&why, "", "rail_high_v (above rail_low_v)", config->rail_high_v, config->rail_low_v, 1e3) ||
        !ins_why_range(&why, "", "noise_bandwidth_hz", config->noise_bandwidth_hz, 1e-3, 1e9))
    {
        return false;
    }
    self->config = *config;
    self->motion = motion;
    self->noise_step_ps = (int64_t)(0.5 * PS_PER_S / config->noise_bandwidth_hz + 0.5);
    for (int i = 0; i < INS_GYRO_CHANNELS; i++)
    {
        self->noise_sigma[i] = config->channel[i].noise_density * sqrt(0.5 * PS_PER_S / (double)self->noise_step_ps);
    }
    return true;
}

static double axis_rate(const ins_gyro_t* self, const ins_gyro_channel_t* c, double t)
{
    double w[3];
    ins_motion_rate(self->motion, t, w);
    return c->axis[0] * w[0] + c->axis[1] * w[1] + c->axis[2] * w[2];
}

/// Integral of exp(-s) x(t - s tau) ds; Abramowitz and Stegun 1964, 25.4.45 with n = 16.
static double low_pass(const ins_gyro_t* self, const ins_gyro_channel_t* c, double t)
{
    static const double node[16][2] = {
        {0.08764941047892784, 0.20615171495780099},   {0.46269632891508083, 0.33105785495088417},
        {1.1410577748312269, 0.26579577764421415},    {2.1292836450983806, 0.13629693429637754},
        {3.4370866338932066, 0.047328928694125219},   {5.0780186145497679, 0.011299900080339453},
        {7.0703385350482341, 0.0018490709435263109},  {9.4383143363919388, 0.00020427191530827846},
        {12.214223368866159, 1.4844586873981299e-5},  {15.441527368781617, 6.8283193308711996e-7},
        {19.180156856753135, 1.8810248410796732e-8},  {23.515905693991909, 2.8623502429738816e-10},
        {28.57872974288214, 2.127079033224103e-12},   {34.583398702286626, 6.2979670025178678e-15},
        {41.940452647688333, 5.0504737000355128e-18}, {51.701160339543318, 4.1614623703728552e-22}};
    const double tau = 0.5 / (INS_TRUTH_PI * c->bandwidth_hz);
    double sum = 0.0;
    for (int k = 15; k >= 0; k--)
    {
        sum += node[k][1] * axis_rate(self, c, t - node[k][0] * tau);
    }
    return sum;
}

static double noise(const ins_gyro_t* self, unsigned channel, int64_t t_ps)
{
    const int64_t step = self->noise_step_ps;
    const int64_t cell = t_ps / step - (t_ps % step < 0 ? 1 : 0);
    return self->noise_sigma[channel] * ins_noise_normal(self->config.seed, channel, cell);
}

double ins_gyro_rate(const ins_gyro_t* self, unsigned channel, int64_t t_ps)
{
    const ins_gyro_channel_t* const c = &self->config.channel[channel];
    const double t = (double)t_ps / PS_PER_S;
    const double rate = c->bandwidth_hz > 0.0 ? low_pass(self, c, t) : axis_rate(self, c, t);
    const double random = self->noise_sigma[channel] > 0.0 ? noise(self, channel, t_ps) : 0.0;
    return (1.0 + c->scale_error) * rate + c->bias + c->drift * t + random;
}

double ins_gyro_volts(void* gyro, unsigned channel, int64_t t_ps)
{
    const ins_gyro_t* const self = gyro;
    const ins_gyro_config_t* const config = &self->config;
    if (channel >= INS_GYRO_CHANNELS)
    {
        return config->rail_low_v;
    }
    const ins_gyro_channel_t* const c = &config->channel[channel];
    const double volts = c->null_v + c->gain * c->sensitivity * ins_gyro_rate(self, channel, t_ps);
    const double below_high = volts > config->rail_high_v ? config->rail_high_v : volts;
    return below_high < config->rail_low_v ? config->rail_low_v : below_high;
}

bool ins_gyro_scale(const ins_gyro_config_t* config, unsigned channel, unsigned bits, double ref_minus_v,
                    double ref_plus_v, double* rate_per_lsb, double* null_code)
{
    if (channel >= INS_GYRO_CHANNELS || bits < 1 || bits > 24 || !(ref_plus_v > ref_minus_v))
    {
        return false;
    }
    const ins_gyro_channel_t* const c = &config->channel[channel];
    const double lsb_v = (ref_plus_v - ref_minus_v) / (double)(1UL << bits);
    *rate_per_lsb = lsb_v / (c->gain * c->sensitivity);
    *null_code = (c->null_v - ref_minus_v) / lsb_v;
    return true;
}
