/// \file   publish_dds.c
/// \brief  States to DDS (ins_dds/dds.h).
/// SPDX-License-Identifier: MIT
#include "ins_dds/dds.h"
#include "output.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define CONFIG_MAX 65536

struct publisher_t
{
    ins_dds_t* dds;
    const char* source;
    const options_t* options;
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

publisher_t* publisher_open(const options_t* options, char* error, size_t size)
{
    ins_dds_config_t cfg;
    ins_dds_config_default(&cfg);
    char* text = NULL;
    cfg.domain = options->domain;
    cfg.kind = options->input == INPUT_NAV ? INS_DDS_SOLUTION : INS_DDS_STATE;
    cfg.topic = options->topic;
    cfg.partition = options->partition;
    cfg.network = options->dds_environment ? INS_DDS_ENVIRONMENT : INS_DDS_LOOPBACK;
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
    publisher_t* self = calloc(1, sizeof *self);
    if (self == NULL || ins_dds_open(&cfg, &self->dds) != INS_DDS_OK)
    {
        (void)snprintf(error, size, "%s%s%s", options->dds_config != NULL ? options->dds_config : "",
                       options->dds_config != NULL ? ": " : "", self == NULL ? "memory is out" : ins_dds_error_text());
        free(self);
        self = NULL;
    }
    else
    {
        self->source = options->source;
        self->options = options;
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

int publisher_put(publisher_t* self, const ins_nav_state_t* state)
{
    return ins_dds_publish(self->dds, state, self->source, wall_ns()) == INS_DDS_OK;
}

int publisher_put_solution(publisher_t* self, const ins_nav_solution_t* solution)
{
    return ins_dds_publish_solution(self->dds, solution, self->source, wall_ns()) == INS_DDS_OK;
}

void publisher_close(publisher_t* self)
{
    if (self != NULL)
    {
        ins_dds_close(self->dds);
        free(self);
    }
}
