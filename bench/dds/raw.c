/// \file   raw.c
/// \brief  Cyclone DDS alone, the measure of libins_dds: COUNT writes of a libins::NavState, one each PERIOD_US (0: at once, a load for
///         callgrind, as publish.c), with the quality of service of the default profile.   bench_dds_raw COUNT [PERIOD_US DOMAIN]
/// SPDX-License-Identifier: MIT
#include "dds/dds.h"
#include "libins.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const char* const loopback =
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" multicast=\"false\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
    "<MaxAutoParticipantIndex>60</MaxAutoParticipantIndex><Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery>"
    "</Domain></CycloneDDS>";

int main(int argc, char** argv)
{
    const long count = argc > 1 ? atol(argv[1]) : 100;
    const long period_us = argc > 2 ? atol(argv[2]) : 0;
    const uint32_t number = argc > 3 ? (uint32_t)strtoul(argv[3], NULL, 10) : 198;
    const dds_entity_t domain = dds_create_domain(number, loopback);
    const dds_entity_t participant = dds_create_participant(number, NULL, NULL);
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 16);
    dds_qset_deadline(qos, DDS_SECS(1));
    dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(1));
    dds_qset_writer_data_lifecycle(qos, false);
    const dds_entity_t topic = dds_create_topic(participant, &libins_NavState_desc, "libins/nav_state", NULL, NULL);
    const dds_entity_t writer = dds_create_writer(participant, topic, qos, NULL);
    dds_delete_qos(qos);
    if (writer < 0)
    {
        fprintf(stderr, "no writer: %s\n", dds_strretcode(writer));
        return 1;
    }
    libins_NavState message;
    memset(&message, 0, sizeof message);
    (void)snprintf(message.source, sizeof message.source, "bench");
    for (long k = 0; k < count; k++)
    {
        if (period_us > 0)
        {
            const struct timespec period = {period_us / 1000000, period_us % 1000000 * 1000};
            (void)nanosleep(&period, NULL);
            message.time_ns = dds_time();
        }
        message.index = (uint64_t)k;
        if (dds_write(writer, &message) != DDS_RETCODE_OK)
        {
            return 1;
        }
    }
    (void)dds_delete(domain);
    return 0;
}
