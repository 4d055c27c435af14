/// \file   emu_f2812/wirelink_types.h
/// \brief  What the messages of emu_f2812/wirelink.h are made of.
/// SPDX-License-Identifier: MIT
#ifndef EMU_F2812_WIRELINK_TYPES_H_INCLUDED
#define EMU_F2812_WIRELINK_TYPES_H_INCLUDED
#include "emu/report.h"
#include "emu/state.h"
#ifdef __cplusplus
extern "C" {
#endif

#define F2812_LINK_VERSION  1
#define F2812_LINK_OCTETS   32768 ///< of the longest message
#define F2812_LINK_EDGES    2048  ///< in a message
#define F2812_LINK_RECORDS  2048
#define F2812_LINK_VALUES   256
#define F2812_LINK_SWITCHES 64
#define F2812_LINK_COUNTS   32
#define F2812_LINK_WIRES    64 ///< watched or driven
#define F2812_LINK_NAME     40 ///< characters of a name, with the final 0
#define F2812_LINK_TEXT     200

typedef enum f2812_link_kind_t
{
    F2812_LINK_HELLO,
    F2812_LINK_START,
    F2812_LINK_WIRE,
    F2812_LINK_RUN,
    F2812_LINK_PEEK,
    F2812_LINK_BREAK,
    F2812_LINK_RECORD,
    F2812_LINK_CLOCK,
    F2812_LINK_STATISTICS,
    F2812_LINK_READY,
    F2812_LINK_DONE,
    F2812_LINK_VALUES_ARE,
    F2812_LINK_RECORDS_ARE,
    F2812_LINK_EDGES_ARE, ///< those that do not fit the DONE that follows
    F2812_LINK_COUNTS_ARE,
    F2812_LINK_REPORT,
    F2812_LINK_REFUSED,
    F2812_LINK_KINDS
} f2812_link_kind_t;

typedef struct f2812_link_edge_t
{
    emu_time_t at;
    uint8_t wire; ///< number of its WIRE message, counted from 0
    bool level;
} f2812_link_edge_t;

/// Why a window ended.
typedef enum f2812_link_why_t
{
    F2812_WHY_REACHED, ///< `until`
    F2812_WHY_BREAK,   ///< an access that a BREAK named
    F2812_WHY_ENDED,   ///< the firmware has ended; time goes on without it
    F2812_WHYS
} f2812_link_why_t;

#define F2812_ACCESS_READ  1u
#define F2812_ACCESS_WRITE 2u

/// What a record is of. A read that gives what it gave, with nothing changed in between, is a turn of a waiting loop: it is neither
/// recorded nor a break's.
typedef enum f2812_link_what_t
{
    F2812_WAS_READ,
    F2812_WAS_WRITTEN,
    F2812_INTERRUPT_BEGAN, ///< address: the vector's number
    F2812_INTERRUPT_ENDED,
    F2812_WHATS
} f2812_link_what_t;

typedef struct f2812_link_record_t
{
    emu_time_t at;
    uint8_t what;
    uint16_t address, value;
} f2812_link_record_t;

typedef struct f2812_link_pair_t
{
    char name[F2812_LINK_NAME], value[F2812_LINK_NAME];
} f2812_link_pair_t;

typedef struct f2812_link_count_t
{
    char name[F2812_LINK_NAME];
    uint64_t value;
} f2812_link_count_t;

typedef struct f2812_link_access_t
{
    uint16_t address;
    uint16_t value;
    uint16_t mask;  ///< BREAK: bits of the value that are compared; 0: any value
    uint8_t access; ///< F2812_ACCESS_...; BREAK: 0 takes all of that address away
} f2812_link_access_t;

#ifdef __cplusplus
}
#endif
#endif // EMU_F2812_WIRELINK_TYPES_H_INCLUDED
