/// \file   ros.c
/// \brief  A ROS 2 node made of DDS entities: topics, writers, type hashes, ros_discovery_info.
/// SPDX-License-Identifier: MIT
#include "ros_internal.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define INFO_TOPIC "ros_discovery_info"
#define INFO_HASH  "RIHS01_e725f4a506958c79f95dd693b965722c57b19cd18e7eff984f49561b93dc985d"

/// Of each topic; the hashes are those of the message definitions from Iron on (REP 2016), unchanged since Humble.
static const struct
{
    const char* name;
    const dds_topic_descriptor_t* type;
    const char* hash;
} kinds[INS_ROS_TOPICS] = {
    {"imu/data", &sensor_msgs_msg_dds__Imu__desc,
     "RIHS01_7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b"},
    {"gnss/fix", &sensor_msgs_msg_dds__NavSatFix__desc,
     "RIHS01_62223ab3fe210a15976021da7afddc9e200dc9ec75231c1b6a557fc598a65404"},
    {"odometry", &nav_msgs_msg_dds__Odometry__desc,
     "RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0"},
    {"twist", &geometry_msgs_msg_dds__TwistWithCovarianceStamped__desc,
     "RIHS01_77b67434531e6529b7a0091357b186b6ebdb17fd9ffd3e0c7ce9d3fb11a44563"},
    {"/tf", &tf2_msgs_msg_dds__TFMessage__desc,
     "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"},
    {"/diagnostics", &diagnostic_msgs_msg_dds__DiagnosticArray__desc,
     "RIHS01_5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e"},
};

struct ins_ros_t
{
    dds_place_t place;
    dds_entity_t writer[INS_ROS_TOPICS]; ///< 0: not published
    uint32_t decimate[INS_ROS_TOPICS];
    uint64_t seen[INS_ROS_TOPICS]; ///< instants that the topic could have carried
    dds_entity_t info;
    char name_space[INS_ROS_NAME_MAX + 1];
    char node[INS_ROS_NAME_MAX + 1];
    ros_frame_t frame;
};

void ins_ros_config_default(ins_ros_config_t* cfg)
{
    memset(cfg, 0, sizeof *cfg);
    ins_dds_config_default(&cfg->dds);
    cfg->dds.domain = INS_ROS_DOMAIN_ENV;
    cfg->node = "libins";
    cfg->name_space = "/";
    cfg->odom = "odom";
    cfg->base = "base_link";
    cfg->imu = "imu_link";
    cfg->gid_octets = ROS_GID;
    for (int i = 0; i < INS_ROS_TOPICS; i++)
    {
        cfg->topic[i].name = kinds[i].name;
        cfg->topic[i].decimate = 1;
        (void)ins_dds_qos_profile("default", &cfg->topic[i].qos);
        cfg->topic[i].qos.deadline_s = 0; // instants may lack what a topic says
    }
}

/// Names of ROS: letters, digits and _, no digit first, with '/' between them where `path` is set.
static int is_name(const char* text, int path)
{
    int first = 1;
    for (const char* c = text; *c != '\0'; c++)
    {
        const int letter = (*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || *c == '_';
        const int digit = *c >= '0' && *c <= '9';
        if (*c == '/' && path && !first)
        {
            first = 1;
            continue;
        }
        if (!(letter || (digit && !first)))
        {
            return 0;
        }
        first = 0;
    }
    return !first;
}

static int fits(const char* what, const char* text, int good)
{
    if (text == NULL || strlen(text) > INS_ROS_NAME_MAX || !good)
    {
        return dds_fail(INS_DDS_E_ARGUMENT,
                        "the ROS %s '%s' is no name: letters, digits and _ make it, no digit first, at most %d octets",
                        what, text == NULL ? "" : text, INS_ROS_NAME_MAX);
    }
    return INS_DDS_OK;
}

static int check(const ins_ros_config_t* cfg)
{
    const char* const space = cfg->name_space;
    int status = fits("node", cfg->node, cfg->node != NULL && is_name(cfg->node, 0));
    status =
        status != INS_DDS_OK
            ? status
            : fits("namespace", space, space != NULL && space[0] == '/' && (space[1] == '\0' || is_name(space + 1, 1)));
    const char* const frames[3] = {cfg->odom, cfg->base, cfg->imu};
    for (int i = 0; i < 3 && status == INS_DDS_OK; i++)
    {
        status = fits("frame", frames[i], frames[i] != NULL && is_name(frames[i], 1));
    }
    for (int i = 0; i < INS_ROS_TOPICS && status == INS_DDS_OK; i++)
    {
        const char* const name = cfg->topic[i].name;
        if (name != NULL)
        {
            status = fits("topic", name, is_name(name[0] == '/' ? name + 1 : name, 1));
            status = status == INS_DDS_OK ? dds_check_topic(&cfg->topic[i], kinds[i].name) : status;
        }
    }
    if (status == INS_DDS_OK && cfg->gid_octets != 0 && cfg->gid_octets != ROS_GID)
    {
        status = dds_fail(INS_DDS_E_ARGUMENT, "ids of ros_discovery_info have 16 octets (0: none is published), not %u",
                          (unsigned)cfg->gid_octets);
    }
    if (status == INS_DDS_OK &&
        !(cfg->rate_sigma >= 0 && cfg->rate_sigma <= 1e6 && cfg->force_sigma >= 0 && cfg->force_sigma <= 1e6))
    {
        status = dds_fail(INS_DDS_E_ARGUMENT, "rate_sigma and force_sigma must be 0 to 1e6");
    }
    return status;
}

/// \param[out] domain  that of ROS_DOMAIN_ID where the configuration leaves it to the environment.
static int choose_domain(uint32_t wanted, uint32_t* domain)
{
    *domain = wanted;
    if (wanted != INS_ROS_DOMAIN_ENV)
    {
        return INS_DDS_OK;
    }
    const char* const text = getenv("ROS_DOMAIN_ID");
    *domain = 0;
    if (text == NULL || text[0] == '\0')
    {
        return INS_DDS_OK;
    }
    char* end = NULL;
    errno = 0;
    const long value = strtol(text, &end, 10);
    if (errno != 0 || *end != '\0' || value < 0 || value > INS_DDS_DOMAIN_MAX)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "ROS_DOMAIN_ID is '%s': set it to 0 to %d, or unset it", text,
                        INS_DDS_DOMAIN_MAX);
    }
    *domain = (uint32_t)value;
    return INS_DDS_OK;
}

/// "typehash=...;" belongs to the writer; rmw_cyclonedds warns at each sample without it (ros2/rmw_cyclonedds#567).
static dds_entity_t create_writer(const ins_ros_t* self, const ins_dds_config_t* dds, const char* name,
                                  const dds_topic_descriptor_t* type, const char* hash, const ins_dds_qos_t* want)
{
    char user[128];
    const int length = snprintf(user, sizeof user, "typehash=%s;", hash);
    dds_qos_t* qos = dds_quality(dds, want, 1);
    dds_qset_userdata(qos, user, (size_t)length);
    const dds_entity_t topic = dds_create_topic(self->place.participant, type, name, NULL, NULL);
    const dds_entity_t writer = topic < 0 ? topic : dds_create_writer(self->place.participant, topic, qos, NULL);
    dds_delete_qos(qos);
    return writer;
}

static int create_topics(ins_ros_t* self, const ins_ros_config_t* cfg, const ins_dds_config_t* dds)
{
    for (int i = 0; i < INS_ROS_TOPICS; i++)
    {
        const char* const name = cfg->topic[i].name;
        if (name == NULL)
        {
            continue;
        }
        char full[2 * INS_ROS_NAME_MAX + 8];
        const char* const space = self->name_space[1] == '\0' ? "" : self->name_space;
        (void)snprintf(full, sizeof full, "rt%s%s%s", name[0] == '/' ? "" : space, name[0] == '/' ? "" : "/", name);
        self->decimate[i] = cfg->topic[i].decimate;
        self->writer[i] = create_writer(self, dds, full, kinds[i].type, kinds[i].hash, &cfg->topic[i].qos);
        if (self->writer[i] < 0)
        {
            return dds_refused(&self->place, full, self->writer[i]);
        }
    }
    return INS_DDS_OK;
}

static int gid_of(dds_entity_t entity, rmw_dds_common_msg_dds__Gid_* out)
{
    dds_guid_t guid;
    const dds_return_t code = dds_get_guid(entity, &guid);
    memcpy(out->data, guid.v, sizeof out->data);
    return code;
}

/// Says once, to whoever comes later too, which node this participant is and which topics are its own.
static int introduce(ins_ros_t* self, const ins_dds_config_t* dds)
{
    rmw_dds_common_msg_dds__Gid_ writers[INS_ROS_TOPICS];
    rmw_dds_common_msg_dds__NodeEntitiesInfo_ node;
    rmw_dds_common_msg_dds__ParticipantEntitiesInfo_ info;
    memset(&node, 0, sizeof node);
    memset(&info, 0, sizeof info);
    ins_dds_qos_t latched;
    (void)ins_dds_qos_profile("latched", &latched);
    self->info = create_writer(self, dds, INFO_TOPIC, &rmw_dds_common_msg_dds__ParticipantEntitiesInfo__desc, INFO_HASH,
                               &latched);
    dds_return_t code = self->info;
    code = code < 0 ? code : gid_of(self->place.participant, &info.gid);
    uint32_t count = 0;
    for (int i = 0; i < INS_ROS_TOPICS && code >= 0; i++)
    {
        if (self->writer[i] > 0)
        {
            code = gid_of(self->writer[i], &writers[count++]);
        }
    }
    node.node_namespace = self->name_space;
    node.node_name = self->node;
    node.writer_gid_seq._maximum = node.writer_gid_seq._length = count;
    node.writer_gid_seq._buffer = writers;
    info.node_entities_info_seq._maximum = info.node_entities_info_seq._length = 1;
    info.node_entities_info_seq._buffer = &node;
    code = code < 0 ? code : dds_write(self->info, &info);
    return code < 0 ? dds_refused(&self->place, INFO_TOPIC, code) : INS_DDS_OK;
}

int ins_ros_open(const ins_ros_config_t* cfg, ins_ros_t** out)
{
    *out = NULL;
    ins_dds_config_t dds = cfg->dds;
    int status = check(cfg);
    status = status == INS_DDS_OK ? choose_domain(cfg->dds.domain, &dds.domain) : status;
    if (status != INS_DDS_OK)
    {
        return status;
    }
    ins_ros_t* self = calloc(1, sizeof *self);
    if (self == NULL)
    {
        return dds_fail(INS_DDS_E_DDS, "memory is out");
    }
    (void)snprintf(self->name_space, sizeof self->name_space, "%s", cfg->name_space);
    (void)snprintf(self->node, sizeof self->node, "%s", cfg->node);
    (void)snprintf(self->frame.odom, sizeof self->frame.odom, "%s", cfg->odom);
    (void)snprintf(self->frame.base, sizeof self->frame.base, "%s", cfg->base);
    (void)snprintf(self->frame.imu, sizeof self->frame.imu, "%s", cfg->imu);
    self->frame.rate_variance = cfg->rate_sigma * cfg->rate_sigma;
    self->frame.force_variance = cfg->force_sigma * cfg->force_sigma;
    status = dds_place_open(&self->place, &dds, "enclave=/;");
    status = status == INS_DDS_OK ? create_topics(self, cfg, &dds) : status;
    status = status == INS_DDS_OK && cfg->gid_octets != 0 ? introduce(self, &dds) : status;
    if (status != INS_DDS_OK)
    {
        ins_ros_close(self);
        return status;
    }
    dds_place_ready(&self->place);
    *out = self;
    return INS_DDS_OK;
}

/// Whether the topic takes this instant, which could go onto it.
static int due(ins_ros_t* self, ins_ros_topic_t topic)
{
    return self->writer[topic] > 0 && self->seen[topic]++ % self->decimate[topic] == 0;
}

static int write_message(const ins_ros_t* self, ins_ros_topic_t topic, const void* message)
{
    const dds_return_t code = dds_write(self->writer[topic], message);
    return code < 0 ? dds_fail(INS_DDS_E_DDS, "DDS could not publish %s: %s", kinds[topic].name, dds_strretcode(code))
                    : INS_DDS_OK;
}

int ins_ros_publish(ins_ros_t* self, const ins_navigation_t* from)
{
    ros_instant_t at;
    int status = ros_instant(&self->frame, from, &at);
    const uint32_t sensor = INS_NAVIGATION_ATTITUDE | INS_NAVIGATION_RATE | INS_NAVIGATION_FORCE;
    const uint32_t moving = INS_NAVIGATION_ATTITUDE | INS_NAVIGATION_VELOCITY;
    const uint32_t pose = moving | INS_NAVIGATION_POSITION;
    if (status == INS_DDS_OK && (from->valid & sensor) != 0 && due(self, INS_ROS_IMU))
    {
        sensor_msgs_msg_dds__Imu_ imu;
        ros_imu(&self->frame, from, &at, &imu);
        status = write_message(self, INS_ROS_IMU, &imu);
    }
    if (status == INS_DDS_OK && (from->valid & INS_NAVIGATION_POSITION) != 0 && due(self, INS_ROS_FIX))
    {
        sensor_msgs_msg_dds__NavSatFix_ fix;
        ros_fix(&self->frame, from, &at, &fix);
        status = write_message(self, INS_ROS_FIX, &fix);
    }
    if (status == INS_DDS_OK && (from->valid & pose) == pose && due(self, INS_ROS_ODOMETRY))
    {
        nav_msgs_msg_dds__Odometry_ odometry;
        ros_odometry(&self->frame, from, &at, &odometry);
        status = write_message(self, INS_ROS_ODOMETRY, &odometry);
    }
    if (status == INS_DDS_OK && (from->valid & moving) == moving && due(self, INS_ROS_TWIST))
    {
        geometry_msgs_msg_dds__TwistWithCovarianceStamped_ twist;
        ros_twist(&self->frame, from, &at, &twist);
        status = write_message(self, INS_ROS_TWIST, &twist);
    }
    if (status == INS_DDS_OK && (from->valid & INS_NAVIGATION_ATTITUDE) != 0 && due(self, INS_ROS_TF))
    {
        geometry_msgs_msg_dds__TransformStamped_ transform;
        ros_transform(&self->frame, from, &at, &transform);
        tf2_msgs_msg_dds__TFMessage_ message;
        memset(&message, 0, sizeof message);
        message.transforms._maximum = message.transforms._length = 1;
        message.transforms._buffer = &transform;
        status = write_message(self, INS_ROS_TF, &message);
    }
    return status;
}

int ins_ros_diagnose(ins_ros_t* self, int64_t time_ns, int level, const char* text, const ins_ros_value_t* values,
                     uint32_t count)
{
    enum
    {
        VALUES_MAX = 64
    };
    if (level < INS_ROS_LEVEL_OK || level > INS_ROS_LEVEL_STALE || count > VALUES_MAX)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "a diagnosis has a level of 0 to 3 and at most %d values", VALUES_MAX);
    }
    if (!due(self, INS_ROS_DIAGNOSTICS))
    {
        return INS_DDS_OK;
    }
    diagnostic_msgs_msg_dds__KeyValue_ pairs[VALUES_MAX];
    for (uint32_t i = 0; i < count; i++)
    {
        pairs[i].key = (char*)(uintptr_t)values[i].key;
        pairs[i].value = (char*)(uintptr_t)values[i].value;
    }
    char name[INS_ROS_NAME_MAX + 16];
    (void)snprintf(name, sizeof name, "%s: navigation", self->node);
    diagnostic_msgs_msg_dds__DiagnosticStatus_ status;
    diagnostic_msgs_msg_dds__DiagnosticArray_ message;
    memset(&status, 0, sizeof status);
    memset(&message, 0, sizeof message);
    status.level = (uint8_t)level;
    status.name = name;
    status.message = (char*)(uintptr_t)text;
    status.hardware_id = self->node;
    status.values._maximum = status.values._length = count;
    status.values._buffer = pairs;
    message.header.stamp = ros_time(time_ns);
    message.header.frame_id = "";
    message.status._maximum = message.status._length = 1;
    message.status._buffer = &status;
    return write_message(self, INS_ROS_DIAGNOSTICS, &message);
}

int ins_ros_matched(ins_ros_t* self, ins_ros_topic_t topic)
{
    if ((unsigned)topic >= INS_ROS_TOPICS || self->writer[topic] <= 0)
    {
        return 0;
    }
    const dds_return_t readers = dds_get_matched_subscriptions(self->writer[topic], NULL, 0);
    return readers < 0 ? dds_fail(INS_DDS_E_DDS, "DDS could not tell its peers: %s", dds_strretcode(readers)) : readers;
}

void ins_ros_close(ins_ros_t* self)
{
    if (self != NULL)
    {
        dds_place_close(&self->place);
        free(self);
    }
}
