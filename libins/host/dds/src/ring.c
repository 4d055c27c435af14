/// \file   ring.c
/// \brief  ring.h. An item is written before its counter is (release), and read after it (acquire).
/// SPDX-License-Identifier: MIT
#include "ring.h"
#include <stdlib.h>
#include <string.h>

int dds_ring_init(dds_ring_t* self, size_t octets, uint32_t least)
{
    self->octets = octets;
    self->size = 1;
    while (self->size < least)
    {
        self->size *= 2;
    }
    self->place = calloc(self->size, octets);
    atomic_init(&self->head, 0u);
    atomic_init(&self->tail, 0u);
    return self->place != NULL ? 0 : -1;
}

void dds_ring_free(dds_ring_t* self)
{
    free(self->place);
}

static void* item_at(const dds_ring_t* self, unsigned counter)
{
    return self->place + (size_t)(counter & (self->size - 1u)) * self->octets;
}

int dds_ring_put(dds_ring_t* self, const void* item)
{
    const unsigned head = atomic_load_explicit(&self->head, memory_order_relaxed);
    if (head - atomic_load_explicit(&self->tail, memory_order_acquire) == self->size)
    {
        return 0;
    }
    memcpy(item_at(self, head), item, self->octets);
    atomic_store_explicit(&self->head, head + 1u, memory_order_release);
    return 1;
}

int dds_ring_get(dds_ring_t* self, void* item)
{
    const unsigned tail = atomic_load_explicit(&self->tail, memory_order_relaxed);
    if (tail == atomic_load_explicit(&self->head, memory_order_acquire))
    {
        return 0;
    }
    memcpy(item, item_at(self, tail), self->octets);
    atomic_store_explicit(&self->tail, tail + 1u, memory_order_release);
    return 1;
}
