// dds_unit DOMAIN STRENGTH LEASE_S [SECURITY_FOLDER]: one of several units that publish the source "vehicle", a state each ms until it is killed; seq is
// its strength.
// SPDX-License-Identifier: MIT
#include "ins_dds/dds.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int main(int argc, char** argv)
{
    if (argc < 4)
    {
        return 2;
    }
    ins_dds_config_t cfg;
    ins_dds_t* dds;
    ins_dds_security_t security;
    char paths[INS_DDS_SECURITY_MEMORY];
    ins_dds_config_default(&cfg);
    if (argc > 4 && ins_dds_security_folder(argv[4], &security, paths) == INS_DDS_OK)
    {
        cfg.security = &security;
    }
    cfg.domain = (uint32_t)strtoul(argv[1], NULL, 10);
    cfg.strength = (int32_t)strtol(argv[2], NULL, 10);
    cfg.lease_s = strtod(argv[3], NULL);
    if (ins_dds_open(&cfg, &dds) != INS_DDS_OK)
    {
        fprintf(stderr, "%s\n", ins_dds_error_text());
        return 3;
    }
    ins_nav_state_t state;
    memset(&state, 0, sizeof state);
    state.q_nb[0] = 1;
    state.seq = (uint32_t)cfg.strength;
    for (;; state.index++)
    {
        if (ins_dds_publish(dds, &state, "vehicle", 0) != INS_DDS_OK)
        {
            fprintf(stderr, "%s\n", ins_dds_error_text());
            return 1;
        }
        (void)usleep(1000);
    }
}
