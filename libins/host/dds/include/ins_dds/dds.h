/// \file   ins_dds/dds.h
/// \brief  Navigation states over DDS (Eclipse Cyclone DDS), types libins::NavState and libins::NavSolution of idl/libins.idl.
///         Units as in ins_nav/nav.h and ins_nav/nav_input.h.
///
///     ins_dds_config_t cfg;
///     ins_dds_config_default(&cfg);
///     if (ins_dds_open(&cfg, &dds) != INS_DDS_OK) { puts(ins_dds_error_text()); }
///     ins_dds_publish(dds, &state, "imu0", now_ns);
///     ins_dds_close(dds);
///
/// The domain is created with an explicit configuration and deleted again by ins_dds_close(): nothing of it is left in the process.
/// The default configuration sends on the loopback interface only. It limits what is sent and announced; it is no access barrier.
/// Writers are RELIABLE, KEEP_LAST, so that best-effort and reliable readers are served and a stalled reader never blocks for long.
/// One thread at a time uses a handle; open and close of different handles must not overlap.
/// SPDX-License-Identifier: MIT
#ifndef INS_DDS_DDS_H_INCLUDED
#define INS_DDS_DDS_H_INCLUDED
#include "ins_nav/nav.h"
#include "ins_nav/nav_input.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_DDS_TOPIC           "libins/nav_state"
#define INS_DDS_SOLUTION_TOPIC  "libins/nav_solution"
#define INS_DDS_SOURCE_MAX      63   ///< octets of a source id
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

/// What a handle carries.
enum
{
    INS_DDS_STATE = 0,   ///< ins_nav_state_t, as libins::NavState
    INS_DDS_SOLUTION = 1 ///< ins_nav_solution_t, as libins::NavSolution
};

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

typedef struct ins_dds_config_t
{
    uint32_t domain;       ///< 0..INS_DDS_DOMAIN_MAX
    int network;           ///< INS_DDS_LOOPBACK ...
    const char* xml;       ///< with INS_DDS_XML: a CycloneDDS XML document (text, not a file name)
    const char* interface; ///< with INS_DDS_INTERFACE: its name, such as "eth0"
    /// With INS_DDS_INTERFACE: addresses or host names, commas between, that are asked instead of multicasting; NULL: multicast. For
    /// other processes of this machine name its own address too.
    const char* peers;
    int kind;              ///< INS_DDS_STATE or INS_DDS_SOLUTION
    const char* topic;     ///< topic name; NULL = the usual one of the kind
    const char* partition; ///< NULL = the default partition
    int publishes;         ///< 1: there is a writer
    int subscribes;        ///< 1: there is a reader
    double deadline_s;     ///< writer: longest time between two samples that it promises; 0 = none
    double lease_s;        ///< writer: it counts as gone after this time without a sign of life
    uint32_t history;      ///< samples kept per source, writer and reader
    /// 0: every writer is heard. Above: of the writers of a source only the strongest alive is (EXCLUSIVE ownership), with this strength
    /// for a writer; reader and writers must all be so. A stronger one takes over at once, a weaker one lease_s after the last sign of life.
    int32_t strength;
    const ins_dds_security_t* security; ///< NULL: none, anybody who reaches the port may publish and listen
    /// Receives the lines of Cyclone's log, which is one for the process: that of the handle opened last, until it is closed. Called
    /// from any thread. NULL: they go to stderr, but for those of an open that fails, which are in the error text.
    void (*log)(void* context, const char* line);
    void* log_context;
} ins_dds_config_t;

typedef struct ins_dds_sample_t
{
    char source[INS_DDS_SOURCE_MAX + 1];
    int64_t published_ns; ///< publisher's clock at publication [ns since 1970]
    int valid; ///< 1: published_ns and state, or solution, hold a sample; 0: this only brings the news that the source is gone
    int gone;                    ///< 1: when it was taken, the last writer of this source had left or fallen silent
    ins_nav_state_t state;       ///< of a handle of INS_DDS_STATE, else 0
    ins_nav_solution_t solution; ///< of a handle of INS_DDS_SOLUTION, else 0
} ins_dds_sample_t;

typedef struct ins_dds_t ins_dds_t;

/// Domain 0, loopback, states, usual topic, no partition, publishes, deadline 1 s, lease 1 s, history 16.
INS_API void ins_dds_config_default(ins_dds_config_t* cfg);
/// The six files as `ins keys` names them in a folder.
/// \param[out] memory  [INS_DDS_SECURITY_MEMORY] holds the paths, as long as `security` is used.
/// \return INS_DDS_OK; INS_DDS_E_ARGUMENT: the name of the folder is too long.
INS_API int ins_dds_security_folder(const char* folder, ins_dds_security_t* security, char* memory);
/// \return INS_DDS_OK, or an error, and then *self is NULL and nothing is left open.
INS_API int ins_dds_open(const ins_dds_config_t* cfg, ins_dds_t** self);
/// \param[in] source id of the publishing unit, 1..INS_DDS_SOURCE_MAX octets: the key of the topic.
INS_API int ins_dds_publish(ins_dds_t* self, const ins_nav_state_t* state, const char* source, int64_t published_ns);
/// As ins_dds_publish(), with a handle of INS_DDS_SOLUTION.
INS_API int ins_dds_publish_solution(ins_dds_t* self, const ins_nav_solution_t* solution, const char* source,
                                     int64_t published_ns);
/// Wait until something is there, at most timeout_s (0 = look, do not wait). \return samples written to out, 0 = timed out; or an error.
INS_API int ins_dds_take(ins_dds_t* self, double timeout_s, ins_dds_sample_t* out, int max);
/// Readers matched with the writer plus writers matched with the reader; negative on error.
INS_API int ins_dds_matched(ins_dds_t* self);
/// NULL is allowed.
INS_API void ins_dds_close(ins_dds_t* self);
/// What the last call of this thread that failed had to say, with a remedy.
INS_API const char* ins_dds_error_text(void);

#ifdef __cplusplus
}
#endif
#endif // INS_DDS_DDS_H_INCLUDED
