/// \file   version.c
/// \brief  Version, header and library check, texts of the status codes.
/// SPDX-License-Identifier: MIT
#include "ins/version.h"

long ins_version(void)
{
    return INS_VERSION;
}

// The last two decimals are the patch: it changes no struct, and neither does it change the soname.
ins_status_t ins_abi_check(long version, unsigned real_size)
{
    return version / 100 == INS_VERSION / 100 && real_size == sizeof(ins_real) ? INS_OK : INS_E_ABI;
}

#define STATUS_CASE(name, value, text)                                                                                 \
    case name:                                                                                                         \
        return text;

const char* ins_status_text(ins_status_t status)
{
    switch (status)
    {
        INS_STATUS_LIST(STATUS_CASE)
    default:
        return "unknown status";
    }
}
