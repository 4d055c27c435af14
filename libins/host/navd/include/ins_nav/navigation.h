/// \file   ins_nav/navigation.h
/// \brief  One instant of navigation from whatever source, with its covariance: what the ROS 2 topics and recorders speak of.
///         Frames: b (forward, right, down) -> n (NED). SI, rad.
/// SPDX-License-Identifier: MIT
#ifndef INS_NAV_NAVIGATION_H_INCLUDED
#define INS_NAV_NAVIGATION_H_INCLUDED
#include "ins_nav/nav_input.h"
#include "ins_nav/types.h"
#ifdef __cplusplus
extern "C" {
#endif

/// Bits of `valid`: what the source knows at this instant. A field without its bit is zero and says nothing. velocity_up: the vertical
/// component of the velocity too. height: llh[2] too.
#define INS_NAVIGATION_VALID_LIST(X)                                                                                   \
    X(INS_NAVIGATION_ATTITUDE, 0x01, "attitude")                                                                       \
    X(INS_NAVIGATION_RATE, 0x02, "rate")                                                                               \
    X(INS_NAVIGATION_FORCE, 0x04, "force")                                                                             \
    X(INS_NAVIGATION_VELOCITY, 0x08, "velocity")                                                                       \
    X(INS_NAVIGATION_VELOCITY_UP, 0x10, "velocity_up")                                                                 \
    X(INS_NAVIGATION_POSITION, 0x20, "position")                                                                       \
    X(INS_NAVIGATION_HEIGHT, 0x40, "height")                                                                           \
    X(INS_NAVIGATION_COVARIANCE, 0x80, "covariance")

/// Clocks of time_ns, the time base. host: of the computer that publishes, UTC since 1970. board: of the sensors' board, since its
/// start. gnss: of a receiver, UTC since 1970.
#define INS_NAVIGATION_CLOCK_LIST(X)                                                                                   \
    X(INS_NAVIGATION_HOST, 0, "host")                                                                                  \
    X(INS_NAVIGATION_BOARD, 1, "board")                                                                                \
    X(INS_NAVIGATION_GNSS, 2, "gnss")

#define INS_NAVIGATION_ENUM(name, value, text) name = (value),
enum
{
    INS_NAVIGATION_VALID_LIST(INS_NAVIGATION_ENUM)
};
enum
{
    INS_NAVIGATION_CLOCK_LIST(INS_NAVIGATION_ENUM)
};
#undef INS_NAVIGATION_ENUM

#define INS_NAVIGATION_P 9 ///< rows of P: attitude error, velocity, position, each north, east, down

typedef struct ins_navigation_t
{
    int64_t time_ns;    ///< of validity [ns]
    uint32_t time_base; ///< clock of time_ns: INS_NAVIGATION_HOST ...
    uint32_t valid;     ///< INS_NAVIGATION_ATTITUDE ...
    double q_nb[4];     ///< scalar first
    double w_ib_b[3];   ///< [rad/s]
    double f_b[3];      ///< specific force [m/s^2]
    double v_n[3];      ///< over ground [m/s]
    double llh[3];      ///< latitude, longitude [rad], height above WGS-84 [m]
    /// Row-major, symmetric [rad, m/s, m], of errors truth less estimate, as those of ins/kf15.h: C_nb true = (I + [phi x]) C_nb.
    double P[INS_NAVIGATION_P * INS_NAVIGATION_P];
} ins_navigation_t;

/// Of a board that samples gyros: attitude and rate, on the host's clock, as the next.
INS_API void ins_navigation_from_state(const ins_nav_state_t* state, int64_t time_ns, ins_navigation_t* out);
/// Of a board that navigates by itself: attitude once aligned, horizontal velocity and position as far as its status goes.
INS_API void ins_navigation_from_solution(const ins_nav_solution_t* solution, int64_t time_ns, ins_navigation_t* out);
/// Its numbers, times, attitude and counts in the form of a state; status, rates and rotations 0.
INS_API void ins_nav_state_from_solution(const ins_nav_solution_t* solution, ins_nav_state_t* out);

#ifdef __cplusplus
}
#endif
#endif // INS_NAV_NAVIGATION_H_INCLUDED
