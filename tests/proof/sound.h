/// \file   sound.h
/// \brief  What holds of each parser's state between any two calls. Assumed and proved by the harnesses, checked by the other tests.
///
/// Each predicate is inductive: with any octet at any time it leads to itself. Counters are left open: they wrap.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_SOUND_H
#define INS_TESTS_SOUND_H
#include "ins/gimu.h"
#include "ins/link.h"
#include "ins/nmea.h"

enum
{
    BOARD_IDLE,
    BOARD_REQUEST,
    BOARD_WAIT_READY,
    BOARD_FRAME,
    BOARD_WAIT_ACK
};
enum
{
    HOST_IDLE,
    HOST_BLOCK
};
enum
{
    NMEA_IDLE,
    NMEA_BODY,
    NMEA_SUM_1,
    NMEA_SUM_2,
    NMEA_END
};

static inline int are_octets(const ins_octet_t* at, unsigned count)
{
    for (unsigned i = 0; i < count; i++)
    {
        if (at[i] > 0xFFu)
        {
            return 0;
        }
    }
    return 1;
}

static inline unsigned sum_of(const ins_octet_t* at, unsigned count)
{
    unsigned sum = 0;
    for (unsigned i = 0; i < count; i++)
    {
        sum = (sum + at[i]) & 0xFFu;
    }
    return sum;
}

static inline int sound_length(const ins_hs_config_t* cfg)
{
    return cfg->block_len >= (cfg->seq ? 4 : 1) && cfg->block_len <= INS_HS_BLOCK_MAX;
}

/// A block on its way is octets whose sum is `sum`; the octet that goes out next is in it, or is the sum.
static inline int sound_board(const ins_hs_board_t* s)
{
    return sound_length(&s->cfg) && s->cfg.reply_timeout >= 1 && s->cfg.reply_timeout <= 32767 &&
           s->state <= BOARD_WAIT_ACK && (s->state != BOARD_FRAME || s->next <= s->cfg.block_len) &&
           (s->state == BOARD_IDLE || (s->tries <= s->cfg.retries && are_octets(s->block, s->cfg.block_len) &&
                                       s->sum == sum_of(s->block, s->cfg.block_len)));
}

/// What came of a block so far is octets whose sum is `sum`.
static inline int sound_host(const ins_hs_host_t* s)
{
    return sound_length(&s->cfg) && s->cfg.octet_timeout >= 1 && s->cfg.octet_timeout <= 32767 &&
           s->state <= HOST_BLOCK && s->tries <= s->cfg.retries && s->have_seq <= 1 && s->seq <= 0xFFu &&
           s->gap <= 0xFFu &&
           (s->state == HOST_IDLE ||
            (s->count <= s->cfg.block_len && are_octets(s->block, s->count) && s->sum == sum_of(s->block, s->count)));
}

/// One of the two machines works, not both; the extended frame goes from the number to the second octet of the CRC.
static inline int sound_link_board(const ins_link_board_t* s)
{
    const unsigned length = s->hs.cfg.block_len;
    return sound_board(&s->hs) && length <= INS_LINK_BLOCK_MAX && s->state <= BOARD_WAIT_ACK && s->seq <= 0xFFu &&
           s->known <= 1 && s->paper_left < INS_LINK_PROBE_EVERY &&
           (s->state == BOARD_IDLE ||
            (s->hs.state == BOARD_IDLE && s->hs.tries <= s->hs.cfg.retries && are_octets(s->hs.block, length))) &&
           (s->state != BOARD_FRAME || s->hs.next <= length + 2);
}

static inline int sound_link_host(const ins_link_host_t* s)
{
    const unsigned length = s->hs.cfg.block_len;
    return sound_host(&s->hs) && length <= INS_LINK_BLOCK_MAX && s->state <= 1 && s->extended <= 1 &&
           (s->state == 0 || (s->hs.state == HOST_IDLE && s->extended && s->hs.count <= length + 2 &&
                              (!s->hs.count || s->hs.sum <= 0xFFu) &&
                              are_octets(s->hs.block, s->hs.count > length ? length
                                                      : s->hs.count        ? s->hs.count - 1u
                                                                           : 0)));
}

/// What waits is octets, begins with a header, and is shorter than what settles any question.
static inline int sound_gimu(const ins_gimu_t* s)
{
    return s->check_12_bits <= 1 && s->count < INS_GIMU_LOOK && are_octets(s->wait, s->count) &&
           (s->count < 1 || s->wait[0] == 0xAAu) && (s->count < 2 || s->wait[1] == 0x55u);
}

/// A packet that was given out: samples of 16 bits, a position that there is on Earth.
static inline int sound_packet(const ins_gimu_packet_t* p)
{
    return p->has_position <= 1 && p->sats <= 32 && p->lat_e7 >= 0 && p->lat_e7 <= INT32_C(900000000) &&
           p->lon_e7 >= 0 && p->lon_e7 <= INT32_C(1810000000);
}

/// The body is text without $ and *, `sum` is its exclusive or; `sent` is a digit, then a verdict.
static inline int sound_nmea(const ins_nmea_t* s)
{
    unsigned sum = 0;
    if (s->state > NMEA_END || s->count > INS_NMEA_BODY_MAX || (s->state == NMEA_SUM_2 && s->sent > 16) ||
        (s->state == NMEA_END && s->sent > 1))
    {
        return 0;
    }
    for (unsigned i = 0; i < s->count; i++)
    {
        const ins_octet_t octet = s->body[i];
        if (octet < ' ' || octet > '~' || octet == '$' || octet == '*')
        {
            return 0;
        }
        sum ^= octet;
    }
    return s->sum == sum;
}

/// A fix that was given out: each figure within what its field can hold.
static inline int sound_fix(const ins_nmea_fix_t* f)
{
    const int32_t figure_max = INT32_C(2000000999); // WHOLE_MAX of nmea.c in thousandths
    const int32_t figures[] = {f->altitude_mm, f->geoid_mm, f->hdop_milli, f->speed_milliknot, f->course_mdeg};
    for (unsigned i = 0; i < sizeof figures / sizeof figures[0]; i++)
    {
        if (figures[i] > figure_max || figures[i] < -figure_max)
        {
            return 0;
        }
    }
    return f->has <= 511 && f->valid <= 1 && f->quality <= 0xFFu && f->sats <= 0xFFu && f->time_ms < 86401000UL &&
           f->lat_e7 <= INT32_C(900000000) && f->lat_e7 >= -INT32_C(900000000) && f->lon_e7 <= INT32_C(1800000000) &&
           f->lon_e7 >= -INT32_C(1800000000) &&
           (!(f->has & INS_NMEA_DATE) ||
            (f->date[0] >= 1 && f->date[0] <= 31 && f->date[1] >= 1 && f->date[1] <= 12 && f->date[2] <= 99));
}

#endif // INS_TESTS_SOUND_H
