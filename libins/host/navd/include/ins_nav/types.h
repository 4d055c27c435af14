/// \file   ins_nav/types.h
/// \brief  Configuration, samples and states of the navigator (ins_nav/nav.h). Frame: b -> n. Units: s, rad, rad/s.
/// SPDX-License-Identifier: MIT
#ifndef INS_NAV_TYPES_H_INCLUDED
#define INS_NAV_TYPES_H_INCLUDED
#include "ins/handshake.h"
#ifdef __cplusplus
extern "C" {
#endif

/// Status bits of a state. long_gap and disagree stay from then on, the others speak of one step.
/// start: fewer previous samples than the formulas want. bridged: samples were lost before this one. clipped: a channel reads 0 or
/// code_max, so the rate may be larger. long_gap: more than bridge_max samples were lost at once. disagree: sequence number and
/// arrival time tell different times; the board restarted, or the period is not the firmware's.
#define INS_NAV_STATUS_LIST(X)                                                                                         \
    X(INS_NAV_START, 0x01, "start")                                                                                    \
    X(INS_NAV_BRIDGED, 0x02, "bridged")                                                                                \
    X(INS_NAV_CLIPPED, 0x04, "clipped")                                                                                \
    X(INS_NAV_LONG_GAP, 0x08, "long_gap")                                                                              \
    X(INS_NAV_DISAGREE, 0x10, "disagree")

#define INS_NAV_STATUS_ENUM(name, value, text) name = (value),
enum
{
    INS_NAV_STATUS_LIST(INS_NAV_STATUS_ENUM) INS_NAV_STATUS_ALL = 0x1F
};
#undef INS_NAV_STATUS_ENUM

#define INS_NAV_CHANNELS 6 ///< most, of a sample

typedef struct ins_nav_config_t
{
    double period_s;   ///< the firmware's sampling period [s]
    uint8_t channels;  ///< 3: gyros X, Y, Z, which the solver takes; 6: accelerometers, for ins_nav_six_t
    uint8_t block_len; ///< 6..INS_HS_BLOCK_MAX octets; two a channel come first (XH XL ...), what follows is not read
    uint8_t seq;       ///< 1: sequence number in the high nibbles of octets 0 and 2
    uint8_t retries;   ///< FFs in a row before the next AA is awaited
    uint16_t octet_timeout_ms; ///< longest silence inside a block; below the board's reply time-out
    int form;                  ///< INS_CONING_ONE or INS_CONING_HIST*
    uint8_t rate_order;        ///< Adams-Moulton order, 2..5
    uint8_t skew_order;        ///< 1..3; used when a delay is not zero
    double
        delay_s[INS_NAV_CHANNELS]; ///< channel i is sampled delay_s[i] after the instant of the sample; all 0 = off [s]
    double lsb_rad_s[3];           ///< rate per code [rad/s]
    double null_code[3];           ///< code at rest
    uint16_t code_max;             ///< full scale; a larger value is no sample and is refused. At most 4095 with seq
    double q_nb[4];                ///< attitude at the first sample, scalar first
    uint32_t bridge_max;           ///< lost samples in a row that may be bridged without INS_NAV_LONG_GAP
    uint32_t clock_tolerance; ///< periods by which arrival time and sequence number may differ without INS_NAV_DISAGREE
} ins_nav_config_t;

/// Of the link, since the start.
typedef struct ins_nav_counts_t
{
    uint64_t accepted;   ///< samples handed on
    uint64_t lost;       ///< since the first sample: missing by their sequence number, or invalid
    uint64_t invalid;    ///< blocks with a right sum and a code above code_max
    uint64_t duplicates; ///< blocks that came again
    uint64_t corrupt;    ///< wrong sums
    uint64_t timeouts;   ///< blocks that stopped half-way
    uint64_t stray;      ///< octets that fit nowhere
} ins_nav_counts_t;

typedef struct ins_nav_sample_t
{
    uint64_t index;                  ///< number since the first sample; lost ones count
    uint16_t code[INS_NAV_CHANNELS]; ///< those beyond the channels are 0
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

#ifdef __cplusplus
}
#endif
#endif // INS_NAV_TYPES_H_INCLUDED
