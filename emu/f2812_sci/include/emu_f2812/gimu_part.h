/// \file   emu_f2812/gimu_part.h
/// \brief  The GIMU of the 2006 thesis (section 4.1) as a part on a line: MMA7260Q, two IDG-1004, 12-bit converter, GPS module,
///         packets on pin T, NMEA on pin R.
///
///     gimu_config_t c;
///     gimu_default_config(&c);
///     c.motion = my_motion;
///     if (!gimu_init(&gimu, &c, &sched, t_wire, NULL, why, sizeof why)) { fputs(why, stderr); }
///
/// volts = null_v + drift_v_s t + sensitivity (1 + scale_error) lowpass(axis . x) + noise, clipped to 0 .. vcc_v
/// code  = nearest of 4095 volts / vcc_v
///
/// x is the body rate [rad/s] for P, Q, R and the specific force [m/s^2] for AX, AY, AZ, asked of config.motion. All six are
/// sampled at the start of the packet's first bit; the conversion takes no time. Packet n begins at power_up + n / 6 s of the
/// GIMU's own clock; every sixth is of type 2. Low-pass: first order, by 8-node Gauss-Laguerre on the input's history,
/// so config.motion is asked for instants up to 23 time constants before a sample.
/// Numbers and their sources: docs/gimu_part.md.
/// SPDX-License-Identifier: MIT
#ifndef EMU_F2812_GIMU_PART_H_INCLUDED
#define EMU_F2812_GIMU_PART_H_INCLUDED
#include "emu/serial.h"
#include "emu/ticker.h"
#ifdef __cplusplus
extern "C" {
#endif

#define GIMU_CHANNELS 6 ///< P, Q, R, AX, AY, AZ
#define GIMU_GYROS    3 ///< the first three
#define GIMU_RATE_HZ  6 ///< packets a second

typedef struct gimu_channel_t
{
    double axis[3];      ///< sensitive axis in b, length 0.9 .. 1.1 (cross-axis sensitivity is an axis off its own)
    double sensitivity;  ///< [V/(rad/s)] or [V/(m/s^2)], not 0; negative turns the sense round
    double scale_error;  ///< 0.01 = reads 1 % high
    double null_v;       ///< at rest, at power-up [V]; need not be a whole code
    double drift_v_s;    ///< of the null, from power-up [V/s]
    double bandwidth_hz; ///< 0 = unlimited
    double
        noise_density; ///< [V/sqrt(Hz)], one-sided; a sample's standard deviation is noise_density sqrt(pi/2 bandwidth_hz)
} gimu_channel_t;

/// What the GPS module knows at an instant. Angles in rad, SI.
typedef struct gimu_fix_t
{
    int64_t of_ps;              ///< the instant the fix is of, 0 at least
    double latitude, longitude; ///< north and east positive
    double height;              ///< above the ellipsoid [m]
    double speed, course;       ///< over ground, from north clockwise
    double hdop;
    unsigned sats; ///< in use; set without a fix too, 0 .. 99
} gimu_fix_t;

/// Body rate [rad/s] and specific force [m/s^2] at t_ps, a function of t_ps alone.
typedef void (*gimu_motion_fn)(void* ctx, int64_t t_ps, double rate_rad_s[3], double specific_force_m_s2[3]);
/// The newest fix there is at t_ps. \return false: no fix; then only of_ps and sats are looked at.
typedef bool (*gimu_fix_fn)(void* ctx, int64_t t_ps, gimu_fix_t* fix);
/// A packet begins: its samples, P, Q, R, AX, AY, AZ.
typedef void (*gimu_sampled_fn)(void* ctx, uint64_t packet, const uint16_t raw[GIMU_CHANNELS], emu_time_t at);

/// What a type 2 packet holds without a fix; the satellites are then as the GPS module says.
typedef enum gimu_no_fix_t
{
    GIMU_HOLD_LAST, ///< the last coordinates, zeros before the first fix
    GIMU_SEND_ZEROS
} gimu_no_fix_t;

/// The first of the two coordinates, which the thesis labels latitude and fills with 120 degrees.
typedef enum gimu_order_t
{
    GIMU_LONGITUDE_FIRST, ///< the octets of its figure 4.5
    GIMU_LATITUDE_FIRST   ///< the labels
} gimu_order_t;

typedef struct gimu_config_t
{
    gimu_channel_t channel[GIMU_CHANNELS];
    double vcc_v;        ///< supply and converter reference, 3.0 .. 3.6
    emu_time_t power_up; ///< start of the first packet, after gimu_init() [ps]
    double baud;         ///< of pin T
    int32_t
        clock_ppb; ///< error of the clock behind cadence and pin T, within +-EMU_PPB_MAX; the GPS module has the right time
    gimu_order_t order;
    gimu_no_fix_t no_fix;
    double nmea_baud;      ///< of pin R
    emu_time_t nmea_delay; ///< sentences begin so long after each whole second [ps]
    double geoid_m;        ///< mean sea level above the ellipsoid at the place, for GGA
    int64_t utc_s;         ///< UTC at instant 0 [s since 1970-01-01, without leap seconds]
    uint64_t seed;         ///< of the noise
    gimu_motion_fn motion; ///< NULL: at rest and level, 9.8 m/s^2
    void* motion_ctx;
    gimu_fix_fn fix; ///< NULL: never a fix, 0 satellites
    void* fix_ctx;
    gimu_sampled_fn sampled; ///< may be NULL
    void* sampled_ctx;
} gimu_config_t;

/// Owned by the caller, stays where it is. Members are private, the counters readable.
typedef struct gimu_t
{
    gimu_config_t config;
    emu_sched_t* sched;
    emu_time_t begun; ///< of power
    emu_serial_end_t t, nmea;
    emu_ticker_t cadence;
    emu_event_t packet_event, nmea_event;
    double noise_v[GIMU_CHANNELS];
    uint64_t rng;
    uint32_t coordinate[2]; ///< latitude, longitude of the last fix, as sent
    uint64_t packets;       ///< begun
    uint64_t sentences;     ///< begun
    uint64_t clipped;       ///< samples at a rail
} gimu_t;

/// Data-sheet sensors without error: nulls at code 2047, no noise, unlimited bandwidth, nominal sensitivities.
EMU_API void gimu_default_config(gimu_config_t* config);
/// The thesis's specimen: its K constants, nulls that an integer misses by 0.7 to 0.8 codes, data-sheet noise and bandwidth.
EMU_API void gimu_thesis_config(gimu_config_t* config);
/// Power comes on now, both pins idle; scheduler and wires outlive the part. \param[in] t  pin T. \param[in] nmea  pin R, may be NULL.
/// \return false when config is refused or a wire has no room: why[why_size] says what is wrong and what would be right.
EMU_API bool gimu_init(gimu_t* self, const gimu_config_t* config, emu_sched_t* sched, emu_wire_t* t, emu_wire_t* nmea,
                       char* why, size_t why_size);

#ifdef __cplusplus
}
#endif
#endif // EMU_F2812_GIMU_PART_H_INCLUDED
