/// \file   dds.c
/// \brief  Domain, writer and reader of libins::NavState or libins::NavSolution on Cyclone DDS 0.10.
/// SPDX-License-Identifier: MIT
#include "dds_internal.h"
#include <stdlib.h>
#include <string.h>

void ins_dds_config_default(ins_dds_config_t* cfg)
{
    memset(cfg, 0, sizeof *cfg);
    cfg->publishes = 1;
    cfg->deadline_s = 1.0;
    cfg->lease_s = 1.0;
    cfg->history = 16;
}

static const char* usual_topic(const ins_dds_config_t* cfg)
{
    return cfg->kind == INS_DDS_STATE ? INS_DDS_TOPIC : INS_DDS_SOLUTION_TOPIC;
}

static int check(const ins_dds_config_t* cfg)
{
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
    return INS_DDS_OK;
}

static int create_entities(ins_dds_t* self, const ins_dds_config_t* cfg)
{
    self->topic = dds_create_topic(self->place.participant,
                                   cfg->kind == INS_DDS_STATE ? &libins_NavState_desc : &libins_NavSolution_desc,
                                   cfg->topic != NULL ? cfg->topic : usual_topic(cfg), NULL, NULL);
    if (self->topic < 0)
    {
        return dds_refused(&self->place, "topic (letters, digits, _ and / may make its name)", self->topic);
    }
    if (cfg->publishes)
    {
        dds_qos_t* qos = dds_quality(cfg, 1);
        self->writer = dds_create_writer(self->place.participant, self->topic, qos, NULL);
        dds_delete_qos(qos);
        if (self->writer < 0)
        {
            return dds_refused(&self->place, "writer", self->writer);
        }
    }
    if (cfg->subscribes)
    {
        dds_qos_t* qos = dds_quality(cfg, 0);
        self->reader = dds_create_reader(self->place.participant, self->topic, qos, NULL);
        dds_delete_qos(qos);
        if (self->reader < 0)
        {
            return dds_refused(&self->place, "reader", self->reader);
        }
        self->waitset = dds_create_waitset(self->place.participant);
        const dds_entity_t condition =
            self->waitset > 0 ? dds_create_readcondition(self->reader, DDS_ANY_STATE) : self->waitset;
        const dds_return_t attached =
            condition > 0 ? dds_waitset_attach(self->waitset, condition, condition) : condition;
        if (attached < 0)
        {
            return dds_refused(&self->place, "waitset", attached);
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
    dds->kind = cfg->kind;
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
    if (self != NULL)
    {
        dds_place_close(&self->place);
        free(self);
    }
}
