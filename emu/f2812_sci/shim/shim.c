/// The firmware as a coroutine: its stack, its start and restart, its interrupts, and how it stops.
/// SPDX-License-Identifier: MIT
#define _XOPEN_SOURCE 700
#include "shim_internal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <ucontext.h>

#define GUARD_OCTETS ((size_t)4096)
#define STACK_OCTETS ((size_t)1 << 20)

typedef enum leave_t
{
    LEAVE_REACHED,
    LEAVE_BROKEN,
    LEAVE_ENDED,
    LEAVE_RESTART
} leave_t;

typedef struct coroutine_t
{
    ucontext_t host, firmware;
    bool inside;  ///< the firmware runs, not the host
    bool started; ///< it has a stack to go on with
    leave_t why;
    uint32_t debt;  ///< f2812_shim_debt while it does not run
    uint8_t* stack; ///< its lowest page may not be touched
} coroutine_t;

static coroutine_t* coroutine_of(const f2812_shim_t* self)
{
    return self->coroutine;
}

/// Back to f2812_shim_run(); goes on here at the next one, but for an end or a restart.
static void leave(f2812_shim_t* self, leave_t why)
{
    coroutine_t* const c = coroutine_of(self);
    c->why = why;
    c->inside = false;
    (void)swapcontext(&c->firmware, &c->host);
    c->inside = true;
}

/// After all else that is due at the instant.
static void until_fire(void* ctx, emu_time_t at)
{
    f2812_shim_t* const self = ctx;
    if (emu_sched_next(self->sched) <= at)
    {
        emu_sched_at(self->sched, &self->until, at);
    }
    else if (coroutine_of(self)->inside)
    {
        leave(self, self->end != NULL ? LEAVE_ENDED : LEAVE_REACHED);
    }
}

void f2812_shim_error(f2812_shim_t* self, emu_report_kind_t kind, const char* text, uint32_t detail)
{
    if (self->report.put != NULL)
    {
        self->report.put(self->report.ctx, kind, text, detail, f2812_now(self->device));
    }
}

_Noreturn void f2812_shim_finish(f2812_shim_t* self, const char* why)
{
    self->end = why;
    leave(self, LEAVE_ENDED);
    for (;;) // time goes on without the firmware
    {
        f2812_advance(self->device, UINT32_MAX);
    }
}

static void interrupt(f2812_shim_t* self, unsigned vector, const f2812_context_t* saved)
{
    void (*const function)(void) = self->program->vectors != NULL ? self->program->vectors[vector] : NULL;
    self->stats.interrupts++;
    f2812_advance(self->device, F2812_CYCLES_INTERRUPT);
    if (function != NULL)
    {
        function();
    }
    else
    {
        f2812_shim_error(self, EMU_GUEST_ERROR, "an interrupt was taken whose entry in PieVectTable is not set",
                         vector);
        f2812_shim_finish(self, "interrupt without a function");
    }
    self->midway = false;
    f2812_shim_step(self, F2812_CYCLES_IRET);
    f2812_iret(self->device, saved);
}

void f2812_shim_attend(f2812_shim_t* self)
{
    while (f2812_interrupt_pending(self->device))
    {
        f2812_context_t saved;
        const int vector = f2812_take_interrupt(self->device, &saved);
        if (vector == F2812_VECTOR_RESET)
        {
            leave(self, LEAVE_RESTART);
        }
        else if (vector != F2812_NO_VECTOR)
        {
            interrupt(self, (unsigned)vector, &saved);
        }
    }
    if (self->stop)
    {
        self->stop = false;
        leave(self, LEAVE_BROKEN);
    }
}

void f2812_shim_idle(f2812_shim_t* self)
{
    (void)f2812_idle(self->device, EMU_TIME_MAX);
    f2812_shim_changes++;
}

/// main() from the beginning when there is no reset, its variables as they were loaded.
static void enter(void)
{
    f2812_shim_t* const self = f2812_shim_current;
    f2812_context_t unused;
    coroutine_of(self)->inside = true;
    while (f2812_in_reset(self->device))
    {
        (void)f2812_skip(self->device, EMU_TIME_MAX);
    }
    (void)f2812_take_interrupt(self->device, &unused); // the reset itself
    memcpy(self->program->data, self->initial, (size_t)(self->program->data_end - self->program->data));
    memset(self->loops, 0, sizeof self->loops);
    self->store = 0;
    self->midway = false;
    f2812_shim_debt = 0;
    self->stats.starts++;
    self->program->main();
    f2812_shim_step(self, 0);
    f2812_shim_finish(self, "main() returned");
}

static void start(f2812_shim_t* self)
{
    coroutine_t* const c = coroutine_of(self);
    (void)getcontext(&c->firmware);
    c->firmware.uc_stack.ss_sp = c->stack + GUARD_OCTETS;
    c->firmware.uc_stack.ss_size = STACK_OCTETS;
    c->firmware.uc_link = NULL;
    makecontext(&c->firmware, enter, 0);
    c->started = true;
}

static leave_t go_on(f2812_shim_t* self, emu_time_t until)
{
    coroutine_t* const c = coroutine_of(self);
    do
    {
        if (!c->started)
        {
            start(self);
        }
        emu_sched_at(self->sched, &self->until, until);
        (void)swapcontext(&c->host, &c->firmware);
        emu_sched_cancel(self->sched, &self->until);
        c->started = c->why != LEAVE_RESTART;
    } while (c->why == LEAVE_RESTART);
    return c->why;
}

f2812_stop_t f2812_shim_run(f2812_shim_t* self, emu_time_t until)
{
    coroutine_t* const c = coroutine_of(self);
    f2812_shim_current = self;
    f2812_shim_debt = c->debt;
    self->waiting = false;
    const leave_t why = go_on(self, until);
    c->debt = f2812_shim_debt;
    return why == LEAVE_REACHED ? F2812_REACHED : why == LEAVE_BROKEN ? F2812_BROKEN : F2812_ENDED;
}

static bool make_coroutine(f2812_shim_t* self)
{
    coroutine_t* const c = calloc(1, sizeof *c);
    self->coroutine = c;
    if (c == NULL)
    {
        return false;
    }
    c->stack = aligned_alloc(GUARD_OCTETS, GUARD_OCTETS + STACK_OCTETS);
    return c->stack != NULL && mprotect(c->stack, GUARD_OCTETS, PROT_NONE) == 0;
}

static void free_all(f2812_shim_t* self)
{
    coroutine_t* const c = coroutine_of(self);
    if (c != NULL && c->stack != NULL)
    {
        (void)mprotect(c->stack, GUARD_OCTETS, PROT_READ | PROT_WRITE);
        free(c->stack);
    }
    free(c);
    free(self->initial);
    free(self->map);
    free(self);
}

/// The shims there are: a program's variables serve one at a time.
static f2812_shim_t* alive;

static bool taken(const f2812_program_t* program)
{
    const f2812_shim_t* shim = alive;
    while (shim != NULL && shim->program != program)
    {
        shim = shim->next;
    }
    return shim != NULL;
}

f2812_shim_t* f2812_shim_create(f2812_t* device, emu_sched_t* sched, const f2812_program_t* program,
                                const emu_report_t* report)
{
    f2812_shim_t* const self = taken(program) ? NULL : calloc(1, sizeof *self);
    const size_t octets = (size_t)(program->data_end - program->data);
    if (self == NULL)
    {
        return NULL;
    }
    self->device = device;
    self->sched = sched;
    self->program = program;
    self->report = report != NULL ? *report : (emu_report_t){0};
    self->skip = true;
    self->until = (emu_event_t){.fire = until_fire, .ctx = self};
    self->initial = malloc(octets + 1);
    if (!make_coroutine(self) || self->initial == NULL || !f2812_shim_make_map(self))
    {
        free_all(self);
        return NULL;
    }
    memcpy(self->initial, program->data, octets);
    self->next = alive;
    alive = self;
    return self;
}

void f2812_shim_destroy(f2812_shim_t* self)
{
    if (self == NULL)
    {
        return;
    }
    emu_sched_cancel(self->sched, &self->until);
    memcpy(self->program->data, self->initial, (size_t)(self->program->data_end - self->program->data));
    f2812_shim_t** link = &alive;
    while (*link != self)
    {
        link = &(*link)->next;
    }
    *link = self->next;
    free_all(self);
}

void f2812_shim_break(f2812_shim_t* self)
{
    self->stop = true;
}

void f2812_shim_end_by(f2812_shim_t* self, emu_time_t until)
{
    if (self->until.pending && until < self->until.at)
    {
        emu_sched_at(self->sched, &self->until, until);
    }
}

bool f2812_shim_waiting(const f2812_shim_t* self)
{
    return self->waiting;
}

void f2812_shim_set_skip(f2812_shim_t* self, bool on)
{
    self->skip = on;
}

const char* f2812_shim_end(const f2812_shim_t* self)
{
    return self->end;
}

bool f2812_shim_overflows(uintptr_t at)
{
    if (f2812_shim_current == NULL)
    {
        return false;
    }
    return at - (uintptr_t)coroutine_of(f2812_shim_current)->stack < GUARD_OCTETS;
}

const f2812_shim_stats_t* f2812_shim_stats(const f2812_shim_t* self)
{
    return &self->stats;
}
