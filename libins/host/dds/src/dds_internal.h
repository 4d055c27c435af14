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

struct ins_dds_t
{
    dds_entity_t domain; ///< 0 = not ours
    dds_entity_t participant;
    dds_entity_t topic;
    dds_entity_t writer;
    dds_entity_t reader;
    dds_entity_t waitset;
    dds_log_t log;
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

/// The two structs hold the same fields; source and published_ns are the caller's.
void dds_from_state(const ins_nav_state_t* from, libins_NavState* message);
void dds_from_solution(const ins_nav_solution_t* from, libins_NavSolution* message);
/// Message `at` of those taken; the contents only if the sample is valid.
void dds_to_sample(const ins_dds_t* self, int at, ins_dds_sample_t* sample);

#endif // INS_DDS_INTERNAL_H_INCLUDED
