/// \file   domain.c
/// \brief  The part of a DDS domain that a handle owns: the domain itself, a participant in it, and Cyclone's log.
/// SPDX-License-Identifier: MIT
#include "dds_internal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define XML_MAX       8192
#define INTERFACE_MAX 15 ///< octets of an interface's name, IFNAMSIZ - 1
#define PEERS_MAX     1024

/// Up to 61 processes of a domain on one machine. MaxAutoParticipantIndex is also the number of ports that discovery tries at each
/// peer, hence not larger.
static const char discovery_xml[] = "<Discovery><ParticipantIndex>auto</ParticipantIndex>"
                                    "<MaxAutoParticipantIndex>60</MaxAutoParticipantIndex>";

/// One interface; with peers, these and no multicast. \param[out] xml [XML_MAX]
static void interface_xml(const char* name, const char* peers, char* xml)
{
    size_t at =
        (size_t)snprintf(xml, XML_MAX,
                         "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"%s\"%s/></Interfaces>"
                         "%s</General>%s",
                         name, peers != NULL ? " multicast=\"false\"" : "",
                         peers != NULL ? "<AllowMulticast>false</AllowMulticast>" : "", discovery_xml);
    if (peers != NULL)
    {
        at += (size_t)snprintf(xml + at, XML_MAX - at, "<Peers>");
        for (size_t length; *peers != '\0'; peers += length + (peers[length] == ','))
        {
            length = strcspn(peers, ",");
            at += (size_t)snprintf(xml + at, XML_MAX - at, "<Peer address=\"%.*s\"/>", (int)length, peers);
        }
        at += (size_t)snprintf(xml + at, XML_MAX - at, "</Peers>");
    }
    (void)snprintf(xml + at, XML_MAX - at, "</Discovery></Domain></CycloneDDS>");
}

/// Names and addresses alone, so that nothing in them is XML.
static int check_interface(const ins_dds_config_t* cfg)
{
    static const char of_names[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.:";
    const char* name = cfg->interface;
    if (name == NULL || name[0] == '\0' || strlen(name) > INTERFACE_MAX || name[strspn(name, of_names)] != '\0')
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "DDS interface '%.32s': `ip link` tells the names of this machine's",
                        name != NULL ? name : "");
    }
    for (const char* peer = cfg->peers; peer != NULL;)
    {
        const size_t length = strspn(peer, of_names);
        if (length == 0 || (peer[length] != ',' && peer[length] != '\0') || strlen(peer) > PEERS_MAX)
        {
            return dds_fail(INS_DDS_E_ARGUMENT,
                            "DDS peers '%.64s': must be addresses or host names, commas between, at most %d octets",
                            cfg->peers, PEERS_MAX);
        }
        peer = peer[length] == ',' ? peer + length + 1 : NULL;
    }
    return INS_DDS_OK;
}

static int check(const ins_dds_config_t* cfg)
{
    if (cfg->domain > INS_DDS_DOMAIN_MAX)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "DDS domain id %u is out of range: use 0 to %d", (unsigned)cfg->domain,
                        INS_DDS_DOMAIN_MAX);
    }
    if (cfg->network < INS_DDS_LOOPBACK || cfg->network > INS_DDS_INTERFACE)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "unknown kind of DDS network configuration: %d", cfg->network);
    }
    if (cfg->network == INS_DDS_XML && (cfg->xml == NULL || cfg->xml[0] != '<'))
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "the DDS configuration must be an XML text that starts with <CycloneDDS>");
    }
    const char* uri = getenv("CYCLONEDDS_URI");
    if (cfg->network == INS_DDS_ENVIRONMENT && (uri == NULL || uri[0] == '\0'))
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "the DDS configuration was to come from CYCLONEDDS_URI, which is not set");
    }
    // Written so that NaN is refused.
    if (!(cfg->lease_s >= 0.01 && cfg->lease_s <= 1e6))
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "the DDS liveliness lease must be 0.01 to 1e6 s");
    }
    if (cfg->strength < 0)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "the DDS strength must be 0, for shared ownership, or more, not %d",
                        (int)cfg->strength);
    }
    return cfg->network == INS_DDS_INTERFACE ? check_interface(cfg) : INS_DDS_OK;
}

int dds_refused(const dds_place_t* self, const char* what, dds_return_t code)
{
    if (code == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY)
    {
        return dds_fail(INS_DDS_E_DDS,
                        "DDS security does not allow the %s: see --publish and --subscribe of `ins keys`", what);
    }
    return dds_fail(INS_DDS_E_DDS, "DDS refused the %s: %s%s%s", what, dds_strretcode(code),
                    self->log.text[0] != '\0' ? ": " : "", self->log.text);
}

static int create_domain(dds_place_t* self, const ins_dds_config_t* cfg)
{
    char made[XML_MAX];
    const char* xml = made;
    const int asked = cfg->network == INS_DDS_INTERFACE;
    interface_xml(asked ? cfg->interface : "lo", asked ? cfg->peers : "127.0.0.1", made);
    xml = cfg->network == INS_DDS_XML ? cfg->xml : xml;
    xml = cfg->network == INS_DDS_ENVIRONMENT ? getenv("CYCLONEDDS_URI") : xml;
    const dds_entity_t domain = dds_create_domain(cfg->domain, xml);
    if (cfg->network == INS_DDS_JOIN)
    {
        if (domain == DDS_RETCODE_PRECONDITION_NOT_MET)
        {
            return INS_DDS_OK;
        }
        if (domain > 0)
        {
            (void)dds_delete(domain);
        }
        return dds_fail(INS_DDS_E_DOMAIN,
                        "this process has no DDS domain %u to join: open it, or choose another network configuration",
                        (unsigned)cfg->domain);
    }
    if (domain > 0)
    {
        self->domain = domain;
        return INS_DDS_OK;
    }
    if (domain == DDS_RETCODE_PRECONDITION_NOT_MET)
    {
        return dds_fail(
            INS_DDS_E_DOMAIN,
            "this process already has DDS domain %u: close it, take another domain id, or open with INS_DDS_JOIN",
            (unsigned)cfg->domain);
    }
    if (strstr(self->log.text, "interface") != NULL)
    {
        return dds_fail(INS_DDS_E_NETWORK, "no network interface that DDS can use (%s): %s", self->log.text,
                        cfg->network == INS_DDS_LOOPBACK
                            ? "run `ip link set lo up`"
                            : "name one of this machine (`ip link`), or use the loopback configuration");
    }
    return cfg->network == INS_DDS_LOOPBACK ? dds_refused(self, "domain", domain)
                                            : dds_fail(INS_DDS_E_ARGUMENT, "DDS refused its configuration (%s): %s",
                                                       dds_strretcode(domain), self->log.text);
}

static int create_participant(dds_place_t* self, const ins_dds_config_t* cfg, const char* user)
{
    dds_qos_t* qos = dds_create_qos();
    if (user != NULL)
    {
        dds_qset_userdata(qos, user, strlen(user));
    }
    const int status = cfg->security != NULL ? dds_secure(cfg->security, qos) : INS_DDS_OK;
    if (status == INS_DDS_OK)
    {
        self->participant = dds_create_participant(cfg->domain, qos, NULL);
    }
    dds_delete_qos(qos);
    return self->participant < 0 ? dds_refused(self, "participant", self->participant) : status;
}

int dds_place_open(dds_place_t* self, const ins_dds_config_t* cfg, const char* user)
{
    const int fault = check(cfg);
    if (fault != INS_DDS_OK)
    {
        return fault;
    }
    (void)pthread_mutex_init(&self->log.mutex, NULL);
    self->opened = 1;
    self->log.collect = 1;
    self->log.log = cfg->log;
    self->log.log_context = cfg->log_context;
    dds_set_log_sink(dds_log_line, &self->log);
    const int status = create_domain(self, cfg);
    return status == INS_DDS_OK ? create_participant(self, cfg, user) : status;
}

void dds_place_ready(dds_place_t* self)
{
    (void)pthread_mutex_lock(&self->log.mutex);
    self->log.collect = 0;
    (void)pthread_mutex_unlock(&self->log.mutex);
    if (self->log.log == NULL)
    {
        dds_set_log_sink(NULL, NULL);
    }
    else if (self->log.text[0] != '\0')
    {
        self->log.log(self->log.log_context, self->log.text);
    }
}

void dds_place_close(dds_place_t* self)
{
    if (!self->opened)
    {
        return;
    }
    if (self->domain > 0)
    {
        (void)dds_delete(self->domain); // and all that was made in it
    }
    else if (self->participant > 0)
    {
        (void)dds_delete(self->participant);
    }
    dds_set_log_sink(NULL, NULL);
    (void)pthread_mutex_destroy(&self->log.mutex);
}

dds_duration_t dds_duration(double seconds)
{
    return (dds_duration_t)(seconds * 1e9);
}
