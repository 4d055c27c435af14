/// \file   ins_nav/vehicle.h
/// \brief  A vehicle's navigator: NMEA and the odometer board's sentences in, position and heading out. Units: SI, rad.
///
///     ins_vehicle_config_t cfg;
///     ins_vehicle_config_default(&cfg);
///     ins_vehicle_init(&v, &cfg);
///     while (receive(&octet))
///     {
///         if (ins_vehicle_octet(&v, port, octet, &solution) == 1) { use(&solution); }    // each 100 ms
///     }
///
/// The two periodic tasks of the GPS/DR paper run on the board's clock: each sentence of the board is the task of 100 ms, dead
/// reckoning, and each first one of a second is the task of 1 s as well, which takes the newest fix. So a recording gives the same at any speed.
/// The board says, each 100 ms (docs/gpsdr_daemon.md):
///
///     $PINSD,<clock, ms>,<odometer, counts since the start>,<yaw rate, code>*<checksum as NMEA's>
///
/// No thread, no clock, no transport, no allocation. Positions are of the plane that touches the Earth at the first fix: 100 km away
/// that is 4 m off.
/// SPDX-License-Identifier: MIT
#ifndef INS_NAV_VEHICLE_H_INCLUDED
#define INS_NAV_VEHICLE_H_INCLUDED
#include "ins/geodesy.h"
#include "ins/gps_dr.h"
#include "ins/gps_dr_paper.h"
#include "ins/nmea.h"
#include "ins_nav/nav_input.h"
#include "ins_nav/navigation.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_VEHICLE_PORTS     2
#define INS_VEHICLE_LINE_MAX  48   ///< octets of a board's sentence between $ and *
#define INS_VEHICLE_FIX_MS    1000 ///< from one task of the fixes to the next
#define INS_VEHICLE_GAP_MS    10000
#define INS_VEHICLE_PERIOD_MS 100

enum
{
    INS_VEHICLE_OURS,    ///< ins/gps_dr.h
    INS_VEHICLE_PRINTED, ///< ins/gps_dr_paper.h
    INS_VEHICLE_CORRECTED
};

typedef struct ins_vehicle_config_t
{
    int filter;              ///< INS_VEHICLE_OURS ...
    ins_gps_dr_config_t car; ///< of ours
    double metres_per_count;
    double lsb_rad_s;  ///< yaw rate per code, negative if codes grow with turns to the left [rad/s]
    double null_code;  ///< at rest
    uint32_t code_max; ///< a larger one is no sample
    double uere_m;     ///< deviation of a coordinate of a fix = HDOP * uere_m [m]
    double latency_s;  ///< of a fix: from its instant to its sentence [s]
} ins_vehicle_config_t;

/// What came and what became of it.
typedef struct ins_vehicle_counts_t
{
    uint64_t samples;  ///< board's sentences used
    uint64_t invalid;  ///< with a right checksum, but not three numbers or a code above code_max
    uint64_t corrupt;  ///< with a wrong checksum, or cut
    uint64_t gaps;     ///< the board's clock was late by half a period or more
    uint64_t restarts; ///< it went back, or on by more than INS_VEHICLE_GAP_MS
    uint64_t repeated; ///< the same clock again
    uint64_t fixes;    ///< taken by the task of 1 s
    uint64_t no_fixes; ///< tasks that found none
    uint64_t refused;  ///< fixes that the filter did not take
} ins_vehicle_counts_t;

/// A board's sentence as it comes.
typedef struct ins_vehicle_line_t
{
    char text[INS_VEHICLE_LINE_MAX + 4]; ///< from $ to the checksum
    uint8_t length;
    uint8_t inside;
} ins_vehicle_line_t;

/// Members are private; counts, fix, gps.taken and the filters are readable.
typedef struct ins_vehicle_t
{
    ins_vehicle_config_t cfg;
    ins_gps_dr_t ours;
    ins_gps_dr_paper_t paper;
    ins_nmea_t nmea[INS_VEHICLE_PORTS];
    ins_vehicle_line_t line[INS_VEHICLE_PORTS];
    ins_nmea_fix_t fix;    ///< the newest GGA
    ins_nmea_fix_t motion; ///< the newest RMC or VTG
    uint8_t fresh;         ///< fix has not been taken yet
    uint8_t moving;        ///< motion has come since the last task
    uint32_t fix_ms;       ///< board's clock when fix came
    uint32_t since_fix_ms; ///< board's time since a fix was taken
    ins_local_t plane;
    uint8_t placed;
    uint8_t started;
    uint32_t last_ms, last_count;
    double t_s; ///< board's time since its first sentence
    double rate;
    uint64_t index;
    ins_vehicle_counts_t counts;
} ins_vehicle_t;

/// One metre per count, 180/4096 deg/s per code of 12 bits around 2048, 5 m of deviation for each unit of HDOP.
INS_API void ins_vehicle_config_default(ins_vehicle_config_t* cfg);
/// \return NULL when cfg is usable, else what is wrong with it and what would be right.
INS_API const char* ins_vehicle_config_problem(const ins_vehicle_config_t* cfg);
/// \return INS_OK; INS_E_RANGE (ins_vehicle_config_problem tells why).
INS_API ins_status_t ins_vehicle_init(ins_vehicle_t* self, const ins_vehicle_config_t* cfg);
/// An octet came. Either port may carry NMEA, the board's sentences or both. \param[in] port  below INS_VEHICLE_PORTS.
/// \return 1: *solution is new, zone is 0 and en_m counts from the first fix; 0.
INS_API int ins_vehicle_octet(ins_vehicle_t* self, unsigned port, ins_octet_t octet, ins_nav_solution_t* solution);
/// The solution as an instant, with the filter's covariance (INS_VEHICLE_OURS alone) once it has a heading. Roll and pitch are taken for
/// zero, so their deviation is a road's slope, INS_VEHICLE_SLOPE; height and vertical velocity are not known and not in it.
INS_API void ins_vehicle_navigation(const ins_vehicle_t* self, const ins_nav_solution_t* solution, int64_t time_ns,
                                    ins_navigation_t* out);
#define INS_VEHICLE_SLOPE 0.05 ///< [rad]
/// INS_GPS_DR_NONE ...
INS_API int ins_vehicle_source(const ins_vehicle_t* self);
/// Deviation of the position, both coordinates [m]; 0 without one.
INS_API double ins_vehicle_sigma(const ins_vehicle_t* self);

#ifdef __cplusplus
}
#endif
#endif // INS_NAV_VEHICLE_H_INCLUDED
