/// \file   status.c
/// \brief  What a status says that follows from an instant of navigation.
/// SPDX-License-Identifier: MIT
#include "dds_internal.h"
#include <math.h>
#include <string.h>

enum
{
    DOWN = 2,
    PLACE = 6 ///< first row of the position in P
};

static double p(const ins_navigation_t* navigation, int i, int j)
{
    return navigation->P[INS_NAVIGATION_P * i + j];
}

/// Root of the larger eigenvalue of the horizontal block: the semi-major axis of the error ellipse.
static double worst_horizontal(const ins_navigation_t* n)
{
    const double mean = (p(n, PLACE, PLACE) + p(n, PLACE + 1, PLACE + 1)) / 2.0;
    const double half = (p(n, PLACE, PLACE) - p(n, PLACE + 1, PLACE + 1)) / 2.0;
    return sqrt(mean + sqrt(half * half + p(n, PLACE, PLACE + 1) * p(n, PLACE, PLACE + 1)));
}

void ins_dds_status_from_navigation(const ins_navigation_t* navigation, ins_dds_status_t* out)
{
    const uint32_t valid = navigation->valid;
    const int known = (valid & INS_NAVIGATION_COVARIANCE) != 0;
    const int placed = (valid & INS_NAVIGATION_POSITION) != 0;
    const int turned = (valid & INS_NAVIGATION_ATTITUDE) != 0;
    memset(out, 0, sizeof *out);
    out->time_ns = navigation->time_ns;
    out->time_base = navigation->time_base;
    out->mode = INS_DDS_MODE_ALIGN;
    out->mode = turned ? INS_DDS_MODE_ATTITUDE : out->mode;
    out->mode = turned && placed ? INS_DDS_MODE_AIDED : out->mode;
    out->sigma_horizontal_m = known && placed ? worst_horizontal(navigation) : (double)NAN;
    out->sigma_vertical_m =
        known && (valid & INS_NAVIGATION_HEIGHT) != 0 ? sqrt(p(navigation, PLACE + DOWN, PLACE + DOWN)) : (double)NAN;
    out->sigma_heading_rad = known && turned ? sqrt(p(navigation, DOWN, DOWN)) : (double)NAN;
    out->fix_age_s = (double)NAN;
}
