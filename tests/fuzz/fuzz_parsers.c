/// \file   fuzz_parsers.c
/// \brief  libFuzzer: handshake, extended link, GIMU, NMEA and the navigation block fed the same octets; each stays sound (tests/proof/sound.h).
///
/// The first octets choose the settings; then each pair of octets is a step of time and an octet of the line.
/// SPDX-License-Identifier: MIT
#include "ins/nav_block.h"
#include "sound.h"
#include <stddef.h>
#include <stdlib.h>

#define SETTINGS 4

int LLVMFuzzerTestOneInput(const unsigned char* data, size_t size);

static void demand(int condition)
{
    if (!condition)
    {
        abort();
    }
}

/// What is taken can be put, unless its velocity is in the last 0.6 m/s of 24 bits.
static void nav_block(const unsigned char* data)
{
    ins_octet_t block[INS_NAV_BLOCK_LEN];
    ins_nav_block_t nav;
    for (size_t i = 0; i < INS_NAV_BLOCK_LEN; i++)
    {
        block[i] = data[i];
    }
    if (ins_nav_block_get(block, &nav) == INS_OK)
    {
        const int slow = nav.v_en[0] * nav.v_en[0] <= INS_NAV_BLOCK_V_MAX * INS_NAV_BLOCK_V_MAX &&
                         nav.v_en[1] * nav.v_en[1] <= INS_NAV_BLOCK_V_MAX * INS_NAV_BLOCK_V_MAX;
        demand(!slow || (ins_nav_block_put(&nav, block) == INS_OK && ins_nav_block_get(block, &nav) == INS_OK));
    }
}

int LLVMFuzzerTestOneInput(const unsigned char* data, size_t size)
{
    if (size < SETTINGS)
    {
        return 0;
    }
    const ins_hs_config_t cfg = {(ins_octet_t)(data[0] % (INS_HS_BLOCK_MAX + 2)), data[1] & 1u, data[2] % 4u, 40, 10};
    ins_hs_board_t board;
    ins_hs_host_t host;
    ins_link_board_t link_board;
    ins_link_host_t link_host;
    ins_gimu_t gimu;
    ins_nmea_t nmea;
    const int good = ins_hs_board_init(&board, &cfg) == INS_OK && ins_hs_host_init(&host, &cfg) == INS_OK;
    const int short_block =
        ins_link_board_init(&link_board, &cfg) == INS_OK && ins_link_host_init(&link_host, &cfg) == INS_OK;
    ins_gimu_init(&gimu, data[3] & 1);
    ins_nmea_init(&nmea);
    if (size >= SETTINGS + INS_NAV_BLOCK_LEN)
    {
        nav_block(data + SETTINGS);
    }
    uint16_t now = 65000;
    for (size_t i = SETTINGS; i + 1 < size; i += 2)
    {
        const ins_octet_t octet = data[i + 1];
        ins_octet_t block[INS_HS_BLOCK_MAX] = {0};
        int16_t reply;
        now = (uint16_t)(now + data[i] % 64u);
        block[0] = octet;
        if (good)
        {
            (void)ins_hs_board_offer(&board, block, octet, now);
            (void)ins_hs_board_tx(&board, now);
            ins_hs_board_rx(&board, octet, now);
            ins_hs_board_tick(&board, now);
            (void)ins_hs_host_rx(&host, octet, now, &reply);
            demand(sound_board(&board) && sound_host(&host));
        }
        if (short_block)
        {
            (void)ins_link_board_offer(&link_board, block, octet, now);
            (void)ins_link_board_tx(&link_board, now);
            ins_link_board_rx(&link_board, octet, now);
            ins_link_board_tick(&link_board, now);
            (void)ins_link_host_rx(&link_host, octet, now, &reply);
            demand(sound_link_board(&link_board) && sound_link_host(&link_host));
        }
        if (ins_gimu_rx(&gimu, octet) != INS_GIMU_NOTHING || (data[i] == 63 && ins_gimu_flush(&gimu)))
        {
            demand(sound_packet(&gimu.packet));
        }
        if (ins_nmea_rx(&nmea, octet) != INS_NMEA_NOTHING)
        {
            demand(sound_fix(&nmea.fix));
        }
        demand(sound_gimu(&gimu) && sound_nmea(&nmea));
    }
    return 0;
}
