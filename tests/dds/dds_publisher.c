// dds_publisher DOMAIN SOURCE COUNT: waits for a reader, publishes states 0 .. COUNT-1, waits until a line or the end comes on
// standard input, closes and ends. Exit code 3 and the text when DDS cannot be opened.
// SPDX-License-Identifier: MIT
#include "ins_dds/dds.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define WAIT_MS 10000

int main(int argc, char** argv)
{
    if (argc != 4)
    {
        fprintf(stderr, "usage: dds_publisher DOMAIN SOURCE COUNT\n");
        return 2;
    }
    ins_dds_config_t cfg;
    ins_dds_t* dds;
    ins_dds_config_default(&cfg);
    cfg.domain = (uint32_t)strtoul(argv[1], NULL, 10);
    cfg.topic[INS_DDS_STATE].qos.history = 1000;
    if (ins_dds_open(&cfg, &dds) != INS_DDS_OK)
    {
        fprintf(stderr, "%s\n", ins_dds_error_text());
        return 3;
    }
    int waited_ms = 0;
    for (; ins_dds_matched(dds) < 1 && waited_ms < WAIT_MS; waited_ms++)
    {
        (void)usleep(1000);
    }
    const uint64_t count = strtoull(argv[3], NULL, 10);
    int failed = waited_ms == WAIT_MS;
    for (uint64_t k = 0; k < count && !failed; k++)
    {
        ins_nav_state_t state;
        memset(&state, 0, sizeof state);
        state.index = k;
        state.q_nb[0] = 1.0 / (double)(k + 1);
        ins_navigation_t navigation;
        ins_navigation_from_state(&state, (int64_t)k, &navigation);
        navigation.valid |= INS_NAVIGATION_POSITION | INS_NAVIGATION_COVARIANCE;
        navigation.llh[0] = 0.5;
        navigation.llh[1] = -0.25;
        navigation.P[7 * INS_NAVIGATION_P + 7] = 2.25;
        failed = ins_dds_publish_navigation(dds, &state, &navigation, argv[2], (int64_t)k) != INS_DDS_OK;
    }
    (void)getchar();
    ins_dds_close(dds);
    return failed;
}
