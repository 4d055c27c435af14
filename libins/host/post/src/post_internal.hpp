/// \file   post_internal.hpp
/// \brief  Errors of ins/kf15.h on nominal states: to add them, to tell them, and their matrices. SPDX-License-Identifier: MIT
#ifndef INS_POST_INTERNAL_HPP_INCLUDED
#define INS_POST_INTERNAL_HPP_INCLUDED
#include "ins_post/gps_ins.hpp"

namespace ins_post
{

Nominal nominal(const ins_gps_ins_t& filter);
/// P without the padding of its rows.
Square square(const ins_kf15_t& kf);
Square identity();
Square product(const Square& a, const Square& b);
Square transition(const ins_kf15_model_t& model);
/// By north, east, down [m].
void move(ins_position_t& position, const Vec3& ned);
State described(double t, const Nominal& at, const Square& P);

} // namespace ins_post
#endif // INS_POST_INTERNAL_HPP_INCLUDED
