/// \file   gimu_config.c
/// \brief  Presets of the GIMU and what is asked of a configuration. Sources: docs/gimu_part.md.
/// SPDX-License-Identifier: MIT
#include "gimu_internal.h"
#include <stdio.h>

#define DEG  (GIMU_PI / 180.0)
#define G    9.8 ///< the thesis's, as everywhere where volts a g become m/s^2
#define VCC  3.3
#define CODE (VCC / GIMU_FULL_CODE) ///< [V]

static const char* const place[GIMU_CHANNELS] = {"P: ", "Q: ", "R: ", "AX: ", "AY: ", "AZ: "};

void gimu_default_config(gimu_config_t* config)
{
    *config = (gimu_config_t){
        .vcc_v = VCC,
        .power_up = 80000 * EMU_PS_PER_US,
        .baud = 19200.0,
        .nmea_baud = 4800.0,
        .nmea_delay = 300000 * EMU_PS_PER_US,
        .utc_s = INT64_C(1149120000), // 2006-06-01 00:00:00
        .seed = 1,
    };
    for (int i = 0; i < GIMU_CHANNELS; i++)
    {
        config->channel[i] = (gimu_channel_t){
            .sensitivity = i < GIMU_GYROS ? 4e-3 / DEG : 0.8 / G,
            .null_v = 2047.0 * CODE,
        };
        config->channel[i].axis[i % 3] = 1.0;
    }
}

void gimu_thesis_config(gimu_config_t* config)
{
    static const double k_deg_s[GIMU_GYROS] = {0.2087, 0.2099, 0.1993}; // the thesis's K constants [deg/s a code]
    static const double beside_2047[GIMU_CHANNELS] = {0.72, -0.66, 0.80, 12.3, -8.6, 21.4};
    static const double drift_v_s[GIMU_GYROS] = {1e-6, 0.0, -1e-6};
    static const double bandwidth_hz[GIMU_CHANNELS] = {140.0, 140.0, 140.0, 350.0, 350.0, 150.0};
    gimu_default_config(config);
    for (int i = 0; i < GIMU_CHANNELS; i++)
    {
        gimu_channel_t* const c = &config->channel[i];
        c->null_v += beside_2047[i] * CODE;
        c->bandwidth_hz = bandwidth_hz[i];
        c->noise_density = i < GIMU_GYROS ? 0.014 * 4e-3 : 350e-6 * 0.8;
        if (i < GIMU_GYROS)
        {
            c->drift_v_s = drift_v_s[i];
            c->scale_error = CODE * DEG / (c->sensitivity * DEG * k_deg_s[i] * DEG) - 1.0;
        }
    }
}

typedef struct
{
    char* text;
    size_t size;
} why_t;

/// \return true when low <= x <= high; otherwise (NaN too) false, and why says so.
static bool in_range(const why_t* why, const char* where, const char* name, double x, double low, double high)
{
    if (x >= low && x <= high)
    {
        return true;
    }
    if (why->text != NULL)
    {
        (void)snprintf(why->text, why->size, "GIMU: %s%s is %.9g, give %.9g to %.9g", where, name, x, low, high);
    }
    return false;
}

static bool check_channel(const gimu_channel_t* c, const char* where, const why_t* why)
{
    const double length2 = c->axis[0] * c->axis[0] + c->axis[1] * c->axis[1] + c->axis[2] * c->axis[2];
    const double sensitivity = c->sensitivity < 0.0 ? -c->sensitivity : c->sensitivity;
    const bool noisy = c->noise_density != 0.0;
    return in_range(why, where, "the length of axis squared", length2, 0.81, 1.21) &&
           in_range(why, where, "|sensitivity|", sensitivity, 1e-6, 1e3) &&
           in_range(why, where, "scale_error", c->scale_error, -0.9, 10.0) &&
           in_range(why, where, "null_v", c->null_v, -10.0, 10.0) &&
           in_range(why, where, "drift_v_s", c->drift_v_s, -1.0, 1.0) &&
           in_range(why, where, "noise_density", c->noise_density, 0.0, 1.0) &&
           in_range(why, where, noisy ? "bandwidth_hz (with noise_density)" : "bandwidth_hz (0: unlimited)",
                    c->bandwidth_hz, noisy ? 1e-2 : 0.0, 1e6) &&
           (c->bandwidth_hz == 0.0 || in_range(why, where, "bandwidth_hz", c->bandwidth_hz, 1e-2, 1e6));
}

bool gimu_check(const gimu_config_t* config, char* text, size_t size)
{
    const why_t why = {text, size};
    for (int i = 0; i < GIMU_CHANNELS; i++)
    {
        if (!check_channel(&config->channel[i], place[i], &why))
        {
            return false;
        }
    }
    return in_range(&why, "", "vcc_v", config->vcc_v, 3.0, 3.6) &&
           in_range(&why, "", "power_up [ps]", (double)config->power_up, 0.0, 1e13) &&
           in_range(&why, "", "baud", config->baud, 2400.0, 230400.0) &&
           in_range(&why, "", "clock_ppb", config->clock_ppb, -(double)EMU_PPB_MAX, EMU_PPB_MAX) &&
           in_range(&why, "", "order", config->order, GIMU_LONGITUDE_FIRST, GIMU_LATITUDE_FIRST) &&
           in_range(&why, "", "no_fix", config->no_fix, GIMU_HOLD_LAST, GIMU_SEND_ZEROS) &&
           in_range(&why, "", "nmea_baud", config->nmea_baud, 2400.0, 230400.0) &&
           in_range(&why, "", "nmea_delay [ps]", (double)config->nmea_delay, 0.0, 0.999e12) &&
           in_range(&why, "", "geoid_m", config->geoid_m, -200.0, 200.0) &&
           in_range(&why, "", "utc_s (2000 to 2099)", (double)config->utc_s, 946684800.0, 4102444799.0 - 1e7);
}
