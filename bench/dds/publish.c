/// \file   publish.c
/// \brief  A load for callgrind: N publications of a navigation state with its covariance, nobody listening. See attitude_step.c for the method.
/// SPDX-License-Identifier: MIT
#include "ins_dds/dds.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(int argc, char** argv)
{
    const long count = argc > 1 ? atol(argv[1]) : 100;
    ins_dds_config_t cfg;
    ins_dds_config_default(&cfg);
    cfg.domain = 199;
    ins_dds_t* dds = NULL;
    if (ins_dds_open(&cfg, &dds) != INS_DDS_OK)
    {
        fprintf(stderr, "%s\n", ins_dds_error_text());
        return 1;
    }
    ins_nav_state_t state;
    memset(&state, 0, sizeof state);
    state.q_nb[0] = 1.0;
    ins_navigation_t navigation;
    ins_navigation_from_state(&state, 0, &navigation);
    navigation.valid |= INS_NAVIGATION_COVARIANCE;
    for (long k = 0; k < count; k++)
    {
        state.index = (uint64_t)k;
        if (ins_dds_publish_navigation(dds, &state, &navigation, "bench", k) != INS_DDS_OK)
        {
            fprintf(stderr, "%s\n", ins_dds_error_text());
            return 1;
        }
    }
    ins_dds_close(dds);
    return 0;
}
