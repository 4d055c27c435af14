// The ring of the outbox under ThreadSanitizer: a putting and a getting thread, items of several words, a ring that is often full and
// whose counters go round. Exit code 0: all in order, none torn, puts = gets + refusals; else 1 and the reason.   test_ring [ITEMS]
// SPDX-License-Identifier: MIT
#include "ring.h"
#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>

#define WORDS 16
#define ITEMS 200000u
#define ROOM  8u

typedef struct item_t
{
    uint32_t word[WORDS];
} item_t;

static dds_ring_t ring;
static atomic_uint refused;
static atomic_int ended;
static uint32_t items = ITEMS;

static void* put(void* unused)
{
    (void)unused;
    for (uint32_t n = 1; n <= items; n++)
    {
        item_t item;
        for (int i = 0; i < WORDS; i++)
        {
            item.word[i] = n;
        }
        if (!dds_ring_put(&ring, &item))
        {
            atomic_fetch_add(&refused, 1u);
            sched_yield();
        }
    }
    atomic_store(&ended, 1);
    return NULL;
}

int main(int argc, char** argv)
{
    pthread_t thread;
    uint32_t got = 0;
    uint32_t last = 0;
    items = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : items;
    if (dds_ring_init(&ring, sizeof(item_t), ROOM - 1) != 0 || ring.size != ROOM)
    {
        return 1;
    }
    atomic_store(&ring.head, UINT32_MAX - items / 2); // the counters go round half-way
    atomic_store(&ring.tail, UINT32_MAX - items / 2);
    if (pthread_create(&thread, NULL, put, NULL) != 0)
    {
        return 1;
    }
    for (;;)
    {
        item_t item;
        const int last_look = atomic_load(&ended);
        if (!dds_ring_get(&ring, &item))
        {
            if (last_look)
            {
                break;
            }
            sched_yield();
            continue;
        }
        for (int i = 0; i < WORDS; i++)
        {
            if (item.word[i] != item.word[0] || item.word[0] <= last)
            {
                fprintf(stderr, "item %u after %u, word %d is %u\n", item.word[0], last, i, item.word[i]);
                return 1;
            }
        }
        last = item.word[0];
        got++;
    }
    (void)pthread_join(thread, NULL);
    printf("%u put, %u got, %u refused\n", items, got, atomic_load(&refused));
    if (got + atomic_load(&refused) != items || got == 0)
    {
        fprintf(stderr, "items are missing\n");
        return 1;
    }
    dds_ring_free(&ring);
    return 0;
}
