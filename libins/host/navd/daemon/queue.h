/// \file   queue.h
/// \brief  Bounded queue from the receiving to the computing thread, guarded by two semaphores: filled places and free places.
/// SPDX-License-Identifier: MIT
#ifndef NAVD_QUEUE_H_INCLUDED
#define NAVD_QUEUE_H_INCLUDED
#include "ins_nav/nav.h"
#include "ins_nav/nav_input.h"
#include <semaphore.h>
#include <stdatomic.h>

typedef struct queue_item_t
{
    union
    {
        ins_nav_sample_t sample;     ///< INPUT_CODES
        ins_nav_solution_t solution; ///< INPUT_NAV
    } is;
    uint64_t arrived_ns; ///< when its last octet was read, monotonic clock
} queue_item_t;

typedef struct queue_t
{
    queue_item_t* item;
    uint32_t size;
    uint32_t head; ///< of the receiving thread
    uint32_t tail; ///< of the computing thread
    uint32_t got;  ///< modulo 2^32, as put
    atomic_uint put;
    sem_t filled;
    sem_t free;
} queue_t;

/// \return 0; -1 when memory is out.
int queue_init(queue_t* self, uint32_t size);
void queue_destroy(queue_t* self);
/// Never waits. \return 1; 0 when full, and then the item is not in.
int queue_put(queue_t* self, const queue_item_t* item);
/// Nothing more will be put.
void queue_close(queue_t* self);
/// Waits. \return 1; 0 when closed and empty.
int queue_get(queue_t* self, queue_item_t* item);

#endif // NAVD_QUEUE_H_INCLUDED
