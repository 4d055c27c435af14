/// \file   main.c
/// \brief  ins-gpsdr: a receiver's NMEA and an odometer board's sentences to position and heading, on a display, as JSON and over DDS.
///
/// After the ARM vehicle navigator paper of the GPS/DR system, section 2: tasks of 100 ms and 1 s, an LCD. The tasks are
/// ins_nav/vehicle.h; here are the lines and where results go. Exit codes: 0 done, 1 time-out or output failed, 2 bad usage, device
/// or DDS.
/// SPDX-License-Identifier: MIT
#include "../daemon/output.h"
#include "../daemon/port.h"
#include "display.h"
#include "options.h"
#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define TICK_MS   100
#define REOPEN_NS 500000000u ///< between tries to open a lost line

enum
{
    RUN,
    END_SIGNAL,
    END_LIMIT,
    END_TIMEOUT,
    END_OUTPUT
};

static atomic_int stop = RUN;

static void on_signal(int number)
{
    (void)number;
    int running = RUN;
    (void)atomic_compare_exchange_strong(&stop, &running, END_SIGNAL);
}

static void set_signals(void)
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    (void)sigemptyset(&action.sa_mask);
    action.sa_handler = on_signal;
    (void)sigaction(SIGINT, &action, NULL);
    (void)sigaction(SIGTERM, &action, NULL);
    action.sa_handler = SIG_IGN; // a closed pipe is a failed write
    (void)sigaction(SIGPIPE, &action, NULL);
}

typedef struct daemon_t
{
    gpsdr_options_t options;
    ins_vehicle_t vehicle;
    output_t output;
    int fd[INS_VEHICLE_PORTS]; ///< -1 = unplugged
    unsigned ports;
    uint64_t tried_ns[INS_VEHICLE_PORTS];
    uint64_t last_ns; ///< when the board last said something
    uint64_t solutions;
    uint64_t reopens;
    int source;
    uint64_t shown; ///< tasks of 1 s at the last display
} daemon_t;

static uint64_t now_ns(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000000u + (uint64_t)t.tv_nsec;
}

static void end(int reason)
{
    int running = RUN;
    (void)atomic_compare_exchange_strong(&stop, &running, reason);
}

static void hand_on(daemon_t* self, const ins_nav_solution_t* solution)
{
    char error[512];
    const int source = ins_vehicle_source(&self->vehicle);
    if (source != self->source)
    {
        event(&self->options.shared, "source", ",\"t_s\":%.1f,\"from\":\"%s\",\"to\":\"%s\"", solution->t_s,
              display_source(self->source), display_source(source));
        self->source = source;
    }
    const uint64_t tasks = self->vehicle.counts.fixes + self->vehicle.counts.no_fixes;
    if (self->options.display && tasks != self->shown)
    {
        if (display_show(&self->vehicle, solution, self->shown > 0) != 0)
        {
            fprintf(stderr, "ins-gpsdr: cannot write standard output: %s\n", strerror(errno));
            end(END_OUTPUT);
        }
        self->shown = tasks;
    }
    ins_navigation_t navigation;
    ins_vehicle_navigation(&self->vehicle, solution, wall_ns(self->last_ns), &navigation);
    if (output_solution(&self->output, solution, &navigation, &stop, error, sizeof error) != 0)
    {
        fprintf(stderr, "ins-gpsdr: %s\n", error);
        end(END_OUTPUT);
    }
    if (++self->solutions == self->options.shared.limit)
    {
        end(END_LIMIT);
    }
}

static void take(daemon_t* self, unsigned port, const uint8_t* octets, size_t count)
{
    ins_nav_solution_t solution;
    for (size_t i = 0; i < count && atomic_load(&stop) == RUN; i++)
    {
        if (ins_vehicle_octet(&self->vehicle, port, octets[i], &solution))
        {
            self->last_ns = now_ns();
            hand_on(self, &solution);
        }
    }
}

static void reopen(daemon_t* self, unsigned port)
{
    char error[1280];
    char text[600];
    const char* const device = self->options.device[port];
    if (now_ns() - self->tried_ns[port] < REOPEN_NS)
    {
        return;
    }
    self->tried_ns[port] = now_ns();
    self->fd[port] = port_open(device, self->options.baud[port], error, sizeof error);
    if (self->fd[port] >= 0)
    {
        self->reopens++;
        event(&self->options.shared, "reopened", ",\"device\":\"%s\"", quoted(device, text, sizeof text));
    }
}

static void read_port(daemon_t* self, unsigned port)
{
    uint8_t octets[256];
    char text[600];
    const ssize_t n = port_read(self->fd[port], octets, sizeof octets);
    if (n > 0)
    {
        take(self, port, octets, (size_t)n);
    }
    else if (n == 0 || (errno != EAGAIN && errno != EINTR))
    {
        event(&self->options.shared, "lost", ",\"device\":\"%s\",\"reason\":\"%s\"",
              quoted(self->options.device[port], text, sizeof text), n == 0 ? "the other end closed" : strerror(errno));
        (void)close(self->fd[port]);
        self->fd[port] = -1;
        self->tried_ns[port] = now_ns();
    }
}

static void run(daemon_t* self)
{
    const double timeout_s = self->options.shared.timeout_s;
    self->last_ns = now_ns();
    while (atomic_load(&stop) == RUN)
    {
        struct pollfd p[INS_VEHICLE_PORTS];
        for (unsigned i = 0; i < self->ports; i++)
        {
            if (self->fd[i] < 0)
            {
                reopen(self, i);
            }
            p[i] = (struct pollfd){self->fd[i], POLLIN, 0}; // one below 0 is passed over
        }
        const int ready = poll(p, self->ports, TICK_MS);
        for (unsigned i = 0; ready > 0 && i < self->ports; i++)
        {
            if (p[i].revents != 0)
            {
                read_port(self, i);
            }
        }
        if (timeout_s > 0.0 && (double)(now_ns() - self->last_ns) * 1e-9 > timeout_s)
        {
            end(END_TIMEOUT);
        }
    }
}

static void summary(const daemon_t* self)
{
    static const char* const reasons[] = {"", "signal", "limit", "timeout", "output"};
    const ins_vehicle_counts_t* c = &self->vehicle.counts;
    uint64_t bad = 0;
    for (unsigned i = 0; i < self->ports; i++)
    {
        const ins_nmea_t* nmea = &self->vehicle.nmea[i];
        bad += (uint64_t)nmea->bad_checksum + nmea->malformed + nmea->cut;
    }
    event(&self->options.shared, "summary",
          ",\"reason\":\"%s\",\"solutions\":%llu,\"samples\":%llu,\"invalid\":%llu,\"corrupt\":%llu,\"gaps\":%llu,"
          "\"restarts\":%llu,\"repeated\":%llu,\"fixes\":%llu,\"no_fixes\":%llu,\"refused\":%llu,\"bad_nmea\":%llu,"
          "\"reopens\":%llu,\"published\":%llu,\"unpublished\":%llu,\"dropped\":%llu,\"unwritten\":%llu",
          reasons[atomic_load(&stop)], (unsigned long long)self->solutions, (unsigned long long)c->samples,
          (unsigned long long)c->invalid, (unsigned long long)c->corrupt, (unsigned long long)c->gaps,
          (unsigned long long)c->restarts, (unsigned long long)c->repeated, (unsigned long long)c->fixes,
          (unsigned long long)c->no_fixes, (unsigned long long)c->refused, (unsigned long long)bad,
          (unsigned long long)self->reopens, (unsigned long long)self->output.counts.published,
          (unsigned long long)self->output.counts.refused, (unsigned long long)self->output.counts.dropped,
          (unsigned long long)self->output.unwritten);
}

static int open_lines(daemon_t* self)
{
    char error[1280];
    char text[600];
    self->ports = self->options.device[1] != NULL ? 2 : 1;
    for (unsigned i = 0; i < self->ports; i++)
    {
        self->fd[i] = port_open(self->options.device[i], self->options.baud[i], error, sizeof error);
        if (self->fd[i] < 0)
        {
            fprintf(stderr, "ins-gpsdr: %s\n", error);
            return 0;
        }
        event(&self->options.shared, "open", ",\"device\":\"%s\"", quoted(self->options.device[i], text, sizeof text));
    }
    return 1;
}

int main(int argc, char** argv)
{
    static daemon_t self;
    const int code = gpsdr_options_parse(argc, argv, &self.options);
    if (code >= 0)
    {
        return code;
    }
    set_signals();
    (void)ins_vehicle_init(&self.vehicle, &self.options.vehicle); // gpsdr_options_parse() has checked it
    if (!open_lines(&self))
    {
        return 2;
    }
    char error[1280];
    if (output_open(&self.output, &self.options.shared, error, sizeof error) != 0)
    {
        fprintf(stderr, "ins-gpsdr: %s\n", error);
        return 2;
    }
    run(&self);
    const int reason = atomic_load(&stop);
    if (reason == END_TIMEOUT)
    {
        fprintf(stderr,
                "ins-gpsdr: no sentence of the board for %g s; are --board and --baud right, does it send $PINSD?\n",
                self.options.shared.timeout_s);
    }
    output_close(&self.output); // publishes what waits, so that it counts
    summary(&self);
    return reason == END_TIMEOUT || reason == END_OUTPUT ? 1 : 0;
}
