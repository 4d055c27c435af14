/// \file   ins_dds/outbox.h
/// \brief  Publishes from a thread of its own what another puts into a bounded queue, so that DDS never holds up a navigator.
///
///     if (ins_dds_outbox_open(dds, ros, "imu0", 256, &outbox) != INS_DDS_OK) { puts(ins_dds_error_text()); }
///     ins_dds_outbox_put(outbox, &outgoing);                // from one thread: no memory, no lock, no waiting
///     ins_dds_outbox_close(outbox, NULL);                   // what is in it is still published
///
/// dds_write() allocates, locks, sends and may wait for a reader; ins_dds_outbox_put() copies the message and posts a semaphore. A message
/// that finds the queue full is dropped and counted; the count is in Status. Of status messages the outbox publishes those that
/// bring a new mode or a new alert, else one a second, and goes on doing so, with INS_DDS_ALERT_SILENT, when nothing is put any more.
/// SPDX-License-Identifier: MIT
#ifndef INS_DDS_OUTBOX_H_INCLUDED
#define INS_DDS_OUTBOX_H_INCLUDED
#include "ins_dds/dds.h"
#include "ins_dds/ros.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_DDS_OUTBOX_MAX 1000000u ///< messages

typedef struct ins_dds_message_t
{
    ins_dds_kind_t kind; ///< INS_DDS_STATE, _SOLUTION, _STATUS, _INNOVATIONS or _RAW_IMU: which member counts
    union
    {
        struct
        {
            ins_nav_state_t state;
            ins_navigation_t navigation; ///< goes to the ROS 2 topics too
        } instant;
        ins_nav_solution_t solution;
        ins_dds_status_t status; ///< published and dropped are filled in; ROS 2 has it as a diagnosis
        ins_dds_innovations_t innovations;
        ins_dds_raw_imu_t raw_imu;
    } is;
} ins_dds_message_t;

typedef struct ins_dds_outbox_counts_t
{
    uint64_t published; ///< states that went to all their topics
    uint64_t refused;   ///< messages that DDS did not take
    uint64_t dropped;   ///< messages that found the queue full
} ins_dds_outbox_counts_t;

typedef struct ins_dds_outbox_t ins_dds_outbox_t;

/// \param[in] dds  may be NULL; belongs to the outbox's thread until it is closed. Kinds that it does not carry are passed over.
/// \param[in] ros  the same. \param[in] size  messages that may wait, 1 to INS_DDS_OUTBOX_MAX; rounded up to a power of two.
/// \return INS_DDS_OK, or an error, and then *self is NULL.
INS_API int ins_dds_outbox_open(ins_dds_t* dds, ins_ros_t* ros, const char* source, uint32_t size,
                                ins_dds_outbox_t** self);
/// From one thread at a time. \return 1; 0: dropped, since the queue is full.
INS_API int ins_dds_outbox_put(ins_dds_outbox_t* self, const ins_dds_message_t* message);
/// From any thread.
INS_API void ins_dds_outbox_counts(ins_dds_outbox_t* self, ins_dds_outbox_counts_t* out);
/// Publishes what waits, and ends. NULL is allowed. \param[out] counts  the last; may be NULL.
INS_API void ins_dds_outbox_close(ins_dds_outbox_t* self, ins_dds_outbox_counts_t* counts);

#ifdef __cplusplus
}
#endif
#endif // INS_DDS_OUTBOX_H_INCLUDED
