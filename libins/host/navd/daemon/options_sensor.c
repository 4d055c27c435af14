/// \file   options_sensor.c
/// \brief  Options of ins-navd about samples, gyros or accelerometers, and how they are navigated with.
/// SPDX-License-Identifier: MIT
#include "arguments.h"
#include "ins/coning.h"
#include "options_internal.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define RAD_PER_DEG (3.14159265358979323846 / 180.0)
#define G_M_S2      9.80665
#define ALL_SIX     0x3Fu

static int form(const char* text, int* out)
{
    static const struct
    {
        const char* name;
        int form;
    } forms[] = {{"one", INS_CONING_ONE},
                 {"hist1", INS_CONING_HIST1},
                 {"hist2-fit", INS_CONING_HIST2_FIT},
                 {"hist2-opt", INS_CONING_HIST2_OPT},
                 {"hist3-fit", INS_CONING_HIST3_FIT},
                 {"hist3-opt", INS_CONING_HIST3_OPT}};
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++)
    {
        if (strcmp(text, forms[i].name) == 0)
        {
            *out = forms[i].form;
            return 1;
        }
    }
    fprintf(stderr, "ins-navd: --form: '%s' is none of one, hist1, hist2-fit, hist2-opt, hist3-fit, hist3-opt\n", text);
    return 0;
}

/// Bits 1 << INPUT_CODES ...: the inputs that have the option. \return 0: it is none of samples.
static unsigned inputs_of(int code)
{
    switch (code)
    {
    case O_LSB:
    case O_FORM:
    case O_RATE_ORDER:
        return 1u << INPUT_CODES;
    case O_ARM:
    case O_ACCEL:
    case O_LSB_FORCE:
    case O_NOISE:
    case O_BIAS:
    case O_SIGMA_ATTITUDE:
    case O_POSITION:
    case O_STILL:
        return 1u << INPUT_SIX;
    case O_BLOCK_LEN:
    case O_SEQ:
    case O_NO_SEQ:
    case 'p':
    case O_NULL:
    case O_CODE_MAX:
    case O_SKEW:
    case O_SKEW_ORDER:
    case 'a':
    case O_BRIDGE_MAX:
        return 1u << INPUT_CODES | 1u << INPUT_SIX;
    default:
        return 0;
    }
}

void sensor_default(options_t* o)
{
    ins_nav_config_default(&o->nav);
    o->nav.octet_timeout_ms = 0; // not given, as the next
    o->nav.block_len = 0;
    o->nav.period_s = (double)NAN;
    ins_nav_six_config_t* const six = &o->six;
    six->lsb_m_s2 = 2.0 * 2.0 * G_M_S2 / 4096.0;
    six->filter.bias = 0.02;
    six->filter.velocity = 0.01;
    six->filter.position = 0.1;
    six->filter.rate = 1e-4;
    six->still_m_s = six->still_rad_s = 1e-3;
    six->still_s = 10.0;
    six->lat_lon_height[0] = (double)NAN;
    for (int i = 0; i < 3; i++)
    {
        six->filter.attitude[i] = 0.01;
    }
    ins_sixacc_paper(0.1, six->accels);
}

/// Accelerometer v[0], from 1: bias, axis, place.
static int accelerometer(options_t* o, const char* text, const double v[8])
{
    const int k = (int)v[0];
    if ((double)k != v[0] || k < 1 || k > INS_NAV_CHANNELS)
    {
        fprintf(stderr, "ins-navd: --accel: '%s' begins with no number from 1 to 6\n", text);
        return 0;
    }
    ins_accel_t* const a = &o->six.accels[k - 1];
    a->bias = v[1];
    memcpy(a->axis, v + 2, sizeof a->axis);
    memcpy(a->r, v + 5, sizeof a->r);
    o->accels_given |= 1u << (k - 1);
    return 1;
}

static int take_six(options_t* o, int code, const char* name, const char* text)
{
    ins_nav_six_config_t* const six = &o->six;
    double v[ARGUMENT_REALS_MAX] = {0};
    int good = 1;
    switch (code)
    {
    case O_ARM:
        good = argument_above_zero(name, text, v);
        ins_sixacc_paper(v[0], six->accels);
        break;
    case O_ACCEL:
        good = argument_reals(name, text, 8, 0, 1.0, v) && accelerometer(o, text, v);
        break;
    case O_LSB_FORCE:
        good = argument_above_zero(name, text, &six->lsb_m_s2);
        break;
    case O_NOISE:
        good = argument_above_zero(name, text, &six->filter.noise);
        break;
    case O_BIAS:
        good = argument_above_zero(name, text, &six->filter.bias);
        break;
    case O_SIGMA_ATTITUDE:
        good = argument_reals(name, text, 3, 1, RAD_PER_DEG, six->filter.attitude);
        break;
    case O_POSITION:
        good = argument_reals(name, text, 3, 0, 1.0, v);
        six->lat_lon_height[0] = v[0] * RAD_PER_DEG;
        six->lat_lon_height[1] = v[1] * RAD_PER_DEG;
        six->lat_lon_height[2] = v[2];
        break;
    default: // O_STILL
        good = argument_reals(name, text, 1, 0, 1.0, &six->still_s);
    }
    return good;
}

int sensor_take(options_t* o, int code, const char* name, const char* text)
{
    const unsigned inputs = inputs_of(code);
    uint64_t n = 0;
    int good = 1;
    double v[3];
    if (inputs == 0)
    {
        return -1;
    }
    for (unsigned input = 0; input < INPUT_COUNT; input++)
    {
        o->not_for[input] = (inputs >> input & 1u) != 0 ? o->not_for[input] : name;
    }
    o->only_six = inputs == 1u << INPUT_SIX ? name : o->only_six;
    switch (code)
    {
    case O_BLOCK_LEN:
        good = argument_whole(name, text, 6, INS_HS_BLOCK_MAX, &n);
        o->nav.block_len = (uint8_t)n;
        break;
    case O_SEQ:
        o->nav.seq = 1;
        break;
    case O_NO_SEQ:
        o->nav.seq = 0;
        break;
    case 'p':
        good = argument_reals(name, text, 1, 0, 1.0, &o->nav.period_s);
        break;
    case O_LSB:
        good = argument_reals(name, text, 3, 1, RAD_PER_DEG, o->nav.lsb_rad_s);
        break;
    case O_NULL:
        good = argument_reals(name, text, 3, 1, 1.0, o->nav.null_code);
        break;
    case O_CODE_MAX:
        good = argument_whole(name, text, 1, UINT16_MAX, &n);
        o->nav.code_max = (uint16_t)n;
        break;
    case O_SKEW:
        o->delays = text;
        break;
    case O_SKEW_ORDER:
        good = argument_whole(name, text, 1, 3, &n);
        o->nav.skew_order = (uint8_t)n;
        break;
    case 'a':
        good = argument_reals(name, text, 3, 0, RAD_PER_DEG, v);
        if (good && ins_nav_config_attitude(&o->nav, v) != INS_OK)
        {
            fprintf(stderr, "ins-navd: --attitude-deg: '%s' is out of range: use -360 to 360\n", text);
            good = 0;
        }
        break;
    case O_FORM:
        good = form(text, &o->nav.form);
        break;
    case O_RATE_ORDER:
        good = argument_whole(name, text, 2, 5, &n);
        o->nav.rate_order = (uint8_t)n;
        break;
    case O_BRIDGE_MAX:
        good = argument_whole(name, text, 0, UINT32_MAX, &n);
        o->nav.bridge_max = (uint32_t)n;
        break;
    default:
        good = take_six(o, code, name, text);
    }
    return good;
}

/// The sampling boards of this project wait two fifths of a period for a reply, at least five octets' time; the navigating one 100 ms.
static uint16_t usual_octet_timeout_ms(const options_t* o)
{
    const double octet_ms = 10e3 / (double)o->baud;
    const double usual_ms = o->input == INPUT_NAV ? 30.0 : 300.0 * o->nav.period_s;
    const double wanted_ms = usual_ms > 3.0 * octet_ms ? usual_ms : 3.0 * octet_ms;
    return (uint16_t)(wanted_ms < 2.0 ? 2.0 : wanted_ms < 1000.0 ? wanted_ms : 1000.0);
}

static const char* six_problem(options_t* o)
{
    ins_nav_six_config_t* const six = &o->six;
    ins_nav_six_t tried;
    if (isnan(six->lat_lon_height[0]))
    {
        return "--position-deg: is missing; --input six navigates from a known place: latitude, longitude, height";
    }
    if (o->accels_given != 0 && o->accels_given != ALL_SIX)
    {
        return "--accel: must be given for all six, or for none";
    }
    six->filter.noise = six->filter.noise > 0.0 ? six->filter.noise : six->lsb_m_s2 * sqrt(0.25 + 1.0 / 12.0);
    six->null_code = o->nav.null_code[0];
    six->link = o->nav;
    return ins_nav_six_init(&tried, six) == INS_OK
               ? NULL
               : "--input six: the accelerometers do not see all of a motion, or a start or deviation is out of range; "
                 "see --accel, --accel-arm-m, --position-deg, --still-s";
}

const char* sensor_finish(options_t* o)
{
    static char text[120];
    ins_nav_config_t* const nav = &o->nav;
    const int six = o->input == INPUT_SIX;
    if (o->not_for[o->input] != NULL)
    {
        const char* const name = o->not_for[o->input];
        const int for_six = o->only_six == name;
        (void)snprintf(text, sizeof text, "--%s is for --input %s: %s", name, for_six ? "six" : "codes",
                       o->input == INPUT_NAV ? "a navigating board says all that itself"
                       : six                 ? "these are accelerometers"
                                             : "these are gyros");
        return text;
    }
    nav->channels = six ? INS_NAV_CHANNELS : nav->channels;
    nav->block_len = (uint8_t)(nav->block_len > 0 ? nav->block_len : 2 * nav->channels);
    nav->period_s = isnan(nav->period_s) ? (six ? 0.01 : 0.02) : nav->period_s;
    if (o->delays != NULL && !argument_reals("skew-us", o->delays, nav->channels, 0, 1e-6, nav->delay_s))
    {
        return "--skew-us: one delay for each channel is needed";
    }
    nav->octet_timeout_ms = nav->octet_timeout_ms > 0 ? nav->octet_timeout_ms : usual_octet_timeout_ms(o);
    const char* const wrong = ins_nav_config_problem(nav);
    return wrong == NULL && six ? six_problem(o) : wrong;
}
