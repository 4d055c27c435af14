/// \file   receive.c
/// \brief  The receiving thread. It answers the board at once and never waits for the computing thread.
/// SPDX-License-Identifier: MIT
#include "receive.h"
#include "output.h"
#include "port.h"
#include <errno.h>
#include <poll.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define TICK_MAX_MS    10 ///< longest wait for an octet before the time-outs are looked at
#define BACKOFF_MIN_MS 50 ///< first pause before a lost device is tried again; doubled each time
#define BACKOFF_MAX_MS 1000
#define SILENT_OCTETS  64          ///< so many octets and
#define SILENT_NS      2000000000u ///< so long without a sample make a hint about the settings

/// What concerns only the thread itself.
typedef struct local_t
{
    uint64_t last_sample_ns; ///< or the start
    uint64_t unplugged_ns;
    uint64_t octets_since; ///< octets since the last sample
    int hinted;
    char error[512];
    char text[600];
} local_t;

uint64_t now_ns(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000000u + (uint64_t)t.tv_nsec;
}

const ins_nav_counts_t* receiver_counts(const receiver_t* self)
{
    return self->options->input == INPUT_NAV ? &self->input.counts : &self->link.counts;
}

/// \return 1: *item holds what came.
static int link_octet(receiver_t* self, uint8_t octet, uint64_t now_ms, int* reply, queue_item_t* item)
{
    return self->options->input == INPUT_NAV
               ? ins_nav_input_octet(&self->input, octet, now_ms, reply, &item->is.solution)
               : ins_nav_link_octet(&self->link, octet, now_ms, reply, &item->is.sample);
}

static void link_tick(receiver_t* self, uint64_t now_ms)
{
    if (self->options->input == INPUT_NAV)
    {
        ins_nav_input_tick(&self->input, now_ms);
    }
    else
    {
        ins_nav_link_tick(&self->link, now_ms);
    }
}

static void unplugged(receiver_t* self, local_t* local, const char* reason)
{
    (void)close(self->fd);
    self->fd = -1;
    local->unplugged_ns = now_ns();
    event(self->options, "lost", ",\"device\":\"%s\",\"reason\":\"%s\"",
          quoted(self->options->device, local->text, sizeof local->text), reason);
}

static void reopen(receiver_t* self, local_t* local, int* backoff_ms)
{
    self->fd = port_open(self->options->device, self->options->baud, local->error, sizeof local->error);
    if (self->fd < 0)
    {
        (void)poll(NULL, 0, *backoff_ms);
        *backoff_ms = *backoff_ms * 2 < BACKOFF_MAX_MS ? *backoff_ms * 2 : BACKOFF_MAX_MS;
        return;
    }
    *backoff_ms = BACKOFF_MIN_MS;
    self->reopens++;
    event(self->options, "reopened", ",\"device\":\"%s\",\"reopens\":%llu,\"down_s\":%.3f",
          quoted(self->options->device, local->text, sizeof local->text), (unsigned long long)self->reopens,
          (double)(now_ns() - local->unplugged_ns) * 1e-9);
}

static void take_octet(receiver_t* self, local_t* local, uint8_t octet, uint64_t t_ns)
{
    int reply;
    queue_item_t item;
    const int got = link_octet(self, octet, t_ns / 1000000u, &reply, &item);
    if (reply >= 0)
    {
        const uint8_t answer = (uint8_t)reply;
        self->unsent += write(self->fd, &answer, 1) != 1; // the board's time-out sees to it
    }
    self->octets++;
    local->octets_since++;
    if (got)
    {
        item.arrived_ns = t_ns;
        local->last_sample_ns = t_ns;
        local->octets_since = 0;
        self->overruns += !queue_put(self->queue, &item);
    }
}

static void listen_once(receiver_t* self, local_t* local)
{
    struct pollfd p = {self->fd, POLLIN, 0};
    const int half_timeout_ms = self->options->nav.octet_timeout_ms / 2;
    const int tick_ms = half_timeout_ms < 1 ? 1 : half_timeout_ms < TICK_MAX_MS ? half_timeout_ms : TICK_MAX_MS;
    const int ready = poll(&p, 1, tick_ms);
    if (ready < 0)
    {
        return; // a signal
    }
    const uint64_t t_ns = now_ns();
    if (ready == 0)
    {
        link_tick(self, t_ns / 1000000u);
        return;
    }
    uint8_t octets[256];
    const ssize_t n = port_read(self->fd, octets, sizeof octets);
    if (n == 0 || (n < 0 && errno != EAGAIN && errno != EINTR))
    {
        unplugged(self, local, n == 0 ? "the other end closed" : strerror(errno));
        return;
    }
    for (ssize_t i = 0; i < n; i++)
    {
        take_octet(self, local, octets[i], t_ns);
    }
}

static void watch(receiver_t* self, local_t* local)
{
    const uint64_t silent_ns = now_ns() - local->last_sample_ns;
    if (local->octets_since == 0)
    {
        local->hinted = 0;
    }
    if (!local->hinted && local->octets_since >= SILENT_OCTETS && silent_ns >= SILENT_NS)
    {
        const ins_nav_counts_t* c = receiver_counts(self);
        local->hinted = 1;
        event(self->options, "no_samples",
              ",\"octets\":%llu,\"invalid\":%llu,\"corrupt\":%llu,\"timeouts\":%llu,\"stray\":%llu,"
              "\"hint\":\"octets arrive, but no block %s with the firmware\"",
              (unsigned long long)local->octets_since, (unsigned long long)c->invalid, (unsigned long long)c->corrupt,
              (unsigned long long)c->timeouts, (unsigned long long)c->stray,
              self->options->input == INPUT_NAV ? "of a navigating board: compare --baud and --input"
                                                : "of samples: compare --baud, --block-len and --seq");
    }
    int running = RUNNING;
    if (self->options->timeout_s > 0.0 && (double)silent_ns * 1e-9 > self->options->timeout_s)
    {
        (void)atomic_compare_exchange_strong(self->stop, &running, STOP_TIMEOUT);
    }
}

void* receive_thread(void* argument)
{
    receiver_t* const self = argument;
    local_t local = {0};
    int backoff_ms = BACKOFF_MIN_MS;
    local.last_sample_ns = local.unplugged_ns = now_ns();
    while (atomic_load(self->stop) == RUNNING)
    {
        if (self->fd < 0)
        {
            reopen(self, &local, &backoff_ms);
        }
        else
        {
            listen_once(self, &local);
        }
        watch(self, &local);
    }
    if (self->fd >= 0)
    {
        (void)close(self->fd);
    }
    queue_close(self->queue);
    return NULL;
}
