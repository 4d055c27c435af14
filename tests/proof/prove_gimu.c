/// \file   prove_gimu.c
/// \brief  GIMU packets from any sound state, for ESBMC: no undefined behaviour, soundness kept, every octet in a packet, skipped, or waiting.
///
/// prove.py gives `gimu.c` with each function of a contract twice: its body as `real_NAME`, proved here to keep the contract, and
/// `NAME`, defined here, which demands what the contract asks for and gives anything that it allows. The loop of settle() has one
/// arbitrary turn: its invariant is demanded, all that it changes becomes anything that keeps it, and after the turn it holds again
/// with fewer octets waiting. So the window has its full length, and settle() any number of turns.
/// SPDX-License-Identifier: MIT
#include "prove.h"

static void any_turn(ins_gimu_t* self);
static void after_turn(const ins_gimu_t* self);
#include "gimu.c"

static ins_gimu_t at_first;  ///< before the loop of settle()
static uint_least8_t waited; ///< before a turn of it

/// The octets that came are waiting, skipped, or in the one packet that was given out.
static int accounted(const ins_gimu_t* before, unsigned came, const ins_gimu_t* s, int result)
{
    return s->t1 == before->t1 + (result == INS_GIMU_T1) && s->t2 == before->t2 + (result == INS_GIMU_T2) &&
           before->count + came == s->count + (s->skipped - before->skipped) +
                                       (result == INS_GIMU_T1   ? INS_GIMU_T1_LEN
                                        : result == INS_GIMU_T2 ? INS_GIMU_T2_LEN
                                                                : 0);
}

static int sound_window(const ins_gimu_t* s)
{
    return s->check_12_bits <= 1 && s->count <= INS_GIMU_LOOK && are_octets(s->wait, INS_GIMU_LOOK);
}

/// A header, or as much of one as has come.
static int begins(const ins_gimu_t* s, unsigned at)
{
    return (s->count <= at || s->wait[at] == 0xAAu) && (s->count <= at + 1 || s->wait[at + 1] == 0x55u);
}

/// What judge() promises: a packet is all there, a header or nothing follows, and a coordinate is one.
static int judged(const ins_gimu_t* s, int end, int length)
{
    return length == SKIP || (length == MORE && !end && s->count < INS_GIMU_LOOK && begins(s, 0)) ||
           (length == INS_GIMU_T1_LEN && s->count >= INS_GIMU_T1_LEN && begins(s, INS_GIMU_T1_LEN)) ||
           (length == INS_GIMU_T2_LEN && s->count >= INS_GIMU_T2_LEN && begins(s, INS_GIMU_T2_LEN) &&
            plausible(word32(s->wait + 14)) && plausible(word32(s->wait + 18)) && s->wait[22] <= SATS_MAX);
}

static int judge(const ins_gimu_t* self, int end)
{
    int length;
    PROVE(sound_window(self));
    GIVEN(judged(self, end, length));
    return length;
}

/// Of what remains, callers need to know where its header is; that all of it moves is proved.
static void drop(ins_gimu_t* self, unsigned n)
{
    ins_gimu_t later;
    PROVE(sound_window(self) && n <= self->count);
    GIVEN(are_octets(later.wait, INS_GIMU_LOOK));
    const unsigned left = self->count - n;
    GIVEN(left < 1 || later.wait[0] == self->wait[n]);
    GIVEN(left < 2 || later.wait[1] == self->wait[n + 1]);
    for (unsigned i = 0; i < INS_GIMU_LOOK; i++)
    {
        self->wait[i] = later.wait[i];
    }
    self->count = (uint_least8_t)left;
}

static int take(ins_gimu_t* self, int length)
{
    ins_gimu_packet_t packet;
    PROVE(length > 0 && judged(self, 0, length));
    GIVEN(sound_packet(&packet));
    self->packet = packet;
    self->t1 += length == INS_GIMU_T1_LEN;
    self->t2 += length == INS_GIMU_T2_LEN;
    drop(self, (unsigned)length);
    return length == INS_GIMU_T1_LEN ? INS_GIMU_T1 : INS_GIMU_T2;
}

static int settle(ins_gimu_t* self, int end)
{
    ins_gimu_t later;
    int result;
    PROVE(sound_window(self));
    GIVEN(sound_gimu(&later) && are_octets(later.wait, INS_GIMU_LOOK));
    GIVEN(result >= INS_GIMU_NOTHING && result <= INS_GIMU_T2 && accounted(self, 0, &later, result));
    GIVEN(!end || later.count < INS_GIMU_T1_LEN);
    GIVEN(result == INS_GIMU_NOTHING || sound_packet(&later.packet));
    *self = later;
    return result;
}

/// The invariant of the loop in settle(): a window of octets, none lost.
static int turning(const ins_gimu_t* s)
{
    return sound_window(s) && accounted(&at_first, 0, s, INS_GIMU_NOTHING);
}

static void any_turn(ins_gimu_t* self)
{
    ins_gimu_t any;
    PROVE(turning(self));
    any.check_12_bits = self->check_12_bits;
    any.packet = self->packet;
    any.t1 = self->t1;
    any.t2 = self->t2;
    GIVEN(turning(&any));
    *self = any;
    waited = any.count;
}

static void after_turn(const ins_gimu_t* self)
{
    PROVE(turning(self));
    PROVE(self->count < waited);
    GIVEN(0);
}

void gimu_init(void)
{
    ins_gimu_t s;
    int check;
    ins_gimu_init(&s, check);
    PROVE(sound_gimu(&s) && sound_window(&s));
}

void gimu_judge(void)
{
    ins_gimu_t s;
    int end;
    GIVEN(sound_window(&s));
    PROVE(judged(&s, end, real_judge(&s, end)));
}

void gimu_drop(void)
{
    static const unsigned lengths[] = {1, INS_GIMU_T1_LEN, INS_GIMU_T2_LEN};
    ins_gimu_t s;
    unsigned k;
    const unsigned n = lengths[CASE];
    GIVEN(sound_window(&s) && n <= s.count);
    const ins_gimu_t before = s;
    real_drop(&s, n);
    PROVE(s.count == before.count - n);
    PROVE(sound_window(&s));
    GIVEN(k < s.count);
    PROVE(s.wait[k] == before.wait[k + n]);
}

void gimu_take(void)
{
    ins_gimu_t s;
    const int length = CASE ? INS_GIMU_T2_LEN : INS_GIMU_T1_LEN;
    GIVEN(sound_window(&s) && judged(&s, 0, length));
    const ins_gimu_t before = s;
    const int result = real_take(&s, length);
    PROVE(result == (CASE ? INS_GIMU_T2 : INS_GIMU_T1));
    PROVE(sound_gimu(&s) && sound_packet(&s.packet) && accounted(&before, 0, &s, result));
}

void gimu_settle(void)
{
    ins_gimu_t s;
    int end;
    GIVEN(sound_window(&s));
    at_first = s;
    const int result = real_settle(&s, end);
    PROVE(result >= INS_GIMU_NOTHING && result <= INS_GIMU_T2);
    PROVE(sound_gimu(&s) && sound_window(&s) && accounted(&at_first, 0, &s, result));
    PROVE(result == INS_GIMU_NOTHING || sound_packet(&s.packet));
    PROVE(!end || s.count < INS_GIMU_T1_LEN);
}

void gimu_rx(void)
{
    ins_gimu_t s;
    ins_octet_t octet;
    GIVEN(sound_gimu(&s) && sound_window(&s));
    const ins_gimu_t before = s;
    const int result = ins_gimu_rx(&s, octet);
    PROVE(sound_gimu(&s) && accounted(&before, 1, &s, result));
    PROVE(result == INS_GIMU_NOTHING || sound_packet(&s.packet));
}

void gimu_flush(void)
{
    ins_gimu_t s;
    GIVEN(sound_gimu(&s) && sound_window(&s));
    const ins_gimu_t before = s;
    const int result = ins_gimu_flush(&s);
    PROVE(sound_gimu(&s) && accounted(&before, 0, &s, result) && s.count < INS_GIMU_T1_LEN);
    PROVE(result == INS_GIMU_NOTHING || sound_packet(&s.packet));
}
