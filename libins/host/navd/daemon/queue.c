/// \file   queue.c
/// \brief  Bounded queue between two threads. A post of `filled` that no put belongs to means closed.
/// SPDX-License-Identifier: MIT
#include "queue.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>

int queue_init(queue_t* self, uint32_t size)
{
    memset(self, 0, sizeof *self);
    self->item = calloc(size, sizeof *self->item);
    self->size = size;
    return self->item != NULL && sem_init(&self->filled, 0, 0) == 0 && sem_init(&self->free, 0, size) == 0 ? 0 : -1;
}

void queue_destroy(queue_t* self)
{
    (void)sem_destroy(&self->filled);
    (void)sem_destroy(&self->free);
    free(self->item);
}

int queue_put(queue_t* self, const queue_item_t* item)
{
    if (sem_trywait(&self->free) != 0)
    {
        return 0;
    }
    self->item[self->head] = *item;
    self->head = (self->head + 1u) % self->size;
    atomic_fetch_add(&self->put, 1u);
    (void)sem_post(&self->filled);
    return 1;
}

void queue_close(queue_t* self)
{
    (void)sem_post(&self->filled);
}

int queue_get(queue_t* self, queue_item_t* item)
{
    while (sem_wait(&self->filled) != 0 && errno == EINTR)
    {
    }
    if (self->got == atomic_load(&self->put))
    {
        return 0;
    }
    *item = self->item[self->tail];
    self->tail = (self->tail + 1u) % self->size;
    self->got++;
    (void)sem_post(&self->free);
    return 1;
}
