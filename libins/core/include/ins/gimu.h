/// \file   ins/gimu.h
/// \brief  Packets of the GIMU (2006 thesis, chapter 4): 19200 Bd 8N1, high octet first, 5 of type 1 and 1 of type 2 a second.
///
///     ins_gimu_t g;
///     ins_gimu_init(&g, 1);
///     if (ins_gimu_rx(&g, octet) != INS_GIMU_NOTHING) { use(&g.packet); }     // each octet
///     if (ins_gimu_flush(&g) != INS_GIMU_NOTHING) { use(&g.packet); }         // the line has been silent
///
///     type 1, 14 octets: AA 55, P, Q, R, AX, AY, AZ (16 bits each, 12 used)
///     type 2, 23 octets: type 1, two coordinates (32 bits each), satellites (8 bits); the thesis's text says 22
///
/// There is no length, type or checksum: the type is found by looking ahead to the next AA 55, which cannot come about within
/// 12-bit samples but can within a coordinate. Type 2 is also asked to be plausible: degrees <= 180, minutes < 60, satellites <= 32.
/// So a packet is given out with the second octet of the next one, or by ins_gimu_flush() at once.
/// What cannot be seen: a wrong bit in the low 12 of a sample, or a plausible one in a coordinate.
/// A coordinate is (d)ddmm.mmmm times 10^4. The thesis's labels are swapped in its example, so both orders are taken: the one above
/// 90 degrees is the longitude; if neither is, the first is the latitude. There is no hemisphere.
/// SPDX-License-Identifier: MIT
#ifndef INS_GIMU_H_INCLUDED
#define INS_GIMU_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_GIMU_T1_LEN  14
#define INS_GIMU_T2_LEN  23
#define INS_GIMU_LOOK    (INS_GIMU_T2_LEN + 2) ///< octets that settle any question
#define INS_GIMU_RATE_HZ 6

/// What an octet led to.
enum
{
    INS_GIMU_NOTHING = 0,
    INS_GIMU_T1 = 1,
    INS_GIMU_T2 = 2
};

typedef struct ins_gimu_packet_t
{
    uint16_t raw[6];        ///< P, Q, R, AX, AY, AZ [LSB]
    uint32_t coordinate[2]; ///< as sent (type 2)
    int32_t lat_e7;         ///< [1e-7 deg] (type 2 with has_position)
    int32_t lon_e7;
    uint_least8_t sats;         ///< (type 2)
    uint_least8_t has_position; ///< 0 for type 1, and where both coordinates are above 90 degrees
} ins_gimu_packet_t;

/// Owned by the caller. Members are private, packet and the counters readable.
typedef struct ins_gimu_t
{
    uint_least8_t check_12_bits;
    uint_least8_t count; ///< octets waiting
    ins_octet_t wait[INS_GIMU_LOOK];
    ins_gimu_packet_t packet; ///< the last one given out
    uint32_t t1;              ///< packets of each type
    uint32_t t2;
    uint32_t skipped; ///< octets that belong to no packet
} ins_gimu_t;

/// \param[in] check_12_bits  1: a sample above FFF is no sample. 0: it is; the thesis's figure 4.4 has such.
INS_API void ins_gimu_init(ins_gimu_t* self, int check_12_bits);
/// An octet came. At most one packet. \return INS_GIMU_T1 or T2: it is in self->packet.
INS_API int ins_gimu_rx(ins_gimu_t* self, ins_octet_t octet);
/// Nothing follows for now: judge what waits without the next header. Fewer than 14 octets go on waiting.
INS_API int ins_gimu_flush(ins_gimu_t* self);

/// A coordinate in 1e-7 degree, rounded. \param[in] coordinate  as sent, plausible.
INS_API int32_t ins_gimu_e7(uint32_t coordinate);

/// Scale of the sensors. A fractional null matters: half a unit is 6.3 degrees a minute.
typedef struct ins_gimu_scale_t
{
    ins_real null[6];      ///< reading at rest [LSB], e.g. a mean of 60 samples or more
    ins_real rate[3];      ///< [rad/s per LSB]
    ins_real acceleration; ///< [m/s^2 per LSB]
} ins_gimu_scale_t;

#define INS_GIMU_NULL INS_C(2047.0)
/// The thesis's calibration of its three gyros [deg/s per LSB].
#define INS_GIMU_KP INS_C(0.2087)
#define INS_GIMU_KQ INS_C(0.2099)
#define INS_GIMU_KR INS_C(0.1993)
/// Data sheets: 4 mV per deg/s and 800 mV per g on 12 bits of 3.3 V.
#define INS_GIMU_K_NOMINAL (INS_C(3300.0) / INS_C(4095.0) / INS_C(4.0))
#define INS_GIMU_G_NOMINAL (INS_C(3300.0) / INS_C(4095.0) / INS_C(800.0)) ///< [g per LSB]
#define INS_GIMU_G         INS_C(9.8)                                     ///< the thesis's g [m/s^2]

/// The thesis's K for the gyros, the data sheet's for the accelerometers, nulls at 2047.
INS_API void ins_gimu_scale_thesis(ins_gimu_scale_t* self);
/// Data-sheet values, nulls at 2047.
INS_API void ins_gimu_scale_nominal(ins_gimu_scale_t* self);
/// Angle and velocity increments of one packet. \param[in] raw  [6]. \param[in] dt  [s], 1/6 for a GIMU.
/// \param[out] dtheta_b  [3] rad. \param[out] dv_b  [3] m/s.
INS_API void ins_gimu_increments(const ins_gimu_scale_t* self, const uint16_t* raw, ins_real dt, ins_real dtheta_b[3],
                                 ins_real dv_b[3]);

#ifdef __cplusplus
}
#endif
#endif // INS_GIMU_H_INCLUDED
