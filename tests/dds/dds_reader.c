// dds_reader DOMAIN: takes states until it is ended or stopped.
// SPDX-License-Identifier: MIT
#include "ins_dds/dds.h"
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char** argv)
{
    ins_dds_config_t cfg;
    ins_dds_t* dds;
    ins_dds_sample_t sample;
    ins_dds_config_default(&cfg);
    cfg.domain = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : 0;
    cfg.publishes = 0;
    cfg.subscribes = 1;
    if (ins_dds_open(&cfg, &dds) != INS_DDS_OK)
    {
        fprintf(stderr, "%s\n", ins_dds_error_text());
        return 3;
    }
    while (ins_dds_take(dds, 60.0, &sample, 1) >= 0)
    {
    }
    return 1;
}
