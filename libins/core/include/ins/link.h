/// \file   ins/link.h
/// \brief  Extended frame of the handshake: CRC-16 and an 8-bit sequence number, with fall-back to the paper's block.
///
///     A>B  55            B>A  44         (a B that knows only the paper is silent: A goes on with AA, ins/handshake.h)
///     A>B  seq, block, crc high, crc low
///                        B>A  00 (right) or FF (send the frame again)
///
/// 55 and 44 differ from AA and BB in every bit. B answers AA with BB as ever, so either side may be the old one. A board that was
/// never answered 44 falls back at the first time-out and asks for the extended form again after INS_LINK_PROBE_EVERY blocks; one
/// that was answered before first spends its retries.
/// CRC-16 with the polynomial x^16 + x^15 + x^12 + x^7 + x^6 + x^4 + x^3 + 1 (0x90D9), start FFFF, over seq and block. It sees any
/// five wrong bits in frames of up to 151 bits, and two may escape it in longer ones: hence INS_LINK_BLOCK_MAX.
/// Source: P. Koopman, T. Chakravarty, DSN 2004 (polynomial 0xC86C in their notation). docs/link.md has the rates measured.
/// SPDX-License-Identifier: MIT
#ifndef INS_LINK_H_INCLUDED
#define INS_LINK_H_INCLUDED
#include "ins/handshake.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_LINK_REQUEST     0x55u
#define INS_LINK_READY       0x44u
#define INS_LINK_PROBE_EVERY 16
#define INS_LINK_BLOCK_MAX   15 ///< octets: 18 with number and CRC, 144 bits
#define INS_LINK_CRC_START   0xFFFFu

/// One more octet.
INS_API uint16_t ins_link_crc(uint16_t crc, ins_octet_t octet);

/// Board side. Members are private but for hs's counters and those below.
typedef struct ins_link_board_t
{
    ins_hs_board_t hs; ///< the paper's form; holds the block and the counters of both forms
    uint_least8_t state;
    uint_least8_t seq;
    uint_least8_t known;      ///< the host answered 44 to this board
    uint_least8_t paper_left; ///< blocks to go before the next 55 to a host that was silent
    uint16_t crc;
    uint16_t extended;  ///< blocks acknowledged in the extended form
    uint16_t fallbacks; ///< times that 55 had no answer
} ins_link_board_t;

/// \param[in] cfg  as for ins_hs_board_init(); cfg.seq says whether the paper's form carries a number too.
/// \return also INS_E_RANGE for a block_len above INS_LINK_BLOCK_MAX.
INS_API ins_status_t ins_link_board_init(ins_link_board_t* self, const ins_hs_config_t* cfg);
/// As ins_hs_board_offer().
INS_API ins_status_t ins_link_board_offer(ins_link_board_t* self, const ins_octet_t* block, uint_least8_t seq,
                                          uint16_t now);
/// As ins_hs_board_busy().
INS_API uint_least8_t ins_link_board_busy(const ins_link_board_t* self);
/// As ins_hs_board_tx().
INS_API int16_t ins_link_board_tx(ins_link_board_t* self, uint16_t now);
/// As ins_hs_board_rx().
INS_API void ins_link_board_rx(ins_link_board_t* self, ins_octet_t octet, uint16_t now);
/// As ins_hs_board_tick().
INS_API void ins_link_board_tick(ins_link_board_t* self, uint16_t now);

/// Host side. hs's block, seq, gap and counters are valid for both forms.
typedef struct ins_link_host_t
{
    ins_hs_host_t hs;
    uint_least8_t extended; ///< the frame under way, or else the last one, is extended
    uint_least8_t state;
    uint16_t crc;
} ins_link_host_t;

/// As ins_hs_host_init(), and INS_E_RANGE for a block_len above INS_LINK_BLOCK_MAX.
INS_API ins_status_t ins_link_host_init(ins_link_host_t* self, const ins_hs_config_t* cfg);
/// As ins_hs_host_rx(), for either form.
INS_API int ins_link_host_rx(ins_link_host_t* self, ins_octet_t octet, uint16_t now, int16_t* reply);
/// As ins_hs_host_tick().
INS_API void ins_link_host_tick(ins_link_host_t* self, uint16_t now);

#ifdef __cplusplus
}
#endif
#endif // INS_LINK_H_INCLUDED
