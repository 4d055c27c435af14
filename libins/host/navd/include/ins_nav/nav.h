/// \file   ins_nav/nav.h
/// \brief  The host of the sampling board: handshake octets in, navigation state out. Frame: b -> n. Units: s, rad, rad/s.
///
///     ins_nav_config_t cfg;
///     ins_nav_config_default(&cfg);
///     ins_nav_init(&nav, &cfg);
///     while (receive(&octet))
///     {
///         if (ins_nav_octet(&nav, octet, now_ms, &reply, &state) == 1) { use(&state); }
///         if (reply >= 0) { send(reply); }
///     }
///
/// Two halves: ins_nav_link_t turns octets into numbered samples, ins_nav_solver_t turns samples into attitude. A program with two
/// threads holds one half in each; ins_nav_t is both in one. No thread, no clock, no transport, no allocation.
/// Time is the firmware's period times the sample number. The arrival time decides one thing only: how many times the 8-bit
/// sequence number went round in a long gap. Lost samples are bridged with one trapezoid over the gap, counted, and flagged.
/// SPDX-License-Identifier: MIT
#ifndef INS_NAV_NAV_H_INCLUDED
#define INS_NAV_NAV_H_INCLUDED
#include "ins/attitude.h"
#include "ins/handshake.h"
#include "ins/rates.h"
#include "ins_nav/types.h"
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

/// Octets to samples. Members are private; counts is readable.
typedef struct ins_nav_link_t
{
    ins_nav_config_t cfg;
    ins_hs_host_t hs;
    uint8_t started;
    uint64_t index;
    uint64_t last_ms;
    ins_nav_counts_t counts;
} ins_nav_link_t;

/// Samples to attitude. Members are private.
typedef struct ins_nav_solver_t
{
    ins_nav_config_t cfg;
    ins_attitude_t attitude;
    ins_rates_t rates;
    ins_skew_t skew;
    uint8_t skewed;
    uint64_t index;
    uint64_t used;
    uint64_t missed;
    uint32_t sticky;
} ins_nav_solver_t;

typedef struct ins_nav_t
{
    ins_nav_link_t link;
    ins_nav_solver_t solver;
} ins_nav_t;

/// 20 ms, blocks of 6 with sequence number, +-90 deg/s over 4096 codes around 2048, history 2 optimal, AM4, no skew, level and north.
INS_API void ins_nav_config_default(ins_nav_config_t* cfg);
/// Attitude at the first sample from roll, pitch, yaw; the same bits on every machine (no libm). \return INS_OK or INS_E_RANGE.
INS_API ins_status_t ins_nav_config_attitude(ins_nav_config_t* cfg, const double euler_rad[3]);
/// \return NULL when cfg is usable, else what is wrong with it and what would be right.
INS_API const char* ins_nav_config_problem(const ins_nav_config_t* cfg);

/// \return INS_OK; INS_E_RANGE (ins_nav_config_problem tells why).
INS_API ins_status_t ins_nav_link_init(ins_nav_link_t* self, const ins_nav_config_t* cfg);
/// An octet came. \param[in] now_ms any free-running clock. \param[out] reply octet to send back, or -1. \return 1: *sample is new; 0.
INS_API int ins_nav_link_octet(ins_nav_link_t* self, ins_octet_t octet, uint64_t now_ms, int* reply,
                               ins_nav_sample_t* sample);
/// Time passes and no octet is waiting: call at least every octet_timeout_ms.
INS_API void ins_nav_link_tick(ins_nav_link_t* self, uint64_t now_ms);

/// \return INS_OK; INS_E_RANGE (ins_nav_config_problem tells why).
INS_API ins_status_t ins_nav_solver_init(ins_nav_solver_t* self, const ins_nav_config_t* cfg);
/// \param[in] sample its index must be above the last one's. \return INS_OK; INS_E_RANGE, nothing changed.
INS_API ins_status_t ins_nav_solver_step(ins_nav_solver_t* self, const ins_nav_sample_t* sample,
                                         ins_nav_state_t* state);

/// Both halves. \return INS_OK; INS_E_RANGE (ins_nav_config_problem tells why).
INS_API ins_status_t ins_nav_init(ins_nav_t* self, const ins_nav_config_t* cfg);
/// Link and solver in one. \return 1: *state is new; 0.
INS_API int ins_nav_octet(ins_nav_t* self, ins_octet_t octet, uint64_t now_ms, int* reply, ins_nav_state_t* state);
/// As ins_nav_link_tick().
INS_API void ins_nav_tick(ins_nav_t* self, uint64_t now_ms);
/// A sample that came another way, after `lost` missing ones. \return INS_OK; INS_E_RANGE for a code above code_max.
INS_API ins_status_t ins_nav_codes(ins_nav_t* self, const uint16_t code[3], uint32_t lost, ins_nav_state_t* state);

/// One line of JSON, ended by a newline; reals as %.17g, so that they read back bit for bit.
/// \return its length without the final 0; 0 when it does not fit (INS_NAV_JSON_MAX always does).
INS_API size_t ins_nav_state_json(const ins_nav_state_t* state, char* buffer, size_t size);
#define INS_NAV_JSON_MAX 1536

#ifdef __cplusplus
}
#endif
#endif // INS_NAV_NAV_H_INCLUDED
