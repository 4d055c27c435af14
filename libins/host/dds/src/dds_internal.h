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

#define TAKE_MAX     16 ///< samples taken from Cyclone at once
#define DDS_TRIANGLE (INS_NAVIGATION_P * (INS_NAVIGATION_P + 1) / 2)

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
    dds_entity_t waitset;
    struct
    {
        dds_entity_t writer; ///< 0: none
        dds_entity_t reader; ///< 0: none
        uint32_t decimate;
        uint64_t seen; ///< messages that the topic could have carried
    } topic[INS_DDS_KINDS];
    int turn; ///< kind that is looked at first
    union
    {
        libins_NavState state[TAKE_MAX];
        libins_NavSolution solution[TAKE_MAX];
        libins_Status status[TAKE_MAX];
        libins_Innovations innovations[TAKE_MAX];
        libins_RawImu raw_imu[TAKE_MAX];
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
/// Reliability, history, durability, partition, and of a writer deadline, lifespan and liveliness; to be freed.
dds_qos_t* dds_quality(const ins_dds_config_t* cfg, const ins_dds_qos_t* want, int is_writer);
/// \return INS_DDS_OK; INS_DDS_E_ARGUMENT for what a topic may not be.
int dds_check_topic(const ins_dds_topic_config_t* topic, const char* usual);
dds_duration_t dds_duration(double seconds);
/// Into the participant's QoS. \return INS_DDS_OK; INS_DDS_E_ARGUMENT: a file is not named or cannot be read.
int dds_secure(const ins_dds_security_t* security, dds_qos_t* qos);

// Both sides hold the same fields; source and published_ns are the caller's.
void dds_from_state(const ins_nav_state_t* from, const ins_navigation_t* navigation, libins_NavState* message);
void dds_from_solution(const ins_nav_solution_t* from, libins_NavSolution* message);
void dds_from_status(const ins_dds_status_t* from, libins_Status* message);
void dds_from_innovations(const ins_dds_innovations_t* from, libins_Innovations* message);
void dds_from_raw_imu(const ins_dds_raw_imu_t* from, libins_RawImu* message);
/// Message `at` of those taken of sample->kind; the contents only if the sample is valid.
void dds_to_sample(const ins_dds_t* self, int at, ins_dds_sample_t* sample);
/// \param[in] P  [INS_NAVIGATION_P^2]. \param[out] triangle  [DDS_TRIANGLE], the upper one, row by row.
void dds_triangle(const double* P, double* triangle);

#endif // INS_DDS_INTERNAL_H_INCLUDED
