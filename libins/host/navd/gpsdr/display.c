/// \file   display.c
/// \brief  Four lines of text.
/// SPDX-License-Identifier: MIT
#include "display.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define DEG_PER_RAD (180.0 / 3.14159265358979323846)
#define DAY_MS      86400000u

const char* display_source(int source)
{
    static const char* const names[] = {"NONE", "ALIGN", "DR", "GPS"}; // INS_GPS_DR_NONE ...
    return names[source];
}

static void put(char* text, size_t size, size_t* length, int written)
{
    (void)text;
    *length = written > 0 && *length + (size_t)written < size ? *length + (size_t)written : size - 1;
}

/// Degrees and minutes of an angle, rounded as one so that no minute is 60.
static void degrees(double rad, long* deg, double* minutes)
{
    const long ten_thousandths = lround(fabs(rad) * DEG_PER_RAD * 60e4);
    *deg = ten_thousandths / 600000;
    *minutes = (double)(ten_thousandths % 600000) * 1e-4;
}

/// UTC of the solution: that of the newest fix and the board's time since it came. With the date as far as the receiver has said it.
static int clock_text(const ins_vehicle_t* v, char* text, size_t size)
{
    if (!(v->fix.has & INS_NMEA_TIME))
    {
        return snprintf(text, size, "--:--:--\n");
    }
    const uint32_t s = (v->fix.time_ms + (v->last_ms - v->fix_ms)) % DAY_MS / 1000u;
    const unsigned h = s / 3600u;
    const unsigned m = s / 60u % 60u;
    if (v->motion.has & INS_NMEA_DATE)
    {
        return snprintf(text, size, "20%02u-%02u-%02u %02u:%02u:%02u UTC\n", v->motion.date[2] % 100u,
                        v->motion.date[1] % 100u, v->motion.date[0] % 100u, h, m, s % 60u);
    }
    return snprintf(text, size, "%02u:%02u:%02u UTC\n", h, m, s % 60u);
}

size_t display_text(const ins_vehicle_t* vehicle, const ins_nav_solution_t* solution, char* text, size_t size)
{
    size_t n = 0;
    if (solution->status & INS_NAV_BLOCK_POSITION)
    {
        long deg[2];
        double minutes[2];
        const double* const at = solution->lat_lon_rad;
        degrees(at[0], &deg[0], &minutes[0]);
        degrees(at[1], &deg[1], &minutes[1]);
        put(text, size, &n,
            snprintf(text, size, "%3ld %07.4f %c  %3ld %07.4f %c\n", deg[0], minutes[0], at[0] < 0 ? 'S' : 'N', deg[1],
                     minutes[1], at[1] < 0 ? 'W' : 'E'));
    }
    else
    {
        put(text, size, &n, snprintf(text, size, "no position\n"));
    }
    put(text, size, &n, clock_text(vehicle, text + n, size - n));
    if (solution->status & INS_NAV_BLOCK_ALIGNED)
    {
        const double heading = solution->euler_rad[2] * DEG_PER_RAD;
        const double tenths = fmod(round(10.0 * (heading < 0 ? heading + 360.0 : heading)), 3600.0);
        put(text, size, &n,
            snprintf(text + n, size - n, "%5.1f km/h   heading %5.1f\n",
                     3.6 * hypot(solution->v_en_m_s[0], solution->v_en_m_s[1]), tenths / 10.0));
    }
    else
    {
        put(text, size, &n, snprintf(text + n, size - n, "  --- km/h   heading  ---\n"));
    }
    put(text, size, &n,
        snprintf(text + n, size - n, "%-5s %2u satellites  +-%.0f m\n", display_source(ins_vehicle_source(vehicle)),
                 (unsigned)solution->sats, ins_vehicle_sigma(vehicle)));
    return n;
}

int display_show(const ins_vehicle_t* vehicle, const ins_nav_solution_t* solution, int again)
{
    char text[DISPLAY_MAX];
    const size_t length = display_text(vehicle, solution, text, sizeof text);
    const int terminal = isatty(STDOUT_FILENO);
    if (again)
    {
        (void)fputs(terminal ? "\033[4A\033[J" : "\n", stdout);
    }
    return fwrite(text, 1, length, stdout) == length && fflush(stdout) == 0 ? 0 : -1;
}
