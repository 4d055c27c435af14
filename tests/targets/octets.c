/// \file   octets.c
/// \brief  Handshake, extended frame, GIMU and NMEA on a line with bit errors: the same events everywhere, in both builds.
/// SPDX-License-Identifier: MIT
#include "report.h"

#define BLOCKS      40
#define OCTETS      3000
#define REPLY_TIME  20
#define OCTET_TIME  8
#define TICKS_MAX   400 // of one block; it is given up long before
#define BLOCK_LEN   6
#define ERROR_EVERY 61 // octets, on average

/// One bit of some octets is wrong.
static ins_octet_t line(ins_octet_t octet)
{
    const unsigned bits = (unsigned)(random_bits() >> 8 & 0xFFFu);
    return (ins_octet_t)(bits % ERROR_EVERY == 0 ? octet ^ (1u << (bits & 7u)) : octet);
}

static void same_hs(const ins_hs_board_t* board, const ins_hs_host_t* host)
{
    for (unsigned i = 0; i < BLOCK_LEN; i++)
    {
        same_integer(host->block[i]);
    }
    same_integer(host->seq);
    same_integer(host->gap);
    same_integer(host->accepted);
    same_integer(host->duplicates);
    same_integer(host->corrupt);
    same_integer(host->timeouts);
    same_integer(host->stray);
    same_integer(board->sent);
    same_integer(board->resent);
    same_integer(board->given_up);
}

static void random_block(ins_octet_t block[BLOCK_LEN])
{
    uint16_t codes[3];
    for (int i = 0; i < 3; i++)
    {
        codes[i] = (uint16_t)(random_bits() & 0xFFFu);
    }
    ins_hs_block_put(codes, block);
}

static const ins_hs_config_t config = {BLOCK_LEN, 1, 3, REPLY_TIME, OCTET_TIME};

static void handshake(void)
{
    ins_hs_board_t board;
    ins_hs_host_t host;
    uint16_t now = 65000; // wraps on the way
    same_begin("handshake");
    same_integer((uint32_t)ins_hs_board_init(&board, &config));
    same_integer((uint32_t)ins_hs_host_init(&host, &config));
    for (unsigned n = 0; n < BLOCKS; n++)
    {
        ins_octet_t block[BLOCK_LEN];
        random_block(block);
        same_integer((uint32_t)ins_hs_board_offer(&board, block, (uint_least8_t)n, now));
        for (int tick = 0; tick < TICKS_MAX && ins_hs_board_busy(&board); tick++, now++)
        {
            const int16_t out = ins_hs_board_tx(&board, now);
            int16_t reply = -1;
            if (out >= 0)
            {
                same_integer((uint32_t)ins_hs_host_rx(&host, line((ins_octet_t)out), now, &reply));
            }
            if (reply >= 0)
            {
                same_integer((uint32_t)reply);
                ins_hs_board_rx(&board, line((ins_octet_t)reply), now);
            }
            ins_hs_board_tick(&board, now);
            ins_hs_host_tick(&host, now);
        }
        same_hs(&board, &host);
    }
    same_end();
}

static void extended(void)
{
    ins_link_board_t board;
    ins_link_host_t host;
    uint16_t now = 65000;
    same_begin("link");
    same_integer((uint32_t)ins_link_board_init(&board, &config));
    same_integer((uint32_t)ins_link_host_init(&host, &config));
    for (unsigned n = 0; n < BLOCKS; n++)
    {
        ins_octet_t block[BLOCK_LEN];
        random_block(block);
        same_integer((uint32_t)ins_link_board_offer(&board, block, (uint_least8_t)n, now));
        for (int tick = 0; tick < TICKS_MAX && ins_link_board_busy(&board); tick++, now++)
        {
            const int16_t out = ins_link_board_tx(&board, now);
            int16_t reply = -1;
            if (out >= 0)
            {
                same_integer((uint32_t)ins_link_host_rx(&host, line((ins_octet_t)out), now, &reply));
            }
            if (reply >= 0)
            {
                same_integer((uint32_t)reply);
                ins_link_board_rx(&board, line((ins_octet_t)reply), now);
            }
            ins_link_board_tick(&board, now);
            ins_link_host_tick(&host, now);
        }
        same_hs(&board.hs, &host.hs);
        same_integer(board.extended);
        same_integer(board.fallbacks);
        same_integer(host.extended);
    }
    same_end();
}

static void same_packet(const ins_gimu_t* self, int type)
{
    same_integer((uint32_t)type);
    if (type != INS_GIMU_NOTHING)
    {
        for (int i = 0; i < 6; i++)
        {
            same_integer(self->packet.raw[i]);
        }
        same_integer(self->packet.coordinate[0]);
        same_integer(self->packet.coordinate[1]);
        same_integer((uint32_t)self->packet.lat_e7);
        same_integer((uint32_t)self->packet.lon_e7);
        same_integer(self->packet.sats);
        same_integer(self->packet.has_position);
    }
}

/// Packets of both types one after the other, coordinates below 90 degrees first, now and then a wrong bit.
static ins_octet_t gimu_octet(unsigned k)
{
    static const ins_octet_t coordinates[8] = {0x01, 0x74, 0x96, 0x1A, 0x07, 0x36, 0x4B, 0x1C};
    const unsigned length = INS_GIMU_T1_LEN + INS_GIMU_T2_LEN;
    const unsigned at = k % length;
    const unsigned in = at < INS_GIMU_T1_LEN ? at : at - INS_GIMU_T1_LEN;
    const ins_octet_t random = (ins_octet_t)(random_bits() >> 11 & 0xFFu);
    if (in == 0)
    {
        return 0xAA;
    }
    if (in == 1)
    {
        return 0x55;
    }
    if (in >= INS_GIMU_T1_LEN && in < INS_GIMU_T2_LEN - 1)
    {
        return coordinates[in - INS_GIMU_T1_LEN];
    }
    return in % 2 ? random : random & 0x0Fu;
}

static void gimu(void)
{
    ins_gimu_t self;
    same_begin("gimu");
    ins_gimu_init(&self, 1);
    for (unsigned k = 0; k < OCTETS; k++)
    {
        same_packet(&self, ins_gimu_rx(&self, line(gimu_octet(k))));
    }
    for (int type = INS_GIMU_T1; type != INS_GIMU_NOTHING;)
    {
        type = ins_gimu_flush(&self);
        same_packet(&self, type);
    }
    same_integer(self.t1);
    same_integer(self.t2);
    same_integer(self.skipped);
    same_end();
}

static void nmea(void)
{
    static const char text[] = "$GPGGA,123519.487,2459.1234567,N,12123.7654321,E,1,08,0.912,545.4,M,16.9,M,,*4B\r\n"
                               "$GPRMC,081836,A,3751.65,S,14507.36,E,000.0,360.0,130998,011.3,E*62\r\n"
                               "$GNVTG,089.0,T,,,15.2,N,,,A*14\r\n"
                               "$GPGSV,1,1,00*79\r\n";
    ins_nmea_t self;
    same_begin("nmea");
    ins_nmea_init(&self);
    for (unsigned k = 0; k < 2 * OCTETS; k++)
    {
        const ins_octet_t octet = (ins_octet_t)text[k % (sizeof text - 1)];
        const int type = ins_nmea_rx(&self, k < sizeof text ? octet : line(octet)); // the first round is clean
        const ins_nmea_fix_t* fix = &self.fix;
        if (type == INS_NMEA_NOTHING)
        {
            continue;
        }
        const int32_t values[] = {type,         fix->has,     fix->valid,       fix->quality,         fix->sats,
                                  fix->lat_e7,  fix->lon_e7,  fix->altitude_mm, fix->geoid_mm,        fix->hdop_milli,
                                  fix->date[0], fix->date[1], fix->date[2],     fix->speed_milliknot, fix->course_mdeg};
        for (unsigned i = 0; i < sizeof values / sizeof values[0]; i++)
        {
            same_integer((uint32_t)values[i]);
        }
        same_integer(fix->time_ms);
    }
    same_integer(self.taken);
    same_integer(self.bad_checksum);
    same_integer(self.malformed);
    same_integer(self.cut);
    same_integer(self.other);
    same_end();
}

void run_octets(void)
{
    handshake();
    extended();
    gimu();
    nmea();
}
