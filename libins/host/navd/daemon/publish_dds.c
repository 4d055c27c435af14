/// \file   publish_dds.c
/// \brief  States to DDS (ins_dds/dds.h) and to ROS 2 topics on it (ins_dds/ros.h).
/// SPDX-License-Identifier: MIT
#include "ins_dds/dds.h"
#include "ins_dds/ros.h"
#include "output.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define CONFIG_MAX 65536

#define DIAGNOSE_NS 1000000000 ///< between two lines of /diagnostics

struct publisher_t
{
    ins_dds_t* dds; ///< NULL = no states
    ins_ros_t* ros; ///< NULL = no ROS topics
    const char* source;
    int64_t diagnosed_ns;
    uint64_t lost; ///< as last diagnosed
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
    cfg.topic[kind].name = options->topic != NULL ? options->topic : cfg.topic[kind].name;
    cfg.partition = options->partition;
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
    publisher_t* self = calloc(1, sizeof *self);
    if (self == NULL || status != INS_DDS_OK || !open_both(self, options, &cfg))
    {
        (void)snprintf(error, size, "%s%s%s", options->dds_config != NULL ? options->dds_config : "",
                       options->dds_config != NULL ? ": " : "", self == NULL ? "memory is out" : ins_dds_error_text());
        publisher_close(self);
        self = NULL;
    }
    else
    {
        self->source = options->source;
    }
    free(text);
    return self;
}

static int64_t wall_ns(void)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_REALTIME, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

/// Once a second, how the link does.
static void diagnose(publisher_t* self, const ins_nav_counts_t* counts, int64_t now_ns)
{
    if (now_ns - self->diagnosed_ns < DIAGNOSE_NS)
    {
        return;
    }
    const struct
    {
        const char* key;
        uint64_t count;
    } all[] = {{"accepted", counts->accepted}, {"lost", counts->lost},
               {"invalid", counts->invalid},   {"duplicates", counts->duplicates},
               {"corrupt", counts->corrupt},   {"timeouts", counts->timeouts},
               {"stray", counts->stray}};
    enum
    {
        COUNTS = sizeof all / sizeof all[0],
        DIGITS = 24
    };
    ins_ros_value_t values[COUNTS];
    char text[COUNTS][DIGITS];
    for (int i = 0; i < COUNTS; i++)
    {
        (void)snprintf(text[i], DIGITS, "%llu", (unsigned long long)all[i].count);
        values[i] = (ins_ros_value_t){all[i].key, text[i]};
    }
    const int loses = counts->lost > self->lost;
    (void)ins_ros_diagnose(self->ros, now_ns, loses ? INS_ROS_LEVEL_WARN : INS_ROS_LEVEL_OK,
                           loses ? "samples are lost on the link" : "samples arrive", values, COUNTS);
    self->lost = counts->lost;
    self->diagnosed_ns = now_ns;
}

static int put_ros(publisher_t* self, const ins_navigation_t* navigation, const ins_nav_counts_t* counts)
{
    diagnose(self, counts, navigation->time_ns);
    return ins_ros_publish(self->ros, navigation) == INS_DDS_OK;
}

int publisher_put(publisher_t* self, const ins_nav_state_t* state, const ins_navigation_t* navigation)
{
    const int64_t now_ns = wall_ns();
    ins_navigation_t own;
    ins_navigation_from_state(state, now_ns, &own);
    const ins_navigation_t* const tell = navigation != NULL ? navigation : &own;
    const int states =
        self->dds == NULL || ins_dds_publish_navigation(self->dds, state, tell, self->source, now_ns) == INS_DDS_OK;
    return (self->ros == NULL || put_ros(self, tell, &state->counts)) && states;
}

int publisher_put_solution(publisher_t* self, const ins_nav_solution_t* solution, const ins_navigation_t* navigation)
{
    const int64_t now_ns = wall_ns();
    ins_navigation_t own;
    ins_nav_state_t state;
    ins_navigation_from_solution(solution, now_ns, &own);
    ins_nav_state_from_solution(solution, &state);
    const int solutions =
        self->dds == NULL || ins_dds_publish_solution(self->dds, solution, self->source, now_ns) == INS_DDS_OK;
    return publisher_put(self, &state, navigation != NULL ? navigation : &own) && solutions;
}

void publisher_close(publisher_t* self)
{
    if (self != NULL)
    {
        ins_ros_close(self->ros); // it may be in the domain that the states' handle owns
        ins_dds_close(self->dds);
        free(self);
    }
}
