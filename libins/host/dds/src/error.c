/// \file   error.c
/// \brief  The text of the last error of a thread, and Cyclone's log, which tells the reason that its return codes hide.
/// SPDX-License-Identifier: MIT
#include "dds_internal.h"
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static _Thread_local char last_error[1024];

const char* ins_dds_error_text(void)
{
    return last_error;
}

int dds_fail(int status, const char* format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(last_error, sizeof last_error, format, arguments);
    va_end(arguments);
    return status;
}

/// Cyclone's log sink: line ends cut off, kept while `collect` is set, passed on otherwise.
void dds_log_line(void* context, const dds_log_data_t* data)
{
    dds_log_t* self = context;
    char line[512];
    (void)snprintf(line, sizeof line, "%.*s", (int)data->size, data->message);
    line[strcspn(line, "\r\n")] = '\0';
    (void)pthread_mutex_lock(&self->mutex);
    if (self->collect)
    {
        const size_t used = strlen(self->text);
        (void)snprintf(self->text + used, sizeof self->text - used, "%s%s", used > 0 ? "; " : "", line);
    }
    else if (self->log != NULL)
    {
        self->log(self->log_context, line);
    }
    (void)pthread_mutex_unlock(&self->mutex);
}
