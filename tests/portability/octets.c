/// \file   octets.c
/// \brief  Every parser and encoder over streams of octets, as a transcript. `octets dirty` adds random bits above the low eight.
///
/// Built with octets of 8 and of 16 bits (wide_octets.h). All transcripts are equal if each octet that comes in is masked.
/// SPDX-License-Identifier: MIT
#include "ins/gimu.h"
#include "ins/link.h"
#include "ins/nav_block.h"
#include "ins/nmea.h"
#include <stdio.h>

#define SESSIONS      40  ///< lines of each kind, each with its own faults
#define SESSION_TICKS 800 ///< octet times of one line
#define PACKETS       400
#define SENTENCES     600
#define BLOCKS        400
#define LONGEST       120 ///< octets of a sentence

#ifdef uint_least8_t
_Static_assert((ins_octet_t)0x100 == 0x100, "octets are to be 16-bit objects here");
#endif

static int dirty;
static uint32_t stream = 20100; ///< the same whether dirty or not
static uint32_t soil = 1;

static unsigned draw(uint32_t* state, unsigned below)
{
    *state = (uint32_t)(*state * 1664525UL + 1013904223UL);
    return (unsigned)((*state >> 8) % below);
}

static unsigned pick(unsigned below)
{
    return draw(&stream, below);
}

static ins_octet_t put(unsigned octet)
{
    return (ins_octet_t)((octet & 0xFFu) | (dirty ? draw(&soil, 256) << 8 : 0));
}

/// The octet as the line delivers it: now and then another one.
static unsigned line(unsigned octet, unsigned faults)
{
    static const unsigned likely[] = {0x00, 0xFF, 0xAA, 0xBB, 0x55, 0x44};
    return pick(100) >= faults ? octet : pick(2) ? likely[pick(6)] : pick(256);
}

static void show_block(const ins_hs_host_t* h)
{
    for (unsigned i = 0; i < h->cfg.block_len; i++)
    {
        printf(" %02X", (unsigned)h->block[i]);
    }
    printf(" seq %u gap %u", (unsigned)h->seq, (unsigned)h->gap);
    if (h->cfg.block_len >= 6)
    {
        uint16_t codes[3];
        ins_octet_t block[6];
        for (unsigned i = 0; i < 6; i++)
        {
            block[i] = put(h->block[i]);
        }
        ins_hs_block_codes(block, codes);
        printf(" codes %u %u %u", (unsigned)codes[0], (unsigned)codes[1], (unsigned)codes[2]);
    }
}

static void show_counters(const ins_hs_board_t* b, const ins_hs_host_t* h)
{
    printf("\nboard %u %u %u, host %lu %lu %lu %lu %lu\n", (unsigned)b->sent, (unsigned)b->resent,
           (unsigned)b->given_up, (unsigned long)h->accepted, (unsigned long)h->duplicates, (unsigned long)h->corrupt,
           (unsigned long)h->timeouts, (unsigned long)h->stray);
}

static void fill(ins_octet_t* block, unsigned length)
{
    uint16_t codes[3];
    for (unsigned i = 0; i < length; i++)
    {
        block[i] = put(pick(256));
    }
    if (length == 6)
    {
        for (unsigned i = 0; i < 3; i++)
        {
            codes[i] = (uint16_t)(pick(256) << 8 | pick(256));
        }
        ins_hs_block_put(codes, block);
    }
}

static void handshake(unsigned faults, ins_hs_config_t cfg)
{
    ins_hs_board_t board;
    ins_hs_host_t host;
    ins_octet_t block[INS_HS_BLOCK_MAX];
    if (ins_hs_board_init(&board, &cfg) != INS_OK || ins_hs_host_init(&host, &cfg) != INS_OK)
    {
        printf("refused\n");
        return;
    }
    for (uint16_t now = 0; now < SESSION_TICKS; now++)
    {
        int16_t reply = -1;
        fill(block, cfg.block_len);
        (void)ins_hs_board_offer(&board, block, put(pick(256)), now);
        const int16_t octet = ins_hs_board_tx(&board, now);
        printf("%d", octet);
        if (octet >= 0)
        {
            const int event = ins_hs_host_rx(&host, put(line((unsigned)octet, faults)), now, &reply);
            printf(">%d:%d", event, reply);
            if (event == INS_HS_BLOCK)
            {
                show_block(&host);
            }
        }
        if (reply >= 0)
        {
            ins_hs_board_rx(&board, put(line((unsigned)reply, faults)), now);
        }
        ins_hs_host_tick(&host, now);
        ins_hs_board_tick(&board, now);
        printf(" ");
    }
    show_counters(&board, &host);
}

static void extended(unsigned faults, ins_hs_config_t cfg)
{
    ins_link_board_t board;
    ins_link_host_t host;
    ins_octet_t block[INS_HS_BLOCK_MAX];
    if (ins_link_board_init(&board, &cfg) != INS_OK || ins_link_host_init(&host, &cfg) != INS_OK)
    {
        printf("refused\n");
        return;
    }
    for (uint16_t now = 0; now < SESSION_TICKS; now++)
    {
        int16_t reply = -1;
        fill(block, cfg.block_len);
        (void)ins_link_board_offer(&board, block, put(pick(256)), now);
        const int16_t octet = ins_link_board_tx(&board, now);
        printf("%d", octet);
        if (octet >= 0)
        {
            const int event = ins_link_host_rx(&host, put(line((unsigned)octet, faults)), now, &reply);
            printf(">%d:%d", event, reply);
            if (event == INS_HS_BLOCK)
            {
                show_block(&host.hs);
            }
        }
        if (reply >= 0)
        {
            ins_link_board_rx(&board, put(line((unsigned)reply, faults)), now);
        }
        ins_link_host_tick(&host, now);
        ins_link_board_tick(&board, now);
        printf(" ");
    }
    show_counters(&board.hs, &host.hs);
    printf("extended %u, fallbacks %u\n", (unsigned)board.extended, (unsigned)board.fallbacks);
}

static void gimu(int check)
{
    ins_gimu_t g;
    ins_gimu_init(&g, check);
    for (unsigned n = 0; n < PACKETS; n++)
    {
        ins_octet_t packet[INS_GIMU_T2_LEN] = {0};
        const unsigned length = pick(3) ? INS_GIMU_T1_LEN : INS_GIMU_T2_LEN;
        for (unsigned i = 2; i < length; i++)
        {
            packet[i] = (ins_octet_t)(i < INS_GIMU_T1_LEN ? i % 2 ? pick(256) : pick(16) : i % 4 == 2 ? 1 : pick(30));
        }
        packet[0] = 0xAA;
        packet[1] = 0x55;
        for (unsigned i = 0; i < length; i++)
        {
            const int type = ins_gimu_rx(&g, put(line(packet[i], 1)));
            const ins_gimu_packet_t* p = &g.packet;
            printf("%d ", type);
            if (type != INS_GIMU_NOTHING)
            {
                printf("%u %u %u %u %u %u %lu %lu %ld %ld %u %u\n", p->raw[0], p->raw[1], p->raw[2], p->raw[3],
                       p->raw[4], p->raw[5], (unsigned long)p->coordinate[0], (unsigned long)p->coordinate[1],
                       (long)p->lat_e7, (long)p->lon_e7, (unsigned)p->sats, (unsigned)p->has_position);
            }
        }
        printf("%d\n", pick(8) ? 0 : ins_gimu_flush(&g));
    }
    printf("%lu %lu %lu\n", (unsigned long)g.t1, (unsigned long)g.t2, (unsigned long)g.skipped);
}

static void nmea(void)
{
    static const char* const bodies[] = {
        "GPGGA,123519.487,4807.0381234,N,01131.000,E,1,08,0.9,545.4,M,-46.9,M,,",
        "GNRMC,235960.5,A,4807.038,S,01131.000,W,022.4,084.4,230394,003.1,W",
        "GPVTG,054.7,T,034.4,M,005.5,N,010.2,K,A",
        "GPGSV,2,1,08,01,40,083,46",
        "GPGGA,,,,,,0,,,,M,,M,,",
    };
    ins_nmea_t n;
    ins_nmea_init(&n);
    for (unsigned k = 0; k < SENTENCES; k++)
    {
        char text[LONGEST];
        unsigned sum = 0;
        unsigned length = 0;
        for (const char* c = bodies[pick(5)]; *c != '\0'; c++)
        {
            text[length++] = (char)(pick(60) ? (unsigned char)*c : 32 + pick(95));
            sum ^= (unsigned char)text[length - 1];
        }
        sum ^= pick(10) == 0;
        length += (unsigned)snprintf(text + length, LONGEST - length, pick(2) ? "*%02X\r\n" : "*%02x\n", sum);
        (void)ins_nmea_rx(&n, put(line('$', 2)));
        for (unsigned i = 0; i < length; i++)
        {
            const int type = ins_nmea_rx(&n, put(line((unsigned char)text[i], pick(20) == 0)));
            printf("%d", type);
            if (type != INS_NMEA_NOTHING)
            {
                const ins_nmea_fix_t* f = &n.fix;
                printf("\n%u %u %u %u %u-%u-%u %lu %ld %ld %ld %ld %ld %ld %ld\n", f->has, (unsigned)f->valid,
                       (unsigned)f->quality, (unsigned)f->sats, (unsigned)f->date[0], (unsigned)f->date[1],
                       (unsigned)f->date[2], (unsigned long)f->time_ms, (long)f->lat_e7, (long)f->lon_e7,
                       (long)f->altitude_mm, (long)f->geoid_mm, (long)f->hdop_milli, (long)f->speed_milliknot,
                       (long)f->course_mdeg);
            }
        }
    }
    printf("%lu %lu %lu %lu %lu\n", (unsigned long)n.taken, (unsigned long)n.bad_checksum, (unsigned long)n.malformed,
           (unsigned long)n.cut, (unsigned long)n.other);
}

/// Blocks of noise with a right version, and what was taken put back.
static void nav_block(void)
{
    for (unsigned k = 0; k < BLOCKS; k++)
    {
        ins_octet_t block[INS_NAV_BLOCK_LEN];
        ins_nav_block_t nav;
        for (unsigned i = 0; i < INS_NAV_BLOCK_LEN; i++)
        {
            block[i] = put(i == 0 ? 4 + pick(4) : i == 2 ? pick(8) : pick(256));
        }
        const ins_status_t taken = ins_nav_block_get(block, &nav);
        printf("%d\n", taken);
        if (taken == INS_OK && ins_nav_block_put(&nav, block) == INS_OK)
        {
            printf("%lu %u %u %u %ld %ld", (unsigned long)nav.time_ms, (unsigned)nav.status, (unsigned)nav.sats,
                   (unsigned)nav.fix_age, (long)nav.en_cm[0], (long)nav.en_cm[1]);
            for (unsigned i = 0; i < INS_NAV_BLOCK_LEN; i++)
            {
                printf(" %02X", (unsigned)block[i]);
            }
            printf("\n");
        }
    }
}

int main(int argc, char** argv)
{
    (void)argv;
    dirty = argc > 1;
    for (unsigned k = 0; k < SESSIONS; k++)
    {
        const ins_hs_config_t cfg = {(uint_least8_t)(k % 3 ? 6 : 4 + k % 12), (uint_least8_t)(k % 2), 3, 40, 10};
        handshake(k % 8, cfg);
        extended(k % 8, cfg);
    }
    gimu(0);
    gimu(1);
    nmea();
    nav_block();
    return 0;
}
