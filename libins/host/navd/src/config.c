/// \file   config.c
/// \brief  Defaults of the navigator, and what makes a configuration unusable.
/// SPDX-License-Identifier: MIT
#include "ins/coning.h"
#include "ins/quat.h"
#include "ins_nav/nav.h"
#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

/// Largest rotation of a period [rad]. Overshoot of the cubic skew interpolation (1.63) and of AM5 (1.79) then stays below pi.
#define TURN_MAX 1.0

void ins_nav_config_default(ins_nav_config_t* cfg)
{
    memset(cfg, 0, sizeof *cfg);
    cfg->period_s = 0.02;
    cfg->channels = 3;
    cfg->block_len = 6;
    cfg->seq = 1;
    cfg->retries = 3;
    cfg->octet_timeout_ms = 6; // the default firmware waits 8.9 ms for a reply
    cfg->form = INS_CONING_HIST2_OPT;
    cfg->rate_order = 4;
    cfg->skew_order = 2;
    cfg->code_max = 4095;
    for (int i = 0; i < 3; i++)
    {
        cfg->lsb_rad_s[i] = PI / 4096.0; // +-90 deg/s over 4096 codes
        cfg->null_code[i] = 2048.0;
    }
    cfg->q_nb[0] = 1.0;
    cfg->bridge_max = 50;
    cfg->clock_tolerance = 32;
}

ins_status_t ins_nav_config_attitude(ins_nav_config_t* cfg, const double euler_rad[3])
{
    double q[3][4];
    for (int i = 0; i < 3; i++)
    {
        double phi[3] = {0.0, 0.0, 0.0};
        phi[i] = euler_rad[i];
        const ins_status_t status = ins_quat_from_rotvec(phi, q[i]);
        if (status != INS_OK)
        {
            return status;
        }
    }
    ins_quat_mul(q[2], q[1], cfg->q_nb);
    ins_quat_mul(cfg->q_nb, q[0], cfg->q_nb);
    return ins_quat_normalise(cfg->q_nb);
}

const char* ins_nav_config_problem(const ins_nav_config_t* cfg)
{
    ins_rates_t rates;
    ins_skew_t skew;
    ins_attitude_t attitude;
    // Written so that NaN is refused.
    if (!(cfg->period_s >= 1e-6 && cfg->period_s <= 3600.0))
    {
        return "the period must be 1e-6 to 3600 s";
    }
    if (cfg->channels != 3 && cfg->channels != INS_NAV_CHANNELS)
    {
        return "there must be 3 channels (gyros) or 6 (accelerometers)";
    }
    if (cfg->block_len < 2 * cfg->channels || cfg->block_len > INS_HS_BLOCK_MAX)
    {
        return "the block length must be 6 to 32 octets (XH XL YH YL ZH ZL come first), of six channels at least 12";
    }
    if (cfg->seq > 1)
    {
        return "seq must be 0 or 1";
    }
    if (cfg->octet_timeout_ms < 1 || cfg->octet_timeout_ms >= 32768)
    {
        return "the octet time-out must be 1 to 32767 ms";
    }
    if (ins_rates_init(&rates, cfg->rate_order, cfg->period_s) != INS_OK)
    {
        return "the rate order must be 2 to 5";
    }
    if (ins_skew_init(&skew, cfg->skew_order, cfg->delay_s, cfg->period_s) != INS_OK)
    {
        return "the skew order must be 1 to 3, and each channel delay at least 0 and less than the period";
    }
    for (int i = 0; i < 3; i++)
    {
        if (!(cfg->lsb_rad_s[i] >= -1e3 && cfg->lsb_rad_s[i] <= 1e3) || !(cfg->lsb_rad_s[i] != 0.0))
        {
            return "the rate per code must be a number other than 0, at most 1000 rad/s";
        }
        if (!(cfg->null_code[i] >= -1e6 && cfg->null_code[i] <= 1e6))
        {
            return "the null code must be a number from -1e6 to 1e6";
        }
    }
    for (int i = 0; i < 3; i++)
    {
        const double span = fmax(fabs(cfg->null_code[i]), fabs((double)cfg->code_max - cfg->null_code[i]));
        if (span * fabs(cfg->lsb_rad_s[i]) * cfg->period_s > TURN_MAX)
        {
            return "the fastest rate turns more than 1 rad in a period: check rate per code and period, or sample "
                   "faster";
        }
    }
    if (cfg->code_max < 1 || (cfg->seq && cfg->code_max > 4095))
    {
        return "code_max must be at least 1, and at most 4095 with a sequence number (it sits in the bits above)";
    }
    if (ins_attitude_init(&attitude, cfg->form, cfg->q_nb) != INS_OK)
    {
        return "the attitude must be a unit quaternion, and the form one with a single interval (INS_CONING_ONE, "
               "INS_CONING_HIST...)";
    }
    return NULL;
}
