/// \file   ins_dds/raw.h
/// \brief  Messages as octets, for recorders and players: what is taken is published again without a look at its fields.
///
///     ins_dds_config_t cfg;
///     ins_dds_raw_topic_t topic;
///     ins_dds_raw_message_t message[64];
///     ins_dds_config_default(&cfg);
///     if (ins_dds_raw_open(&cfg, &raw) != INS_DDS_OK) { puts(ins_dds_error_text()); }
///     while (ins_dds_raw_found(raw, &topic, 1) > 0) { ins_dds_raw_subscribe(raw, &topic); }
///     int count = ins_dds_raw_take(raw, 0.1, message, 64);
///     for (int k = 0; k < count; k++) { use(message[k].octets); }
///
/// The octets are CDR with the four of its header (00 01 00 00: XCDR1, little endian), as they came. Types are those of idl/.
/// One thread at a time uses a handle.
/// SPDX-License-Identifier: MIT
#ifndef INS_DDS_RAW_H_INCLUDED
#define INS_DDS_RAW_H_INCLUDED
#include "ins_dds/dds.h"
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

#define INS_DDS_RAW_NAME   255 ///< octets of a topic's, type's or partition's name, and of USER_DATA
#define INS_DDS_RAW_TOPICS 64  ///< topics of a handle, read and written

/// How a writer offers a topic, and so how a reader must ask for it and a player offer it again.
typedef struct ins_dds_raw_topic_t
{
    char name[INS_DDS_RAW_NAME + 1];      ///< on the wire: ROS 2 topics begin with rt/
    char type[INS_DDS_RAW_NAME + 1];      ///< libins::NavState, sensor_msgs::msg::dds_::Imu_ ...
    char partition[INS_DDS_RAW_NAME + 1]; ///< its first; "": the default one
    char user[INS_DDS_RAW_NAME + 1];      ///< USER_DATA of the writer, as of ROS 2: typehash=...;
    int best_effort;                      ///< lost samples stay lost; a player sends them again all the same
    int latched;                          ///< TRANSIENT_LOCAL: who comes late gets the newest sample
    int exclusive;                        ///< EXCLUSIVE ownership, of the next strength
    int32_t strength;
    double deadline_s; ///< 0: none
} ins_dds_raw_topic_t;

typedef struct ins_dds_raw_message_t
{
    int topic;             ///< what ins_dds_raw_subscribe() gave
    int64_t published_ns;  ///< its writer's clock [ns since 1970]
    const uint8_t* octets; ///< until the next take, or close
    size_t size;
} ins_dds_raw_message_t;

typedef struct ins_dds_raw_t ins_dds_raw_t;

/// Of the configuration: domain, network, xml, security and log.
/// \return INS_DDS_OK, or an error, and then *self is NULL and nothing is left open.
INS_API int ins_dds_raw_open(const ins_dds_config_t* cfg, ins_dds_raw_t** self);
/// Writers of others that have appeared since the last call, at most max. \return how many; or an error.
INS_API int ins_dds_raw_found(ins_dds_raw_t* self, ins_dds_raw_topic_t* out, int max);
/// The type with this index, NULL beyond the last: what can be subscribed and published.
INS_API const char* ins_dds_raw_type(int index);
/// \return the index of a reader that keeps everything until it is taken; or an error.
INS_API int ins_dds_raw_subscribe(ins_dds_raw_t* self, const ins_dds_raw_topic_t* topic);
/// \return the index of a writer that waits up to 10 s for a reliable reader that does not keep up; or an error.
INS_API int ins_dds_raw_publish(ins_dds_raw_t* self, const ins_dds_raw_topic_t* topic);
/// Wait until something is there, at most timeout_s. \return messages written to out, 0 = timed out; or an error.
INS_API int ins_dds_raw_take(ins_dds_raw_t* self, double timeout_s, ins_dds_raw_message_t* out, int max);
/// \return INS_DDS_OK; INS_DDS_E_ARGUMENT: no such writer; INS_DDS_E_DDS: not CDR of its type, or a reader does not keep up.
INS_API int ins_dds_raw_write(ins_dds_raw_t* self, int topic, const uint8_t* octets, size_t size);
/// Wait until every reliable reader has everything that was written. \return INS_DDS_OK; INS_DDS_E_DDS: not within timeout_s.
INS_API int ins_dds_raw_delivered(ins_dds_raw_t* self, double timeout_s);
/// Readers or writers of others that the topic with this index is matched with; negative on error.
INS_API int ins_dds_raw_matched(ins_dds_raw_t* self, int topic);
/// NULL is allowed.
INS_API void ins_dds_raw_close(ins_dds_raw_t* self);

#ifdef __cplusplus
}
#endif
#endif // INS_DDS_RAW_H_INCLUDED
