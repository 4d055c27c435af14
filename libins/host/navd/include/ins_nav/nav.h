/// \file   ins_nav/nav.h
/// \brief  The host of the sampling board: handshake octets in, navigation state out. Frame: b -> n. Units: s, rad, rad/s.
///
///     ins_nav_config_t cfg;
///     ins_nav_config_default(&cfg);
///     ins_nav_init(&nav, &cfg);
///     for (each octet) { if (ins_nav_octet(&nav, octet, now_ms, &reply, &state) == 1) { use(&state); } if (reply >= 0) { send(reply); } }
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
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

/// Status bits of a state. Those marked "stays" hold from then on, the others speak of one step.
#define INS_NAV_STATUS_LIST(X)                                                                        \
    X(INS_NAV_START, 0x01u, "start")       /* fewer previous samples than the formulas want */        \
    X(INS_NAV_BRIDGED, 0x02u, "bridged")   /* samples were lost before this one */                    \
    X(INS_NAV_CLIPPED, 0x04u, "clipped")   /* a channel reads 0 or code_max: the rate may be larger */ \
    X(INS_NAV_LONG_GAP, 0x08u, "long_gap") /* stays: more than bridge_max samples were lost at once */ \
    X(INS_NAV_DISAGREE, 0x10u, "disagree") /* stays: sequence number and arrival time disagree; board restarted, or wrong period */

#define INS_NAV_STATUS_ENUM(name, value, text) name = (value),
enum
{
    INS_NAV_STATUS_LIST(INS_NAV_STATUS_ENUM) INS_NAV_STATUS_ALL = 0x1Fu
};
#undef INS_NAV_STATUS_ENUM

typedef struct ins_nav_config_t
{
    double period_s;            ///< the firmware's sampling period [s]
    uint8_t block_len;          ///< 6..INS_HS_BLOCK_MAX octets; XH XL YH YL ZH ZL come first, what follows is not read
    uint8_t seq;                ///< 1: sequence number in the high nibbles of octets 0 and 2
    uint8_t retries;            ///< FFs in a row before the next AA is awaited
    uint16_t octet_timeout_ms;  ///< longest silence inside a block; below the board's reply time-out
    int form;                   ///< INS_CONING_ONE or INS_CONING_HIST*
    uint8_t rate_order;         ///< Adams-Moulton order, 2..5
    uint8_t skew_order;         ///< 1..3; used when a delay is not zero
    double delay_s[3];          ///< channel i is sampled delay_s[i] after the instant of the sample; all 0 = off [s]
    double lsb_rad_s[3];        ///< rate per code [rad/s]
    double null_code[3];        ///< code at rest
    uint16_t code_max;          ///< full scale; a larger value is no sample and is refused. At most 4095 with seq
    double q_nb[4];             ///< attitude at the first sample, scalar first
    uint32_t bridge_max;        ///< lost samples in a row that may be bridged without INS_NAV_LONG_GAP
    uint32_t clock_tolerance;   ///< periods by which arrival time and sequence number may differ without INS_NAV_DISAGREE
} ins_nav_config_t;

/// Of the link, since the start.
typedef struct ins_nav_counts_t
{
    uint64_t accepted;   ///< samples handed on
    uint64_t lost;       ///< samples missing by their sequence number, and the invalid ones
    uint64_t invalid;    ///< blocks with a right sum and a code above code_max
    uint64_t duplicates; ///< blocks that came again
    uint64_t corrupt;    ///< wrong sums
    uint64_t timeouts;   ///< blocks that stopped half-way
    uint64_t stray;      ///< octets that fit nowhere
} ins_nav_counts_t;

typedef struct ins_nav_sample_t
{
    uint64_t index; ///< number since the first sample; lost ones count
    uint16_t code[3];
    uint8_t seq;
    uint8_t disagree; ///< see INS_NAV_DISAGREE
    ins_nav_counts_t counts;
} ins_nav_sample_t;

typedef struct ins_nav_state_t
{
    uint64_t index;      ///< sample number since the first one; lost ones count
    double t_s;          ///< index * period_s [s]
    double q_nb[4];      ///< v_n = q v_b q*, scalar first
    double euler_rad[3]; ///< roll, pitch, yaw (ZYX) [rad]; from libm, for display
    double w_ib_b[3];    ///< rate at the instant of the sample [rad/s]
    double dtheta_b[3];  ///< rotation since the last state as integrated, before the coning correction [rad]
    uint32_t seq;        ///< sequence number (0 without)
    uint32_t bridged;    ///< samples lost just before this one
    uint32_t status;     ///< INS_NAV_START ...
    uint64_t used;       ///< states so far; index + 1 = used + missed
    uint64_t missed;     ///< samples bridged so far: lost on the line, or dropped by a full queue
    ins_nav_counts_t counts;
} ins_nav_state_t;

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
/// \return NULL when cfg is usable, else what is wrong with it and what would be right.
INS_API const char* ins_nav_config_problem(const ins_nav_config_t* cfg);

/// \return INS_OK; INS_E_RANGE (ins_nav_config_problem tells why).
INS_API ins_status_t ins_nav_link_init(ins_nav_link_t* self, const ins_nav_config_t* cfg);
/// An octet came. \param[in] now_ms any free-running clock. \param[out] reply octet to send back, or -1. \return 1: *sample is new; 0.
INS_API int ins_nav_link_octet(ins_nav_link_t* self, ins_octet_t octet, uint64_t now_ms, int* reply, ins_nav_sample_t* sample);
/// Time passes and no octet is waiting: call at least every octet_timeout_ms.
INS_API void ins_nav_link_tick(ins_nav_link_t* self, uint64_t now_ms);

INS_API ins_status_t ins_nav_solver_init(ins_nav_solver_t* self, const ins_nav_config_t* cfg);
/// \param[in] sample its index must be above the last one's. \return INS_OK; INS_E_RANGE, nothing changed.
INS_API ins_status_t ins_nav_solver_step(ins_nav_solver_t* self, const ins_nav_sample_t* sample, ins_nav_state_t* state);

INS_API ins_status_t ins_nav_init(ins_nav_t* self, const ins_nav_config_t* cfg);
/// Link and solver in one. \return 1: *state is new; 0.
INS_API int ins_nav_octet(ins_nav_t* self, ins_octet_t octet, uint64_t now_ms, int* reply, ins_nav_state_t* state);
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
