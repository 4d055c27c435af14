/// \file   accel.c
/// \brief  Accelerometers off the origin: specific force, angular acceleration and rate -> volts. Frame: b. V, m/s^2, s.
/// Source: C.-Y. Hung, C.-M. Fang, C.-Y. Wang, S.-C. Lee, six-accelerometer schemes, equations 3 to 8, table 1.
/// SPDX-License-Identifier: MIT
#include "ins_truth/accel.h"
#include "noise_internal.h"
#include "why_internal.h"
#include <math.h>

#define PS_PER_S   1e12
#define STEP_PS    1000000000 ///< of the difference
#define HALF_SQRT2 0.70710678118654752440
#define NOISE      64u ///< streams of noise, and of turn-on biases, begin here
#define TURN_ON    96u

void ins_accel_paper_config(ins_accel_config_t* config, double rho, double range, double ref_minus_v, double ref_plus_v)
{
    static const signed char axis[6][3] = {{1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {0, -1, 1}, {-1, 0, 1}, {-1, 1, 0}};
    static const signed char place[6][3] = {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    *config = (ins_accel_config_t){.count = 6, .noise_hold_s = 50e-6, .seed = 1};
    config->rail_low_v = ref_minus_v;
    config->rail_high_v = ref_plus_v;
    for (int j = 0; j < 6; j++)
    {
        ins_accel_channel_t* const c = &config->channel[j];
        c->sensitivity = (ref_plus_v - ref_minus_v) / (2.0 * range);
        c->null_v = 0.5 * (ref_minus_v + ref_plus_v);
        for (int i = 0; i < 3; i++)
        {
            c->axis[i] = HALF_SQRT2 * axis[j][i];
            c->r[i] = rho * place[j][i];
        }
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool check_channel(const ins_accel_channel_t* c, const char* place, const ins_why_t* why)
{
    return ins_why_range(why, place, "the length of axis", sqrt(dot(c->axis, c->axis)), 0.5, 2.0) &&
           ins_why_range(why, place, "the length of r", sqrt(dot(c->r, c->r)), 0.0, 1e3) &&
           ins_why_range(why, place, "|sensitivity|", fabs(c->sensitivity), 1e-9, 1e6) &&
           ins_why_range(why, place, "null_v", c->null_v, -1e3, 1e3) &&
           ins_why_range(why, place, "bias", c->bias, -1e3, 1e3) &&
           ins_why_range(why, place, "scale_error", c->scale_error, -1.0, 1e3) &&
           ins_why_range(why, place, "quadratic", c->quadratic, -1.0, 1.0) &&
           ins_why_range(why, place, "noise", c->noise, 0.0, 1e3);
}

bool ins_accels_init(ins_accels_t* self, const ins_accel_config_t* config, const ins_track_t* track, char* text,
                     size_t size)
{
    const ins_why_t why = {text, size};
    if (!ins_why_range(&why, "", "count", config->count, 1, INS_ACCEL_CHANNELS))
    {
        return false;
    }
    for (unsigned i = 0; i < config->count; i++)
    {
        char place[] = "accelerometer  0: ";
        place[14] = i + 1 < 10 ? ' ' : '1';
        place[15] = (char)('0' + (i + 1) % 10);
        if (!check_channel(&config->channel[i], place, &why))
        {
            return false;
        }
    }
    if (!ins_why_range(&why, "", "rail_low_v", config->rail_low_v, -1e3, 1e3) ||
        !ins_why_range(&why, "", "rail_high_v (above rail_low_v)", config->rail_high_v, config->rail_low_v, 1e3) ||
        !ins_why_range(&why, "", "turn_on", config->turn_on, 0.0, 1e3) ||
        !ins_why_range(&why, "", "noise_hold_s", config->noise_hold_s, 1e-6, 1.0))
    {
        return false;
    }
    self->config = *config;
    self->track = track;
    self->hold_ps = (int64_t)(config->noise_hold_s * PS_PER_S + 0.5);
    return true;
}

/// The derivative of w_ib_b by its sixth-order central difference.
static void angular_acceleration(const ins_track_t* track, int64_t t_ps, double wd[3])
{
    static const double weight[3] = {45.0, -9.0, 1.0};
    wd[0] = wd[1] = wd[2] = 0.0;
    for (int k = 3; k > 0; k--)
    {
        ins_track_state_t before;
        ins_track_state_t after;
        ins_track_at(track, (double)(t_ps - k * (int64_t)STEP_PS) / PS_PER_S, &before);
        ins_track_at(track, (double)(t_ps + k * (int64_t)STEP_PS) / PS_PER_S, &after);
        for (int i = 0; i < 3; i++)
        {
            wd[i] += weight[k - 1] / 60.0 * (PS_PER_S / STEP_PS) * (after.w_ib_b[i] - before.w_ib_b[i]);
        }
    }
}

double ins_accels_exact(const ins_accels_t* self, unsigned channel, int64_t t_ps)
{
    // axis . (wd x r) = wd . (r x axis); axis . (w x (w x r)) = (axis . w)(r . w) - (axis . r)(w . w)
    const double* const u = self->config.channel[channel].axis;
    const double* const r = self->config.channel[channel].r;
    const double moment[3] = {r[1] * u[2] - r[2] * u[1], r[2] * u[0] - r[0] * u[2], r[0] * u[1] - r[1] * u[0]};
    ins_track_state_t now;
    double wd[3];
    ins_track_at(self->track, (double)t_ps / PS_PER_S, &now);
    angular_acceleration(self->track, t_ps, wd);
    const double* const w = now.w_ib_b;
    return dot(u, now.f_b) + dot(wd, moment) + dot(u, w) * dot(r, w) - dot(u, r) * dot(w, w);
}

double ins_accels_reading(const ins_accels_t* self, unsigned channel, int64_t t_ps)
{
    const ins_accel_channel_t* const c = &self->config.channel[channel];
    const uint64_t seed = self->config.seed;
    const double x = ins_accels_exact(self, channel, t_ps);
    double errors = c->bias + c->quadratic * x * x;
    if (self->config.turn_on > 0.0)
    {
        errors += self->config.turn_on * ins_noise_normal(seed, TURN_ON + channel, 0);
    }
    if (c->noise > 0.0)
    {
        const int64_t cell = t_ps / self->hold_ps - (t_ps % self->hold_ps < 0 ? 1 : 0);
        errors += c->noise * ins_noise_normal(seed, NOISE + channel, cell);
    }
    return (1.0 + c->scale_error) * x + errors;
}

double ins_accels_volts(void* accels, unsigned channel, int64_t t_ps)
{
    const ins_accels_t* const self = accels;
    const ins_accel_config_t* const config = &self->config;
    if (channel >= config->count)
    {
        return config->rail_low_v;
    }
    const ins_accel_channel_t* const c = &config->channel[channel];
    const double volts = c->null_v + c->sensitivity * ins_accels_reading(self, channel, t_ps);
    const double below_high = volts > config->rail_high_v ? config->rail_high_v : volts;
    return below_high < config->rail_low_v ? config->rail_low_v : below_high;
}
