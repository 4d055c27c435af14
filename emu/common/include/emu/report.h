/// \file   emu/report.h
/// \brief  What a run has to say: "the firmware did something wrong" and "the emulator does not model this" are two different reports.
/// SPDX-License-Identifier: MIT
#ifndef EMU_REPORT_H_INCLUDED
#define EMU_REPORT_H_INCLUDED
#include "emu/time.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef enum emu_report_kind_t
{
    EMU_GUEST_ERROR, ///< the firmware did something wrong
    EMU_NOT_MODELLED ///< our gap
} emu_report_kind_t;

/// text lives until the function returns. detail: address, opcode or the like, as the text says.
typedef void (*emu_report_fn)(void* ctx, emu_report_kind_t kind, const char* text, uint32_t detail, emu_time_t at);

typedef struct emu_report_t
{
    emu_report_fn put;
    void* ctx;
} emu_report_t;

#ifdef __cplusplus
}
#endif
#endif // EMU_REPORT_H_INCLUDED
