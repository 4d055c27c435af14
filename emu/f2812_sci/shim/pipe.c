/// The program's side of the pipe: one message in, its answer out; see emu_f2812/wirelink.h.
/// SPDX-License-Identifier: MIT
#define _DEFAULT_SOURCE // setitimer
#include "pipe_internal.h"
#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#define LOOK_US 500000 ///< firmware that never comes to a hook does not outlive its run by more

static int hang_up_fd;

static void look(int signal)
{
    struct pollfd other = {.fd = hang_up_fd};
    (void)signal;
    if (poll(&other, 1, 0) == 1)
    {
        _exit(0);
    }
}

/// The run may be killed: then nobody waits for this process, and it must not stay.
static void watch_other_end(int fd)
{
    const struct itimerval every = {.it_interval = {.tv_usec = LOOK_US}, .it_value = {.tv_usec = LOOK_US}};
    struct sigaction action = {.sa_handler = look, .sa_flags = SA_RESTART};
    hang_up_fd = fd;
    (void)sigaction(SIGALRM, &action, NULL);
    (void)setitimer(ITIMER_REAL, &every, NULL);
    (void)prctl(PR_SET_PDEATHSIG, 0); // is sent at the end of a thread of the parent already
}

void f2812_pipe_send(pipe_t* self, f2812_link_t* message)
{
    uint8_t octets[F2812_LINK_OCTETS];
    emu_state_t io = {.to = octets, .size = sizeof octets};
    const size_t size = f2812_link_walk(message, &io);
    if (size == 0 || send(self->fd, octets, size, MSG_NOSIGNAL) != (ssize_t)size)
    {
        if (errno != EPIPE)
        {
            (void)fprintf(stderr, "%s: the run could not be answered: %s\n", self->program->name, strerror(errno));
        }
        exit(errno == EPIPE ? 0 : 1);
    }
}

void f2812_pipe_answer(pipe_t* self, f2812_link_kind_t kind)
{
    self->out.kind = (uint8_t)kind;
    f2812_pipe_send(self, &self->out);
}

void f2812_pipe_refuse(pipe_t* self, const char* what, const char* why)
{
    char text[2 * F2812_LINK_TEXT];
    (void)snprintf(text, sizeof text, "%s: %s", what, why);
    f2812_link_text(self->out.u.refused.text, F2812_LINK_TEXT, text);
    f2812_pipe_answer(self, F2812_LINK_REFUSED);
}

static void on_report(void* ctx, emu_report_kind_t kind, const char* text, uint32_t detail, emu_time_t at)
{
    pipe_t* const self = ctx;
    self->report.kind = F2812_LINK_REPORT;
    self->report.u.report.at = at;
    self->report.u.report.detail = detail;
    self->report.u.report.kind = (uint8_t)kind;
    f2812_link_text(self->report.u.report.text, F2812_LINK_TEXT, text);
    f2812_pipe_send(self, &self->report);
}

static void on_edge_out(void* ctx, bool level, emu_time_t at)
{
    const pipe_wire_t* const wire = ctx;
    pipe_t* const self = wire->pipe;
    if (self->edges.u.edges.count == F2812_LINK_EDGES)
    {
        self->edges.kind = F2812_LINK_EDGES_ARE;
        f2812_pipe_send(self, &self->edges);
        self->edges.u.edges.count = 0;
    }
    self->edges.u.edges.edges[self->edges.u.edges.count++] =
        (f2812_link_edge_t){.at = at, .wire = (uint8_t)(wire - self->wires), .level = level};
    if (wire->answered && self->shim != NULL && self->in.kind == F2812_LINK_RUN)
    {
        f2812_shim_end_by(self->shim, at + self->in.u.run.answer);
    }
}

static void on_edge_in(void* ctx, emu_time_t at)
{
    pipe_t* const self = ctx;
    const f2812_link_edge_t edge = self->in.u.run.edges[self->edge++];
    if (self->edge < self->in.u.run.count)
    {
        emu_sched_first(&self->sched, &self->edge_event, self->in.u.run.edges[self->edge].at);
    }
    const pipe_wire_t* const wire = &self->wires[edge.wire];
    emu_wire_drive(wire->wire, wire->driver, edge.level ? EMU_STRONG1 : EMU_STRONG0, at);
}

static void start(pipe_t* self)
{
    f2812_config_t config;
    f2812_default_config(&config);
    config.oscclk_hz = self->in.u.start.oscclk_hz;
    config.report = (emu_report_t){on_report, self};
    for (unsigned i = 0; i < self->in.u.start.count; i++)
    {
        const f2812_link_pair_t* const pair = &self->in.u.start.switches[i];
        const char* const why = f2812_switch_set(&config.switches, pair->name, pair->value);
        if (why != NULL)
        {
            f2812_pipe_refuse(self, pair->name, why);
            return;
        }
    }
    emu_sched_init(&self->sched);
    self->device = f2812_create(&config, &self->sched);
    self->shim =
        self->device != NULL ? f2812_shim_create(self->device, &self->sched, self->program, &config.report) : NULL;
    if (self->shim == NULL)
    {
        f2812_pipe_refuse(self, "the board could not be made", "out of memory, or an oscillator outside its range");
        return;
    }
    self->edge_event = (emu_event_t){.fire = on_edge_in, .ctx = self};
    f2812_pipe_answer(self, F2812_LINK_READY);
}

static void open_wire(pipe_t* self)
{
    const char* const name = self->in.u.wire.name;
    emu_wire_t* const net = f2812_wire(self->device, name);
    if (net == NULL || self->wire_count == F2812_LINK_WIRES)
    {
        f2812_pipe_refuse(self, name, net == NULL ? "the F2812 has no such wire" : "too many wires are looked at");
        return;
    }
    pipe_wire_t* const wire = &self->wires[self->wire_count];
    *wire = (pipe_wire_t){.pipe = self, .wire = net, .driver = -1, .answered = self->in.u.wire.answered};
    if (self->in.u.wire.driven)
    {
        wire->driver = emu_wire_add_driver(net);
        emu_wire_drive(net, wire->driver, EMU_STRONG1, self->sched.now); // a line is idle at first
    }
    if (self->in.u.wire.driven ? wire->driver < 0 : emu_wire_watch(net, on_edge_out, wire) != 0)
    {
        f2812_pipe_refuse(self, name, "is looked at too often");
        return;
    }
    self->wire_count++;
    if (wire->driver < 0 && !net->level)
    {
        on_edge_out(wire, false, self->sched.now); // its reader takes it for high
    }
    f2812_pipe_answer(self, F2812_LINK_READY);
}

static bool edges_possible(const pipe_t* self)
{
    for (unsigned i = 0; i < self->in.u.run.count; i++)
    {
        const f2812_link_edge_t* const edge = &self->in.u.run.edges[i];
        if (edge->wire >= self->wire_count || self->wires[edge->wire].driver < 0 || edge->at <= self->sched.now ||
            edge->at > self->in.u.run.until)
        {
            return false;
        }
    }
    return self->in.u.run.until >= self->sched.now;
}

static void run(pipe_t* self)
{
    if (!edges_possible(self))
    {
        f2812_pipe_refuse(self, "window", "an edge is outside it, or on a wire that is not driven");
        return;
    }
    self->edge = 0;
    self->broken = false;
    memset(&self->out.u.done.access, 0, sizeof self->out.u.done.access);
    if (self->in.u.run.count > 0)
    {
        emu_sched_first(&self->sched, &self->edge_event, self->in.u.run.edges[0].at);
    }
    const f2812_stop_t stop = f2812_shim_run(self->shim, self->in.u.run.until);
    emu_sched_cancel(&self->sched, &self->edge_event); // after a break the run sends what has not come yet once more
    f2812_pipe_flush(self);
    self->out.u.done.reached = self->sched.now;
    const bool waits = stop == F2812_ENDED || (stop == F2812_REACHED && f2812_shim_waiting(self->shim));
    const emu_time_t due = emu_sched_next(&self->sched);
    self->out.u.done.quiet = waits && due > self->sched.now ? due : self->sched.now + 1;
    self->out.u.done.why = stop == F2812_ENDED                    ? F2812_WHY_ENDED
                           : stop == F2812_BROKEN && self->broken ? F2812_WHY_BREAK
                                                                  : F2812_WHY_REACHED;
    f2812_link_text(self->out.u.done.end, F2812_LINK_TEXT, stop == F2812_ENDED ? f2812_shim_end(self->shim) : "");
    self->out.u.done.count = self->edges.u.edges.count;
    memcpy(self->out.u.done.edges, self->edges.u.edges.edges,
           self->edges.u.edges.count * sizeof self->edges.u.edges.edges[0]);
    self->edges.u.edges.count = 0;
    f2812_pipe_answer(self, F2812_LINK_DONE);
}

static void peek(pipe_t* self)
{
    self->out.u.values.count = self->in.u.peek.count;
    for (unsigned i = 0; i < self->in.u.peek.count; i++)
    {
        self->out.u.values.values[i] = f2812_peek(self->device, (uint16_t)(self->in.u.peek.address + i));
    }
    f2812_pipe_answer(self, F2812_LINK_VALUES_ARE);
}

static void count(pipe_t* self, const char* name, uint64_t value)
{
    f2812_link_count_t* const c = &self->out.u.counts.counts[self->out.u.counts.count++];
    f2812_link_text(c->name, F2812_LINK_NAME, name);
    c->value = value;
}

static void count_all(pipe_t* self)
{
    const f2812_shim_stats_t* const stats = f2812_shim_stats(self->shim);
    self->out.u.counts.count = 0;
    count(self, "accesses", stats->accesses);
    count(self, "blocks", stats->blocks);
    count(self, "turns", stats->turns);
    count(self, "skipped", stats->skipped);
    count(self, "interrupts", stats->interrupts);
    count(self, "starts", stats->starts);
    f2812_pipe_answer(self, F2812_LINK_COUNTS_ARE);
}

static void handle(pipe_t* self)
{
    if ((self->in.kind == F2812_LINK_START) != (self->device == NULL))
    {
        f2812_pipe_refuse(self, "order", "START comes once, and first");
        return;
    }
    switch (self->in.kind)
    {
    case F2812_LINK_START:
        start(self);
        break;
    case F2812_LINK_WIRE:
        open_wire(self);
        break;
    case F2812_LINK_RUN:
        run(self);
        break;
    case F2812_LINK_PEEK:
        peek(self);
        break;
    case F2812_LINK_BREAK:
        f2812_pipe_set_break(self);
        break;
    case F2812_LINK_RECORD:
        f2812_pipe_record(self);
        break;
    case F2812_LINK_CLOCK:
        f2812_set_osc_ppb(self->device, self->in.u.clock.ppb);
        f2812_pipe_answer(self, F2812_LINK_READY);
        break;
    case F2812_LINK_STATISTICS:
        count_all(self);
        break;
    default:
        f2812_pipe_refuse(self, "kind", "no message for a program");
        break;
    }
}

int f2812_pipe_main(int fd, const f2812_program_t* program)
{
    static pipe_t self;
    static uint8_t octets[F2812_LINK_OCTETS];
    self.fd = fd;
    self.program = program;
    watch_other_end(fd);
    self.out.u.hello.bits = (uint8_t)(8 * sizeof(void*));
    f2812_link_text(self.out.u.hello.name, F2812_LINK_NAME, program->name);
    f2812_pipe_answer(&self, F2812_LINK_HELLO);
    for (;;)
    {
        const ssize_t size = recv(fd, octets, sizeof octets, 0);
        if (size == 0 || (size < 0 && errno == ECONNRESET))
        {
            return 0;
        }
        emu_state_t io = {.from = octets, .size = size > 0 ? (size_t)size : 0};
        if (size < 0 || f2812_link_walk(&self.in, &io) == 0)
        {
            (void)fprintf(stderr, "%s: what came over descriptor %d is no message of a run\n", program->name, fd);
            return 1;
        }
        handle(&self);
    }
}
