/// \file   qos.c
/// \brief  Profiles of quality of service by name, and what Cyclone is told of one.
/// Source: names and values of ROS 2's rmw_qos_profile_sensor_data and _default; "latched" is ROS's word for a topic that keeps its
/// last message (tf_static); OMG DDS 1.4 (formal/2015-04-10), 2.2.3.
/// SPDX-License-Identifier: MIT
#include "dds_internal.h"
#include <stdio.h>
#include <string.h>

#define MAX_BLOCKING                                                                                                   \
    DDS_MSECS(100) ///< what a write may wait for room; with KEEP_LAST it replaces the oldest sample instead

static const struct
{
    const char* name;
    ins_dds_qos_t qos;
} profiles[] = {
    {"default", {.reliable = 1, .history = 16, .deadline_s = 1.0}},
    {"sensor_data", {.history = 5, .deadline_s = 1.0, .lifespan_s = 0.5}},
    {"latched", {.reliable = 1, .latched = 1, .history = 1}},
    {"reliable", {.reliable = 1, .history = 1000}},
};

int ins_dds_qos_profile(const char* name, ins_dds_qos_t* qos)
{
    char names[128] = "";
    for (size_t i = 0; i < sizeof profiles / sizeof profiles[0]; i++)
    {
        if (strcmp(name, profiles[i].name) == 0)
        {
            *qos = profiles[i].qos;
            return INS_DDS_OK;
        }
        const size_t used = strlen(names);
        (void)snprintf(names + used, sizeof names - used, "%s%s", used > 0 ? ", " : "", profiles[i].name);
    }
    return dds_fail(INS_DDS_E_ARGUMENT, "'%s' is no QoS profile: it is one of %s", name, names);
}

int dds_check_topic(const ins_dds_topic_config_t* topic, const char* usual)
{
    const char* const name = topic->name;
    if (name[0] == '\0')
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "the DDS topic name is empty: the usual one is %s", usual);
    }
    if (topic->decimate < 1)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "the topic %s is decimated by 0: by 1 all are published", name);
    }
    if (topic->qos.history < 1 || topic->qos.history > 100000)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "the DDS history of %s must be 1 to 100000 samples", name);
    }
    // Written so that NaN is refused.
    if (!(topic->qos.deadline_s >= 0.0 && topic->qos.deadline_s <= 1e6) ||
        !(topic->qos.lifespan_s >= 0.0 && topic->qos.lifespan_s <= 1e6))
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "the DDS deadline and lifespan of %s must be 0 to 1e6 s", name);
    }
    return INS_DDS_OK;
}

static dds_duration_t or_none(double seconds)
{
    return seconds > 0.0 ? dds_duration(seconds) : DDS_INFINITY;
}

dds_qos_t* dds_quality(const ins_dds_config_t* cfg, const ins_dds_qos_t* want, int is_writer)
{
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, want->reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, MAX_BLOCKING);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, (int32_t)want->history);
    dds_qset_durability(qos, want->latched ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
    if (cfg->partition != NULL)
    {
        dds_qset_partition1(qos, cfg->partition);
    }
    dds_qset_ownership(qos, cfg->strength > 0 ? DDS_OWNERSHIP_EXCLUSIVE : DDS_OWNERSHIP_SHARED);
    if (is_writer)
    {
        dds_qset_ownership_strength(qos, cfg->strength);
        dds_qset_writer_data_lifecycle(qos, false);
        dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, dds_duration(cfg->lease_s));
        dds_qset_deadline(qos, or_none(want->deadline_s));
        dds_qset_lifespan(qos, or_none(want->lifespan_s));
    }
    return qos;
}
