/// \file   ins/ins.hpp
/// \brief  The core for C++17 with Eigen in and out: a thin border, no second implementation. Parsers, links and the fixed-point path
///         have no Eigen in them and are used as they are in C.
/// SPDX-License-Identifier: MIT
#ifndef INS_INS_HPP_INCLUDED
#define INS_INS_HPP_INCLUDED
#include "ins/accelfit.hpp"
#include "ins/align.hpp"
#include "ins/attitude.hpp"
#include "ins/compare.hpp"
#include "ins/eigen.hpp"
#include "ins/filters.hpp"
#include "ins/geodesy.hpp"
#include "ins/gimu.hpp"
#include "ins/gps_dr.hpp"
#include "ins/gps_ins.hpp"
#include "ins/gyro_free.hpp"
#include "ins/ins.h"
#include "ins/kf15.hpp"
#include "ins/quaternion.hpp"
#include "ins/rates.hpp"
#include "ins/sculling.hpp"
#include "ins/sixacc.hpp"
#include "ins/strapdown.hpp"
#endif // INS_INS_HPP_INCLUDED
