/// \file   output.h
/// \brief  Where states go: JSON lines into a file or pipe, and DDS. Events of the daemon go to standard error as JSON lines.
/// SPDX-License-Identifier: MIT
#ifndef NAVD_OUTPUT_H_INCLUDED
#define NAVD_OUTPUT_H_INCLUDED
#include "ins_nav/navigation.h"
#include "options.h"
#include <stdatomic.h>

typedef struct publisher_t publisher_t;

/// \return NULL with the reason in error.
publisher_t* publisher_open(const options_t* options, char* error, size_t size);

// None of these waits: what does not fit into the publisher's queue is dropped and counted.
void publisher_put(publisher_t* self, const ins_nav_state_t* state, const ins_navigation_t* navigation);
void publisher_put_solution(publisher_t* self, const ins_nav_solution_t* solution, const ins_navigation_t* navigation);
/// What the sensors said, as codes. \param[in] time_ns  of its arrival, the host's clock.
void publisher_put_sample(publisher_t* self, const ins_nav_sample_t* sample, const ins_nav_config_t* nav,
                          int64_t time_ns);

typedef struct publisher_counts_t
{
    uint64_t published; ///< states
    uint64_t refused;   ///< messages that DDS did not take
    uint64_t dropped;   ///< messages that found the queue full
} publisher_counts_t;

/// Publishes what waits. NULL is allowed.
publisher_counts_t publisher_close(publisher_t* self);

typedef struct output_t
{
    int fd; ///< -1 = no JSON
    const char* name;
    publisher_t* publisher;    ///< NULL = no DDS
    publisher_counts_t counts; ///< after output_close()
    uint64_t unwritten;        ///< lines given up because the reader did not read when the daemon had to stop
} output_t;

/// \return 0; -1 with the reason in error.
int output_open(output_t* self, const options_t* options, char* error, size_t size);
/// The host's clock of an instant of the monotonic one [ns since 1970].
int64_t wall_ns(uint64_t monotonic_ns);
/// Waits for a slow reader of the JSON lines, until *stop.
/// \return 0; -1 with the reason in error: no further line can be written.
int output_state(output_t* self, const ins_nav_state_t* state, const ins_navigation_t* navigation,
                 const atomic_int* stop, char* error, size_t size);
/// The same, for six accelerometers.
int output_six(output_t* self, const ins_nav_six_state_t* state, const ins_navigation_t* navigation,
               const atomic_int* stop, char* error, size_t size);
/// The same, for what a navigating board says.
int output_solution(output_t* self, const ins_nav_solution_t* solution, const ins_navigation_t* navigation,
                    const atomic_int* stop, char* error, size_t size);
/// Of what follows as a state.
void output_sample(output_t* self, const ins_nav_sample_t* sample, const ins_nav_config_t* nav, int64_t time_ns);
void output_close(output_t* self);

/// One line {"event":"NAME", ...} on standard error. The format's rest begins after the name, such as ",\"count\":%d".
void event(const options_t* options, const char* name, const char* format, ...);
/// text as the inside of a JSON string, cut to fit.
const char* quoted(const char* text, char* buffer, size_t size);

#endif // NAVD_OUTPUT_H_INCLUDED
