/// \file   emu/state.h
/// \brief  Snapshot and restore by one walk over the fields of a part: the same function counts, saves and loads.
///
///     uint8_t octets[64];
///     bool on = true;
///     uint32_t strokes = 7;
///     emu_state_t io = {.to = octets, .size = sizeof octets}; // .from = octets: the same lines load
///     emu_state_tag(&io, "PUMP", 1);
///     emu_state_bool(&io, &on);
///     emu_state_u32(&io, &strokes);
///
/// Octets are little endian, the same on every machine. Pointers and configuration are not saved: a snapshot is loaded into an object
/// that was created with the same configuration. A value that cannot be is refused by setting `bad`; fields loaded before it keep their
/// new values, so whoever begins a walk saves first what he may have to load again.
/// SPDX-License-Identifier: MIT
#ifndef EMU_STATE_H_INCLUDED
#define EMU_STATE_H_INCLUDED
#include "emu/time.h"
#include <stdbool.h>
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

#define EMU_TIME_LOADED_MAX (EMU_TIME_MAX / 2) ///< a later instant is refused: there must be room to add to it

/// Both `to` and `from` NULL: only counts. All other members 0 but size.
typedef struct emu_state_t
{
    uint8_t* to;         ///< saving
    const uint8_t* from; ///< loading
    size_t size, at;     ///< octets there are; octets passed, also where they did not fit
    bool bad;            ///< octets ran out, or a value was refused; loading then leaves every further field as it is
} emu_state_t;

EMU_API void emu_state_bool(emu_state_t* io, bool* value);    ///< one octet; loading refuses all but 0 and 1
EMU_API void emu_state_u8(emu_state_t* io, uint8_t* value);   ///< one octet
EMU_API void emu_state_u16(emu_state_t* io, uint16_t* value); ///< two octets
EMU_API void emu_state_u32(emu_state_t* io, uint32_t* value); ///< four octets
EMU_API void emu_state_u64(emu_state_t* io, uint64_t* value); ///< eight octets
EMU_API void emu_state_i64(emu_state_t* io, int64_t* value);  ///< eight octets, two's complement
EMU_API void emu_state_f64(emu_state_t* io, double* value);   ///< eight octets, IEEE 754 bits
EMU_API void emu_state_octets(emu_state_t* io, void* octets, size_t count); ///< count octets as they are
/// Eight octets: a name of four characters and a version. Loading anything else is refused.
EMU_API void emu_state_tag(emu_state_t* io, const char name[4], uint32_t version);
/// Whether this walk loads.
EMU_API bool emu_state_loading(const emu_state_t* io);
/// Refuse what was loaded unless `good`; nothing when saving or counting.
EMU_API void emu_state_check(emu_state_t* io, bool good);

/// Whether an instant that was loaded can be one: 0 .. EMU_TIME_LOADED_MAX.
EMU_API bool emu_state_time(emu_time_t t);

#ifdef __cplusplus
}
#endif
#endif // EMU_STATE_H_INCLUDED
