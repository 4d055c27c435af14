/// \file   receive.h
/// \brief  The receiving thread of ins-navd: octets from the line through the handshake into the queue; re-plugging.
/// SPDX-License-Identifier: MIT
#ifndef NAVD_RECEIVE_H_INCLUDED
#define NAVD_RECEIVE_H_INCLUDED
#include "options.h"
#include "queue.h"

typedef enum stop_t
{
    RUNNING = 0,
    STOP_SIGNAL,
    STOP_LIMIT,
    STOP_TIMEOUT,
    STOP_OUTPUT
} stop_t;

/// Of one run. The receiving thread writes the counters; the other reads them when that has ended.
typedef struct receiver_t
{
    const options_t* options;
    queue_t* queue;
    atomic_int* stop;      ///< stop_t
    ins_nav_link_t link;   ///< INPUT_CODES
    ins_nav_input_t input; ///< INPUT_NAV
    int fd;                ///< -1 = unplugged
    uint64_t octets;       ///< read
    uint64_t overruns;     ///< samples dropped because the queue was full
    uint64_t reopens;      ///< times the line came back
    uint64_t unsent;       ///< replies that the line did not take
} receiver_t;

uint64_t now_ns(void);
/// Of the half that the input takes.
const ins_nav_counts_t* receiver_counts(const receiver_t* self);
/// \param[in] self a receiver_t. Runs until *stop, then closes the queue.
void* receive_thread(void* self);

#endif // NAVD_RECEIVE_H_INCLUDED
