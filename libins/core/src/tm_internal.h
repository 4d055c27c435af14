/// \file   tm_internal.h
/// \brief  What both transverse Mercator series ask of their input. Unit: rad.
/// SPDX-License-Identifier: MIT
#ifndef INS_TM_INTERNAL_H_INCLUDED
#define INS_TM_INTERNAL_H_INCLUDED
#include "ins/ins_math.h"
#include "ins/tm.h"

#define TM_PI INS_C(3.14159265358979324)

static inline ins_real tm_wrap(ins_real angle)
{
    return angle > TM_PI ? angle - 2 * TM_PI : angle < -TM_PI ? angle + 2 * TM_PI : angle;
}

/// 1 if forward takes the point. \param[out] dlon  longitude from the central meridian.
static inline int tm_in_reach(const ins_tm_t* self, ins_real lat, ins_real lon, ins_real* dlon)
{
    *dlon = tm_wrap(lon - self->lon0);
    return ins_fabs(lat) <= TM_PI / 2 && ins_fabs(*dlon) <= INS_TM_DLON_MAX;
}

#endif // INS_TM_INTERNAL_H_INCLUDED
