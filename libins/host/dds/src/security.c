/// \file   security.c
/// \brief  The built-in plugins of DDS Security, as Cyclone DDS has them, for a participant.
/// Source: OMG DDS Security 1.1 (formal/2018-04-01), 8.3 to 8.5 and tables 45, 63 (names of the properties).
/// SPDX-License-Identifier: MIT
#include "dds_internal.h"
#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#define FILES           6
#define PATH_MAX_OCTETS (INS_DDS_SECURITY_MEMORY / FILES - 1)

static const char* const plugins[][2] = {
    {"dds.sec.auth.library.path", "dds_security_auth"},
    {"dds.sec.auth.library.init", "init_authentication"},
    {"dds.sec.auth.library.finalize", "finalize_authentication"},
    {"dds.sec.crypto.library.path", "dds_security_crypto"},
    {"dds.sec.crypto.library.init", "init_crypto"},
    {"dds.sec.crypto.library.finalize", "finalize_crypto"},
    {"dds.sec.access.library.path", "dds_security_ac"},
    {"dds.sec.access.library.init", "init_access_control"},
    {"dds.sec.access.library.finalize", "finalize_access_control"},
};

/// Cyclone says only "Error" for a file that is not there.
static int readable(const char* what, const char* path)
{
    FILE* file = path != NULL ? fopen(path, "r") : NULL;
    if (file == NULL)
    {
        return dds_fail(INS_DDS_E_ARGUMENT, "DDS security: the %s cannot be read: %s: %s; `ins keys` makes these files",
                        what, path != NULL ? path : "no file named", path != NULL ? strerror(errno) : "name it");
    }
    (void)fclose(file);
    return INS_DDS_OK;
}

int dds_secure(const ins_dds_security_t* security, dds_qos_t* qos)
{
    const struct
    {
        const char* property;
        const char* what;
        const char* path;
    } files[] = {
        {"dds.sec.auth.identity_ca", "identity CA", security->identity_ca},
        {"dds.sec.auth.identity_certificate", "certificate", security->certificate},
        {"dds.sec.auth.private_key", "private key", security->key},
        {"dds.sec.access.permissions_ca", "permissions CA", security->permissions_ca},
        {"dds.sec.access.governance", "governance", security->governance},
        {"dds.sec.access.permissions", "permissions", security->permissions},
    };
    for (size_t i = 0; i < sizeof plugins / sizeof plugins[0]; i++)
    {
        dds_qset_prop(qos, plugins[i][0], plugins[i][1]);
    }
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
    {
        char uri[PATH_MAX_OCTETS + 8];
        const int status = readable(files[i].what, files[i].path);
        if (status != INS_DDS_OK)
        {
            return status;
        }
        if (strlen(files[i].path) > PATH_MAX_OCTETS)
        {
            return dds_fail(INS_DDS_E_ARGUMENT, "DDS security: the path of the %s is longer than %d octets",
                            files[i].what, PATH_MAX_OCTETS);
        }
        (void)snprintf(uri, sizeof uri, "file:%s", files[i].path);
        dds_qset_prop(qos, files[i].property, uri);
    }
    return INS_DDS_OK;
}

int ins_dds_security_folder(const char* folder, ins_dds_security_t* security, char* memory)
{
    const struct
    {
        const char* name;
        const char** path;
    } files[FILES] = {
        {"identity_ca.pem", &security->identity_ca},
        {"certificate.pem", &security->certificate},
        {"key.pem", &security->key},
        {"permissions_ca.pem", &security->permissions_ca},
        {"governance.p7s", &security->governance},
        {"permissions.p7s", &security->permissions},
    };
    const int listed = strchr(folder, ',') != NULL;
    for (int i = 0; i < FILES; i++)
    {
        char* const path = memory + (ptrdiff_t)i * (PATH_MAX_OCTETS + 1);
        const int end = (int)strcspn(folder, ",");
        const int length = listed ? snprintf(path, PATH_MAX_OCTETS + 1, "%.*s", end, folder)
                                  : snprintf(path, PATH_MAX_OCTETS + 1, "%s/%s", folder, files[i].name);
        if (listed && (folder[end] == ',') != (i < FILES - 1))
        {
            return dds_fail(INS_DDS_E_ARGUMENT, "DDS security: a folder is needed, or %d files, commas between", FILES);
        }
        folder += listed ? end + (folder[end] == ',') : 0;
        if (length < 0 || length > PATH_MAX_OCTETS)
        {
            return dds_fail(INS_DDS_E_ARGUMENT, "DDS security: the path of the folder is longer than %d octets",
                            PATH_MAX_OCTETS - 20);
        }
        *files[i].path = path;
    }
    return INS_DDS_OK;
}
