/// \file   stall.c
/// \brief  Times of the publishing call while readers of the domain stand still: of the outbox, then of DDS itself, a state each ms.
///         Waits for READERS readers and then for a line on standard input.   bench_dds_stall DOMAIN READERS COUNT
/// SPDX-License-Identifier: MIT
#include "ins_dds/outbox.h"
#include "times.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define PERIOD_US   1000
#define OUTBOX_SIZE 256

int main(int argc, char** argv)
{
    if (argc != 4)
    {
        return 2;
    }
    ins_dds_config_t cfg;
    ins_dds_t* dds;
    ins_dds_outbox_t* outbox;
    ins_dds_config_default(&cfg);
    cfg.domain = (uint32_t)strtoul(argv[1], NULL, 10);
    const size_t count = strtoul(argv[3], NULL, 10);
    int64_t* took_ns = calloc(count + 1, sizeof *took_ns);
    if (took_ns == NULL || count == 0 || ins_dds_open(&cfg, &dds) != INS_DDS_OK ||
        ins_dds_outbox_open(dds, NULL, "bench", OUTBOX_SIZE, &outbox) != INS_DDS_OK)
    {
        fprintf(stderr, "%s\n", ins_dds_error_text());
        return 3;
    }
    while (ins_dds_matched(dds) < atoi(argv[2]))
    {
        (void)usleep(PERIOD_US);
    }
    (void)fputs("ready\n", stderr);
    (void)getchar();
    ins_dds_message_t message;
    memset(&message, 0, sizeof message);
    message.kind = INS_DDS_STATE;
    for (size_t k = 0; k < count; k++)
    {
        message.is.instant.state.index = k;
        const int64_t begin_ns = times_now_ns(CLOCK_MONOTONIC);
        (void)ins_dds_outbox_put(outbox, &message);
        took_ns[k] = times_now_ns(CLOCK_MONOTONIC) - begin_ns;
        (void)usleep(PERIOD_US);
    }
    times_print("outbox_put", took_ns, count);
    ins_dds_outbox_counts_t counts;
    ins_dds_outbox_close(outbox, &counts);
    for (size_t k = 0; k < count; k++)
    {
        const int64_t begin_ns = times_now_ns(CLOCK_MONOTONIC);
        (void)ins_dds_publish_navigation(dds, &message.is.instant.state, &message.is.instant.navigation, "bench", 0);
        took_ns[k] = times_now_ns(CLOCK_MONOTONIC) - begin_ns;
        (void)usleep(PERIOD_US);
    }
    times_print("publish", took_ns, count);
    printf("{\"name\":\"counts\",\"published\":%llu,\"dropped\":%llu}\n", (unsigned long long)counts.published,
           (unsigned long long)counts.dropped);
    ins_dds_close(dds);
    free(took_ns);
    return 0;
}
