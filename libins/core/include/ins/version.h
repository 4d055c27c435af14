/// \file   ins/version.h
/// \brief  Version of the library, and the check that header and binary belong together (double or float, version).
/// SPDX-License-Identifier: MIT
#ifndef INS_VERSION_H_INCLUDED
#define INS_VERSION_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_VERSION_MAJOR 0
#define INS_VERSION_MINOR 1
#define INS_VERSION_PATCH 0
/// 10000 major + 100 minor + patch
#define INS_VERSION (INS_VERSION_MAJOR * 10000L + INS_VERSION_MINOR * 100L + INS_VERSION_PATCH)

/// Version of the binary, as INS_VERSION.
INS_API long ins_version(void);
/// \return INS_OK, or INS_E_ABI: the program was compiled with the headers of another major or minor version, or for another
/// ins_real. Patch releases go together.
INS_API ins_status_t ins_abi_check(long version, unsigned real_size);
/// Call once at start: INS_ABI_CHECK() == INS_OK.
#define INS_ABI_CHECK() ins_abi_check(INS_VERSION, (unsigned)sizeof(ins_real))
/// Text for a status code; "unknown status" for any other number.
INS_API const char* ins_status_text(ins_status_t status);

#ifdef __cplusplus
}
#endif
#endif // INS_VERSION_H_INCLUDED
