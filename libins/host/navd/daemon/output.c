/// \file   output.c
/// \brief  JSON lines of states and events.
/// SPDX-License-Identifier: MIT
#include "output.h"
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define WAIT_MS 100

int output_open(output_t* self, const options_t* options, char* error, size_t size)
{
    memset(self, 0, sizeof *self);
    self->fd = -1;
    self->name = options->json;
    if (options->json != NULL)
    {
        self->fd = strcmp(options->json, "-") == 0
                       ? dup(STDOUT_FILENO)
                       : open(options->json, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        if (self->fd < 0)
        {
            (void)snprintf(error, size, "cannot write %s: %s", options->json, strerror(errno));
            return -1;
        }
    }
    if (options->dds || options->ros != NULL)
    {
        self->publisher = publisher_open(options, error, size);
        if (self->publisher == NULL)
        {
            output_close(self);
            return -1;
        }
    }
    return 0;
}

/// A pipe that is ready takes a line whole (shorter than PIPE_BUF), so this blocks in poll only.
static int write_line(output_t* self, const char* line, size_t length, const atomic_int* stop)
{
    size_t done = 0;
    while (done < length)
    {
        struct pollfd p = {self->fd, POLLOUT, 0};
        const int ready = poll(&p, 1, WAIT_MS);
        if (ready == 0 && atomic_load(stop))
        {
            self->unwritten++;
            return 0;
        }
        if (ready <= 0)
        {
            continue;
        }
        const ssize_t n = write(self->fd, line + done, length - done);
        if (n < 0 && errno != EINTR && errno != EAGAIN)
        {
            return -1;
        }
        done += n > 0 ? (size_t)n : 0u;
    }
    return 0;
}

static int finish(output_t* self, const char* line, size_t length, const atomic_int* stop, char* error, size_t size)
{
    if (self->fd >= 0 && write_line(self, line, length, stop) != 0)
    {
        (void)snprintf(error, size, "cannot write %s: %s", self->name, strerror(errno));
        return -1;
    }
    return 0;
}

int output_state(output_t* self, const ins_nav_state_t* state, const ins_navigation_t* navigation,
                 const atomic_int* stop, char* error, size_t size)
{
    char line[INS_NAV_JSON_MAX];
    if (self->publisher != NULL)
    {
        publisher_put(self->publisher, state, navigation);
    }
    const size_t length = self->fd >= 0 ? ins_nav_state_json(state, line, sizeof line) : 0;
    return finish(self, line, length, stop, error, size);
}

int output_six(output_t* self, const ins_nav_six_state_t* state, const ins_navigation_t* navigation,
               const atomic_int* stop, char* error, size_t size)
{
    char line[INS_NAV_SIX_JSON_MAX];
    if (self->publisher != NULL)
    {
        publisher_put(self->publisher, &state->nav, navigation);
    }
    const size_t length = self->fd >= 0 ? ins_nav_six_json(state, line, sizeof line) : 0;
    return finish(self, line, length, stop, error, size);
}

int output_solution(output_t* self, const ins_nav_solution_t* solution, const ins_navigation_t* navigation,
                    const atomic_int* stop, char* error, size_t size)
{
    char line[INS_NAV_JSON_MAX];
    if (self->publisher != NULL)
    {
        publisher_put_solution(self->publisher, solution, navigation);
    }
    const size_t length = self->fd >= 0 ? ins_nav_solution_json(solution, line, sizeof line) : 0;
    return finish(self, line, length, stop, error, size);
}

void output_sample(output_t* self, const ins_nav_sample_t* sample, const ins_nav_config_t* nav, int64_t time_ns)
{
    if (self->publisher != NULL)
    {
        publisher_put_sample(self->publisher, sample, nav, time_ns);
    }
}

int64_t wall_ns(uint64_t monotonic_ns)
{
    struct timespec wall;
    struct timespec now;
    (void)clock_gettime(CLOCK_REALTIME, &wall);
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)(wall.tv_sec - now.tv_sec) * 1000000000 + (wall.tv_nsec - now.tv_nsec) + (int64_t)monotonic_ns;
}

void output_close(output_t* self)
{
    self->counts = publisher_close(self->publisher);
    self->publisher = NULL;
    if (self->fd >= 0)
    {
        (void)close(self->fd);
        self->fd = -1;
    }
}

void event(const options_t* options, const char* name, const char* format, ...)
{
    if (options->quiet)
    {
        return;
    }
    char rest[1024];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(rest, sizeof rest, format, arguments);
    va_end(arguments);
    (void)fprintf(stderr, "{\"event\":\"%s\"%s}\n", name, rest);
}

const char* quoted(const char* text, char* buffer, size_t size)
{
    size_t n = 0;
    for (; *text != '\0' && n + 3 < size; text++)
    {
        const char c = *text;
        if (c == '"' || c == '\\')
        {
            buffer[n++] = '\\';
        }
        buffer[n++] = (unsigned char)c < 0x20u ? '?' : c;
    }
    buffer[n] = '\0';
    return buffer;
}
