/// \file   dds.c
/// \brief  Topics, writers and readers of idl/libins.idl on Cyclone DDS 0.10.
/// SPDX-License-Identifier: MIT
#include "dds_internal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define KIND(kind, usual, type) [kind] = {usual, &libins_##type##_desc, sizeof(libins_##type)},
static const struct
{
    const char* usual; ///< name of the topic
    const dds_topic_descriptor_t* type;
    size_t size;
} kinds[INS_DDS_KINDS] = {INS_DDS_KIND_LIST(KIND)};
#undef KIND

void ins_dds_config_carry(ins_dds_config_t* cfg, ins_dds_kind_t kind)
{
    cfg->topic[kind].name = kinds[kind].usual;
}

void ins_dds_config_default(ins_dds_config_t* cfg)
{
    memset(cfg, 0, sizeof *cfg);
    cfg->publishes = 1;
    cfg->lease_s = 1.0;
    for (int kind = 0; kind < INS_DDS_KINDS; kind++)
    {
        cfg->topic[kind].decimate = 1;
        (void)ins_dds_qos_profile(kind == INS_DDS_STATUS ? "latched" : "default", &cfg->topic[kind].qos);
    }
    cfg->topic[INS_DDS_STATE_DECIMATED].decimate = 10;
    ins_dds_config_carry(cfg, INS_DDS_STATE);
}

int ins_dds_config_qos(ins_dds_config_t* cfg, const char* choice)
{
    const size_t length = strcspn(choice, "=");
    char names[128] = "";
    for (int kind = 0; kind < INS_DDS_KINDS; kind++)
    {
        const char* const name = strchr(kinds[kind].usual, '/') + 1;
        if (choice[length] == '=' && strlen(name) == length && strncmp(choice, name, length) == 0)
        {
            return ins_dds_qos_profile(choice + length + 1, &cfg->topic[kind].qos);
        }
        const size_t used = strlen(names);
        (void)snprintf(names + used, sizeof names - used, "%s%s", used > 0 ? ", " : "", name);
    }
    return dds_fail(INS_DDS_E_ARGUMENT, "QoS '%s': TOPIC=PROFILE is needed, with TOPIC one of %s", choice, names);
}

static int check(const ins_dds_config_t* cfg)
{
    int carried = 0;
    for (int kind = 0; kind < INS_DDS_KINDS; kind++)
    {
        if (cfg->topic[kind].name == NULL)
        {
            continue;
        }
        carried = 1;
        const int status = dds_check_topic(&cfg->topic[kind], kinds[kind].usual);
        if (status != INS_DDS_OK)
        {
            return status;
        }
    }
    if (!carried || (!cfg->publishes && !cfg->subscribes))
    {
        return dds_fail(INS_DDS_E_ARGUMENT,
                        "the DDS configuration neither publishes nor subscribes, or names no topic to do so");
    }
    return INS_DDS_OK;
}

static int create_reader(ins_dds_t* self, const ins_dds_config_t* cfg, int kind, dds_entity_t topic)
{
    dds_qos_t* qos = dds_quality(cfg, &cfg->topic[kind].qos, 0);
    self->topic[kind].reader = dds_create_reader(self->place.participant, topic, qos, NULL);
    dds_delete_qos(qos);
    if (self->topic[kind].reader < 0)
    {
        return dds_refused(&self->place, "reader", self->topic[kind].reader);
    }
    const dds_entity_t condition = dds_create_readcondition(self->topic[kind].reader, DDS_ANY_STATE);
    const dds_return_t attached = condition > 0 ? dds_waitset_attach(self->waitset, condition, condition) : condition;
    return attached < 0 ? dds_refused(&self->place, "waitset", attached) : INS_DDS_OK;
}

static int create_topic(ins_dds_t* self, const ins_dds_config_t* cfg, int kind)
{
    const ins_dds_topic_config_t* const want = &cfg->topic[kind];
    const dds_entity_t topic = dds_create_topic(self->place.participant, kinds[kind].type, want->name, NULL, NULL);
    if (topic < 0)
    {
        return dds_refused(&self->place, "topic (letters, digits, _ and / may make its name)", topic);
    }
    self->topic[kind].decimate = want->decimate;
    if (cfg->publishes)
    {
        dds_qos_t* qos = dds_quality(cfg, &want->qos, 1);
        self->topic[kind].writer = dds_create_writer(self->place.participant, topic, qos, NULL);
        dds_delete_qos(qos);
        if (self->topic[kind].writer < 0)
        {
            return dds_refused(&self->place, "writer", self->topic[kind].writer);
        }
    }
    return cfg->subscribes ? create_reader(self, cfg, kind, topic) : INS_DDS_OK;
}

static int create_entities(ins_dds_t* self, const ins_dds_config_t* cfg)
{
    self->waitset = dds_create_waitset(self->place.participant);
    int status = self->waitset < 0 ? dds_refused(&self->place, "waitset", self->waitset) : INS_DDS_OK;
    for (int kind = 0; kind < INS_DDS_KINDS && status == INS_DDS_OK; kind++)
    {
        status = cfg->topic[kind].name != NULL ? create_topic(self, cfg, kind) : INS_DDS_OK;
    }
    return status;
}

int ins_dds_open(const ins_dds_config_t* cfg, ins_dds_t** self)
{
    *self = NULL;
    int status = check(cfg);
    if (status != INS_DDS_OK)
    {
        return status;
    }
    ins_dds_t* dds = calloc(1, sizeof *dds);
    if (dds == NULL)
    {
        return dds_fail(INS_DDS_E_DDS, "memory is out");
    }
    status = dds_place_open(&dds->place, cfg, NULL);
    status = status == INS_DDS_OK ? create_entities(dds, cfg) : status;
    if (status != INS_DDS_OK)
    {
        ins_dds_close(dds);
        return status;
    }
    dds_place_ready(&dds->place);
    *self = dds;
    return INS_DDS_OK;
}

/// \param[out] id  [INS_DDS_SOURCE_MAX + 1], zeros before.
static int may_publish(const ins_dds_t* self, ins_dds_kind_t kind, const char* source, char* id)
{
    if (self->topic[kind].writer <= 0)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "this DDS handle was not opened to publish %s: ins_dds_config_carry() does",
                        kinds[kind].usual);
    }
    const size_t length = strlen(source);
    if (length < 1 || length > INS_DDS_SOURCE_MAX)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "a source id has 1 to %d octets, this one %zu", INS_DDS_SOURCE_MAX, length);
    }
    memcpy(id, source, length);
    return INS_DDS_OK;
}

static int write_message(ins_dds_t* self, ins_dds_kind_t kind, const void* message)
{
    if (self->topic[kind].seen++ % self->topic[kind].decimate != 0)
    {
        return INS_DDS_OK;
    }
    const dds_return_t code = dds_write(self->topic[kind].writer, message);
    return code < 0 ? dds_fail(INS_DDS_E_DDS, "DDS could not publish: %s", dds_strretcode(code)) : INS_DDS_OK;
}

int ins_dds_publish_navigation(ins_dds_t* self, const ins_nav_state_t* state, const ins_navigation_t* navigation,
                               const char* source, int64_t published_ns)
{
    libins_NavState message = {0};
    const ins_dds_kind_t slow = INS_DDS_STATE_DECIMATED;
    const ins_dds_kind_t first =
        self->topic[slow].writer > 0 && self->topic[INS_DDS_STATE].writer <= 0 ? slow : INS_DDS_STATE;
    int status = may_publish(self, first, source, message.source);
    if (status != INS_DDS_OK)
    {
        return status;
    }
    message.published_ns = published_ns;
    dds_from_state(state, navigation, &message);
    status = write_message(self, first, &message);
    return status == INS_DDS_OK && first != slow && self->topic[slow].writer > 0 ? write_message(self, slow, &message)
                                                                                 : status;
}

int ins_dds_publish(ins_dds_t* self, const ins_nav_state_t* state, const char* source, int64_t published_ns)
{
    ins_navigation_t navigation;
    ins_navigation_from_state(state, published_ns, &navigation);
    return ins_dds_publish_navigation(self, state, &navigation, source, published_ns);
}

#define PUBLISH(kind, word, from_t, message_t)                                                                         \
    int ins_dds_publish_##word(ins_dds_t* self, const from_t* word, const char* source, int64_t published_ns)          \
    {                                                                                                                  \
        message_t message = {.published_ns = published_ns};                                                            \
        const int refused = may_publish(self, kind, source, message.source);                                           \
        if (refused != INS_DDS_OK)                                                                                     \
        {                                                                                                              \
            return refused;                                                                                            \
        }                                                                                                              \
        dds_from_##word(word, &message);                                                                               \
        return write_message(self, kind, &message);                                                                    \
    }
PUBLISH(INS_DDS_SOLUTION, solution, ins_nav_solution_t, libins_NavSolution)
PUBLISH(INS_DDS_STATUS, status, ins_dds_status_t, libins_Status)
PUBLISH(INS_DDS_INNOVATIONS, innovations, ins_dds_innovations_t, libins_Innovations)
PUBLISH(INS_DDS_RAW_IMU, raw_imu, ins_dds_raw_imu_t, libins_RawImu)

/// What is there now. \return samples in out, fewer than taken where a sample only says that its source is back.
static int take_topic(ins_dds_t* self, ins_dds_kind_t kind, ins_dds_sample_t* out, int max)
{
    void* buffer[TAKE_MAX];
    dds_sample_info_t info[TAKE_MAX];
    for (int i = 0; i < TAKE_MAX; i++)
    {
        buffer[i] = (char*)&self->taken + (size_t)i * kinds[kind].size;
    }
    const uint32_t want = max < TAKE_MAX ? (uint32_t)max : TAKE_MAX;
    const dds_return_t got = dds_take(self->topic[kind].reader, buffer, info, want, want);
    if (got < 0)
    {
        return dds_fail(INS_DDS_E_DDS, "DDS could not take: %s", dds_strretcode(got));
    }
    int count = 0;
    for (int i = 0; i < got; i++)
    {
        if (!info[i].valid_data && info[i].instance_state == DDS_IST_ALIVE)
        {
            continue;
        }
        ins_dds_sample_t* sample = &out[count++];
        memset(sample, 0, sizeof *sample);
        sample->kind = kind;
        sample->valid = info[i].valid_data;
        sample->gone = info[i].instance_state != DDS_IST_ALIVE;
        dds_to_sample(self, i, sample);
    }
    return count;
}

/// Of all topics, beginning with the one after that which came first the last time.
static int take_now(ins_dds_t* self, ins_dds_sample_t* out, int max)
{
    int count = 0;
    self->turn = (self->turn + 1) % INS_DDS_KINDS;
    for (int i = 0; i < INS_DDS_KINDS && count < max; i++)
    {
        const int kind = (self->turn + i) % INS_DDS_KINDS;
        if (self->topic[kind].reader > 0)
        {
            const int got = take_topic(self, (ins_dds_kind_t)kind, out + count, max - count);
            if (got < 0)
            {
                return got;
            }
            count += got;
        }
    }
    return count;
}

static int has_reader(const ins_dds_t* self)
{
    int readers = 0;
    for (int kind = 0; kind < INS_DDS_KINDS; kind++)
    {
        readers += self->topic[kind].reader > 0;
    }
    return readers > 0;
}

int ins_dds_take(ins_dds_t* self, double timeout_s, ins_dds_sample_t* out, int max)
{
    if (!has_reader(self))
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "this DDS handle was not opened to subscribe");
    }
    if (max < 1 || !(timeout_s >= 0.0 && timeout_s <= 1e9))
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "a DDS take wants room for at least 1 sample and a time-out of 0 to 1e9 s");
    }
    const dds_time_t end = dds_time() + dds_duration(timeout_s);
    for (;;)
    {
        const int count = take_now(self, out, max);
        if (count != 0 || dds_time() >= end)
        {
            return count;
        }
        const dds_return_t code = dds_waitset_wait_until(self->waitset, NULL, 0, end);
        if (code < 0)
        {
            return dds_fail(INS_DDS_E_DDS, "DDS could not wait: %s", dds_strretcode(code));
        }
    }
}

int ins_dds_matched(ins_dds_t* self)
{
    int count = 0;
    for (int kind = 0; kind < INS_DDS_KINDS; kind++)
    {
        const dds_entity_t writer = self->topic[kind].writer;
        const dds_entity_t reader = self->topic[kind].reader;
        const dds_return_t readers = writer > 0 ? dds_get_matched_subscriptions(writer, NULL, 0) : 0;
        const dds_return_t writers = reader > 0 ? dds_get_matched_publications(reader, NULL, 0) : 0;
        if (readers < 0 || writers < 0)
        {
            return dds_fail(INS_DDS_E_DDS, "DDS could not tell its peers: %s",
                            dds_strretcode(readers < 0 ? readers : writers));
        }
        count += readers + writers;
    }
    return count;
}

void ins_dds_close(ins_dds_t* self)
{
    if (self != NULL)
    {
        dds_place_close(&self->place);
        free(self);
    }
}
