/// \file   gimu.c
/// \brief  The GIMU of the 2006 thesis (section 4.1, figures 4.4 and 4.5): packets of samples and coordinates on pin T.
///
/// | octets   | type 1, 14 octets                         | type 2, 23 octets, every sixth |
/// | 0, 1     | AA 55                                     | the same                       |
/// | 2 .. 13  | P, Q, R, AX, AY, AZ, 16 bits, high first  | the same                       |
/// | 14 .. 21 |                                           | two coordinates, 32 bits       |
/// | 22       |                                           | satellites                     |
///
/// The thesis's text says 22 octets; its figure has 23. A coordinate is degrees times 10^6 plus minutes times 10^4, of the absolute
/// value: there is no hemisphere.
/// SPDX-License-Identifier: MIT
#include "gimu_internal.h"
#include <math.h>
#include <stdio.h>

#define TYPE_2_EVERY 6u
#define DEGREE       600000.0 ///< of a minute times 10^4

uint32_t gimu_coordinate(double angle)
{
    const double minutes = floor(fabs(angle) * (180.0 / GIMU_PI) * DEGREE + 0.5); // times 10^4
    const double degrees = floor(minutes / DEGREE);
    return degrees <= 360.0 ? (uint32_t)(degrees * 1e6 + (minutes - degrees * DEGREE)) : 0;
}

bool gimu_newest_fix(const gimu_t* self, emu_time_t at, gimu_fix_t* fix)
{
    *fix = (gimu_fix_t){.of_ps = at - at % EMU_PS_PER_S};
    return self->config.fix != NULL && self->config.fix(self->config.fix_ctx, at, fix);
}

static void put(gimu_t* self, uint32_t value, unsigned octets)
{
    for (unsigned i = octets; i-- > 0;)
    {
        (void)emu_serial_end_send(&self->t, (uint8_t)(value >> (8 * i) & 0xFFu));
    }
}

static void put_fix(gimu_t* self, emu_time_t at)
{
    gimu_fix_t fix;
    const unsigned longitude_first = self->config.order == GIMU_LONGITUDE_FIRST;
    if (gimu_newest_fix(self, at, &fix))
    {
        self->coordinate[0] = gimu_coordinate(fix.latitude);
        self->coordinate[1] = gimu_coordinate(fix.longitude);
    }
    else if (self->config.no_fix == GIMU_SEND_ZEROS)
    {
        self->coordinate[0] = self->coordinate[1] = 0;
    }
    put(self, self->coordinate[longitude_first], 4);
    put(self, self->coordinate[1 - longitude_first], 4);
    put(self, fix.sats, 1);
}

static void packet(void* ctx, emu_time_t at)
{
    gimu_t* const self = ctx;
    uint16_t raw[GIMU_CHANNELS];
    gimu_sample(self, at, raw);
    put(self, 0xAA55u, 2);
    for (int i = 0; i < GIMU_CHANNELS; i++)
    {
        put(self, raw[i], 2);
    }
    if (self->packets % TYPE_2_EVERY == TYPE_2_EVERY - 1)
    {
        put_fix(self, at);
    }
    if (self->config.sampled != NULL)
    {
        self->config.sampled(self->config.sampled_ctx, self->packets, raw, at);
    }
    self->packets++;
    emu_sched_at(self->sched, &self->packet_event,
                 self->begun + self->config.power_up + emu_ticker_time(&self->cadence, self->packets));
}

static void nmea(void* ctx, emu_time_t at)
{
    gimu_t* const self = ctx;
    gimu_send_nmea(self, at);
    emu_sched_at(self->sched, &self->nmea_event, at + EMU_PS_PER_S);
}

bool gimu_init(gimu_t* self, const gimu_config_t* config, emu_sched_t* sched, emu_wire_t* t, emu_wire_t* nmea_wire,
               char* why, size_t why_size)
{
    static const emu_clock_t cadence = {GIMU_RATE_HZ, 1};
    if (!gimu_check(config, why, why_size))
    {
        return false;
    }
    *self = (gimu_t){.config = *config,
                     .sched = sched,
                     .begun = sched->now,
                     .packet_event = {.fire = packet, .ctx = self},
                     .nmea_event = {.fire = nmea, .ctx = self},
                     .rng = config->seed};
    const double baud = config->baud * (1.0 + 1e-9 * config->clock_ppb);
    if (emu_serial_end_init(&self->t, sched, t, NULL, baud, NULL, NULL) != 0 ||
        (nmea_wire != NULL &&
         emu_serial_end_init(&self->nmea, sched, nmea_wire, NULL, config->nmea_baud, NULL, NULL) != 0))
    {
        if (why != NULL)
        {
            (void)snprintf(why, why_size, "GIMU: a wire has %d drivers already, take one off", EMU_WIRE_DRIVERS);
        }
        return false;
    }
    for (int i = 0; i < GIMU_CHANNELS; i++)
    {
        self->noise_v[i] = config->channel[i].noise_density * sqrt(0.5 * GIMU_PI * config->channel[i].bandwidth_hz);
    }
    emu_ticker_init(&self->cadence, &cadence);
    emu_ticker_rate(&self->cadence, 0, config->clock_ppb);
    emu_sched_at(sched, &self->packet_event, self->begun + config->power_up);
    if (nmea_wire != NULL)
    {
        // The first whole second that finds the module under power, and awake when its sentences are due.
        const emu_time_t wait = config->power_up > config->nmea_delay ? config->power_up - config->nmea_delay : 0;
        const emu_time_t second = (self->begun + wait + EMU_PS_PER_S - 1) / EMU_PS_PER_S * EMU_PS_PER_S;
        emu_sched_at(sched, &self->nmea_event, second + config->nmea_delay);
    }
    return true;
}
