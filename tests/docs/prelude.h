/// \file   prelude.h
/// \brief  What the usage examples in headers and pages take as given: the caller's inputs, outputs and functions. Compiled, not linked.
/// SPDX-License-Identifier: MIT
#include "ins/ins.h"
#ifndef INS_REAL_FLOAT
#include "emu/trace.h"
#include "emu_8051/acq_board.h"
#include "emu_f2812/f2812.h"
#include "ins_dds/dds.h"
#include "ins_dds/outbox.h"
#include "ins_dds/raw.h"
#include "ins_dds/ros.h"
#include "ins_nav/nav.h"
#include "ins_nav/nav_input.h"
#include "ins_nav/six.h"
#include "ins_nav/vehicle.h"
#include "ins_truth/accel.h"
#include "ins_truth/body.h"
#include "ins_truth/drive.h"
#include "ins_truth/exact.h"
#include "ins_truth/front_end.h"
#include "ins_truth/gps.h"
#include "ins_truth/gyro.h"
#include "ins_truth/imu.h"
#include "ins_truth/motion.h"
extern ins_nav_t nav;
extern ins_nav_state_t state;
extern ins_dds_t* dds;
extern ins_dds_raw_t* raw;
extern ins_dds_outbox_t* outbox;
extern ins_dds_message_t outgoing;
extern ins_ros_t* ros;
extern ins_navigation_t navigation;
extern int64_t now_ns;
extern uint64_t now_ms;
extern int reply;
extern ins_motion_t* motion;
extern const ins_motion_sines_t sines;
extern const ins_track_t* track;
extern ins_track_state_t moment;
extern ins_gps_fix_t newest;
extern double rate_per_lsb, null_code, volts;
extern int64_t t_ps;
extern double t;
extern char why[256];
extern tlc2543_config_t adc;
extern acq_board_t* board;
extern emu_trace_t trace;
int receive(ins_octet_t* octet);
void send(int octet);
#endif
#include <stddef.h>
#include <stdio.h>

#define N 8
void use(const void* result);
void refuse_to_fly(void);
ins_real sample(unsigned index);
extern ins_octet_t octet;
extern ins_real q_nb0[4], v_n0[3], w0_b[3], w_mid_b[3], w_end_b[3], dtheta_b[3], phi[3], dv_b[3], q_nb[4], w_ib_b[3];
extern ins_real readings[6], var[6], Phi[9], P[9], Q[9], h[3], x[3], y[3], info[9], work[12], en[2];
extern ins_real x_i[2][3], P_i[2][9], beta;
extern ins_real T, period_s, dt, q, r, z, z0, fix, nis, feedback, lat, lon, height, east, north, yaw_rate, distance;
extern ins_increment_t increment;
extern ins_unicycle_t u;
extern unsigned n, i, count;
