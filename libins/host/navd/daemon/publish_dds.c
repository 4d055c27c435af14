/// \file   publish_dds.c
/// \brief  States to DDS (ins_dds/dds.h) and to ROS 2 topics on it (ins_dds/ros.h).
/// SPDX-License-Identifier: MIT
#include "ins_dds/dds.h"
#include "ins_dds/outbox.h"
#include "output.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CONFIG_MAX 65536

#define FIX_AGE_NONE 25.5 ///< of a solution: that or longer, or none [s]
#define OUTBOX_SIZE  256  ///< messages that may wait for DDS

struct publisher_t
{
    ins_dds_t* dds; ///< NULL = no states
    ins_ros_t* ros; ///< NULL = no ROS topics
    ins_dds_outbox_t* outbox;
    uint64_t sample; ///< index of the last
};

static void log_line(void* context, const char* line)
{
    char text[512];
    event(context, "dds", ",\"text\":\"%s\"", quoted(line, text, sizeof text));
}

/// \return the file as text, to be freed; NULL with the reason in error.
static char* read_config(const char* path, char* error, size_t size)
{
    FILE* file = fopen(path, "r");
    char* text = file != NULL ? calloc(1, CONFIG_MAX) : NULL;
    if (text == NULL)
    {
        (void)snprintf(error, size, "cannot read %s: %s", path, strerror(errno));
    }
    else if (fread(text, 1, CONFIG_MAX, file) == CONFIG_MAX || ferror(file))
    {
        (void)snprintf(error, size, "cannot read %s: it must be a file of less than %d octets", path, CONFIG_MAX);
        free(text);
        text = NULL;
    }
    if (file != NULL)
    {
        (void)fclose(file);
    }
    return text;
}

/// \return 1; 0 with the reason in error.
static int open_both(publisher_t* self, const options_t* options, ins_dds_config_t* cfg)
{
    if (options->dds && ins_dds_open(cfg, &self->dds) != INS_DDS_OK)
    {
        return 0;
    }
    if (options->ros == NULL)
    {
        return 1;
    }
    ins_ros_config_t ros;
    const char* const domain = getenv("ROS_DOMAIN_ID");
    ins_ros_config_default(&ros);
    ros.node = "ins_navd";
    ros.name_space = options->ros;
    ros.dds.domain = options->dds && (domain == NULL || domain[0] == '\0') ? cfg->domain : ros.dds.domain;
    ros.dds.network = cfg->network;
    ros.dds.xml = cfg->xml;
    ros.dds.interface = cfg->interface;
    ros.dds.peers = cfg->peers;
    ros.dds.security = cfg->security;
    ros.dds.log = cfg->log;
    ros.dds.log_context = cfg->log_context;
    int status = ins_ros_open(&ros, &self->ros);
    if (status == INS_DDS_E_DOMAIN) // the states' own
    {
        ros.dds.network = INS_DDS_JOIN;
        status = ins_ros_open(&ros, &self->ros);
    }
    return status == INS_DDS_OK;
}

publisher_t* publisher_open(const options_t* options, char* error, size_t size)
{
    ins_dds_config_t cfg;
    ins_dds_config_default(&cfg);
    char* text = NULL;
    cfg.domain = options->domain;
    const ins_dds_kind_t kind = options->input == INPUT_NAV ? INS_DDS_SOLUTION : INS_DDS_STATE;
    ins_dds_config_carry(&cfg, kind);
    ins_dds_config_carry(&cfg, INS_DDS_STATUS);
    if (options->input == INPUT_CODES)
    {
        ins_dds_config_carry(&cfg, INS_DDS_RAW_IMU);
    }
    cfg.topic[kind].name = options->topic != NULL ? options->topic : cfg.topic[kind].name;
    cfg.partition = options->partition;
    if (options->decimate > 0)
    {
        ins_dds_config_carry(&cfg, INS_DDS_STATE_DECIMATED);
        cfg.topic[INS_DDS_STATE_DECIMATED].decimate = options->decimate;
    }
    cfg.strength = options->strength;
    cfg.lease_s = options->lease_s > 0.0 ? options->lease_s : cfg.lease_s;
    cfg.network = options->dds_environment         ? INS_DDS_ENVIRONMENT
                  : options->dds_interface != NULL ? INS_DDS_INTERFACE
                                                   : INS_DDS_LOOPBACK;
    cfg.interface = options->dds_interface;
    cfg.peers = options->dds_peers;
    cfg.log = log_line;
    cfg.log_context = (void*)(uintptr_t)options; // only read
    if (options->dds_config != NULL)
    {
        text = read_config(options->dds_config, error, size);
        if (text == NULL)
        {
            return NULL;
        }
        cfg.network = INS_DDS_XML;
        cfg.xml = text;
    }
    char paths[INS_DDS_SECURITY_MEMORY];
    ins_dds_security_t security;
    int status = INS_DDS_OK;
    if (options->security != NULL)
    {
        status = ins_dds_security_folder(options->security, &security, paths);
        cfg.security = &security;
    }
    for (unsigned i = 0; i < options->qos_count && status == INS_DDS_OK; i++)
    {
        status = ins_dds_config_qos(&cfg, options->qos[i]);
    }
    publisher_t* self = calloc(1, sizeof *self);
    if (self == NULL || status != INS_DDS_OK || !open_both(self, options, &cfg) ||
        ins_dds_outbox_open(self->dds, self->ros, options->source, OUTBOX_SIZE, &self->outbox) != INS_DDS_OK)
    {
        (void)snprintf(error, size, "%s%s%s", options->dds_config != NULL ? options->dds_config : "",
                       options->dds_config != NULL ? ": " : "", self == NULL ? "memory is out" : ins_dds_error_text());
        publisher_close(self);
        self = NULL;
    }
    free(text);
    return self;
}

static void put_status(publisher_t* self, ins_dds_status_t* status, uint32_t alerts, const ins_nav_counts_t* counts)
{
    ins_dds_message_t message = {.kind = INS_DDS_STATUS};
    status->alerts = alerts;
    status->counts = *counts;
    message.is.status = *status;
    (void)ins_dds_outbox_put(self->outbox, &message);
}

static int put_instant(publisher_t* self, const ins_nav_state_t* state, const ins_navigation_t* navigation)
{
    ins_dds_message_t message = {.kind = INS_DDS_STATE};
    message.is.instant.state = *state;
    message.is.instant.navigation = *navigation;
    return ins_dds_outbox_put(self->outbox, &message);
}

void publisher_put(publisher_t* self, const ins_nav_state_t* state, const ins_navigation_t* navigation)
{
    ins_dds_status_t status;
    (void)put_instant(self, state, navigation);
    ins_dds_status_from_navigation(navigation, &status);
    put_status(self, &status,
               ((state->status & INS_NAV_CLIPPED) != 0 ? (uint32_t)INS_DDS_ALERT_CLIPPED : 0u) |
                   ((state->status & INS_NAV_DISAGREE) != 0 ? (uint32_t)INS_DDS_ALERT_DISAGREE : 0u),
               &state->counts);
}

void publisher_put_solution(publisher_t* self, const ins_nav_solution_t* solution, const ins_navigation_t* navigation)
{
    ins_dds_message_t message = {.kind = INS_DDS_SOLUTION};
    ins_nav_state_t state;
    ins_dds_status_t status;
    message.is.solution = *solution;
    (void)ins_dds_outbox_put(self->outbox, &message);
    ins_nav_state_from_solution(solution, &state);
    (void)put_instant(self, &state, navigation);
    ins_dds_status_from_navigation(navigation, &status);
    if (status.mode == INS_DDS_MODE_AIDED && (solution->status & INS_NAV_BLOCK_FILTER) == 0)
    {
        status.mode = INS_DDS_MODE_DEAD_RECKONING;
    }
    status.fix_age_s = solution->fix_age_s < FIX_AGE_NONE ? solution->fix_age_s : (double)NAN;
    status.sats = solution->sats;
    put_status(self, &status, (solution->status & INS_NAV_BLOCK_GATED) != 0 ? INS_DDS_ALERT_REFUSED : 0,
               &solution->counts);
}

void publisher_put_sample(publisher_t* self, const ins_nav_sample_t* sample, const ins_nav_config_t* nav,
                          int64_t time_ns)
{
    ins_dds_message_t message = {.kind = INS_DDS_RAW_IMU};
    ins_dds_raw_imu_t* const raw = &message.is.raw_imu;
    if (nav->channels != 3)
    {
        return; // six accelerometers are no IMU
    }
    raw->time_ns = time_ns;
    raw->index = sample->index;
    raw->t_s = (double)sample->index * nav->period_s;
    raw->dt_s = (double)(sample->index - self->sample) * nav->period_s;
    for (int i = 0; i < 3; i++)
    {
        raw->gyro_b[i] = (sample->code[i] - nav->null_code[i]) * nav->lsb_rad_s[i];
        raw->accel_b[i] = (double)NAN;
    }
    raw->temperature_k = (double)NAN;
    self->sample = sample->index;
    (void)ins_dds_outbox_put(self->outbox, &message);
}

publisher_counts_t publisher_close(publisher_t* self)
{
    publisher_counts_t counts = {0, 0, 0};
    if (self != NULL)
    {
        ins_dds_outbox_counts_t all = {0, 0, 0};
        ins_dds_outbox_close(self->outbox, &all);
        ins_ros_close(self->ros); // it may be in the domain that the states' handle owns
        ins_dds_close(self->dds);
        free(self);
        counts = (publisher_counts_t){all.published, all.refused, all.dropped};
    }
    return counts;
}
