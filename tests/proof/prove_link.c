/// \file   prove_link.c
/// \brief  One step of the handshake and the extended link from any sound state, for ESBMC: no undefined behaviour, soundness kept, every octet accounted for.
///
/// Since the state after `init` is sound and every step keeps it, streams of any length are. A local variable that is not set
/// stands for any value. Where a length decides how far loops run, CASE is that
/// length, and each has a run of its own (prove.py).
/// SPDX-License-Identifier: MIT
#include "prove.h"

static int is_reply(int16_t reply)
{
    return reply == -1 || reply == INS_HS_READY || reply == INS_LINK_READY || reply == INS_HS_ACCEPT ||
           reply == INS_HS_RESEND;
}

void board_init(void)
{
    ins_hs_board_t s;
    ins_hs_config_t cfg;
    const ins_hs_board_t before = s;
    if (ins_hs_board_init(&s, &cfg) == INS_OK)
    {
        PROVE(sound_board(&s));
    }
    else
    {
        PROVE(s.state == before.state && s.cfg.block_len == before.cfg.block_len && s.sent == before.sent);
    }
}

void board_offer(void)
{
    ins_hs_board_t s;
    ins_octet_t block[INS_HS_BLOCK_MAX];
    uint_least8_t seq;
    uint16_t now;
    s.cfg.block_len = CASE;
    GIVEN(sound_board(&s));
    const int idle = s.state == BOARD_IDLE;
    PROVE((ins_hs_board_offer(&s, block, seq, now) == INS_OK) == idle);
    PROVE(sound_board(&s));
    PROVE(s.state != BOARD_IDLE);
}

void board_tx(void)
{
    ins_hs_board_t s;
    uint16_t now;
    GIVEN(sound_board(&s));
    const int16_t octet = ins_hs_board_tx(&s, now);
    PROVE(octet >= -1 && octet <= 255);
    PROVE(sound_board(&s));
}

void board_rx(void)
{
    ins_hs_board_t s;
    ins_octet_t octet;
    uint16_t now;
    GIVEN(sound_board(&s));
    const unsigned done = (uint16_t)(s.sent + s.given_up);
    const int busy = ins_hs_board_busy(&s);
    ins_hs_board_rx(&s, octet, now);
    PROVE(sound_board(&s));
    PROVE((uint16_t)(s.sent + s.given_up - done) == (busy && !ins_hs_board_busy(&s))); // each block is counted once
}

void board_tick(void)
{
    ins_hs_board_t s;
    uint16_t now;
    GIVEN(sound_board(&s));
    ins_hs_board_tick(&s, now);
    PROVE(sound_board(&s));
}

void host_init(void)
{
    ins_hs_host_t s;
    ins_hs_config_t cfg;
    const ins_hs_host_t before = s;
    if (ins_hs_host_init(&s, &cfg) == INS_OK)
    {
        PROVE(sound_host(&s));
    }
    else
    {
        PROVE(s.state == before.state && s.cfg.block_len == before.cfg.block_len && s.accepted == before.accepted);
    }
}

void host_rx(void)
{
    ins_hs_host_t s;
    ins_octet_t octet;
    uint16_t now;
    int16_t reply;
    s.count = CASE;
    GIVEN(sound_host(&s));
    const uint32_t accepted = s.accepted;
    const uint32_t duplicates = s.duplicates;
    const uint32_t corrupt = s.corrupt;
    const int event = ins_hs_host_rx(&s, octet, now, &reply);
    PROVE(sound_host(&s));
    PROVE(is_reply(reply));
    PROVE((event == INS_HS_BLOCK) == (s.accepted != accepted));
    PROVE((event == INS_HS_DUPLICATE) == (s.duplicates != duplicates));
    PROVE((event == INS_HS_CORRUPT) == (s.corrupt != corrupt));
    PROVE((event == INS_HS_BLOCK || event == INS_HS_DUPLICATE) == (reply == INS_HS_ACCEPT));
    PROVE((event == INS_HS_CORRUPT) == (reply == INS_HS_RESEND));
}

void host_tick(void)
{
    ins_hs_host_t s;
    uint16_t now;
    GIVEN(sound_host(&s));
    ins_hs_host_tick(&s, now);
    PROVE(sound_host(&s));
}

void link_board_offer(void)
{
    ins_link_board_t s;
    ins_octet_t block[INS_LINK_BLOCK_MAX];
    uint_least8_t seq;
    uint16_t now;
    s.hs.cfg.block_len = CASE;
    GIVEN(sound_link_board(&s));
    const int busy = ins_link_board_busy(&s);
    PROVE((ins_link_board_offer(&s, block, seq, now) == INS_OK) == !busy);
    PROVE(sound_link_board(&s));
    PROVE(ins_link_board_busy(&s));
}

void link_board_tx(void)
{
    ins_link_board_t s;
    uint16_t now;
    GIVEN(sound_link_board(&s));
    const int16_t octet = ins_link_board_tx(&s, now);
    PROVE(octet >= -1 && octet <= 255);
    PROVE(sound_link_board(&s));
}

void link_board_rx(void)
{
    ins_link_board_t s;
    ins_octet_t octet;
    uint16_t now;
    s.hs.cfg.block_len = CASE;
    GIVEN(sound_link_board(&s));
    const int busy = ins_link_board_busy(&s);
    const unsigned done = (uint16_t)(s.hs.sent + s.hs.given_up);
    ins_link_board_rx(&s, octet, now);
    PROVE(sound_link_board(&s));
    PROVE((uint16_t)(s.hs.sent + s.hs.given_up - done) == (busy && !ins_link_board_busy(&s)));
}

void link_board_tick(void)
{
    ins_link_board_t s;
    uint16_t now;
    s.hs.cfg.block_len = CASE;
    GIVEN(sound_link_board(&s));
    ins_link_board_tick(&s, now);
    PROVE(sound_link_board(&s));
}

void link_host_rx(void)
{
    ins_link_host_t s;
    ins_octet_t octet;
    uint16_t now;
    int16_t reply;
    s.hs.count = CASE;
    GIVEN(sound_link_host(&s));
    const uint32_t accepted = s.hs.accepted;
    const int event = ins_link_host_rx(&s, octet, now, &reply);
    PROVE(sound_link_host(&s));
    PROVE(is_reply(reply));
    PROVE((event == INS_HS_BLOCK) == (s.hs.accepted != accepted));
    PROVE((event == INS_HS_BLOCK || event == INS_HS_DUPLICATE) == (reply == INS_HS_ACCEPT));
    PROVE((event == INS_HS_CORRUPT) == (reply == INS_HS_RESEND));
}

void link_host_tick(void)
{
    ins_link_host_t s;
    uint16_t now;
    GIVEN(sound_link_host(&s));
    ins_link_host_tick(&s, now);
    PROVE(sound_link_host(&s));
}
