/// \file   dds_internal.h
/// \brief  Shared by the sources of libins_dds.
/// SPDX-License-Identifier: MIT
#ifndef INS_DDS_INTERNAL_H_INCLUDED
#define INS_DDS_INTERNAL_H_INCLUDED
#include "dds/dds.h"
#include "dds/ddsrt/log.h"
#include "ins_dds/dds.h"
#include "libins.h"
#include <pthread.h>

#define TAKE_MAX 16 ///< samples taken from Cyclone at once

typedef struct dds_log_t
{
    pthread_mutex_t mutex;
    int collect;
    char text[768]; ///< lines collected, "; " between them
    void (*log)(void* context, const char* line);
    void* log_context;
} dds_log_t;

/// The part of a DDS domain that a handle owns. Zeros before dds_place_open().
typedef struct dds_place_t
{
    dds_entity_t domain; ///< 0 = not ours
    dds_entity_t participant;
    int opened;
    dds_log_t log;
} dds_place_t;

struct ins_dds_t
{
    dds_place_t place;
    dds_entity_t topic;
    dds_entity_t writer;
    dds_entity_t reader;
    dds_entity_t waitset;
    int kind; ///< INS_DDS_STATE or INS_DDS_SOLUTION
    union
    {
        libins_NavState state[TAKE_MAX];
        libins_NavSolution solution[TAKE_MAX];
    } taken;
};

/// Sets the thread's error text. \return status
int dds_fail(int status, const char* format, ...);
void dds_log_line(void* context, const dds_log_data_t* data);
/// What the configuration says beyond kind and topics. After a refusal the place is still to be closed.
/// \param[in] user  USER_DATA of the participant, NULL: none.
int dds_place_open(dds_place_t* self, const ins_dds_config_t* cfg, const char* user);
/// All entities are there: Cyclone's log goes where the configuration says from now on.
void dds_place_ready(dds_place_t* self);
void dds_place_close(dds_place_t* self);
/// The error for an entity that Cyclone did not make. \return INS_DDS_E_DDS
int dds_refused(const dds_place_t* self, const char* what, dds_return_t code);
/// Reliability, history, durability, partition, and of a writer deadline and liveliness; to be freed.
dds_qos_t* dds_quality(const ins_dds_config_t* cfg, int is_writer);
dds_duration_t dds_duration(double seconds);
/// Into the participant's QoS. \return INS_DDS_OK; INS_DDS_E_ARGUMENT: a file is not named or cannot be read.
int dds_secure(const ins_dds_security_t* security, dds_qos_t* qos);

/// The two structs hold the same fields; source and published_ns are the caller's.
void dds_from_state(const ins_nav_state_t* from, libins_NavState* message);
void dds_from_solution(const ins_nav_solution_t* from, libins_NavSolution* message);
/// Message `at` of those taken; the contents only if the sample is valid.
void dds_to_sample(const ins_dds_t* self, int at, ins_dds_sample_t* sample);

#endif // INS_DDS_INTERNAL_H_INCLUDED
