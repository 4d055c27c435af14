/// \file   ring.h
/// \brief  A bounded queue from one thread to one other without locks: neither side ever waits.
/// Source: L. Lamport, Specifying Concurrent Program Modules, ACM TOPLAS 5(2), 1983, 190-222: two counters, each of one writer.
/// SPDX-License-Identifier: MIT
#ifndef INS_DDS_RING_H_INCLUDED
#define INS_DDS_RING_H_INCLUDED
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>

typedef struct dds_ring_t
{
    unsigned char* place;
    size_t octets;    ///< of an item
    uint32_t size;    ///< items, a power of two, so that the counters may go round
    atomic_uint head; ///< items put, modulo 2^32; of the putting thread
    atomic_uint tail; ///< items got; of the getting thread
} dds_ring_t;

/// \param[in] least  items that it must hold, up to 2^30. \return 0; -1 when memory is out.
int dds_ring_init(dds_ring_t* self, size_t octets, uint32_t least);
void dds_ring_free(dds_ring_t* self);
/// \return 1; 0 when full, and then the item is not in.
int dds_ring_put(dds_ring_t* self, const void* item);
/// \return 1; 0 when empty.
int dds_ring_get(dds_ring_t* self, void* item);

#endif // INS_DDS_RING_H_INCLUDED
