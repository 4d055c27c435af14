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
    libins_NavState taken[TAKE_MAX];
};

/// Sets the thread's error text. \return status
int dds_fail(int status, const char* format, ...);
void dds_log_line(void* context, const dds_log_data_t* data);

/// The two structs hold the same fields; source and published_ns are the caller's.
void dds_from_state(const ins_nav_state_t* state, libins_NavState* message);
void dds_to_state(const libins_NavState* message, ins_nav_state_t* state);

#endif // INS_DDS_INTERNAL_H_INCLUDED
