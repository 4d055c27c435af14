/// \file   convert.c
/// \brief  The structs of C <-> the messages of idl/libins.idl.
/// SPDX-License-Identifier: MIT
#include "dds_internal.h"
#include <string.h>

// FIELD copies a member, ARRAY an array; both are of the same type on both sides.
// clang-format off
#define COUNT_FIELDS(FIELD)       \
    FIELD(counts.accepted)        \
    FIELD(counts.lost)            \
    FIELD(counts.invalid)         \
    FIELD(counts.duplicates)      \
    FIELD(counts.corrupt)         \
    FIELD(counts.timeouts)        \
    FIELD(counts.stray)

#define STATE_FIELDS(FIELD, ARRAY) \
    FIELD(index)                  \
    FIELD(t_s)                    \
    ARRAY(euler_rad)              \
    ARRAY(dtheta_b)               \
    FIELD(seq)                    \
    FIELD(bridged)                \
    FIELD(status)                 \
    FIELD(used)                   \
    FIELD(missed)                 \
    COUNT_FIELDS(FIELD)

#define NAVIGATION_FIELDS(FIELD, ARRAY) \
    FIELD(time_ns)                \
    FIELD(time_base)              \
    FIELD(valid)                  \
    ARRAY(q_nb)                   \
    ARRAY(w_ib_b)                 \
    ARRAY(f_b)                    \
    ARRAY(v_n)                    \
    ARRAY(llh)

#define SOLUTION_FIELDS(FIELD, ARRAY) \
    FIELD(index)                  \
    FIELD(t_s)                    \
    ARRAY(q_nb)                   \
    ARRAY(euler_rad)              \
    ARRAY(en_m)                   \
    ARRAY(lat_lon_rad)            \
    ARRAY(v_en_m_s)               \
    FIELD(fix_age_s)              \
    FIELD(sats)                   \
    FIELD(zone)                   \
    FIELD(seq)                    \
    FIELD(lost)                   \
    FIELD(status)                 \
    COUNT_FIELDS(FIELD)

#define STATUS_FIELDS(FIELD, ARRAY) \
    FIELD(time_ns)                \
    FIELD(time_base)              \
    FIELD(mode)                   \
    FIELD(alerts)                 \
    FIELD(sigma_horizontal_m)     \
    FIELD(sigma_vertical_m)       \
    FIELD(sigma_heading_rad)      \
    FIELD(fix_age_s)              \
    FIELD(sats)                   \
    FIELD(fixes)                  \
    FIELD(position_refused)       \
    FIELD(velocity_refused)       \
    FIELD(aid_refused)            \
    FIELD(imu_refused)            \
    FIELD(published)              \
    FIELD(dropped)                \
    COUNT_FIELDS(FIELD)

#define INNOVATIONS_FIELDS(FIELD, ARRAY) \
    FIELD(time_ns)                \
    FIELD(time_base)              \
    FIELD(kind)                   \
    FIELD(verdict)                \
    FIELD(size)                   \
    ARRAY(innovation)             \
    ARRAY(sigma)                  \
    FIELD(nis)

#define RAW_IMU_FIELDS(FIELD, ARRAY) \
    FIELD(time_ns)                \
    FIELD(time_base)              \
    FIELD(increments)             \
    FIELD(index)                  \
    FIELD(t_s)                    \
    FIELD(dt_s)                   \
    ARRAY(gyro_b)                 \
    ARRAY(accel_b)                \
    FIELD(temperature_k)
// clang-format on

#define FIELD(name) to->name = from->name;
#define ARRAY(name) memcpy(to->name, from->name, sizeof to->name);
#define BOTH_WAYS(word, type, message, FIELDS)                                                                         \
    void dds_from_##word(const type* from, message* to)                                                                \
    {                                                                                                                  \
        FIELDS(FIELD, ARRAY)                                                                                           \
    }                                                                                                                  \
    static void to_##word(const message* from, type* to)                                                               \
    {                                                                                                                  \
        FIELDS(FIELD, ARRAY)                                                                                           \
    }
BOTH_WAYS(solution, ins_nav_solution_t, libins_NavSolution, SOLUTION_FIELDS)
BOTH_WAYS(status, ins_dds_status_t, libins_Status, STATUS_FIELDS)
BOTH_WAYS(innovations, ins_dds_innovations_t, libins_Innovations, INNOVATIONS_FIELDS)
BOTH_WAYS(raw_imu, ins_dds_raw_imu_t, libins_RawImu, RAW_IMU_FIELDS)

void dds_triangle(const double* P, double* triangle)
{
    for (int i = 0; i < INS_NAVIGATION_P; i++)
    {
        for (int j = i; j < INS_NAVIGATION_P; j++)
        {
            *triangle++ = P[INS_NAVIGATION_P * i + j];
        }
    }
}

static void square(const double* triangle, double* P)
{
    for (int i = 0; i < INS_NAVIGATION_P; i++)
    {
        for (int j = i; j < INS_NAVIGATION_P; j++)
        {
            P[INS_NAVIGATION_P * i + j] = P[INS_NAVIGATION_P * j + i] = *triangle++;
        }
    }
}

/// q_nb and w_ib_b are in the message once.
void dds_from_state(const ins_nav_state_t* state, const ins_navigation_t* navigation, libins_NavState* to)
{
    {
        const ins_nav_state_t* const from = state;
        STATE_FIELDS(FIELD, ARRAY)
    }
    const ins_navigation_t* const from = navigation;
    NAVIGATION_FIELDS(FIELD, ARRAY)
    if ((from->valid & INS_NAVIGATION_COVARIANCE) != 0)
    {
        dds_triangle(from->P, to->P);
    }
}

static void to_state(const libins_NavState* from, ins_nav_state_t* to)
{
    STATE_FIELDS(FIELD, ARRAY)
    ARRAY(q_nb)
    ARRAY(w_ib_b)
}

static void to_navigation(const libins_NavState* from, ins_navigation_t* to)
{
    NAVIGATION_FIELDS(FIELD, ARRAY)
    square(from->P, to->P);
}

void dds_to_sample(const ins_dds_t* self, int at, ins_dds_sample_t* sample)
{
#define CASE(kind, word)                                                                                               \
    case kind:                                                                                                         \
        memcpy(sample->source, self->taken.word[at].source, sizeof sample->source);                                    \
        if (sample->valid)                                                                                             \
        {                                                                                                              \
            sample->published_ns = self->taken.word[at].published_ns;                                                  \
            to_##word(&self->taken.word[at], &sample->word);                                                           \
        }                                                                                                              \
        break;
    switch (sample->kind)
    {
        CASE(INS_DDS_SOLUTION, solution)
        CASE(INS_DDS_STATUS, status)
        CASE(INS_DDS_INNOVATIONS, innovations)
        CASE(INS_DDS_RAW_IMU, raw_imu)
    case INS_DDS_STATE:
    case INS_DDS_STATE_DECIMATED:
    case INS_DDS_KINDS:
        memcpy(sample->source, self->taken.state[at].source, sizeof sample->source);
        if (sample->valid)
        {
            sample->published_ns = self->taken.state[at].published_ns;
            to_state(&self->taken.state[at], &sample->state);
            to_navigation(&self->taken.state[at], &sample->navigation);
        }
        break;
    }
}
