/// \file   ins_dds/dds.h
/// \brief  Navigation over DDS (Eclipse Cyclone DDS), types of idl/libins.idl: NavState, NavSolution, Status, Innovations, RawImu.
///         Units as in ins_nav/nav.h, ins_nav/navigation.h and ins_dds/messages.h.
///
///     ins_dds_config_t cfg;
///     ins_dds_config_default(&cfg);                   // states; ins_dds_config_carry() adds topics
///     if (ins_dds_open(&cfg, &dds) != INS_DDS_OK) { puts(ins_dds_error_text()); }
///     ins_dds_publish_navigation(dds, &state, &navigation, "imu0", now_ns);
///     ins_dds_close(dds);
///
/// The domain is created with an explicit configuration and deleted again by ins_dds_close(): nothing of it is left in the process.
/// The default configuration sends on the loopback interface only. It limits what is sent and announced; it is no access barrier.
/// Writers are RELIABLE, KEEP_LAST, so that best-effort and reliable readers are served and a stalled reader never blocks for long.
/// One thread at a time uses a handle; open and close of different handles must not overlap.
/// SPDX-License-Identifier: MIT
#ifndef INS_DDS_DDS_H_INCLUDED
#define INS_DDS_DDS_H_INCLUDED
#include "ins_dds/dds_config.h"
#include "ins_dds/messages.h"
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

#define INS_DDS_SOURCE_MAX 63 ///< octets of a source id

/// Of its kind's member alone; the others are 0.
typedef struct ins_dds_sample_t
{
    char source[INS_DDS_SOURCE_MAX + 1];
    ins_dds_kind_t kind;
    int64_t published_ns; ///< publisher's clock at publication [ns since 1970]
    int valid; ///< 1: published_ns and the kind's member hold a sample; 0: only the news that the source is gone
    int gone;  ///< 1: when it was taken, the last writer of this source had left or fallen silent
    ins_nav_state_t state; ///< of INS_DDS_STATE and INS_DDS_STATE_DECIMATED, with navigation
    ins_navigation_t navigation;
    ins_nav_solution_t solution;
    ins_dds_status_t status;
    ins_dds_innovations_t innovations;
    ins_dds_raw_imu_t raw_imu;
} ins_dds_sample_t;

typedef struct ins_dds_t ins_dds_t;

/// \return INS_DDS_OK, or an error, and then *self is NULL and nothing is left open.
INS_API int ins_dds_open(const ins_dds_config_t* cfg, ins_dds_t** self);

// Each publishes to the topic of its kind, and refuses when the handle does not carry it.

/// What a board that samples gyros knows: attitude and rate, on the publisher's clock.
/// \param[in] source  id of the publishing unit, 1..INS_DDS_SOURCE_MAX octets: the key of the topic.
INS_API int ins_dds_publish(ins_dds_t* self, const ins_nav_state_t* state, const char* source, int64_t published_ns);
/// The full state; to INS_DDS_STATE_DECIMATED too when that is carried.
/// \param[in] state  numbers, times and counts; q_nb, euler_rad and w_ib_b follow the navigation.
INS_API int ins_dds_publish_navigation(ins_dds_t* self, const ins_nav_state_t* state,
                                       const ins_navigation_t* navigation, const char* source, int64_t published_ns);
/// What a navigating board says.
INS_API int ins_dds_publish_solution(ins_dds_t* self, const ins_nav_solution_t* solution, const char* source,
                                     int64_t published_ns);
/// How far the source is to be believed.
INS_API int ins_dds_publish_status(ins_dds_t* self, const ins_dds_status_t* status, const char* source,
                                   int64_t published_ns);
/// A measurement beside what the filter expected.
INS_API int ins_dds_publish_innovations(ins_dds_t* self, const ins_dds_innovations_t* innovations, const char* source,
                                        int64_t published_ns);
/// What the sensors said.
INS_API int ins_dds_publish_raw_imu(ins_dds_t* self, const ins_dds_raw_imu_t* raw_imu, const char* source,
                                    int64_t published_ns);

/// Wait until something is there, at most timeout_s (0 = look, do not wait). Each topic comes in order, the topics by turns.
/// \return samples written to out, 0 = timed out; or an error.
INS_API int ins_dds_take(ins_dds_t* self, double timeout_s, ins_dds_sample_t* out, int max);
/// One line of JSON, ended by a newline: source, published_ns and what the kind holds; reals as %.17g, NaN as null.
/// \return its length without the final 0; 0 when it does not fit (INS_DDS_JSON_MAX always does).
INS_API size_t ins_dds_sample_json(const ins_dds_sample_t* sample, char* buffer, size_t size);
#define INS_DDS_JSON_MAX 4096
/// Readers matched with the writers plus writers matched with the readers; negative on error.
INS_API int ins_dds_matched(ins_dds_t* self);
/// NULL is allowed.
INS_API void ins_dds_close(ins_dds_t* self);
/// What the last call of this thread that failed had to say, with a remedy.
INS_API const char* ins_dds_error_text(void);

#ifdef __cplusplus
}
#endif
#endif // INS_DDS_DDS_H_INCLUDED
