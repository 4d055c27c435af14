/// \file   ins/nmea.h
/// \brief  NMEA 0183 sentences GGA, RMC and VTG of any talker, octet by octet. Integer arithmetic only: no strtod, no locale.
///
///     ins_nmea_t n;
///     ins_nmea_init(&n);
///     if (ins_nmea_rx(&n, octet) != INS_NMEA_NOTHING) { use(&n.fix); }        // each octet
///
/// A sentence counts when its checksum agrees and every field that is there can be read; it is given out with the carriage
/// return or line feed after it. Empty fields leave their bit in fix.has unset. Digits beyond those kept are cut off: seven of a
/// minute, three of another figure. Only one sentence is held: nothing is merged.
/// Source: NMEA 0183 v4.10, GGA, RMC, VTG; checksum: exclusive or of what stands between $ and *.
/// SPDX-License-Identifier: MIT
#ifndef INS_NMEA_H_INCLUDED
#define INS_NMEA_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_NMEA_BODY_MAX 100 ///< octets between $ and *; the standard has 76, some receivers more

/// What an octet led to.
enum
{
    INS_NMEA_NOTHING = 0,
    INS_NMEA_GGA,
    INS_NMEA_RMC,
    INS_NMEA_VTG
};

/// Bits of ins_nmea_fix_t.has.
enum
{
    INS_NMEA_TIME = 1,
    INS_NMEA_POSITION = 2,
    INS_NMEA_SATS = 4,
    INS_NMEA_HDOP = 8,
    INS_NMEA_ALTITUDE = 16,
    INS_NMEA_GEOID = 32,
    INS_NMEA_SPEED = 64,
    INS_NMEA_COURSE = 128,
    INS_NMEA_DATE = 256
};

typedef struct ins_nmea_fix_t
{
    uint16_t has;            ///< which of the following were in the sentence
    uint_least8_t valid;     ///< GGA: quality above 0; RMC: A; VTG: mode is not N
    uint_least8_t quality;   ///< GGA: 0 none, 1 GPS, 2 differential, 4 fixed, 5 float ...; else 0
    uint_least8_t sats;      ///< satellites in use
    uint_least8_t date[3];   ///< day, month, year of the century
    uint32_t time_ms;        ///< since midnight UTC
    int32_t lat_e7, lon_e7;  ///< [1e-7 deg], north and east positive
    int32_t altitude_mm;     ///< above mean sea level
    int32_t geoid_mm;        ///< mean sea level above the ellipsoid
    int32_t hdop_milli;      ///< [1e-3]
    int32_t speed_milliknot; ///< 1 knot = 1852/3600 m/s
    int32_t course_mdeg;     ///< from true north, clockwise [1e-3 deg]
} ins_nmea_fix_t;

/// Owned by the caller. Members are private, fix and the counters readable.
typedef struct ins_nmea_t
{
    uint_least8_t state;
    uint_least8_t count;
    uint_least8_t sum;  ///< of the body so far
    uint_least8_t sent; ///< first digit of the checksum; then whether it agrees
    ins_octet_t body[INS_NMEA_BODY_MAX];
    ins_nmea_fix_t fix;    ///< of the last sentence given out
    uint32_t taken;        ///< sentences given out
    uint32_t bad_checksum; ///< checksum did not agree, or was not two hexadecimal digits and the end of the line
    uint32_t malformed;    ///< checksum right, but a field cannot be read
    uint32_t cut;          ///< sentences that stopped, ran too long, or held what is no text
    uint32_t other;        ///< right, but none of the three
} ins_nmea_t;

/// Nothing seen yet, all counters 0.
INS_API void ins_nmea_init(ins_nmea_t* self);
/// An octet came. \return INS_NMEA_GGA, RMC or VTG: self->fix has it; else INS_NMEA_NOTHING.
INS_API int ins_nmea_rx(ins_nmea_t* self, ins_octet_t octet);

#ifdef __cplusplus
}
#endif
#endif // INS_NMEA_H_INCLUDED
