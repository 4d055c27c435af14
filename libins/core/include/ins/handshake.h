/// \file   ins/handshake.h
/// \brief  The checksummed handshake of Zheng and Zhou (2010), section 3.3, as two octet-driven state machines.
///
/// A is the sampling board, B the host:
///     A>B  AA            B>A  BB
///     A>B  block, sum    B>A  00 (right) or FF (send block and sum again)
/// The paper leaves open the block's layout, the kind of sum, retry limits and time-outs. Chosen here: a block of 1 to 32 octets
/// (the paper's is XH XL YH YL ZH ZL), sum modulo 256 of the block, bounded retries, a time-out on every wait.
/// The machines know no transport and no clock: the caller feeds octets and `now`, a free-running 16-bit count in a unit of the
/// caller's choice (milliseconds on a host, a timer tick on a board); time-outs are in the same unit, below 32768.
///
/// Option `seq`: an 8-bit sequence number in the high nibbles of octets 0 (bits 7..4) and 2 (bits 3..0), which 12-bit samples leave
/// zero. B then recognises a block that was resent because its 00 was lost, and a gap is known. Off, the octets are the paper's.
///
/// What the sum cannot show: two octets swapped, errors that compensate. What the sequence number cannot show: 256 blocks lost in a
/// row (the next is then taken for a repetition). What it needs: a board that counts on; one that starts again from 0 makes a gap.
/// SDCC compiles this header and both sources for mcs51.
/// SPDX-License-Identifier: MIT
#ifndef INS_HANDSHAKE_H_INCLUDED
#define INS_HANDSHAKE_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

#ifndef INS_HS_BLOCK_MAX
#define INS_HS_BLOCK_MAX 32 ///< octets; a small target may define it as its own block length
#endif
#ifndef INS_HS_MEM
#define INS_HS_MEM ///< memory of the board machine and its blocks; on an 8051 -DINS_HS_MEM=__idata halves its code
#endif
#define INS_HS_REQUEST 0xAAu
#define INS_HS_READY   0xBBu
#define INS_HS_ACCEPT  0x00u
#define INS_HS_RESEND  0xFFu

/// Both sides take one; a member that the other side alone uses may be 0. reply_timeout must be longer than octet_timeout and one
/// exchange of octets, so that the host is back in idle when the board asks again.
typedef struct ins_hs_config_t
{
    uint_least8_t block_len; ///< 1..INS_HS_BLOCK_MAX octets; at least 4 with seq
    uint_least8_t seq;       ///< 1: sequence number in the spare high nibbles of X and Y
    uint_least8_t
        retries; ///< board: frames and requests sent again for one block; host: FFs, less one, for one request
    uint16_t reply_timeout; ///< board: wait for BB, 00 or FF, from when ins_hs_board_tx() gave the octet before
    uint16_t octet_timeout; ///< host: longest silence inside a block
} ins_hs_config_t;

/// Board side (A). Start with ins_hs_board_init(). Members are private, the counters readable.
typedef struct ins_hs_board_t
{
    ins_hs_config_t cfg;
    uint_least8_t state;
    uint_least8_t tries;
    uint_least8_t next; ///< next octet of the frame to transmit
    uint_least8_t sum;
    uint16_t since;
    ins_octet_t block[INS_HS_BLOCK_MAX];
    uint16_t sent;     ///< blocks acknowledged with 00
    uint16_t resent;   ///< frames or requests sent again, after FF or a time-out
    uint16_t given_up; ///< blocks dropped after the last retry
} ins_hs_board_t;

/// Nothing on its way, counters 0. \return INS_OK; INS_E_RANGE for a cfg that ins_hs_config_t does not allow.
INS_API ins_status_t ins_hs_board_init(INS_HS_MEM ins_hs_board_t* self, const ins_hs_config_t* cfg);
/// Offer a block for transmission, with its sequence number (ignored with cfg.seq = 0).
/// \return INS_OK; INS_E_STATE while an earlier block is on its way (nothing changed; see ins_hs_board_busy).
INS_API ins_status_t ins_hs_board_offer(INS_HS_MEM ins_hs_board_t* self, const INS_HS_MEM ins_octet_t* block,
                                        uint_least8_t seq, uint16_t now);
/// 1 while a block is on its way.
INS_API uint_least8_t ins_hs_board_busy(const INS_HS_MEM ins_hs_board_t* self);
/// Next octet to put on the line, or -1 for none. Call whenever the transmitter is free.
INS_API int16_t ins_hs_board_tx(INS_HS_MEM ins_hs_board_t* self, uint16_t now);
/// An octet came from the host.
INS_API void ins_hs_board_rx(INS_HS_MEM ins_hs_board_t* self, ins_octet_t octet, uint16_t now);
/// Time passes: call at least every reply_timeout / 2 or so; expires waits.
INS_API void ins_hs_board_tick(INS_HS_MEM ins_hs_board_t* self, uint16_t now);

/// What an octet led to, on the host.
enum
{
    INS_HS_NOTHING = 0,
    INS_HS_BLOCK = 1,     ///< a new block is in self->block (sequence nibbles removed), self->seq and self->gap are set
    INS_HS_DUPLICATE = 2, ///< a block already delivered came again (cfg.seq only); it was acknowledged
    INS_HS_CORRUPT = 3    ///< the sum did not agree; FF was answered, or the tries are used up
};

/// Host side (B). Start with ins_hs_host_init(). Members are private, block, seq, gap and the counters readable.
typedef struct ins_hs_host_t
{
    ins_hs_config_t cfg;
    uint_least8_t state;
    uint_least8_t tries;
    uint_least8_t count;
    uint_least8_t sum;
    uint_least8_t have_seq;
    uint_least8_t seq; ///< sequence number of the last block delivered (0 with cfg.seq = 0)
    uint_least8_t gap; ///< blocks missing between the last two delivered, modulo 256 (0 with cfg.seq = 0)
    uint16_t since;
    ins_octet_t block[INS_HS_BLOCK_MAX];
    uint32_t accepted;   ///< new blocks delivered
    uint32_t duplicates; ///< resent blocks recognised
    uint32_t corrupt;    ///< sums that did not agree
    uint32_t timeouts;   ///< blocks that stopped half-way
    uint32_t stray;      ///< octets that fit nowhere
} ins_hs_host_t;

/// In idle, counters 0. \return as ins_hs_board_init().
INS_API ins_status_t ins_hs_host_init(ins_hs_host_t* self, const ins_hs_config_t* cfg);
/// An octet came from the board. \param[out] reply octet to send back (BB, 00, FF), or -1. \return one of INS_HS_*.
INS_API int ins_hs_host_rx(ins_hs_host_t* self, ins_octet_t octet, uint16_t now, int16_t* reply);
/// Time passes without an octet: call it whenever the line has been silent for more than octet_timeout, else a block that stopped
/// half-way is found only when the next one fails its sum. Never call it between octets that are already waiting to be read.
INS_API void ins_hs_host_tick(ins_hs_host_t* self, uint16_t now);

/// The paper's block of three 12-bit codes, XH XL YH YL ZH ZL. A code's bits 15..12 are not sent (ins_hs_board_offer puts the
/// sequence number there).
/// \param[in] codes  [3] \param[out] block  [6]
INS_API void ins_hs_block_put(const INS_HS_MEM uint16_t* codes, INS_HS_MEM ins_octet_t* block);
/// \param[in] block  [6] \param[out] codes  [3] 0..4095
INS_API void ins_hs_block_codes(const ins_octet_t* block, uint16_t* codes);

#ifdef __cplusplus
}
#endif
#endif // INS_HANDSHAKE_H_INCLUDED
