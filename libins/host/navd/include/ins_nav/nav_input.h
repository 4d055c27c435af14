/// \file   ins_nav/nav_input.h
/// \brief  The host of a navigating board: handshake octets in, its position, velocity and attitude out. Frame: b -> n, grid. Units: SI.
///
///     ins_nav_input_t input;
///     ins_nav_input_config_t limits;
///     ins_nav_solution_t solution;
///     ins_nav_input_config_default(&limits);
///     ins_nav_input_init(&input, &limits);
///     while (receive(&octet))
///     {
///         if (ins_nav_input_octet(&input, octet, now_ms, &reply, &solution) == 1) { use(&solution); }
///         if (reply >= 0) { send(reply); }
///     }
///
/// The board has navigated already: nothing is integrated here. Its blocks (ins/nav_block.h) carry its clock, so a block that is missing
/// costs only itself. No thread, no clock, no transport, no allocation.
/// SPDX-License-Identifier: MIT
#ifndef INS_NAV_NAV_INPUT_H_INCLUDED
#define INS_NAV_NAV_INPUT_H_INCLUDED
#include "ins/handshake.h"
#include "ins/nav_block.h"
#include "ins/tm.h"
#include "ins_nav/types.h"
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

/// Beside those of INS_NAV_BLOCK_STATUS_LIST: the board's clock went back before this block.
#define INS_NAV_RESTARTED 0x1000u

typedef struct ins_nav_input_config_t
{
    uint8_t retries;           ///< FFs in a row before the next AA is awaited
    uint16_t octet_timeout_ms; ///< longest silence inside a block; below the board's reply time-out
} ins_nav_input_config_t;

/// What the board says, in doubles.
typedef struct ins_nav_solution_t
{
    uint64_t index;        ///< block number since the first one; lost ones count, but for those around a restart
    double t_s;            ///< the board's clock at the sample, since its start [s]
    double q_nb[4];        ///< v_n = q v_b q*, scalar first, n is NED
    double euler_rad[3];   ///< roll, pitch, heading (ZYX) [rad]; from libm, for display
    double en_m[2];        ///< easting, northing of TWD97 TM2 [m]
    double lat_lon_rad[2]; ///< from these by ins_tm_inverse() [rad]; 0 without a position
    double v_en_m_s[2];    ///< east, north [m/s]
    double fix_age_s;      ///< 25.5: that or longer, or none [s]
    uint32_t sats;         ///< of the last fix
    uint32_t zone;         ///< 121 or 119; 0 without a position
    uint32_t seq;          ///< sequence number
    uint32_t lost;         ///< blocks missing just before this one
    uint32_t status;       ///< INS_NAV_BLOCK_ALIGNED ..., INS_NAV_RESTARTED
    ins_nav_counts_t counts;
} ins_nav_solution_t;

/// Members are private; counts is readable.
typedef struct ins_nav_input_t
{
    ins_hs_host_t hs;
    ins_tm_t zone[2]; ///< 121, 119
    uint8_t started;
    uint32_t last_ms;   ///< as sent
    uint64_t rounds_ms; ///< what its 32 bits have lost
    uint64_t index;
    ins_nav_counts_t counts;
} ins_nav_input_t;

/// 3 retries, 30 ms between octets.
INS_API void ins_nav_input_config_default(ins_nav_input_config_t* cfg);
/// \return INS_OK; INS_E_RANGE unless octet_timeout_ms is 1 to 32767.
INS_API ins_status_t ins_nav_input_init(ins_nav_input_t* self, const ins_nav_input_config_t* cfg);
/// An octet came. \param[in] now_ms  any free-running clock. \param[out] reply  octet to send back, or -1. \return 1: *solution is new; 0.
INS_API int ins_nav_input_octet(ins_nav_input_t* self, ins_octet_t octet, uint64_t now_ms, int* reply,
                                ins_nav_solution_t* solution);
/// Time passes and no octet is waiting: call at least every octet_timeout_ms.
INS_API void ins_nav_input_tick(ins_nav_input_t* self, uint64_t now_ms);

/// One line of JSON, as ins_nav_state_json() writes a state. INS_NAV_JSON_MAX always suffices.
INS_API size_t ins_nav_solution_json(const ins_nav_solution_t* solution, char* buffer, size_t size);

#ifdef __cplusplus
}
#endif
#endif // INS_NAV_NAV_INPUT_H_INCLUDED
