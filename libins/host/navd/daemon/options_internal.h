/// \file   options_internal.h
/// \brief  What the sources of ins-navd's command line share: codes of its options, and those about samples and their navigation.
/// SPDX-License-Identifier: MIT
#ifndef NAVD_OPTIONS_INTERNAL_H_INCLUDED
#define NAVD_OPTIONS_INTERNAL_H_INCLUDED
#include "options.h"

enum
{
    O_INPUT = 256,
    O_BLOCK_LEN,
    O_SEQ,
    O_NO_SEQ,
    O_OCTET_TIMEOUT,
    O_LSB,
    O_NULL,
    O_CODE_MAX,
    O_SKEW,
    O_SKEW_ORDER,
    O_FORM,
    O_RATE_ORDER,
    O_BRIDGE_MAX,
    O_ARM,
    O_ACCEL,
    O_LSB_FORCE,
    O_NOISE,
    O_BIAS,
    O_SIGMA_ATTITUDE,
    O_POSITION,
    O_STILL,
    O_DDS,
    O_DDS_CONFIG,
    O_DDS_ENV,
    O_DDS_INTERFACE,
    O_DDS_PEER,
    O_STRENGTH,
    O_LEASE,
    O_SECURITY,
    O_QOS,
    O_DECIMATE,
    O_ROS,
    O_TOPIC,
    O_PARTITION,
    O_SOURCE,
    O_QUEUE
};

/// Before any option is taken.
void sensor_default(options_t* options);
/// \param[in] name  of the option. \return 1; 0 after a message; -1: it is none of these.
int sensor_take(options_t* options, int code, const char* name, const char* text);
/// After the last one: what was not given. \return NULL, or what is wrong.
const char* sensor_finish(options_t* options);

#endif // NAVD_OPTIONS_INTERNAL_H_INCLUDED
