/// \file   ins/ins.h
/// \brief  All of the core.
/// SPDX-License-Identifier: MIT
#ifndef INS_INS_H_INCLUDED
#define INS_INS_H_INCLUDED
#include "ins/attitude.h"
#include "ins/config.h"
#include "ins/coning.h"
#include "ins/dead_reckoning.h"
#include "ins/earth.h"
#include "ins/fiter.h"
#include "ins/fusion.h"
#include "ins/geodesy.h"
#include "ins/gimu.h"
#include "ins/gps_axis.h"
#include "ins/handshake.h"
#include "ins/ins_math.h"
#include "ins/kalman.h"
#include "ins/markov.h"
#include "ins/nmea.h"
#include "ins/pva.h"
#include "ins/q31.h"
#include "ins/quat.h"
#include "ins/rates.h"
#include "ins/reuse.h"
#include "ins/sculling.h"
#include "ins/strapdown.h"
#include "ins/thesis.h"
#include "ins/tm.h"
#include "ins/unicycle.h"
#include "ins/vec.h"
#include "ins/version.h"
#endif // INS_INS_H_INCLUDED
