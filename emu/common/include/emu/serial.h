/// \file   emu/serial.h
/// \brief  Asynchronous serial: an end that carries octets as bits at its own baud, and a line between two wires with declared faults.
///
/// emu_serial_end_t transmits on one wire and samples another, each bit at the instant its own clock says: a wrong baud, noise, a
/// break or a cut shows as on the desk (framing errors, wrong octets). 8N1; the receiver validates the start bit at its centre and takes
/// the majority of three samples at 7/16, 8/16, 9/16 of each bit.
/// emu_serial_line_t copies the level of one wire to another with faults: bit slots inverted with a probability, octets swallowed,
/// windows in which the line is cut (reads idle). Bit slots lie on a grid of 1/baud that began at init: an inverted slot covers the
/// centre of one bit, or of an idle one, where it makes a ghost start. Seeded (splitmix64), no state shared between lines.
/// SPDX-License-Identifier: MIT
#ifndef EMU_SERIAL_H_INCLUDED
#define EMU_SERIAL_H_INCLUDED
#include "emu/sched.h"
#include "emu/wire.h"
#ifdef __cplusplus
extern "C" {
#endif

#define EMU_SERIAL_FIFO 4096 ///< octets that wait for the transmitter
#define EMU_BAUD_MIN    50.0
#define EMU_BAUD_MAX    4e6

typedef void (*emu_serial_rx_fn)(void* ctx, uint8_t octet, bool framing_ok,
                                 emu_time_t at); ///< at: decision, 9/16 of the stop bit

typedef struct emu_serial_end_t
{
    emu_sched_t* sched;
    emu_wire_t* tx; ///< may be NULL: listen only
    emu_wire_t* rx; ///< may be NULL: send only
    int tx_driver;
    double
        baud; ///< own clock; bit n of a frame ends at round((n + 1) * 1e12 / baud) ps; emu_serial_end_set_baud() changes it
    emu_serial_rx_fn received;
    void* ctx;
    emu_event_t tx_event, rx_event;
    uint16_t tx_frame, rx_bits;
    uint8_t tx_bit, rx_bit, rx_sample, rx_votes;
    bool tx_busy, rx_busy;
    emu_time_t tx_start, rx_start;
    uint8_t fifo[EMU_SERIAL_FIFO];
    uint32_t fifo_head, fifo_count;
    uint64_t octets_sent, octets_received, framing_errors, overflow;
    uint64_t false_starts; ///< counted when the line moves again, or by the time that the frame would have ended
} emu_serial_end_t;

/// \return 0; -1 for a baud outside 50 .. 4e6 or no free driver or watcher.
EMU_API int emu_serial_end_init(emu_serial_end_t* self, emu_sched_t* sched, emu_wire_t* tx, emu_wire_t* rx, double baud,
                                emu_serial_rx_fn received, void* ctx);
/// Queue one octet; it starts at once if the transmitter is free. \return false when the queue is full (counted in overflow).
EMU_API bool emu_serial_end_send(emu_serial_end_t* self, uint8_t octet);
/// Another baud, from the next bit of either direction on. \return false for one outside 50 .. 4e6; then nothing is changed.
EMU_API bool emu_serial_end_set_baud(emu_serial_end_t* self, double baud);
/// What is on its way, the queue and the counters, and the baud. After emu_sched_state; its wires are their owner's.
EMU_API void emu_serial_end_state(emu_serial_end_t* self, emu_state_t* io);

typedef struct emu_serial_cut_t
{
    emu_time_t from, to;
} emu_serial_cut_t;

typedef struct emu_serial_faults_t
{
    double baud;                  ///< length of a bit slot for bit_error and octet_loss; not looked at without them
    double bit_error;             ///< probability that a bit slot is inverted
    double octet_loss;            ///< probability that a frame is swallowed
    const emu_serial_cut_t* cuts; ///< sorted, not overlapping; caller keeps the array
    unsigned cut_count;
    uint64_t seed;
} emu_serial_faults_t;

typedef struct emu_serial_line_t
{
    emu_sched_t* sched;
    emu_wire_t* from;
    emu_wire_t* to;
    int driver;
    emu_serial_faults_t faults;
    emu_event_t noise_event, cut_event, loss_event;
    uint64_t rng;
    bool inverted, cut, swallowing;
    unsigned next_cut;
    emu_time_t slot_origin;
    uint64_t slot; ///< the slot noise_event begins
    bool hit;      ///< it is inverted
    uint64_t slots_inverted, octets_swallowed;
} emu_serial_line_t;

/// \return 0; -1 for a probability outside 0 .. 0.5, a bad baud or cut list, or no free driver or watcher.
EMU_API int emu_serial_line_init(emu_serial_line_t* self, emu_sched_t* sched, emu_wire_t* from, emu_wire_t* to,
                                 const emu_serial_faults_t* faults);
/// Where the line is in its faults and its random numbers. After emu_sched_state; its wires are their owner's.
EMU_API void emu_serial_line_state(emu_serial_line_t* self, emu_state_t* io);

#ifdef __cplusplus
}
#endif
#endif // EMU_SERIAL_H_INCLUDED
