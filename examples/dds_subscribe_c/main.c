// Prints navigation states that arrive over DDS, with the installed libins_dds.   subscribe [DOMAIN [COUNT]]
// SPDX-License-Identifier: MIT
#include <ins_dds/dds.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/// As far as the source knows it: latitude, longitude, and the larger of their standard deviations.
static void print_place(const ins_navigation_t* n)
{
    const double degrees = 57.295779513082321;
    if ((n->valid & INS_NAVIGATION_POSITION) != 0)
    {
        printf(", %.7f %.7f deg", n->llh[0] * degrees, n->llh[1] * degrees);
    }
    if ((n->valid & INS_NAVIGATION_COVARIANCE) != 0)
    {
        const double north = n->P[6 * INS_NAVIGATION_P + 6];
        const double east = n->P[7 * INS_NAVIGATION_P + 7];
        printf(" +- %.2f m", sqrt(north > east ? north : east));
    }
}

int main(int argc, char** argv)
{
    ins_dds_config_t cfg;
    ins_dds_t* dds;
    ins_dds_config_default(&cfg); // loopback
    cfg.network = getenv("CYCLONEDDS_URI") != NULL ? INS_DDS_ENVIRONMENT : cfg.network;
    cfg.domain = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : 0;
    cfg.publishes = 0;
    cfg.subscribes = 1;
    cfg.topic[INS_DDS_STATE].qos.history = 100; // samples that may wait here before the oldest goes
    if (ins_dds_open(&cfg, &dds) != INS_DDS_OK)
    {
        fprintf(stderr, "%s\n", ins_dds_error_text());
        return 2;
    }
    long left = argc > 2 ? atol(argv[2]) : -1;
    while (left != 0)
    {
        ins_dds_sample_t sample;
        const int got = ins_dds_take(dds, 10.0, &sample, 1);
        if (got <= 0)
        {
            fprintf(stderr, "%s\n", got < 0 ? ins_dds_error_text() : "nothing came for 10 s");
            break;
        }
        if (sample.valid)
        {
            const double* e = sample.state.euler_rad;
            printf("%s %llu: roll %.6f pitch %.6f yaw %.6f rad", sample.source, (unsigned long long)sample.state.index,
                   e[0], e[1], e[2]);
            print_place(&sample.navigation);
            printf("\n");
            left--;
        }
        else if (sample.gone)
        {
            printf("%s: its publisher has gone\n", sample.source);
        }
    }
    ins_dds_close(dds);
    return left > 0 ? 1 : 0;
}
