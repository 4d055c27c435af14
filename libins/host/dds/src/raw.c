/// \file   raw.c
/// \brief  Octets of any type of ours from readers and to writers of Cyclone DDS 0.10, by its serialised samples (ddsi_serdata).
/// SPDX-License-Identifier: MIT
#include "ins_dds/raw.h"
#define asm __asm__ // the next header's inline functions say asm, which is no word of C11
#include "dds/ddsi/ddsi_serdata.h"
#undef asm
#include "ros_internal.h"
#include <stdlib.h>
#include <string.h>

#define TAKE_AT_ONCE 64
#define KEEP_UP      DDS_SECS(10) ///< what a write waits for a reader

static const dds_topic_descriptor_t* const types[] = {
    &libins_NavState_desc,
    &libins_NavSolution_desc,
    &libins_Status_desc,
    &libins_Innovations_desc,
    &libins_RawImu_desc,
    &sensor_msgs_msg_dds__Imu__desc,
    &sensor_msgs_msg_dds__NavSatFix__desc,
    &nav_msgs_msg_dds__Odometry__desc,
    &geometry_msgs_msg_dds__TwistWithCovarianceStamped__desc,
    &tf2_msgs_msg_dds__TFMessage__desc,
    &diagnostic_msgs_msg_dds__DiagnosticArray__desc,
};
#define TYPES (sizeof types / sizeof types[0])

struct ins_dds_raw_t
{
    dds_place_t place;
    ins_dds_config_t cfg;
    dds_entity_t publications;
    dds_entity_t waitset;
    dds_entity_t entity[INS_DDS_RAW_TOPICS]; ///< reader or writer
    int is_writer[INS_DDS_RAW_TOPICS];
    int topics;
    int next; ///< whose turn it is to be taken from
    int held; ///< samples that out of the last take points into
    struct ddsi_serdata* sample[TAKE_AT_ONCE];
    ddsrt_iovec_t octets[TAKE_AT_ONCE];
};

const char* ins_dds_raw_type(int index)
{
    return index >= 0 && (size_t)index < TYPES ? types[index]->m_typename : NULL;
}

static int watch(ins_dds_raw_t* self, dds_entity_t reader)
{
    const dds_entity_t condition = reader > 0 ? dds_create_readcondition(reader, DDS_ANY_STATE) : reader;
    return condition > 0 ? dds_waitset_attach(self->waitset, condition, condition) : condition;
}

int ins_dds_raw_open(const ins_dds_config_t* cfg, ins_dds_raw_t** out)
{
    *out = NULL;
    ins_dds_raw_t* self = calloc(1, sizeof *self);
    if (self == NULL)
    {
        return dds_fail(INS_DDS_E_DDS, "memory is out");
    }
    self->cfg = *cfg;
    int status = dds_place_open(&self->place, cfg, "enclave=/;");
    if (status == INS_DDS_OK)
    {
        self->publications = dds_create_reader(self->place.participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, NULL, NULL);
        self->waitset = dds_create_waitset(self->place.participant);
        const dds_return_t code = self->waitset > 0 ? watch(self, self->publications) : self->waitset;
        status = code < 0 ? dds_refused(&self->place, "discovery", code) : INS_DDS_OK;
    }
    if (status != INS_DDS_OK)
    {
        ins_dds_raw_close(self);
        return status;
    }
    dds_place_ready(&self->place);
    *out = self;
    return INS_DDS_OK;
}

/// \return 0: the text does not fit.
static int keep(char* to, const char* text)
{
    const size_t length = strlen(text);
    if (length > INS_DDS_RAW_NAME)
    {
        return 0;
    }
    memcpy(to, text, length + 1);
    return 1;
}

/// \return 0: a name is longer than those of ours.
static int describe(const dds_builtintopic_endpoint_t* from, ins_dds_raw_topic_t* to)
{
    memset(to, 0, sizeof *to);
    int fits = keep(to->name, from->topic_name) && keep(to->type, from->type_name);
    uint32_t count = 0;
    char** partitions = NULL;
    if (dds_qget_partition(from->qos, &count, &partitions))
    {
        fits = fits && (count == 0 || keep(to->partition, partitions[0]));
        for (uint32_t i = 0; i < count; i++)
        {
            dds_free(partitions[i]);
        }
        dds_free(partitions);
    }
    void* user = NULL;
    size_t size = 0;
    if (dds_qget_userdata(from->qos, &user, &size))
    {
        if (size > 0 && size <= INS_DDS_RAW_NAME)
        {
            memcpy(to->user, user, size);
        }
        dds_free(user);
    }
    dds_reliability_kind_t reliability = DDS_RELIABILITY_RELIABLE;
    dds_durability_kind_t durability = DDS_DURABILITY_VOLATILE;
    dds_ownership_kind_t ownership = DDS_OWNERSHIP_SHARED;
    dds_duration_t deadline = DDS_INFINITY;
    (void)dds_qget_reliability(from->qos, &reliability, NULL);
    to->best_effort = reliability == DDS_RELIABILITY_BEST_EFFORT;
    to->latched = dds_qget_durability(from->qos, &durability) && durability != DDS_DURABILITY_VOLATILE;
    to->exclusive = dds_qget_ownership(from->qos, &ownership) && ownership == DDS_OWNERSHIP_EXCLUSIVE;
    (void)dds_qget_ownership_strength(from->qos, &to->strength);
    if (dds_qget_deadline(from->qos, &deadline) && deadline != DDS_INFINITY)
    {
        to->deadline_s = (double)deadline * 1e-9;
    }
    return fits;
}

static int is_own(const ins_dds_raw_t* self, const dds_builtintopic_endpoint_t* writer)
{
    dds_guid_t own;
    return dds_get_guid(self->place.participant, &own) == DDS_RETCODE_OK &&
           memcmp(&own, &writer->participant_key, sizeof own) == 0;
}

int ins_dds_raw_found(ins_dds_raw_t* self, ins_dds_raw_topic_t* out, int max)
{
    int count = 0;
    while (count < max)
    {
        void* sample = NULL;
        dds_sample_info_t info;
        const dds_return_t got = dds_take(self->publications, &sample, &info, 1, 1);
        if (got < 0)
        {
            return dds_fail(INS_DDS_E_DDS, "DDS could not tell its topics: %s", dds_strretcode(got));
        }
        if (got == 0)
        {
            break;
        }
        if (info.valid_data && info.instance_state == DDS_IST_ALIVE && !is_own(self, sample))
        {
            count += describe(sample, &out[count]);
        }
        (void)dds_return_loan(self->publications, &sample, got);
    }
    return count;
}

static const dds_topic_descriptor_t* type_named(const char* name)
{
    for (size_t i = 0; i < TYPES; i++)
    {
        if (strcmp(types[i]->m_typename, name) == 0)
        {
            return types[i];
        }
    }
    return NULL;
}

static dds_qos_t* quality(const ins_dds_raw_t* self, const ins_dds_raw_topic_t* topic, int is_writer)
{
    ins_dds_config_t cfg = self->cfg;
    cfg.partition = topic->partition[0] != '\0' ? topic->partition : NULL;
    cfg.strength = topic->strength;
    const ins_dds_qos_t want = {.reliable = is_writer || !topic->best_effort,
                                .latched = topic->latched,
                                .history = 1,
                                .deadline_s = topic->deadline_s};
    dds_qos_t* qos = dds_quality(&cfg, &want, is_writer);
    dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED);
    dds_qset_ownership(qos, topic->exclusive ? DDS_OWNERSHIP_EXCLUSIVE : DDS_OWNERSHIP_SHARED);
    if (is_writer)
    {
        dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, KEEP_UP);
        dds_qset_userdata(qos, topic->user, strlen(topic->user));
    }
    if (topic->latched)
    {
        dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, 1, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED,
                                    DDS_LENGTH_UNLIMITED);
    }
    return qos;
}

static int create(ins_dds_raw_t* self, const ins_dds_raw_topic_t* topic, int is_writer)
{
    const dds_topic_descriptor_t* const type = type_named(topic->type);
    if (type == NULL)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "topic %s: libins_dds has no type %s", topic->name, topic->type);
    }
    if (self->topics == INS_DDS_RAW_TOPICS)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "topic %s: a handle has at most %d topics", topic->name,
                        INS_DDS_RAW_TOPICS);
    }
    const dds_entity_t place = self->place.participant;
    const dds_entity_t entity = dds_create_topic(place, type, topic->name, NULL, NULL);
    if (entity < 0)
    {
        return dds_refused(&self->place, topic->name, entity);
    }
    dds_qos_t* qos = quality(self, topic, is_writer);
    const dds_entity_t end =
        is_writer ? dds_create_writer(place, entity, qos, NULL) : dds_create_reader(place, entity, qos, NULL);
    dds_delete_qos(qos);
    const dds_return_t code = end > 0 && !is_writer ? watch(self, end) : end;
    if (code < 0)
    {
        return dds_refused(&self->place, topic->name, code);
    }
    self->entity[self->topics] = end;
    self->is_writer[self->topics] = is_writer;
    return self->topics++;
}

int ins_dds_raw_subscribe(ins_dds_raw_t* self, const ins_dds_raw_topic_t* topic)
{
    return create(self, topic, 0);
}

int ins_dds_raw_publish(ins_dds_raw_t* self, const ins_dds_raw_topic_t* topic)
{
    return create(self, topic, 1);
}

static void let_go(ins_dds_raw_t* self)
{
    for (int i = 0; i < self->held; i++)
    {
        ddsi_serdata_to_ser_unref(self->sample[i], &self->octets[i]);
    }
    self->held = 0;
}

static int take_from(ins_dds_raw_t* self, int topic, ins_dds_raw_message_t* out, int max)
{
    struct ddsi_serdata* sample[TAKE_AT_ONCE];
    dds_sample_info_t info[TAKE_AT_ONCE];
    const dds_return_t got = dds_takecdr(self->entity[topic], sample, (uint32_t)max, info, DDS_ANY_STATE);
    if (got < 0)
    {
        return dds_fail(INS_DDS_E_DDS, "DDS could not take: %s", dds_strretcode(got));
    }
    int count = 0;
    for (int i = 0; i < got; i++)
    {
        if (info[i].valid_data)
        {
            ddsrt_iovec_t* const octets = &self->octets[self->held];
            self->sample[self->held++] = ddsi_serdata_to_ser_ref(sample[i], 0, ddsi_serdata_size(sample[i]), octets);
            out[count++] = (ins_dds_raw_message_t){topic, info[i].source_timestamp, octets->iov_base, octets->iov_len};
        }
        ddsi_serdata_unref(sample[i]);
    }
    return count;
}

static int take_now(ins_dds_raw_t* self, ins_dds_raw_message_t* out, int max)
{
    let_go(self);
    int count = 0;
    for (int i = 0; i < self->topics && count < max; i++)
    {
        const int topic = (self->next + i) % self->topics;
        const int got = self->is_writer[topic] ? 0 : take_from(self, topic, out + count, max - count);
        if (got < 0)
        {
            return got;
        }
        count += got;
    }
    self->next = self->topics > 0 ? (self->next + 1) % self->topics : 0;
    return count;
}

int ins_dds_raw_take(ins_dds_raw_t* self, double timeout_s, ins_dds_raw_message_t* out, int max)
{
    if (max < 1 || !(timeout_s >= 0.0 && timeout_s <= 1e9))
    {
        return dds_fail(INS_DDS_E_ARGUMENT,
                        "a DDS take wants room for at least 1 message and a time-out of 0 to 1e9 s");
    }
    const int room = max < TAKE_AT_ONCE ? max : TAKE_AT_ONCE;
    const int count = take_now(self, out, room);
    if (count != 0 || timeout_s == 0.0)
    {
        return count;
    }
    const dds_return_t code = dds_waitset_wait(self->waitset, NULL, 0, dds_duration(timeout_s));
    return code < 0 ? dds_fail(INS_DDS_E_DDS, "DDS could not wait: %s", dds_strretcode(code))
                    : take_now(self, out, room);
}

// A sample that is nothing but its octets. Its type is of no domain, so dds_writecdr() makes one of the writer's type of it, which
// checks the octets (ddsi_serdata_ref_as_type).
typedef struct octets_t
{
    struct ddsi_serdata head;
    const uint8_t* octets;
    uint32_t size;
} octets_t;

static uint32_t octets_size(const struct ddsi_serdata* sample)
{
    return ((const octets_t*)sample)->size;
}

static struct ddsi_serdata* octets_ref(const struct ddsi_serdata* sample, size_t offset, size_t size,
                                       ddsrt_iovec_t* out)
{
    out->iov_base = (void*)(uintptr_t)(((const octets_t*)sample)->octets + offset);
    out->iov_len = size;
    return ddsi_serdata_ref(sample);
}

static void octets_unref(struct ddsi_serdata* sample, const ddsrt_iovec_t* octets)
{
    (void)octets;
    ddsi_serdata_unref(sample);
}

static void octets_free(struct ddsi_serdata* sample)
{
    (void)sample; // is on the stack of ins_dds_raw_write()
}

int ins_dds_raw_write(ins_dds_raw_t* self, int topic, const uint8_t* octets, size_t size)
{
    static const struct ddsi_serdata_ops samples = {
        .get_size = octets_size, .to_ser_ref = octets_ref, .to_ser_unref = octets_unref, .free = octets_free};
    static const struct ddsi_sertype_ops any = {.version = ddsi_sertype_v0};
    static const struct ddsi_sertype type = {.ops = &any, .serdata_ops = &samples};
    if (topic < 0 || topic >= self->topics || !self->is_writer[topic])
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "this handle has no DDS writer %d", topic);
    }
    if (size < 4 || size > INT32_MAX)
    {
        return dds_fail(INS_DDS_E_DDS, "%zu octets are no CDR: it has a header of 4", size);
    }
    octets_t sample = {.octets = octets, .size = (uint32_t)size};
    ddsi_serdata_init(&sample.head, &type, SDK_DATA);
    const dds_return_t code = dds_writecdr(self->entity[topic], &sample.head);
    return code < 0 ? dds_fail(INS_DDS_E_DDS, "DDS could not publish %zu octets: %s", size, dds_strretcode(code))
                    : INS_DDS_OK;
}

int ins_dds_raw_delivered(ins_dds_raw_t* self, double timeout_s)
{
    const dds_time_t end = dds_time() + dds_duration(timeout_s);
    for (int i = 0; i < self->topics; i++)
    {
        const dds_duration_t left = end - dds_time();
        if (self->is_writer[i] && dds_wait_for_acks(self->entity[i], left > 0 ? left : 0) != DDS_RETCODE_OK)
        {
            return dds_fail(INS_DDS_E_DDS, "a reader has not confirmed everything within %g s", timeout_s);
        }
    }
    return INS_DDS_OK;
}

int ins_dds_raw_matched(ins_dds_raw_t* self, int topic)
{
    if (topic < 0 || topic >= self->topics)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "this handle has no DDS topic %d", topic);
    }
    const dds_entity_t end = self->entity[topic];
    const dds_return_t count = self->is_writer[topic] ? dds_get_matched_subscriptions(end, NULL, 0)
                                                      : dds_get_matched_publications(end, NULL, 0);
    return count < 0 ? dds_fail(INS_DDS_E_DDS, "DDS could not tell its peers: %s", dds_strretcode(count)) : count;
}

void ins_dds_raw_close(ins_dds_raw_t* self)
{
    if (self != NULL)
    {
        let_go(self);
        dds_place_close(&self->place);
        free(self);
    }
}
