/// \file   ins_dds/dds_config.h
/// \brief  What a DDS handle is to be: domain, network, security, topics and their quality of service.
/// SPDX-License-Identifier: MIT
#ifndef INS_DDS_DDS_CONFIG_H_INCLUDED
#define INS_DDS_DDS_CONFIG_H_INCLUDED
#include "ins/config.h"
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

#define INS_DDS_SECURITY_MEMORY 6144 ///< octets, for ins_dds_security_folder()
#define INS_DDS_DOMAIN_MAX      230  ///< DDS security of Cyclone 0.10 accepts no higher one

enum
{
    INS_DDS_OK = 0,
    INS_DDS_E_ARGUMENT = -1, ///< bad configuration or argument
    INS_DDS_E_DOMAIN = -2,   ///< the process already has this domain; INS_DDS_JOIN takes part in it
    INS_DDS_E_NETWORK = -3,  ///< no usable network interface
    INS_DDS_E_DDS = -4       ///< refused by Cyclone DDS
};

/// What a handle carries, each on a topic of its own: enumerator, usual topic, type of idl/libins.idl.
#define INS_DDS_KIND_LIST(X)                                                                                           \
    X(INS_DDS_STATE, "libins/nav_state", NavState)                                                                     \
    X(INS_DDS_SOLUTION, "libins/nav_solution", NavSolution)                                                            \
    X(INS_DDS_STATUS, "libins/status", Status)                                                                         \
    X(INS_DDS_INNOVATIONS, "libins/innovations", Innovations)                                                          \
    X(INS_DDS_RAW_IMU, "libins/raw_imu", RawImu)                                                                       \
    X(INS_DDS_STATE_DECIMATED, "libins/nav_state_decimated", NavState)

/// In the order of the list.
typedef enum ins_dds_kind_t
{
    INS_DDS_STATE,
    INS_DDS_SOLUTION,
    INS_DDS_STATUS,
    INS_DDS_INNOVATIONS,
    INS_DDS_RAW_IMU,
    INS_DDS_STATE_DECIMATED,
    INS_DDS_KINDS
} ins_dds_kind_t;

/// Where the domain's configuration comes from.
enum
{
    INS_DDS_LOOPBACK = 0,    ///< built in: interface lo, no multicast
    INS_DDS_XML = 1,         ///< the text in cfg.xml
    INS_DDS_ENVIRONMENT = 2, ///< the environment variable CYCLONEDDS_URI, which must be set
    INS_DDS_JOIN = 3,        ///< the process already has the domain; it is left alone on close
    INS_DDS_INTERFACE = 4    ///< cfg.interface, and cfg.peers where multicast does not pass
};

/// DDS Security 1.1: who we are, and who may do what. Paths of files; `ins keys` makes them (docs/dds_security.md).
typedef struct ins_dds_security_t
{
    const char* identity_ca;    ///< certificate of who signs the participants' certificates, PEM
    const char* certificate;    ///< our own, PEM
    const char* key;            ///< its private key, PEM
    const char* permissions_ca; ///< certificate of who signs the next two, PEM
    const char* governance;     ///< what a domain protects, signed, S/MIME
    const char* permissions;    ///< what we may publish and subscribe, signed, S/MIME
} ins_dds_security_t;

/// History is KEEP_LAST: a reader that stands still costs samples, never the writer's time.
typedef struct ins_dds_qos_t
{
    int reliable;      ///< 1: lost ones are sent again; serves readers of both kinds. 0: BEST_EFFORT
    int latched;       ///< 1: TRANSIENT_LOCAL, who comes later gets the newest; 0: VOLATILE
    uint32_t history;  ///< samples kept per source
    double deadline_s; ///< writer: longest time between two samples that it promises; 0: none
    double lifespan_s; ///< writer: what is older is not delivered; 0: does not age
} ins_dds_qos_t;

typedef struct ins_dds_topic_config_t
{
    const char* name;  ///< NULL: not carried
    uint32_t decimate; ///< writer: one of so many, the first included; 1: all
    ins_dds_qos_t qos;
} ins_dds_topic_config_t;

typedef struct ins_dds_config_t
{
    uint32_t domain;       ///< 0..INS_DDS_DOMAIN_MAX
    int network;           ///< INS_DDS_LOOPBACK ...
    const char* xml;       ///< with INS_DDS_XML: a CycloneDDS XML document (text, not a file name)
    const char* interface; ///< with INS_DDS_INTERFACE: its name, such as "eth0"
    /// With INS_DDS_INTERFACE: addresses or host names, commas between, that are asked instead of multicasting; NULL: multicast. For
    /// other processes of this machine name its own address too.
    const char* peers;
    const char* partition; ///< NULL = the default partition
    int publishes;         ///< 1: each topic has a writer
    int subscribes;        ///< 1: each topic has a reader
    ins_dds_topic_config_t topic[INS_DDS_KINDS];
    double lease_s; ///< writer: it counts as gone after this time without a sign of life
    /// 0: every writer is heard. Above: of the writers of a source only the strongest alive is (EXCLUSIVE ownership), with this strength
    /// for a writer; reader and writers must all be so. A stronger one takes over at once, a weaker one lease_s after the last sign of life.
    int32_t strength;
    const ins_dds_security_t* security; ///< NULL: none, anybody who reaches the port may publish and listen
    /// Receives the lines of Cyclone's log, which is one for the process: that of the handle opened last, until it is closed. Called
    /// from any thread. NULL: they go to stderr, but for those of an open that fails, which are in the error text.
    void (*log)(void* context, const char* line);
    void* log_context;
} ins_dds_config_t;

/// Domain 0, loopback, states on their usual topic, no partition, publishes, lease 1 s; "latched" for status, else "default".
INS_API void ins_dds_config_default(ins_dds_config_t* cfg);
/// One topic more, with its usual name.
INS_API void ins_dds_config_carry(ins_dds_config_t* cfg, ins_dds_kind_t kind);
/// A profile by its name: default, sensor_data, latched, reliable (docs/dds.md says what they hold).
/// \return INS_DDS_OK; INS_DDS_E_ARGUMENT: there is none of that name; the error text lists them.
INS_API int ins_dds_qos_profile(const char* name, ins_dds_qos_t* qos);
/// One topic's profile from a text such as "nav_state=sensor_data": the usual name without "libins/", then the profile's.
/// \return INS_DDS_OK; INS_DDS_E_ARGUMENT: no such topic or profile; the error text lists them.
INS_API int ins_dds_config_qos(ins_dds_config_t* cfg, const char* choice);
/// The six files as `ins keys` names them in a folder; or, with commas between, the six paths in the order of ins_dds_security_t.
/// \param[out] memory  [INS_DDS_SECURITY_MEMORY] holds the paths, as long as `security` is used.
/// \return INS_DDS_OK; INS_DDS_E_ARGUMENT: the name of the folder is too long.
INS_API int ins_dds_security_folder(const char* folder, ins_dds_security_t* security, char* memory);

#ifdef __cplusplus
}
#endif
#endif // INS_DDS_DDS_CONFIG_H_INCLUDED
