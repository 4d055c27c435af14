/// \file   imu.c
/// \brief  Errors of an IMU, sample by sample. Frame b; rad, m/s, s, K.
/// Source: IEEE Std 952-1997, annex C (coefficients); M. S. Keshner, Proc. IEEE 70(3), 1982, 212-218 (1/f from relaxations).
/// SPDX-License-Identifier: MIT
#include "ins_truth/imu.h"
#include "ins_truth/elementary.h"
#include "noise_internal.h"
#include "why_internal.h"
#include <math.h>

#define FLICKER_FIRST_S 0.1
#define FLICKER_RATIO   10.0
#define LN_RATIO        2.302585092994046
#define STREAMS         32u ///< of each triad, three for each cause

/// Causes of randomness; each has a stream for x, y and z.
enum
{
    TURN_ON = 0,
    WHITE = 3,
    MARKOV = 6,
    WALK = 9,
    FLICKER = 12 ///< and 3 k on
};

void ins_imu_ideal_config(ins_imu_config_t* config)
{
    *config = (ins_imu_config_t){.gyro.markov_tau_s = 100.0, .accel.markov_tau_s = 100.0, .seed = 1};
}

typedef struct
{
    const char* name;
    const double* values;
    int count;
    double low, high;
} limit_t;

static bool check(const limit_t* limits, size_t count, const char* where, const ins_why_t* why)
{
    for (size_t k = 0; k < count; k++)
    {
        for (int i = 0; i < limits[k].count; i++)
        {
            if (!(limits[k].values[i] >= limits[k].low && limits[k].values[i] <= limits[k].high))
            {
                ins_why_say(why, "%s%s[%d] is %.9g, give %.9g to %.9g", where, limits[k].name, i, limits[k].values[i],
                            limits[k].low, limits[k].high);
                return false;
            }
        }
    }
    return true;
}

static bool check_triad(const ins_imu_triad_t* t, const char* where, const ins_why_t* why)
{
    const limit_t limits[] = {{"bias", t->bias, 3, -1e3, 1e3},
                              {"turn_on", t->turn_on, 3, 0.0, 1e3},
                              {"scale", t->scale, 3, -1.0, 1e3},
                              {"misalignment", t->misalignment, 9, -1.0, 1.0},
                              {"random_walk", t->random_walk, 3, 0.0, 1e3},
                              {"bias_instability", t->bias_instability, 3, 0.0, 1e3},
                              {"rate_random_walk", t->rate_random_walk, 3, 0.0, 1e3},
                              {"markov", t->markov, 3, 0.0, 1e3},
                              {"markov_tau_s", &t->markov_tau_s, 1, 1e-3, 1e9},
                              {"bias_per_k", t->bias_per_k, 3, -1e3, 1e3},
                              {"scale_per_k", t->scale_per_k, 3, -1.0, 1.0},
                              {"quantum", &t->quantum, 1, 0.0, 1e3},
                              {"range", &t->range, 1, 0.0, 1e6}};
    if (!check(limits, sizeof limits / sizeof limits[0], where, why))
    {
        return false;
    }
    for (int i = 0; i < 9; i += 4)
    {
        if (t->misalignment[i] != 0.0)
        {
            ins_why_say(why, "%smisalignment[%d] is %.9g, give 0: what an axis sees of itself is scale", where, i,
                        t->misalignment[i]);
            return false;
        }
    }
    return true;
}

/// Of a stream of a triad (0 gyro, 1 accelerometer); the steady state of Markov processes is cell 0, sample k is cell k + 1.
static double normal(const ins_imu_t* self, unsigned triad, unsigned stream, int64_t cell)
{
    return ins_noise_normal(self->config.seed, triad * STREAMS + stream, cell);
}

static double flicker_sigma(double bias_instability)
{
    return bias_instability * sqrt(LN_RATIO / INS_TRUTH_PI);
}

static void start(ins_imu_t* self, unsigned triad, const ins_imu_triad_t* t, ins_imu_state_t* s)
{
    *s = (ins_imu_state_t){.saturated = 0};
    for (unsigned i = 0; i < 3; i++)
    {
        s->turn_on[i] = t->turn_on[i] > 0.0 ? t->turn_on[i] * normal(self, triad, TURN_ON + i, 0) : 0.0;
        s->markov[i] = t->markov[i] > 0.0 ? t->markov[i] * normal(self, triad, MARKOV + i, 0) : 0.0;
        s->bias[i] = t->bias[i] + s->turn_on[i] + s->markov[i];
        for (unsigned k = 0; k < INS_IMU_FLICKERS && t->bias_instability[i] > 0.0; k++)
        {
            s->flicker[k][i] = flicker_sigma(t->bias_instability[i]) * normal(self, triad, FLICKER + 3 * k + i, 0);
            s->bias[i] += s->flicker[k][i];
        }
    }
}

bool ins_imu_init(ins_imu_t* self, const ins_imu_config_t* config, char* text, size_t size)
{
    const ins_why_t why = {text, size};
    const limit_t g = {"g_sensitivity", config->g_sensitivity, 9, -1e3, 1e3};
    if (!check_triad(&config->gyro, "gyro: ", &why) || !check_triad(&config->accel, "accel: ", &why) ||
        !check(&g, 1, "", &why))
    {
        return false;
    }
    self->config = *config;
    self->samples = 0;
    start(self, 0, &config->gyro, &self->gyro);
    start(self, 1, &config->accel, &self->accel);
    return true;
}

/// x(t + dt) = phi x(t) + sigma sqrt(1 - phi^2) w, phi = exp(-dt / tau).
static double relax(double x, double sigma, double phi, double w)
{
    return phi * x + sigma * sqrt(1.0 - phi * phi) * w;
}

static void drift(const ins_imu_t* self, unsigned triad, const ins_imu_triad_t* t, double dt_s, double above_k,
                  ins_imu_state_t* s)
{
    const int64_t cell = self->samples + 1;
    double flicker_phi[INS_IMU_FLICKERS];
    double tau_s = FLICKER_FIRST_S;
    for (int k = 0; k < INS_IMU_FLICKERS; k++, tau_s *= FLICKER_RATIO)
    {
        flicker_phi[k] = ins_truth_exp(-dt_s / tau_s);
    }
    const double phi = ins_truth_exp(-dt_s / t->markov_tau_s);
    for (unsigned i = 0; i < 3; i++)
    {
        double sum = t->bias[i] + s->turn_on[i] + t->bias_per_k[i] * above_k;
        for (unsigned k = 0; k < INS_IMU_FLICKERS && t->bias_instability[i] > 0.0; k++)
        {
            s->flicker[k][i] = relax(s->flicker[k][i], flicker_sigma(t->bias_instability[i]), flicker_phi[k],
                                     normal(self, triad, FLICKER + 3 * k + i, cell));
            sum += s->flicker[k][i];
        }
        if (t->markov[i] > 0.0)
        {
            s->markov[i] = relax(s->markov[i], t->markov[i], phi, normal(self, triad, MARKOV + i, cell));
        }
        if (t->rate_random_walk[i] > 0.0)
        {
            s->walk[i] += t->rate_random_walk[i] * sqrt(dt_s) * normal(self, triad, WALK + i, cell);
        }
        s->bias[i] = sum + s->markov[i] + s->walk[i];
    }
}

/// Of the integral of x over a sample; g: of what else it feels [u/s].
static void sense(const ins_imu_t* self, unsigned triad, const ins_imu_triad_t* t, double dt_s, double above_k,
                  const double x[3], const double g[3], ins_imu_state_t* s, double out[3])
{
    double y[3];
    for (unsigned i = 0; i < 3; i++)
    {
        const double* const row = t->misalignment + 3 * i;
        const double seen =
            x[i] * (1.0 + t->scale[i] + t->scale_per_k[i] * above_k) + row[0] * x[0] + row[1] * x[1] + row[2] * x[2];
        const double white = t->random_walk[i] > 0.0
                                 ? t->random_walk[i] * sqrt(dt_s) * normal(self, triad, WHITE + i, self->samples + 1)
                                 : 0.0;
        y[i] = seen + (g[i] + s->bias[i]) * dt_s + white;
        if (t->range > 0.0 && !(fabs(y[i]) <= t->range * dt_s))
        {
            y[i] = y[i] < 0.0 ? -t->range * dt_s : t->range * dt_s;
            s->saturated++;
        }
    }
    for (int i = 0; i < 3; i++)
    {
        out[i] = y[i];
        if (t->quantum > 0.0)
        {
            out[i] = t->quantum * floor((y[i] + s->left[i]) / t->quantum + 0.5);
            s->left[i] += y[i] - out[i];
        }
    }
}

void ins_imu_apply(ins_imu_t* self, double dt_s, double above_k, const double theta[3], const double v[3],
                   double theta_out[3], double v_out[3])
{
    static const double none[3] = {0.0, 0.0, 0.0};
    double g[3];
    for (int i = 0; i < 3; i++)
    {
        const double* const row = self->config.g_sensitivity + 3 * i;
        g[i] = (row[0] * v[0] + row[1] * v[1] + row[2] * v[2]) / dt_s;
    }
    drift(self, 0, &self->config.gyro, dt_s, above_k, &self->gyro);
    drift(self, 1, &self->config.accel, dt_s, above_k, &self->accel);
    sense(self, 0, &self->config.gyro, dt_s, above_k, theta, g, &self->gyro, theta_out);
    sense(self, 1, &self->config.accel, dt_s, above_k, v, none, &self->accel, v_out);
    self->samples++;
}
