/// \file   listen.c
/// \brief  How old states are when a subscriber has them: its clock less time_ns, of COUNT of them after the first ones.
///         bench_dds_listen DOMAIN COUNT
/// SPDX-License-Identifier: MIT
#include "ins_dds/dds.h"
#include "times.h"
#include <stdio.h>
#include <stdlib.h>

#define FIRST_ONES 50
#define WAIT_S     30.0

int main(int argc, char** argv)
{
    if (argc != 3)
    {
        return 2;
    }
    ins_dds_config_t cfg;
    ins_dds_t* dds;
    ins_dds_config_default(&cfg);
    cfg.domain = (uint32_t)strtoul(argv[1], NULL, 10);
    cfg.publishes = 0;
    cfg.subscribes = 1;
    const size_t count = strtoul(argv[2], NULL, 10);
    int64_t* age_ns = calloc(count + 1, sizeof *age_ns);
    if (age_ns == NULL || count == 0 || ins_dds_open(&cfg, &dds) != INS_DDS_OK)
    {
        fprintf(stderr, "%s\n", ins_dds_error_text());
        return 3;
    }
    (void)fputs("ready\n", stderr);
    size_t got = 0;
    while (got < count + FIRST_ONES)
    {
        ins_dds_sample_t sample;
        if (ins_dds_take(dds, WAIT_S, &sample, 1) != 1)
        {
            fprintf(stderr, "%zu states came, then none for %g s\n", got, WAIT_S);
            return 1;
        }
        const int64_t now_ns = times_now_ns(CLOCK_REALTIME);
        if (sample.valid && ++got > FIRST_ONES)
        {
            age_ns[got - FIRST_ONES - 1] = now_ns - sample.navigation.time_ns;
        }
    }
    times_print("age", age_ns, count);
    ins_dds_close(dds);
    free(age_ns);
    return 0;
}
