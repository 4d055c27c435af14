/// \file   pipe_internal.h
/// \brief  State of the program's side of the pipe, and what its files offer each other. Not installed.
/// SPDX-License-Identifier: MIT
#ifndef F2812_PIPE_INTERNAL_H_INCLUDED
#define F2812_PIPE_INTERNAL_H_INCLUDED
#include "emu_f2812/wirelink.h"
#include "pipe.h"

#define BREAKS 64
#define WORDS  0x10000u

typedef struct pipe_t pipe_t;

typedef struct pipe_wire_t
{
    pipe_t* pipe;
    emu_wire_t* wire;
    int driver; ///< -1: watched
    bool answered;
} pipe_wire_t;

struct pipe_t
{
    int fd;
    const f2812_program_t* program;
    emu_sched_t sched;
    f2812_t* device; ///< NULL before START
    f2812_shim_t* shim;
    pipe_wire_t wires[F2812_LINK_WIRES];
    unsigned wire_count;
    emu_event_t edge_event;
    unsigned edge; ///< of `in`, the next to come
    f2812_link_access_t breaks[BREAKS];
    unsigned break_count;
    bool record_accesses, record_interrupts, broken;
    uint32_t change, seen[WORDS]; ///< number of the last change, and at which a word was last read
    uint16_t value[WORDS];        ///< what it was then
    f2812_link_t in, out, edges, records, report;
};

/// Exits when it cannot be sent.
void f2812_pipe_send(pipe_t* self, f2812_link_t* message);
/// self->out, as a message of this kind.
void f2812_pipe_answer(pipe_t* self, f2812_link_kind_t kind);
void f2812_pipe_refuse(pipe_t* self, const char* what, const char* why);

/// The records so far.
void f2812_pipe_flush(pipe_t* self);
/// self->in is a BREAK.
void f2812_pipe_set_break(pipe_t* self);
/// self->in is a RECORD.
void f2812_pipe_record(pipe_t* self);

#endif // F2812_PIPE_INTERNAL_H_INCLUDED
