/// \file   options.h
/// \brief  The command line of ins-navd.
/// SPDX-License-Identifier: MIT
#ifndef NAVD_OPTIONS_H_INCLUDED
#define NAVD_OPTIONS_H_INCLUDED
#include "ins_nav/nav.h"
#include "ins_nav/nav_input.h"
#include "ins_nav/six.h"

/// What the board's blocks hold.
typedef enum input_t
{
    INPUT_CODES, ///< codes of three gyros: the daemon navigates
    INPUT_NAV,   ///< ins/nav_block.h: the board has navigated
    INPUT_SIX,   ///< codes of six accelerometers: the daemon navigates
    INPUT_COUNT
} input_t;

#define QOS_MAX 8u

typedef struct options_t
{
    input_t input;
    const char* not_for[INPUT_COUNT]; ///< name of an option given that this input does not have; NULL = none
    const char* only_six;             ///< of one that only INPUT_SIX has
    const char* delays;               ///< as given; NULL = 0
    ins_nav_config_t nav;             ///< octet_timeout_ms is for all
    ins_nav_six_config_t six;         ///< INPUT_SIX
    unsigned accels_given;            ///< bit k: accelerometer k
    const char* device;
    long baud;
    int wait; ///< a device that is missing at the start is waited for
    uint32_t queue;
    const char* json; ///< file, "-" = standard output, NULL = none
    int dds;          ///< 1: publish
    uint32_t domain;
    const char* dds_config;    ///< XML file, NULL = loopback
    int dds_environment;       ///< 1: configuration from CYCLONEDDS_URI
    const char* dds_interface; ///< NULL = loopback
    const char* dds_peers;     ///< on dds_interface, commas between; NULL = multicast
    const char* topic;         ///< NULL = the default
    const char* partition;
    int32_t strength;         ///< of exclusive ownership, 0 = shared
    double lease_s;           ///< of liveliness, 0 = the default
    const char* security;     ///< folder, NULL = none
    const char* qos[QOS_MAX]; ///< TOPIC=PROFILE each
    unsigned qos_count;
    uint32_t decimate; ///< one state in so many on a topic of its own too, 0 = none
    const char* source;
    const char* ros;  ///< ROS 2 namespace to publish in, NULL = none
    uint64_t limit;   ///< states, 0 = none
    double timeout_s; ///< 0 = none
    int quiet;
} options_t;

/// \return NULL, or what is wrong with the choice of network.
static inline const char* options_network_problem(const options_t* o)
{
    if ((o->dds_config != NULL) + o->dds_environment + (o->dds_interface != NULL) > 1)
    {
        return "--dds-config, --dds-env and --dds-interface exclude each other";
    }
    return o->dds_peers != NULL && o->dds_interface == NULL ? "--dds-peer wants --dds-interface" : NULL;
}

/// \return -1 to go on, else the exit code: 0 after --help or --version, 2 after a message about what is wrong.
int options_parse(int argc, char** argv, options_t* options);

#endif // NAVD_OPTIONS_H_INCLUDED
