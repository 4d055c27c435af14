/// \file   outbox.c
/// \brief  The thread that publishes, and what it makes of status messages.
/// SPDX-License-Identifier: MIT
#include "ins_dds/outbox.h"
#include "dds_internal.h"
#include "ring.h"
#include <errno.h>
#include <inttypes.h>
#include <semaphore.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define SECOND_NS 1000000000

struct ins_dds_outbox_t
{
    ins_dds_t* dds;
    ins_ros_t* ros;
    char source[INS_DDS_SOURCE_MAX + 1];
    dds_ring_t ring;
    sem_t filled; ///< a post for each item, and one that no item belongs to means closed
    pthread_t thread;
    atomic_int closed;
    atomic_ullong published, refused, dropped;
    // Of the thread.
    ins_dds_status_t status; ///< as put last
    int has_status;
    ins_dds_status_t told;
    int64_t told_ns; ///< when
    int64_t came_ns; ///< of the last message
};

static int64_t clock_ns(clockid_t which)
{
    struct timespec now;
    (void)clock_gettime(which, &now);
    return (int64_t)now.tv_sec * SECOND_NS + now.tv_nsec;
}

static void diagnose(ins_dds_outbox_t* self, const ins_dds_status_t* status)
{
    const struct
    {
        const char* key;
        uint64_t count;
    } all[] = {{"accepted", status->counts.accepted}, {"lost", status->counts.lost},
               {"invalid", status->counts.invalid},   {"duplicates", status->counts.duplicates},
               {"corrupt", status->counts.corrupt},   {"timeouts", status->counts.timeouts},
               {"stray", status->counts.stray},       {"refused", status->position_refused + status->velocity_refused},
               {"dropped", status->dropped}};
    enum
    {
        COUNTS = sizeof all / sizeof all[0],
        DIGITS = 24
    };
    ins_ros_value_t values[COUNTS];
    char text[COUNTS][DIGITS];
    for (int i = 0; i < COUNTS; i++)
    {
        (void)snprintf(text[i], DIGITS, "%" PRIu64, all[i].count);
        values[i] = (ins_ros_value_t){all[i].key, text[i]};
    }
    const char* told = "samples arrive";
    told = (status->alerts & INS_DDS_ALERT_DROPPED) != 0 ? "messages are dropped" : told;
    told = (status->alerts & INS_DDS_ALERT_REFUSED) != 0 ? "the last fix was refused" : told;
    told = (status->alerts & INS_DDS_ALERT_LOST) != 0 ? "samples are lost on the link" : told;
    told = (status->alerts & INS_DDS_ALERT_SILENT) != 0 ? "no samples arrive" : told;
    const int level = status->alerts == 0                            ? INS_ROS_LEVEL_OK
                      : (status->alerts & INS_DDS_ALERT_SILENT) != 0 ? INS_ROS_LEVEL_STALE
                                                                     : INS_ROS_LEVEL_WARN;
    (void)ins_ros_diagnose(self->ros, clock_ns(CLOCK_REALTIME), level, told, values, COUNTS);
}

/// 1: published, or not carried.
static int carried_out(const ins_dds_outbox_t* self, ins_dds_kind_t kind, const ins_dds_message_t* m, int64_t now_ns)
{
    if (self->dds == NULL || self->dds->topic[kind].writer <= 0)
    {
        return 1;
    }
    switch (kind)
    {
    case INS_DDS_STATE:
        return ins_dds_publish_navigation(self->dds, &m->is.instant.state, &m->is.instant.navigation, self->source,
                                          now_ns) == INS_DDS_OK;
    case INS_DDS_SOLUTION:
        return ins_dds_publish_solution(self->dds, &m->is.solution, self->source, now_ns) == INS_DDS_OK;
    case INS_DDS_STATUS:
        return ins_dds_publish_status(self->dds, &m->is.status, self->source, now_ns) == INS_DDS_OK;
    case INS_DDS_INNOVATIONS:
        return ins_dds_publish_innovations(self->dds, &m->is.innovations, self->source, now_ns) == INS_DDS_OK;
    case INS_DDS_RAW_IMU:
        return ins_dds_publish_raw_imu(self->dds, &m->is.raw_imu, self->source, now_ns) == INS_DDS_OK;
    case INS_DDS_STATE_DECIMATED:
    case INS_DDS_KINDS:
        break;
    }
    return 0;
}

/// Tells it when it brings a mode or an alert that is new, or the last was a second ago.
static void tell_status(ins_dds_outbox_t* self)
{
    const int64_t now_ns = clock_ns(CLOCK_MONOTONIC);
    const int first = self->told_ns == 0;
    ins_dds_message_t message = {.kind = INS_DDS_STATUS, .is.status = self->status};
    ins_dds_status_t* const status = &message.is.status;
    status->published = atomic_load(&self->published);
    status->dropped = atomic_load(&self->dropped);
    status->alerts |= now_ns - self->came_ns >= SECOND_NS ? INS_DDS_ALERT_SILENT : 0u;
    status->alerts |= status->counts.lost > self->told.counts.lost ? INS_DDS_ALERT_LOST : 0u;
    status->alerts |= status->dropped > self->told.dropped ? INS_DDS_ALERT_DROPPED : 0u;
    if (!first && status->mode == self->told.mode && (status->alerts & ~self->told.alerts) == 0 &&
        now_ns - self->told_ns < SECOND_NS)
    {
        return;
    }
    const int refused = !carried_out(self, INS_DDS_STATUS, &message, clock_ns(CLOCK_REALTIME));
    (void)atomic_fetch_add(&self->refused, (unsigned)refused);
    if (self->ros != NULL)
    {
        diagnose(self, status);
    }
    self->told = *status;
    self->told_ns = now_ns;
}

static void publish(ins_dds_outbox_t* self, const ins_dds_message_t* message)
{
    self->came_ns = clock_ns(CLOCK_MONOTONIC);
    if (message->kind == INS_DDS_STATUS)
    {
        self->status = message->is.status;
        self->has_status = 1;
        tell_status(self);
        return;
    }
    int done = carried_out(self, message->kind, message, clock_ns(CLOCK_REALTIME));
    if (message->kind == INS_DDS_STATE && self->ros != NULL)
    {
        done = ins_ros_publish(self->ros, &message->is.instant.navigation) == INS_DDS_OK && done;
    }
    (void)atomic_fetch_add(&self->published, (unsigned)(done && message->kind == INS_DDS_STATE));
    (void)atomic_fetch_add(&self->refused, (unsigned)!done);
}

/// Waits for a post, at most a second.
static void await(ins_dds_outbox_t* self)
{
    struct timespec until;
    (void)clock_gettime(CLOCK_REALTIME, &until);
    until.tv_sec++;
    while (sem_timedwait(&self->filled, &until) != 0 && errno == EINTR)
    {
    }
}

static void* run(void* argument)
{
    ins_dds_outbox_t* const self = argument;
    ins_dds_message_t message;
    for (;;)
    {
        await(self);
        if (dds_ring_get(&self->ring, &message))
        {
            publish(self, &message);
        }
        else if (atomic_load(&self->closed))
        {
            return NULL;
        }
        else if (self->has_status)
        {
            tell_status(self);
        }
    }
}

int ins_dds_outbox_open(ins_dds_t* dds, ins_ros_t* ros, const char* source, uint32_t size, ins_dds_outbox_t** out)
{
    *out = NULL;
    const size_t length = strlen(source);
    if (length < 1 || length > INS_DDS_SOURCE_MAX || size < 1 || size > INS_DDS_OUTBOX_MAX)
    {
        return dds_fail(INS_DDS_E_ARGUMENT,
                        "an outbox has a source id of 1 to %d octets, here %zu, and room for 1 to %u messages, here %u",
                        INS_DDS_SOURCE_MAX, length, INS_DDS_OUTBOX_MAX, (unsigned)size);
    }
    ins_dds_outbox_t* self = calloc(1, sizeof *self);
    if (self == NULL || dds_ring_init(&self->ring, sizeof(ins_dds_message_t), size) != 0)
    {
        free(self);
        return dds_fail(INS_DDS_E_DDS, "memory is out");
    }
    memcpy(self->source, source, length);
    self->dds = dds;
    self->ros = ros;
    (void)sem_init(&self->filled, 0, 0);
    if (pthread_create(&self->thread, NULL, run, self) != 0)
    {
        (void)sem_destroy(&self->filled);
        dds_ring_free(&self->ring);
        free(self);
        return dds_fail(INS_DDS_E_DDS, "the outbox's thread could not be started");
    }
    *out = self;
    return INS_DDS_OK;
}

int ins_dds_outbox_put(ins_dds_outbox_t* self, const ins_dds_message_t* message)
{
    if (!dds_ring_put(&self->ring, message))
    {
        (void)atomic_fetch_add_explicit(&self->dropped, 1u, memory_order_relaxed);
        return 0;
    }
    (void)sem_post(&self->filled);
    return 1;
}

void ins_dds_outbox_counts(ins_dds_outbox_t* self, ins_dds_outbox_counts_t* out)
{
    out->published = atomic_load(&self->published);
    out->refused = atomic_load(&self->refused);
    out->dropped = atomic_load(&self->dropped);
}

void ins_dds_outbox_close(ins_dds_outbox_t* self, ins_dds_outbox_counts_t* counts)
{
    if (self == NULL)
    {
        return;
    }
    atomic_store(&self->closed, 1);
    (void)sem_post(&self->filled);
    (void)pthread_join(self->thread, NULL);
    if (counts != NULL)
    {
        ins_dds_outbox_counts(self, counts);
    }
    (void)sem_destroy(&self->filled);
    dds_ring_free(&self->ring);
    free(self);
}
