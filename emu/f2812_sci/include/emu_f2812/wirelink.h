/// \file   emu_f2812/wirelink.h
/// \brief  What a run and the process of a board program say to each other: levels of wires with their instants, windows of virtual time.
///
///     program -> run   HELLO
///     run -> program   START                                            answered by READY or REFUSED
///     run -> program   WIRE, BREAK, RECORD, CLOCK | PEEK | STATISTICS   answered by READY | VALUES | COUNTS, or REFUSED
///     run -> program   RUN                                              answered by any number of REPORT, RECORDS and EDGES, then DONE
///
/// One message is one packet of a SOCK_SEQPACKET socket: an octet for its kind, then the members of its struct in their order, little
/// endian, arrays and text with their length before them. The program is as new as the run: HELLO carries the version, and any other is
/// refused. A window: every edge of RUN is after the instant that was reached, and none after `until`; when DONE comes, all edges up to
/// `reached` are out. What the program sends may come back to it as an answer; `answer` is the least time that takes.
/// SPDX-License-Identifier: MIT
#ifndef EMU_F2812_WIRELINK_H_INCLUDED
#define EMU_F2812_WIRELINK_H_INCLUDED
#include "emu_f2812/wirelink_types.h"
#ifdef __cplusplus
extern "C" {
#endif

/// By kind; the others' members are not looked at.
typedef struct f2812_link_t
{
    uint8_t kind;
    /// \cond the members of each kind, which the header shows best
    union
    {
        struct
        {
            uint8_t bits; ///< of a pointer in the program: 32 or 64
            char name[F2812_LINK_NAME];
        } hello;
        struct
        {
            uint64_t oscclk_hz;
            uint16_t count;
            f2812_link_pair_t switches[F2812_LINK_SWITCHES];
        } start;
        struct
        {
            bool driven;   ///< the run drives it, else its edges are reported
            bool answered; ///< an edge may be answered: see run.answer
            char name[F2812_LINK_NAME];
        } wire;
        struct
        {
            emu_time_t until;
            emu_time_t
                answer; ///< so long after the first edge of a wire that is answered the window ends, if not before
            uint16_t count;
            f2812_link_edge_t edges[F2812_LINK_EDGES]; ///< sorted by instant
        } run;
        struct
        {
            emu_time_t reached;
            emu_time_t quiet; ///< no edge leaves before this instant unless one comes in before
            uint8_t why;
            f2812_link_access_t access; ///< of F2812_WHY_BREAK
            char end[F2812_LINK_TEXT];  ///< of F2812_WHY_ENDED: how
            uint16_t count;
            f2812_link_edge_t edges[F2812_LINK_EDGES]; ///< sorted by instant
        } done;
        struct
        {
            uint16_t count;
            f2812_link_edge_t edges[F2812_LINK_EDGES]; ///< sorted by instant
        } edges;
        struct
        {
            uint16_t address, count;
        } peek;
        f2812_link_access_t at;
        struct
        {
            bool accesses, interrupts;
        } record;
        struct
        {
            int32_t ppb; ///< error of the oscillator from now on
        } clock;
        struct
        {
            uint16_t count;
            uint16_t values[F2812_LINK_VALUES];
        } values;
        struct
        {
            uint16_t count;
            f2812_link_record_t records[F2812_LINK_RECORDS];
        } records;
        struct
        {
            uint16_t count;
            f2812_link_count_t counts[F2812_LINK_COUNTS];
        } counts;
        struct
        {
            emu_time_t at;
            uint32_t detail;
            uint8_t kind; ///< emu_report_kind_t
            char text[F2812_LINK_TEXT];
        } report;
        struct
        {
            char text[F2812_LINK_TEXT];
        } refused;
    } u;
    /// \endcond
} f2812_link_t;

/// One message, saved or loaded as `io` says (emu/state.h). \return its octets; 0: what was loaded is no message, or too little room.
EMU_API size_t f2812_link_walk(f2812_link_t* self, emu_state_t* io);
/// Copy of a text that fits a message's member of `size` characters; the rest of a longer one is left out.
EMU_API void f2812_link_text(char* to, size_t size, const char* from);

#ifdef __cplusplus
}
#endif
#endif // EMU_F2812_WIRELINK_H_INCLUDED
