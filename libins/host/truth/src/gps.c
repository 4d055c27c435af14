/// \file   gps.c
/// \brief  GPS fixes from a track: white and first-order Markov errors, latency, outages. SI, rad.
/// SPDX-License-Identifier: MIT
#include "ins_truth/gps.h"
#include "ins_truth/elementary.h"
#include "noise_internal.h"
#include "place_internal.h"
#include "why_internal.h"
#include <math.h>

#define PS_PER_S 1e12

/// Streams of random numbers; three each, north, east, down.
enum
{
    STREAM_WHITE = 0,
    STREAM_SLOW = 3,
    STREAM_VELOCITY = 6,
    STREAM_SATS = 9
};

void ins_gps_ideal_config(ins_gps_config_t* config)
{
    *config =
        (ins_gps_config_t){.period_ps = (int64_t)PS_PER_S, .markov_tau_s = 100.0, .sats = 8, .hdop = 1.2, .seed = 1};
}

void ins_gps_default_config(ins_gps_config_t* config)
{
    ins_gps_ideal_config(config);
    config->latency_ps = (int64_t)PS_PER_S / 10;
    for (int i = 0; i < 3; i++)
    {
        const double vertical = i == 2 ? 2.0 : 1.0;
        config->white[i] = 1.5 * vertical;
        config->markov[i] = 2.5 * vertical;
        config->velocity[i] = 0.1;
    }
    config->sats_spread = 2;
}

static bool check_errors(const ins_gps_config_t* c, const ins_why_t* why)
{
    static const char* const white[3] = {"white[0]", "white[1]", "white[2]"};
    static const char* const markov[3] = {"markov[0]", "markov[1]", "markov[2]"};
    static const char* const velocity[3] = {"velocity[0]", "velocity[1]", "velocity[2]"};
    for (int i = 0; i < 3; i++)
    {
        if (!ins_why_range(why, "", white[i], c->white[i], 0.0, 1e4) ||
            !ins_why_range(why, "", markov[i], c->markov[i], 0.0, 1e4) ||
            !ins_why_range(why, "", velocity[i], c->velocity[i], 0.0, 1e4))
        {
            return false;
        }
    }
    return ins_why_range(why, "", "markov_tau_s", c->markov_tau_s, 1e-3, 1e6);
}

static bool check(const ins_gps_config_t* c, const ins_why_t* why)
{
    if (!ins_why_range(why, "", "period_ps", (double)c->period_ps, 1e10, 1e14) ||
        !ins_why_range(why, "", "latency_ps", (double)c->latency_ps, 0.0, 1e13) || !check_errors(c, why) ||
        !ins_why_range(why, "", "sats", c->sats, 3.0, 32.0) ||
        !ins_why_range(why, "", "sats_spread (leaving 3)", c->sats_spread, 0.0, c->sats - 3.0) ||
        !ins_why_range(why, "", "sats_outage", c->sats_outage, 0.0, 2.0) ||
        !ins_why_range(why, "", "hdop", c->hdop, 0.5, 50.0) ||
        !ins_why_range(why, "", "first_fix_s", c->first_fix_s, 0.0, 1e9) ||
        !ins_why_range(why, "", "outages", c->outages, 0.0, INS_GPS_OUTAGES))
    {
        return false;
    }
    for (unsigned i = 0; i < c->outages; i++)
    {
        if (!(c->outage[i].from_s <= c->outage[i].to_s))
        {
            ins_why_say(why, "outage %u: from_s is %.9g, to_s %.9g, give from_s <= to_s", i + 1, c->outage[i].from_s,
                        c->outage[i].to_s);
            return false;
        }
    }
    return true;
}

bool ins_gps_init(ins_gps_t* self, const ins_gps_config_t* config, const ins_track_t* track, char* text, size_t size)
{
    const ins_why_t why = {text, size};
    if (!check(config, &why))
    {
        return false;
    }
    self->config = *config;
    self->track = track;
    self->phi = ins_truth_exp(-(double)config->period_ps / PS_PER_S / config->markov_tau_s);
    self->kick = sqrt(1.0 - self->phi * self->phi);
    self->slow_number = -1;
    return true;
}

/// Bring the slow error to fix `number`; from the beginning when it lies before the one at hand.
static void slow_until(ins_gps_t* self, int64_t number)
{
    if (number < self->slow_number || self->slow_number < 0)
    {
        self->slow_number = 0;
        for (unsigned i = 0; i < 3; i++)
        {
            self->slow[i] = ins_noise_normal(self->config.seed, STREAM_SLOW + i, 0);
        }
    }
    while (self->slow_number < number)
    {
        self->slow_number++;
        for (unsigned i = 0; i < 3; i++)
        {
            const double w = ins_noise_normal(self->config.seed, STREAM_SLOW + i, self->slow_number);
            self->slow[i] = self->phi * self->slow[i] + self->kick * w;
        }
    }
}

static bool in_view(const ins_gps_config_t* c, double t)
{
    bool view = t >= c->first_fix_s;
    for (unsigned i = 0; i < c->outages; i++)
    {
        view = view && !(t >= c->outage[i].from_s && t < c->outage[i].to_s);
    }
    return view;
}

static void measure(ins_gps_t* self, const ins_track_geodetic_t* truth, ins_gps_fix_t* fix)
{
    const ins_gps_config_t* const c = &self->config;
    ins_place_t place;
    double error_n[3];
    double error_e[3];
    slow_until(self, fix->number);
    for (unsigned i = 0; i < 3; i++)
    {
        error_n[i] =
            c->white[i] * ins_noise_normal(c->seed, STREAM_WHITE + i, fix->number) + c->markov[i] * self->slow[i];
        fix->v_n[i] = truth->v_n[i] + c->velocity[i] * ins_noise_normal(c->seed, STREAM_VELOCITY + i, fix->number);
    }
    ins_place_of_llh(truth->llh, &place);
    ins_place_into_e(&place, error_n, error_e);
    for (int i = 0; i < 3; i++)
    {
        error_e[i] += place.xyz_e[i];
    }
    ins_place_of_xyz(error_e, &place);
    for (int i = 0; i < 3; i++)
    {
        fix->llh[i] = place.llh[i];
    }
    fix->speed = sqrt(fix->v_n[0] * fix->v_n[0] + fix->v_n[1] * fix->v_n[1]);
    fix->course = ins_truth_atan2(fix->v_n[1], fix->v_n[0]);
    fix->course += fix->course < 0.0 ? 2.0 * INS_TRUTH_PI : 0.0;
    fix->sats = c->sats - (unsigned)(ins_noise_bits(c->seed, STREAM_SATS, fix->number) % (c->sats_spread + 1u));
    fix->hdop = c->hdop;
}

void ins_gps_number(ins_gps_t* self, int64_t number, ins_gps_fix_t* fix)
{
    ins_track_geodetic_t truth;
    *fix =
        (ins_gps_fix_t){.number = number, .of_ps = number * self->config.period_ps, .sats = self->config.sats_outage};
    const double t = (double)fix->of_ps / PS_PER_S;
    ins_track_geodetic(self->track, t, &truth);
    fix->valid = in_view(&self->config, t) && truth.llh[2] == truth.llh[2];
    if (fix->valid)
    {
        measure(self, &truth, fix);
    }
}

bool ins_gps_fix(ins_gps_t* self, int64_t t_ps, ins_gps_fix_t* fix)
{
    if (t_ps < self->config.latency_ps)
    {
        *fix = (ins_gps_fix_t){.number = -1};
        return false;
    }
    ins_gps_number(self, (t_ps - self->config.latency_ps) / self->config.period_ps, fix);
    return fix->valid;
}
