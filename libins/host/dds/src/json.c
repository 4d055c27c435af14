/// \file   json.c
/// \brief  A sample of any topic as one line of JSON.
/// SPDX-License-Identifier: MIT
#include "dds_internal.h"
#include "json_writer.h"
#include <inttypes.h>

#define CASE(name, value, text)                                                                                        \
    case name:                                                                                                         \
        return text;
#define NAME(function, LIST)                                                                                           \
    static const char* function(uint32_t value)                                                                        \
    {                                                                                                                  \
        switch (value)                                                                                                 \
        {                                                                                                              \
            LIST(CASE)                                                                                                 \
        default:                                                                                                       \
            return "unknown"; /* of a newer publisher */                                                               \
        }                                                                                                              \
    }
NAME(clock_name, INS_NAVIGATION_CLOCK_LIST)
NAME(mode_name, INS_DDS_MODE_LIST)
NAME(measured_name, INS_DDS_MEASURED_LIST)
NAME(verdict_name, INS_DDS_VERDICT_LIST)
#define BIT(name, value, text) comma = json_bit(w, bits, (uint32_t)(value), comma, text);

/// A source id comes from the network.
static void put_text(json_writer_t* w, const char* text)
{
    json_put(w, "\"");
    for (; *text != '\0'; text++)
    {
        const unsigned char c = (unsigned char)*text;
        json_put(w, c < 0x20 ? "\\u%04x" : c == '"' || c == '\\' ? "\\%c" : "%c", c);
    }
    json_put(w, "\"");
}

static void put_real(json_writer_t* w, const char* name, double value)
{
    json_put(w, ",\"%s\":", name);
    json_real(w, value);
}

static void put_count(json_writer_t* w, const char* name, uint64_t value)
{
    json_put(w, ",\"%s\":%" PRIu64, name, value);
}

/// No comma before it.
static void put_time(json_writer_t* w, int64_t time_ns, uint32_t time_base)
{
    json_put(w, "\"time_ns\":%" PRId64 ",\"time_base\":\"%s\"", time_ns, clock_name(time_base));
}

static void put_navigation(json_writer_t* w, const ins_navigation_t* from)
{
    const uint32_t bits = from->valid;
    const char* comma = "";
    json_put(w, ",\"navigation\":{");
    put_time(w, from->time_ns, from->time_base);
    json_put(w, ",\"valid\":[");
    INS_NAVIGATION_VALID_LIST(BIT)
    json_put(w, "]");
    json_reals(w, "f_b", from->f_b, 3);
    json_reals(w, "v_n", from->v_n, 3);
    json_reals(w, "llh", from->llh, 3);
    if ((bits & INS_NAVIGATION_COVARIANCE) != 0)
    {
        double triangle[DDS_TRIANGLE];
        dds_triangle(from->P, triangle);
        json_reals(w, "P", triangle, DDS_TRIANGLE);
    }
    json_put(w, "}");
}

static void put_status(json_writer_t* w, const ins_dds_status_t* from)
{
    const uint32_t bits = from->alerts;
    const char* comma = "";
    put_time(w, from->time_ns, from->time_base);
    json_put(w, ",\"mode\":\"%s\",\"alerts\":[", mode_name(from->mode));
    INS_DDS_ALERT_LIST(BIT)
    json_put(w, "]");
    put_real(w, "sigma_horizontal_m", from->sigma_horizontal_m);
    put_real(w, "sigma_vertical_m", from->sigma_vertical_m);
    put_real(w, "sigma_heading_rad", from->sigma_heading_rad);
    put_real(w, "fix_age_s", from->fix_age_s);
    put_count(w, "sats", from->sats);
    put_count(w, "fixes", from->fixes);
    put_count(w, "position_refused", from->position_refused);
    put_count(w, "velocity_refused", from->velocity_refused);
    put_count(w, "aid_refused", from->aid_refused);
    put_count(w, "imu_refused", from->imu_refused);
    put_count(w, "published", from->published);
    put_count(w, "dropped", from->dropped);
    json_link(w, &from->counts);
}

static void put_innovations(json_writer_t* w, const ins_dds_innovations_t* from)
{
    const int size = from->size < 3 ? (int)from->size : 3;
    put_time(w, from->time_ns, from->time_base);
    json_put(w, ",\"kind\":\"%s\",\"verdict\":\"%s\"", measured_name(from->kind), verdict_name(from->verdict));
    json_reals(w, "innovation", from->innovation, size);
    json_reals(w, "sigma", from->sigma, size);
    put_real(w, "nis", from->nis);
}

static void put_raw_imu(json_writer_t* w, const ins_dds_raw_imu_t* from)
{
    put_time(w, from->time_ns, from->time_base);
    json_put(w, ",\"increments\":%s", from->increments != 0 ? "true" : "false");
    put_count(w, "index", from->index);
    put_real(w, "t_s", from->t_s);
    put_real(w, "dt_s", from->dt_s);
    json_reals(w, "gyro_b", from->gyro_b, 3);
    json_reals(w, "accel_b", from->accel_b, 3);
    put_real(w, "temperature_k", from->temperature_k);
}

size_t ins_dds_sample_json(const ins_dds_sample_t* sample, char* buffer, size_t size)
{
    json_writer_t w = {buffer, size};
    json_put(&w, "{\"source\":");
    put_text(&w, sample->source);
    json_put(&w, ",\"published_ns\":%" PRId64 ",", sample->published_ns);
    switch (sample->kind)
    {
    case INS_DDS_SOLUTION:
        json_solution(&w, &sample->solution);
        break;
    case INS_DDS_STATUS:
        put_status(&w, &sample->status);
        break;
    case INS_DDS_INNOVATIONS:
        put_innovations(&w, &sample->innovations);
        break;
    case INS_DDS_RAW_IMU:
        put_raw_imu(&w, &sample->raw_imu);
        break;
    case INS_DDS_STATE:
    case INS_DDS_STATE_DECIMATED:
    case INS_DDS_KINDS:
        json_state(&w, &sample->state);
        put_navigation(&w, &sample->navigation);
        break;
    }
    return json_end(&w, buffer);
}
