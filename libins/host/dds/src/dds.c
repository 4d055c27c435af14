/// \file   dds.c
/// \brief  Domain, writer and reader of libins::NavState or libins::NavSolution on Cyclone DDS 0.10.
/// SPDX-License-Identifier: MIT
#include "dds_internal.h"
#include <stdlib.h>
#include <string.h>

/// Loopback only, no multicast, up to 61 processes of a domain on one machine. MaxAutoParticipantIndex is also the number of ports
/// that discovery tries, hence not larger.
static const char loopback_xml[] =
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" multicast=\"false\"/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
    "<MaxAutoParticipantIndex>60</MaxAutoParticipantIndex><Peers><Peer "
    "address=\"127.0.0.1\"/></Peers></Discovery></Domain>"
    "</CycloneDDS>";

#define MAX_BLOCKING                                                                                                   \
    DDS_MSECS(100) ///< what a write may wait for room; with KEEP_LAST it replaces the oldest sample instead

void ins_dds_config_default(ins_dds_config_t* cfg)
{
    memset(cfg, 0, sizeof *cfg);
    cfg->publishes = 1;
    cfg->deadline_s = 1.0;
    cfg->lease_s = 1.0;
    cfg->history = 16;
}

static dds_duration_t duration(double seconds)
{
    return (dds_duration_t)(seconds * 1e9);
}

static const char* usual_topic(const ins_dds_config_t* cfg)
{
    return cfg->kind == INS_DDS_STATE ? INS_DDS_TOPIC : INS_DDS_SOLUTION_TOPIC;
}

static int check(const ins_dds_config_t* cfg)
{
    if (cfg->domain > INS_DDS_DOMAIN_MAX)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "DDS domain id %u is out of range: use 0 to %d", (unsigned)cfg->domain,
                        INS_DDS_DOMAIN_MAX);
    }
    if (cfg->network < INS_DDS_LOOPBACK || cfg->network > INS_DDS_JOIN)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "unknown kind of DDS network configuration: %d", cfg->network);
    }
    if (cfg->network == INS_DDS_XML && (cfg->xml == NULL || cfg->xml[0] != '<'))
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "the DDS configuration must be an XML text that starts with <CycloneDDS>");
    }
    const char* uri = getenv("CYCLONEDDS_URI");
    if (cfg->network == INS_DDS_ENVIRONMENT && (uri == NULL || uri[0] == '\0'))
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "the DDS configuration was to come from CYCLONEDDS_URI, which is not set");
    }
    if (cfg->kind != INS_DDS_STATE && cfg->kind != INS_DDS_SOLUTION)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "unknown kind of DDS messages: %d", cfg->kind);
    }
    if (cfg->topic != NULL && cfg->topic[0] == '\0')
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "the DDS topic name is empty: the usual one is %s", usual_topic(cfg));
    }
    if (!cfg->publishes && !cfg->subscribes)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "the DDS configuration neither publishes nor subscribes");
    }
    // Written so that NaN is refused.
    if (!(cfg->deadline_s >= 0.0 && cfg->deadline_s <= 1e6) || !(cfg->lease_s >= 0.01 && cfg->lease_s <= 1e6))
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "the DDS deadline must be 0 to 1e6 s, the liveliness lease 0.01 to 1e6 s");
    }
    if (cfg->history < 1 || cfg->history > 100000)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "the DDS history must be 1 to 100000 samples");
    }
    return INS_DDS_OK;
}

static int refused(const ins_dds_t* self, const char* what, dds_return_t code)
{
    return dds_fail(INS_DDS_E_DDS, "DDS refused the %s: %s%s%s", what, dds_strretcode(code),
                    self->log.text[0] != '\0' ? ": " : "", self->log.text);
}

static int create_domain(ins_dds_t* self, const ins_dds_config_t* cfg)
{
    const char* xml = loopback_xml;
    xml = cfg->network == INS_DDS_XML ? cfg->xml : xml;
    xml = cfg->network == INS_DDS_ENVIRONMENT ? getenv("CYCLONEDDS_URI") : xml;
    const dds_entity_t domain = dds_create_domain(cfg->domain, xml);
    if (cfg->network == INS_DDS_JOIN)
    {
        if (domain == DDS_RETCODE_PRECONDITION_NOT_MET)
        {
            return INS_DDS_OK;
        }
        if (domain > 0)
        {
            (void)dds_delete(domain);
        }
        return dds_fail(INS_DDS_E_DOMAIN,
                        "this process has no DDS domain %u to join: open it, or choose another network configuration",
                        (unsigned)cfg->domain);
    }
    if (domain > 0)
    {
        self->domain = domain;
        return INS_DDS_OK;
    }
    if (domain == DDS_RETCODE_PRECONDITION_NOT_MET)
    {
        return dds_fail(
            INS_DDS_E_DOMAIN,
            "this process already has DDS domain %u: close it, take another domain id, or open with INS_DDS_JOIN",
            (unsigned)cfg->domain);
    }
    if (strstr(self->log.text, "interface") != NULL)
    {
        return dds_fail(INS_DDS_E_NETWORK, "no network interface that DDS can use (%s): %s", self->log.text,
                        cfg->network == INS_DDS_LOOPBACK
                            ? "run `ip link set lo up`"
                            : "name one of this machine (`ip link`), or use the loopback configuration");
    }
    return cfg->network == INS_DDS_LOOPBACK ? refused(self, "domain", domain)
                                            : dds_fail(INS_DDS_E_ARGUMENT, "DDS refused its configuration (%s): %s",
                                                       dds_strretcode(domain), self->log.text);
}

static dds_qos_t* quality(const ins_dds_config_t* cfg, int is_writer)
{
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, MAX_BLOCKING);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, (int32_t)cfg->history);
    dds_qset_durability(qos, DDS_DURABILITY_VOLATILE);
    if (cfg->partition != NULL)
    {
        dds_qset_partition1(qos, cfg->partition);
    }
    if (is_writer)
    {
        dds_qset_writer_data_lifecycle(qos, false);
        dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, duration(cfg->lease_s));
        dds_qset_deadline(qos, cfg->deadline_s > 0.0 ? duration(cfg->deadline_s) : DDS_INFINITY);
    }
    return qos;
}

static int create_entities(ins_dds_t* self, const ins_dds_config_t* cfg)
{
    self->participant = dds_create_participant(cfg->domain, NULL, NULL);
    if (self->participant < 0)
    {
        return refused(self, "participant", self->participant);
    }
    self->topic = dds_create_topic(self->participant,
                                   cfg->kind == INS_DDS_STATE ? &libins_NavState_desc : &libins_NavSolution_desc,
                                   cfg->topic != NULL ? cfg->topic : usual_topic(cfg), NULL, NULL);
    if (self->topic < 0)
    {
        return refused(self, "topic (letters, digits, _ and / may make its name)", self->topic);
    }
    if (cfg->publishes)
    {
        dds_qos_t* qos = quality(cfg, 1);
        self->writer = dds_create_writer(self->participant, self->topic, qos, NULL);
        dds_delete_qos(qos);
        if (self->writer < 0)
        {
            return refused(self, "writer", self->writer);
        }
    }
    if (cfg->subscribes)
    {
        dds_qos_t* qos = quality(cfg, 0);
        self->reader = dds_create_reader(self->participant, self->topic, qos, NULL);
        dds_delete_qos(qos);
        if (self->reader < 0)
        {
            return refused(self, "reader", self->reader);
        }
        self->waitset = dds_create_waitset(self->participant);
        const dds_entity_t condition =
            self->waitset > 0 ? dds_create_readcondition(self->reader, DDS_ANY_STATE) : self->waitset;
        const dds_return_t attached =
            condition > 0 ? dds_waitset_attach(self->waitset, condition, condition) : condition;
        if (attached < 0)
        {
            return refused(self, "waitset", attached);
        }
    }
    return INS_DDS_OK;
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
    (void)pthread_mutex_init(&dds->log.mutex, NULL);
    dds->kind = cfg->kind;
    dds->log.collect = 1;
    dds->log.log = cfg->log;
    dds->log.log_context = cfg->log_context;
    dds_set_log_sink(dds_log_line, &dds->log);
    status = create_domain(dds, cfg);
    status = status == INS_DDS_OK ? create_entities(dds, cfg) : status;
    if (status != INS_DDS_OK)
    {
        ins_dds_close(dds);
        return status;
    }
    (void)pthread_mutex_lock(&dds->log.mutex);
    dds->log.collect = 0;
    (void)pthread_mutex_unlock(&dds->log.mutex);
    if (cfg->log == NULL)
    {
        dds_set_log_sink(NULL, NULL);
    }
    else if (dds->log.text[0] != '\0')
    {
        cfg->log(cfg->log_context, dds->log.text);
    }
    *self = dds;
    return INS_DDS_OK;
}

/// \param[out] id  [INS_DDS_SOURCE_MAX + 1], zeros before.
static int may_publish(const ins_dds_t* self, int kind, const char* source, char* id)
{
    if (self->writer <= 0 || self->kind != kind)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "this DDS handle was not opened to publish%s",
                        self->writer <= 0       ? ""
                        : kind == INS_DDS_STATE ? " states: cfg.kind was INS_DDS_SOLUTION"
                                                : " solutions: cfg.kind was INS_DDS_STATE");
    }
    const size_t length = strlen(source);
    if (length < 1 || length > INS_DDS_SOURCE_MAX)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "a source id has 1 to %d octets, this one %zu", INS_DDS_SOURCE_MAX, length);
    }
    memcpy(id, source, length);
    return INS_DDS_OK;
}

static int write_message(const ins_dds_t* self, const void* message)
{
    const dds_return_t code = dds_write(self->writer, message);
    return code < 0 ? dds_fail(INS_DDS_E_DDS, "DDS could not publish: %s", dds_strretcode(code)) : INS_DDS_OK;
}

int ins_dds_publish(ins_dds_t* self, const ins_nav_state_t* state, const char* source, int64_t published_ns)
{
    libins_NavState message = {0};
    message.published_ns = published_ns;
    dds_from_state(state, &message);
    const int status = may_publish(self, INS_DDS_STATE, source, message.source);
    return status == INS_DDS_OK ? write_message(self, &message) : status;
}

int ins_dds_publish_solution(ins_dds_t* self, const ins_nav_solution_t* solution, const char* source,
                             int64_t published_ns)
{
    libins_NavSolution message = {0};
    message.published_ns = published_ns;
    dds_from_solution(solution, &message);
    const int status = may_publish(self, INS_DDS_SOLUTION, source, message.source);
    return status == INS_DDS_OK ? write_message(self, &message) : status;
}

/// What is there now. \return samples in out, fewer than taken where a sample only says that its source is back.
static int take_now(ins_dds_t* self, ins_dds_sample_t* out, int max)
{
    void* buffer[TAKE_MAX];
    dds_sample_info_t info[TAKE_MAX];
    for (int i = 0; i < TAKE_MAX; i++)
    {
        buffer[i] = self->kind == INS_DDS_STATE ? (void*)&self->taken.state[i] : (void*)&self->taken.solution[i];
    }
    const uint32_t want = max < TAKE_MAX ? (uint32_t)max : TAKE_MAX;
    const dds_return_t got = dds_take(self->reader, buffer, info, want, want);
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
        sample->valid = info[i].valid_data;
        sample->gone = info[i].instance_state != DDS_IST_ALIVE;
        dds_to_sample(self, i, sample);
    }
    return count;
}

int ins_dds_take(ins_dds_t* self, double timeout_s, ins_dds_sample_t* out, int max)
{
    if (self->reader <= 0)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "this DDS handle was not opened to subscribe");
    }
    if (max < 1 || !(timeout_s >= 0.0 && timeout_s <= 1e9))
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "a DDS take wants room for at least 1 sample and a time-out of 0 to 1e9 s");
    }
    const dds_time_t end = dds_time() + duration(timeout_s);
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
    const dds_return_t readers = self->writer > 0 ? dds_get_matched_subscriptions(self->writer, NULL, 0) : 0;
    const dds_return_t writers = self->reader > 0 ? dds_get_matched_publications(self->reader, NULL, 0) : 0;
    if (readers < 0 || writers < 0)
    {
        return dds_fail(INS_DDS_E_DDS, "DDS could not tell its peers: %s",
                        dds_strretcode(readers < 0 ? readers : writers));
    }
    return readers + writers;
}

void ins_dds_close(ins_dds_t* self)
{
    if (self == NULL)
    {
        return;
    }
    if (self->domain > 0)
    {
        (void)dds_delete(self->domain); // and all that was made in it
    }
    else if (self->participant > 0)
    {
        (void)dds_delete(self->participant);
    }
    dds_set_log_sink(NULL, NULL);
    (void)pthread_mutex_destroy(&self->log.mutex);
    free(self);
}
