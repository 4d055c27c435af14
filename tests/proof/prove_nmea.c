/// \file   prove_nmea.c
/// \brief  NMEA sentences from any sound state, for ESBMC: no undefined behaviour, soundness kept, each $ ends in one counter.
///
/// Functions have contracts as in prove_gimu.c, and each loop over a field one arbitrary turn, so a body has its full length.
/// What sound_nmea() says of every octet of the body is proved of one at any place. Its exclusive or is `folded`, which follows
/// the body: nothing of it changes but what is put behind it.
/// SPDX-License-Identifier: MIT
#include "prove.h"

typedef struct cursor_t cursor_t;
static void any_end(cursor_t* c);
static void after_end(const cursor_t* c);
static void any_decimal(cursor_t* c, int32_t* whole, unsigned* kept);
static void after_decimal(const cursor_t* c, int32_t whole, unsigned kept);
static void any_zero(int32_t* whole, unsigned* kept);
static void after_zero(int32_t whole, unsigned kept);
static void any_digit(cursor_t* c, int32_t* whole);
static void after_digit(const cursor_t* c, int32_t whole);
#include "nmea.c"

#define SECONDS_END 100L ///< two digits
#define DEGREE      10000000L
static const int32_t power[] = {1, 10, 100, 1000, 10000, 100000L, 1000000L, 10000000L};
static int32_t top;        ///< of decimals(): `whole` is below it
static unsigned all, seen; ///< decimals to keep; a loop's measure before its turn

static int sound_cursor(const cursor_t* c)
{
    return c->at <= c->end && c->end <= c->length && c->length <= INS_NMEA_BODY_MAX && (c->fine == 0 || c->fine == 1);
}

/// Moves on within its field, and stays unreadable if it is.
static void move(cursor_t* c)
{
    unsigned at;
    int fine;
    GIVEN(at >= c->at && at <= c->end && (fine == 0 || fine == 1) && fine <= c->fine);
    c->at = at;
    c->fine = fine;
}

/// In this field or one behind it.
static void any_field(cursor_t* c)
{
    unsigned end;
    GIVEN(end >= c->end && end <= c->length);
    c->end = end;
    move(c);
}

static int moved(const cursor_t* c, const cursor_t* before)
{
    return sound_cursor(c) && c->at >= before->at && c->end == before->end && c->length == before->length &&
           c->text == before->text && c->fine <= before->fine;
}

static void find_end(cursor_t* c)
{
    unsigned end;
    PROVE(c->at <= c->length && c->length <= INS_NMEA_BODY_MAX);
    GIVEN(end >= c->at && end <= c->length);
    c->end = end;
}

static int32_t digits(cursor_t* c, unsigned count)
{
    int32_t value;
    PROVE(sound_cursor(c) && count <= 3);
    GIVEN(value >= 0 && value < power[count]);
    move(c);
    return value;
}

static int32_t decimals(cursor_t* c, int32_t whole, unsigned kept)
{
    int32_t value;
    PROVE(sound_cursor(c) && whole >= 0 && kept <= MINUTE_DIGITS);
    const int32_t below = whole < SECONDS_END ? SECONDS_END : WHOLE_MAX;
    PROVE(whole < below && (below == SECONDS_END || kept <= MILLI_DIGITS));
    GIVEN(value >= 0 && value < below * power[kept]);
    move(c);
    GIVEN(c->at == c->end);
    return value;
}

static int is_figure(int32_t value)
{
    return value < WHOLE_MAX * 1000 && value > -WHOLE_MAX * 1000;
}

static int thousandths(cursor_t* c, int32_t* value)
{
    int32_t figure;
    int there;
    PROVE(sound_cursor(c));
    move(c);
    GIVEN(there == 0 || (there == 1 && is_figure(figure)));
    *value = there ? figure : *value;
    return there;
}

static int small(cursor_t* c, uint_least8_t* value)
{
    uint_least8_t number;
    int there;
    PROVE(sound_cursor(c));
    move(c);
    GIVEN(there == 0 || (there == 1 && number <= 255));
    *value = there ? number : *value;
    return there;
}

static void time_of_day(cursor_t* c, ins_nmea_fix_t* fix)
{
    ins_nmea_fix_t timed;
    PROVE(sound_cursor(c) && (!c->fine || sound_fix(fix)));
    any_field(c);
    GIVEN(!c->fine || sound_fix(&timed));
    *fix = timed;
}

static int coordinate(cursor_t* c, unsigned degree_digits, int32_t limit, ins_octet_t minus, ins_octet_t plus,
                      int32_t* e7)
{
    int32_t value;
    int there;
    (void)minus;
    (void)plus;
    PROVE(sound_cursor(c) && degree_digits <= 3 && limit <= 180);
    any_field(c);
    GIVEN(there == 0 || (there == 1 && value >= -limit * DEGREE && value <= limit * DEGREE));
    *e7 = there ? value : *e7;
    return there;
}

static void read_fields(int type, cursor_t* c, ins_nmea_fix_t* fix)
{
    ins_nmea_fix_t read;
    PROVE(type >= INS_NMEA_GGA && type <= INS_NMEA_VTG && sound_cursor(c) && sound_fix(fix));
    any_field(c);
    GIVEN(!c->fine || sound_fix(&read));
    *fix = read;
}

/// One of these three has grown by one.
static int sentence(ins_nmea_t* self)
{
    int type;
    ins_nmea_fix_t fix;
    PROVE(self->count <= INS_NMEA_BODY_MAX);
    GIVEN(type >= INS_NMEA_NOTHING && type <= INS_NMEA_VTG);
    if (type != INS_NMEA_NOTHING)
    {
        GIVEN(sound_fix(&fix));
        self->fix = fix;
        self->taken++;
        return type;
    }
    int malformed;
    self->malformed += malformed != 0;
    self->other += malformed == 0;
    return type;
}

static void any_end(cursor_t* c)
{
    unsigned end;
    PROVE(c->end >= c->at && c->end <= c->length);
    GIVEN(end >= c->at && end <= c->length);
    c->end = seen = end;
}

static void after_end(const cursor_t* c)
{
    PROVE(c->end >= c->at && c->end <= c->length);
    PROVE(c->end > seen);
    GIVEN(0);
}

static int below_top(int32_t whole, unsigned kept)
{
    return kept <= all && whole >= 0 && whole < top * power[all - kept];
}

static void any_decimal(cursor_t* c, int32_t* whole, unsigned* kept)
{
    int32_t value;
    unsigned left;
    PROVE(sound_cursor(c) && below_top(*whole, *kept));
    GIVEN(below_top(value, left));
    *whole = value;
    *kept = left;
    move(c);
    seen = c->at;
}

static void after_decimal(const cursor_t* c, int32_t whole, unsigned kept)
{
    PROVE(sound_cursor(c) && below_top(whole, kept));
    PROVE(c->at > seen);
    GIVEN(0);
}

static void any_zero(int32_t* whole, unsigned* kept)
{
    int32_t value;
    unsigned left;
    PROVE(below_top(*whole, *kept));
    GIVEN(below_top(value, left));
    *whole = value;
    *kept = seen = left;
}

static void after_zero(int32_t whole, unsigned kept)
{
    PROVE(below_top(whole, kept));
    PROVE(kept < seen);
    GIVEN(0);
}

static void any_digit(cursor_t* c, int32_t* whole)
{
    int32_t value;
    PROVE(sound_cursor(c) && *whole >= 0 && *whole < WHOLE_MAX);
    GIVEN(value >= 0 && value < WHOLE_MAX);
    *whole = value;
    move(c);
    seen = c->at;
}

static void after_digit(const cursor_t* c, int32_t whole)
{
    PROVE(sound_cursor(c) && whole >= 0 && whole < WHOLE_MAX);
    PROVE(c->at > seen);
    GIVEN(0);
}

/// How many of the five counters have grown, each by one.
static unsigned grown(const ins_nmea_t* s, const ins_nmea_t* before)
{
    PROVE(s->taken == before->taken || s->taken == before->taken + 1);
    PROVE(s->bad_checksum == before->bad_checksum || s->bad_checksum == before->bad_checksum + 1);
    PROVE(s->malformed == before->malformed || s->malformed == before->malformed + 1);
    PROVE(s->cut == before->cut || s->cut == before->cut + 1);
    PROVE(s->other == before->other || s->other == before->other + 1);
    return (unsigned)((s->taken != before->taken) + (s->bad_checksum != before->bad_checksum) +
                      (s->malformed != before->malformed) + (s->cut != before->cut) + (s->other != before->other));
}

void nmea_find_end(void)
{
    ins_octet_t text[INS_NMEA_BODY_MAX];
    cursor_t c;
    c.text = text;
    GIVEN(c.at <= c.length && c.length <= INS_NMEA_BODY_MAX);
    const cursor_t before = c;
    real_find_end(&c);
    PROVE(c.end >= c.at && c.end <= c.length && c.at == before.at && c.length == before.length &&
          c.fine == before.fine);
    PROVE(c.end == c.length || text[c.end] == ',');
}

void nmea_digits(void)
{
    ins_octet_t text[INS_NMEA_BODY_MAX];
    cursor_t c;
    unsigned count;
    c.text = text;
    GIVEN(sound_cursor(&c) && count <= 3);
    const cursor_t before = c;
    const int32_t value = real_digits(&c, count);
    PROVE(moved(&c, &before) && value >= 0 && value < power[count]);
    PROVE(!c.fine || c.at == before.at + count);
}

void nmea_decimals(void)
{
    static const int32_t tops[] = {SECONDS_END, SECONDS_END, WHOLE_MAX};
    ins_octet_t text[INS_NMEA_BODY_MAX];
    cursor_t c;
    int32_t whole;
    c.text = text;
    top = tops[CASE];
    all = CASE == 0 ? MINUTE_DIGITS : MILLI_DIGITS;
    GIVEN(sound_cursor(&c) && whole >= 0 && whole < top);
    const cursor_t before = c;
    const int32_t value = real_decimals(&c, whole, all);
    PROVE(moved(&c, &before) && c.at == c.end);
    PROVE(value >= 0 && value < top * power[all]);
}

void nmea_thousandths(void)
{
    ins_octet_t text[INS_NMEA_BODY_MAX];
    cursor_t c;
    int32_t value;
    c.text = text;
    GIVEN(sound_cursor(&c));
    const cursor_t before = c;
    const int32_t old = value;
    const int there = real_thousandths(&c, &value);
    PROVE(moved(&c, &before));
    PROVE(there ? there == 1 && is_figure(value) : value == old);
}

void nmea_small(void)
{
    ins_octet_t text[INS_NMEA_BODY_MAX];
    cursor_t c;
    uint_least8_t value;
    c.text = text;
    GIVEN(sound_cursor(&c));
    const cursor_t before = c;
    const uint_least8_t old = value;
    const int there = real_small(&c, &value);
    PROVE(moved(&c, &before));
    PROVE(there ? there == 1 && value <= 255 : value == old);
}

/// Of its field, or of one behind it.
static int went_on(const cursor_t* c, const cursor_t* before)
{
    return sound_cursor(c) && c->at >= before->at && c->end >= before->end && c->length == before->length &&
           c->text == before->text && c->fine <= before->fine;
}

void nmea_time_of_day(void)
{
    ins_octet_t text[INS_NMEA_BODY_MAX];
    cursor_t c;
    ins_nmea_fix_t fix;
    c.text = text;
    GIVEN(sound_cursor(&c) && (!c.fine || sound_fix(&fix)));
    const cursor_t before = c;
    real_time_of_day(&c, &fix);
    PROVE(went_on(&c, &before));
    PROVE(!c.fine || sound_fix(&fix));
}

void nmea_coordinate(void)
{
    ins_octet_t text[INS_NMEA_BODY_MAX];
    cursor_t c;
    int32_t value;
    const int32_t limit = CASE ? 180 : 90;
    c.text = text;
    GIVEN(sound_cursor(&c));
    const cursor_t before = c;
    const int32_t old = value;
    const int there = real_coordinate(&c, CASE ? 3 : 2, limit, CASE ? 'W' : 'S', CASE ? 'E' : 'N', &value);
    PROVE(went_on(&c, &before));
    PROVE(there ? there == 1 && value >= -limit * DEGREE && value <= limit * DEGREE : value == old);
}

void nmea_read_fields(void)
{
    static const ins_nmea_fix_t nothing;
    ins_octet_t text[INS_NMEA_BODY_MAX];
    cursor_t c;
    ins_nmea_fix_t fix = nothing;
    c.text = text;
    GIVEN(sound_cursor(&c));
    const cursor_t before = c;
    real_read_fields(CASE, &c, &fix);
    PROVE(went_on(&c, &before));
    PROVE(!c.fine || sound_fix(&fix));
}

void nmea_sentence(void)
{
    ins_nmea_t s;
    unsigned k;
    GIVEN(s.count <= INS_NMEA_BODY_MAX && k < INS_NMEA_BODY_MAX);
    const ins_nmea_t before = s;
    const int type = real_sentence(&s);
    PROVE(type >= INS_NMEA_NOTHING && type <= INS_NMEA_VTG);
    PROVE(s.taken == before.taken + (type != INS_NMEA_NOTHING));
    PROVE(grown(&s, &before) == 1 && s.bad_checksum == before.bad_checksum);
    PROVE(type == INS_NMEA_NOTHING || sound_fix(&s.fix));
    PROVE(s.state == before.state && s.count == before.count && s.sum == before.sum && s.cut == before.cut);
    PROVE(s.body[k] == before.body[k]);
}

void nmea_init(void)
{
    ins_nmea_t s;
    ins_nmea_init(&s);
    PROVE(sound_nmea(&s));
}

static int is_text(ins_octet_t octet)
{
    return octet >= ' ' && octet <= '~' && octet != '$' && octet != '*';
}

static int sound_frame(const ins_nmea_t* s)
{
    return s->state <= NMEA_END && s->count <= INS_NMEA_BODY_MAX && (s->state != NMEA_SUM_2 || s->sent <= 16) &&
           (s->state != NMEA_END || s->sent <= 1);
}

void nmea_rx(void)
{
    ins_nmea_t s;
    ins_octet_t octet;
    unsigned k;
    s.state = CASE;
    GIVEN(sound_frame(&s) && k < INS_NMEA_BODY_MAX && (k >= s.count || is_text(s.body[k])));
    const uint_least8_t folded = s.sum;
    const ins_nmea_t before = s;
    const int type = ins_nmea_rx(&s, octet);
    const ins_octet_t clean = octet & 0xFFu;
    PROVE(sound_frame(&s) && (k >= s.count || is_text(s.body[k])));
    PROVE(grown(&s, &before) + (s.state != NMEA_IDLE) == (unsigned)((before.state != NMEA_IDLE) + (clean == '$')));
    PROVE((type != INS_NMEA_NOTHING) == (s.taken != before.taken));
    PROVE(type == INS_NMEA_NOTHING || sound_fix(&s.fix));
    PROVE(k >= s.count || k >= before.count || s.body[k] == before.body[k]);
    PROVE(s.count == 0 ? clean == '$' || before.count == 0 : s.count == before.count || s.count == before.count + 1);
    PROVE(s.sum == (s.count == before.count + 1    ? folded ^ s.body[before.count]
                    : s.count == 0 && clean == '$' ? 0
                                                   : folded));
}
