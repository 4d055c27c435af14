/// \file   emu/wire.h
/// \brief  A net with drivers of different strength, as on a board: a quasi-bidirectional port pin is weak high or strong low.
///
/// Resolution: any strong driver wins over weak ones; strong low against strong high is a contention (counted, reads low);
/// weak low against weak high reads low; nobody driving: the net keeps its last level and is reported as floating.
/// A net may be shorted, to a supply, which wins over any driver, or to another net, with which it then resolves as one.
/// SPDX-License-Identifier: MIT
#ifndef EMU_WIRE_H_INCLUDED
#define EMU_WIRE_H_INCLUDED
#include "emu/state.h"
#ifdef __cplusplus
extern "C" {
#endif

#define EMU_WIRE_DRIVERS  8
#define EMU_WIRE_WATCHERS 8

typedef enum emu_drive_t
{
    EMU_Z = 0, ///< high impedance
    EMU_WEAK0,
    EMU_WEAK1,
    EMU_STRONG0,
    EMU_STRONG1
} emu_drive_t;

typedef void (*emu_wire_fn)(void* ctx, bool level, emu_time_t at);

typedef enum emu_rail_t
{
    EMU_RAIL_NONE = 0,
    EMU_RAIL_GND,
    EMU_RAIL_VCC
} emu_rail_t;

typedef struct emu_wire_t
{
    const char* name; ///< as on the schematic: "P1.3 DATA OUT"
    uint8_t drivers, watchers;
    uint32_t drives; ///< four bits a driver, one for each strength but Z
    struct
    {
        emu_wire_fn fn;
        void* ctx;
    } watch[EMU_WIRE_WATCHERS];
    bool level;
    bool floating;
    emu_time_t changed; ///< instant of the last change of level
    bool shorted;       ///< either of the two below is set
    uint8_t rail;       ///< emu_rail_t; is not part of the state: whoever makes shorts makes them again
    struct emu_wire_t* bridge;
    uint64_t contentions;
} emu_wire_t;

/// level: what an undriven net reads at first.
EMU_API void emu_wire_init(emu_wire_t* self, const char* name, bool level);
/// \return driver number for emu_wire_drive(), or -1 when EMU_WIRE_DRIVERS are taken.
EMU_API int emu_wire_add_driver(emu_wire_t* self);
/// fn is called after each change of level, in the order of registration; it must not drive this wire. \return 0, or -1 when full.
EMU_API int emu_wire_watch(emu_wire_t* self, emu_wire_fn fn, void* ctx);
/// What a driver puts on the wire from `at` on; watchers are told when the level changes.
EMU_API void emu_wire_drive(emu_wire_t* self, int driver, emu_drive_t drive, emu_time_t at);
/// Short a net to a supply; EMU_RAIL_NONE takes it away.
EMU_API void emu_wire_short(emu_wire_t* self, emu_rail_t rail, emu_time_t at);
/// Short two nets to each other. \return 0, or -1 when one of them is shorted to a net already, or both are one.
EMU_API int emu_wire_bridge(emu_wire_t* self, emu_wire_t* other, emu_time_t at);
/// Take the short to the other net away.
EMU_API void emu_wire_unbridge(emu_wire_t* self, emu_time_t at);
/// Level and drives; watchers are not told of what was loaded.
EMU_API void emu_wire_state(emu_wire_t* self, emu_state_t* io);

#ifdef __cplusplus
}
#endif
#endif // EMU_WIRE_H_INCLUDED
