/// \file   ins/nav_block.h
/// \brief  Navigation result in a block of 32 octets for the handshake: position, velocity, attitude, time. Frame: b -> n, grid. Units: SI.
///
///     ins_nav_block_t told = {0};
///     ins_octet_t block[INS_NAV_BLOCK_LEN];
///     ins_nav_block_put(&told, block);       // on the DSP; then ins_hs_board_offer(), with block_len = INS_NAV_BLOCK_LEN and seq = 1
///     ins_nav_block_get(block, &told);       // on the PC, of a host's block, after INS_HS_BLOCK
///
/// Fixed point, high octet first, two's complement. The high nibbles of octets 0 and 2 stay 0: the handshake's number goes there.
///
///     0       bits 3..2 version (1), bits 1..0 number of the quaternion's largest component, which is not sent
///     1       satellites of the last fix
///     2, 3    status, 12 bits (INS_NAV_BLOCK_STATUS_LIST)
///     4..7    time of the sample since the board's start [ms], modulo 2^32
///     8..11, 12..15    easting, northing [cm]
///     16..18, 19..21   velocity east, north [mm/s]
///     22..30  the other three components of q_nb, in order, of the sign that makes the largest positive [2^-23]
///     31      age of the last fix [0.1 s]; 255: that or longer, or none
///
/// An attitude comes back within 4.2e-7 rad (float: 9e-7), whatever it is: no pole, no libm but sqrt.
/// Source: the thesis on the GPS-enabled IMU, Chung Hua University, 2009, sends position, velocity and heading to a PC; the layout is ours.
/// SPDX-License-Identifier: MIT
#ifndef INS_NAV_BLOCK_H_INCLUDED
#define INS_NAV_BLOCK_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_NAV_BLOCK_LEN     32
#define INS_NAV_BLOCK_VERSION 1
#define INS_NAV_BLOCK_OLD     255u          ///< of fix_age
#define INS_NAV_BLOCK_V_MAX   INS_C(8388.0) ///< fastest that fits [m/s]

/// aligned: nulls and level are found, the attitude counts. integer, fraction: the nulls are so calibrated (neither: not at all).
/// position: the grid coordinates and velocities count. filter: they come from the filter and not from dead reckoning alone.
/// zone_119: grid of TWD97 zone 119, else 121. gated: the filter refused the last fix. line_error: octets of the sensor were damaged
/// since the block before. gap: the sensor's packets were interrupted since the block before. watchdog: the last start was the watchdog's.
/// clipped: a gyro reads an end of its scale.
#define INS_NAV_BLOCK_STATUS_LIST(X)                                                                                   \
    X(INS_NAV_BLOCK_ALIGNED, 0x001, "aligned")                                                                         \
    X(INS_NAV_BLOCK_INTEGER, 0x002, "integer_null")                                                                    \
    X(INS_NAV_BLOCK_FRACTION, 0x004, "fractional_null")                                                                \
    X(INS_NAV_BLOCK_POSITION, 0x008, "position")                                                                       \
    X(INS_NAV_BLOCK_FILTER, 0x010, "filter")                                                                           \
    X(INS_NAV_BLOCK_ZONE_119, 0x020, "zone_119")                                                                       \
    X(INS_NAV_BLOCK_GATED, 0x040, "gated")                                                                             \
    X(INS_NAV_BLOCK_LINE_ERROR, 0x080, "line_error")                                                                   \
    X(INS_NAV_BLOCK_GAP, 0x100, "sensor_gap")                                                                          \
    X(INS_NAV_BLOCK_WATCHDOG, 0x200, "watchdog")                                                                       \
    X(INS_NAV_BLOCK_CLIPPED, 0x400, "clipped")

#define INS_NAV_BLOCK_STATUS_ENUM(name, value, text) name = (value),
enum
{
    INS_NAV_BLOCK_STATUS_LIST(INS_NAV_BLOCK_STATUS_ENUM) INS_NAV_BLOCK_STATUS_ALL = 0x7FF
};
#undef INS_NAV_BLOCK_STATUS_ENUM

typedef struct ins_nav_block_t
{
    uint32_t time_ms;
    uint16_t status;
    uint_least8_t sats;
    uint_least8_t fix_age; ///< [0.1 s]
    int32_t en_cm[2];      ///< easting, northing
    ins_real v_en[2];      ///< velocity east, north [m/s]
    ins_real q_nb[4];      ///< scalar first, v_n = q v_b q*, n is NED
} ins_nav_block_t;

/// \param[out] block  [INS_NAV_BLOCK_LEN].
/// \return INS_OK; INS_E_RANGE for NaN, a velocity above INS_NAV_BLOCK_V_MAX, a quaternion whose norm is not within 1e-3 of 1 (it is
/// normalised), or status bits beyond INS_NAV_BLOCK_STATUS_ALL; block is then unchanged.
INS_API ins_status_t ins_nav_block_put(const ins_nav_block_t* nav, ins_octet_t* block);
/// \param[in] block  [INS_NAV_BLOCK_LEN], without a sequence number (as ins_hs_host_t has it).
/// \return INS_OK; INS_E_RANGE for another version, bits that are always 0, or components that are no quaternion's; nav is then unchanged.
INS_API ins_status_t ins_nav_block_get(const ins_octet_t* block, ins_nav_block_t* nav);

#ifdef __cplusplus
}
#endif
#endif // INS_NAV_BLOCK_H_INCLUDED
