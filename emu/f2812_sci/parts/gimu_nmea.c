/// \file   gimu_nmea.c
/// \brief  Pin R: GGA and RMC of NMEA 0183 v2.3 once a second, as the GPS module writes them. Integer figures, no libm but floor.
///
/// Without a fix the fields of position, speed and course are empty, GGA has quality 0, RMC status V and mode N.
/// SPDX-License-Identifier: MIT
#include "gimu_internal.h"
#include <math.h>
#include <stdio.h>

#define DAY_MS      INT64_C(86400000)
#define KNOT        (1852.0 / 3600.0) ///< [m/s]
#define BODY        160               ///< room for what stands between $ and *
#define FIGURE      24
#define POSITION    40
#define DEGREE      1000000u ///< of a coordinate
#define FIGURE_MOST 1e9      ///< larger figures do not occur

/// Nearest whole number of x.
static long nearest(double x)
{
    const double inside = x > FIGURE_MOST ? FIGURE_MOST : (x > -FIGURE_MOST ? x : -FIGURE_MOST);
    return (long)floor(inside + 0.5);
}

/// Day, month, year of the century of a day since 1970-01-01 (2000 to 2099, where every fourth year is a leap year).
static unsigned date_of(int64_t day)
{
    static const unsigned days[12] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    unsigned left = (unsigned)(day - 10957); // since 2000-01-01
    unsigned year = 4 * (left / 1461);
    left %= 1461;
    for (unsigned length = 366; left >= length; length = 365)
    {
        left -= length;
        year++;
    }
    unsigned month = 0;
    for (;;)
    {
        const unsigned length = days[month] + (month == 1 && year % 4 == 0);
        if (left < length)
        {
            return (left + 1) * 10000 + (month + 1) * 100 + year;
        }
        left -= length;
        month++;
    }
}

static void put_sentence(gimu_t* self, const char* body)
{
    static const char hex[] = "0123456789ABCDEF";
    unsigned sum = 0;
    (void)emu_serial_end_send(&self->nmea, '$');
    for (const char* c = body; *c != '\0'; c++)
    {
        sum ^= (unsigned char)*c;
        (void)emu_serial_end_send(&self->nmea, (uint8_t)*c);
    }
    const char end[5] = {'*', hex[sum >> 4 & 15u], hex[sum & 15u], '\r', '\n'};
    for (int i = 0; i < 5; i++)
    {
        (void)emu_serial_end_send(&self->nmea, (uint8_t)end[i]);
    }
    self->sentences++;
}

/// "ddmm.mmmm,N,dddmm.mmmm,E", or its commas alone.
static void put_position(char text[POSITION], const gimu_fix_t* fix, bool known)
{
    const uint32_t lat = gimu_coordinate(fix->latitude);
    const uint32_t lon = gimu_coordinate(fix->longitude);
    (void)snprintf(text, POSITION, known ? "%02u%02u.%04u,%c,%03u%02u.%04u,%c" : ",,,", lat / DEGREE,
                   lat % DEGREE / 10000, lat % 10000, fix->latitude < 0.0 ? 'S' : 'N', lon / DEGREE,
                   lon % DEGREE / 10000, lon % 10000, fix->longitude < 0.0 ? 'W' : 'E');
}

/// x in tenths, as "-0.3".
static void put_tenths(char text[FIGURE], double x)
{
    const long tenths = nearest(10.0 * x);
    const long size = tenths < 0 ? -tenths : tenths;
    (void)snprintf(text, FIGURE, "%s%ld.%ld", tenths < 0 ? "-" : "", size / 10, size % 10);
}

static void put_gga(gimu_t* self, const char* time, const char* position, const gimu_fix_t* fix, bool known)
{
    char body[BODY];
    char hdop[FIGURE];
    char altitude[FIGURE];
    char geoid[FIGURE];
    put_tenths(hdop, fix->hdop);
    put_tenths(altitude, fix->height - self->config.geoid_m);
    put_tenths(geoid, self->config.geoid_m);
    (void)snprintf(body, sizeof body, "GPGGA,%s,%s,%c,%02u,%s,%s,M,%s,M,,0000", time, position, known ? '1' : '0',
                   fix->sats, known ? hdop : "", known ? altitude : "", known ? geoid : "");
    put_sentence(self, body);
}

static void put_rmc(gimu_t* self, const char* time, const char* position, unsigned date, const gimu_fix_t* fix,
                    bool known)
{
    char body[BODY];
    char motion[2 * FIGURE];
    const long speed = nearest(100.0 * fix->speed / KNOT);
    const long turned = nearest(100.0 * fix->course * 180.0 / GIMU_PI) % 36000;
    const long course = turned < 0 ? turned + 36000 : turned;
    (void)snprintf(motion, sizeof motion, known ? "%ld.%02ld,%ld.%02ld" : ",", speed / 100, speed % 100, course / 100,
                   course % 100);
    (void)snprintf(body, sizeof body, "GPRMC,%s,%c,%s,%s,%06u,,,%c", time, known ? 'A' : 'V', position, motion, date,
                   known ? 'A' : 'N');
    put_sentence(self, body);
}

void gimu_send_nmea(gimu_t* self, emu_time_t at)
{
    gimu_fix_t fix;
    char time[16];
    char position[POSITION];
    const bool known = gimu_newest_fix(self, at, &fix);
    const int64_t ms = self->config.utc_s * 1000 + fix.of_ps / 1000000000;
    const unsigned of_day = (unsigned)(ms % DAY_MS);
    (void)snprintf(time, sizeof time, "%02u%02u%02u.%03u", of_day / 3600000, of_day / 60000 % 60, of_day / 1000 % 60,
                   of_day % 1000);
    put_position(position, &fix, known);
    put_gga(self, time, position, &fix, known);
    put_rmc(self, time, position, date_of(ms / DAY_MS), &fix, known);
}
