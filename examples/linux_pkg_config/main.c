/// \file   main.c
/// \brief  NMEA sentences from standard input to metres north, east and down of the first fix. Frame: n (NED). SI, rad.
///
///     cat /dev/ttyUSB0 | nmea_ned
///
/// One line a GGA sentence with a fix: time [s], north, east, down [m], satellites. Counters of what was refused at the end.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#include <stdio.h>

#define RAD_PER_E7 1.745329251994329577e-9 ///< of 1e-7 deg

int main(void)
{
    if (INS_ABI_CHECK() != INS_OK)
    {
        fprintf(stderr, "nmea_ned: %s\n", ins_status_text(INS_E_ABI));
        return 1;
    }
    ins_nmea_t nmea;
    ins_nmea_fix_t first;
    int started = 0;
    int octet;
    ins_nmea_init(&nmea);
    while ((octet = getchar()) != EOF)
    {
        const ins_nmea_fix_t* fix = &nmea.fix;
        if (ins_nmea_rx(&nmea, (ins_octet_t)octet) != INS_NMEA_GGA || !fix->valid)
        {
            continue;
        }
        if (!started)
        {
            first = *fix;
            started = 1;
        }
        // The difference is taken in integers: nothing of a millimetre is lost, in float either.
        const ins_position_t from = {{(ins_real)(first.lat_e7 * RAD_PER_E7), 0, 0}, {0, 0, 0}};
        ins_position_t to = from;
        ins_real ned[3];
        to.offset[0] = (ins_real)((fix->lat_e7 - first.lat_e7) * RAD_PER_E7);
        to.offset[1] = (ins_real)((fix->lon_e7 - first.lon_e7) * RAD_PER_E7);
        to.offset[2] = (ins_real)((fix->altitude_mm + fix->geoid_mm - first.altitude_mm - first.geoid_mm) * 1e-3);
        ins_position_difference(&from, &to, ned);
        printf("%.3f %.3f %.3f %.3f %d\n", fix->time_ms * 1e-3, (double)ned[0], (double)ned[1], (double)ned[2],
               fix->sats);
    }
    fprintf(stderr, "%lu taken, %lu wrong checksum, %lu malformed, %lu cut, %lu other\n", (unsigned long)nmea.taken,
            (unsigned long)nmea.bad_checksum, (unsigned long)nmea.malformed, (unsigned long)nmea.cut,
            (unsigned long)nmea.other);
    return started ? 0 : 1;
}
