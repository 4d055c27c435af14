/// \file   publish_none.c
/// \brief  In place of publish_dds.c where the build has no DDS (the ARM daemon).
/// SPDX-License-Identifier: MIT
#include "output.h"
#include <stdio.h>

publisher_t* publisher_open(const options_t* options, char* error, size_t size)
{
    (void)options;
    (void)snprintf(error, size,
                   "this ins-navd was built without DDS: leave out --dds, or build it with INS_BUILD_DDS=ON");
    return NULL;
}

void publisher_put(publisher_t* self, const ins_nav_state_t* state, const ins_navigation_t* navigation)
{
    (void)self;
    (void)state;
    (void)navigation;
}

void publisher_put_solution(publisher_t* self, const ins_nav_solution_t* solution, const ins_navigation_t* navigation)
{
    (void)self;
    (void)solution;
    (void)navigation;
}

void publisher_put_sample(publisher_t* self, const ins_nav_sample_t* sample, const ins_nav_config_t* nav,
                          int64_t time_ns)
{
    (void)self;
    (void)sample;
    (void)nav;
    (void)time_ns;
}

publisher_counts_t publisher_close(publisher_t* self)
{
    (void)self;
    return (publisher_counts_t){0, 0, 0};
}
