/// \file   sculling_internal.h
/// \brief  The parts of a sculling step that its two paths share. Frame: b. Units: rad, m/s.
/// SPDX-License-Identifier: MIT
#ifndef INS_SCULLING_INTERNAL_H_INCLUDED
#define INS_SCULLING_INTERNAL_H_INCLUDED
#include "ins/sculling.h"

static inline void sculling_keep(ins_sculling_t* self, const ins_increment_t* now)
{
    self->prev[1] = self->prev[0];
    self->prev[0] = *now;
}

/// Any form, at start-up too, any size of increment; refuses what is out of range.
ins_status_t ins_sculling_step_any(ins_sculling_t* self, const ins_increment_t* increment, ins_real dv_b[3]);

#endif // INS_SCULLING_INTERNAL_H_INCLUDED
