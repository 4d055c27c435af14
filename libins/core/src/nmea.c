/// \file   nmea.c
/// \brief  NMEA 0183: framing and checksum octet by octet, fields when the checksum has agreed.
/// SPDX-License-Identifier: MIT
#include "ins/nmea.h"

#define MILLI_DIGITS  3
#define MINUTE_DIGITS 7
#define WHOLE_MAX     2000000L ///< of a figure with three decimals, so that its thousandths fit

enum
{
    OUTSIDE,
    BODY,
    SUM_1, ///< the first digit of the checksum is due
    SUM_2,
    END ///< carriage return or line feed is due
};

void ins_nmea_init(ins_nmea_t* self)
{
    static const ins_nmea_t zero = {0};
    *self = zero;
}

/// Fields of a body whose checksum agreed, one after the other.
typedef struct cursor_t
{
    const ins_octet_t* text;
    unsigned at, end; ///< the field under the cursor is [at, end)
    unsigned length;  ///< of the body
    int fine;         ///< 1: nothing unreadable so far
} cursor_t;

static void find_end(cursor_t* c)
{
    for (c->end = c->at; c->end < c->length && c->text[c->end] != ','; c->end++)
    {
    }
}

/// To the next field; beyond the last one every field is empty.
static void next(cursor_t* c)
{
    c->at = c->end < c->length ? c->end + 1 : c->length;
    find_end(c);
}

static int empty(const cursor_t* c)
{
    return c->at == c->end;
}

/// One character, 0 for an empty field.
static ins_octet_t letter(cursor_t* c)
{
    if (empty(c))
    {
        return 0;
    }
    c->fine &= c->end - c->at == 1;
    return c->text[c->at];
}

static int is_digit(ins_octet_t octet)
{
    return octet >= '0' && octet <= '9';
}

/// Just `digits` digits at the cursor, which moves on. \return their number; not fine if there are fewer.
static int32_t digits(cursor_t* c, unsigned count)
{
    int32_t value = 0;
    for (; count > 0; count--)
    {
        if (c->at == c->end || !is_digit(c->text[c->at]))
        {
            c->fine = 0;
            return 0;
        }
        value = 10 * value + (int32_t)(c->text[c->at] - '0');
        c->at++;
    }
    return value;
}

/// `whole` and the decimals at the cursor (none, or a point and digits to the end of the field) in units of 10^-kept.
static int32_t decimals(cursor_t* c, int32_t whole, unsigned kept)
{
    if (c->at < c->end)
    {
        c->fine &= c->text[c->at] == '.';
        c->at++;
    }
    for (; c->at < c->end; c->at++)
    {
        c->fine &= is_digit(c->text[c->at]);
        if (kept > 0 && c->fine)
        {
            whole = 10 * whole + (int32_t)(c->text[c->at] - '0');
            kept--;
        }
    }
    for (; kept > 0; kept--)
    {
        whole *= 10;
    }
    return whole;
}

/// A figure in thousandths, with a sign or without. \return 1 if the field is not empty.
static int thousandths(cursor_t* c, int32_t* value)
{
    int32_t whole = 0;
    if (empty(c))
    {
        return 0;
    }
    const int negative = c->text[c->at] == '-';
    c->at += (unsigned)negative;
    c->fine &= c->at < c->end && is_digit(c->text[c->at]);
    for (; c->at < c->end && is_digit(c->text[c->at]); c->at++)
    {
        if (whole >= WHOLE_MAX / 10)
        {
            c->fine = 0;
            return 0;
        }
        whole = 10 * whole + (int32_t)(c->text[c->at] - '0');
    }
    whole = decimals(c, whole, MILLI_DIGITS);
    *value = negative ? -whole : whole;
    return 1;
}

/// A small whole number. \return 1 if the field is not empty.
static int small(cursor_t* c, uint_least8_t* value)
{
    int32_t v;
    if (!thousandths(c, &v))
    {
        return 0;
    }
    c->fine &= v >= 0 && v <= 255000L && v % 1000 == 0;
    *value = (uint_least8_t)((v / 1000) & 0xFF);
    return 1;
}

static void time_of_day(cursor_t* c, ins_nmea_fix_t* fix)
{
    if (!empty(c))
    {
        const int32_t h = digits(c, 2);
        const int32_t m = digits(c, 2);
        const int32_t ms = decimals(c, digits(c, 2), MILLI_DIGITS);
        c->fine &= h < 24 && m < 60 && ms < 61000L; // a leap second is 60
        fix->time_ms = (uint32_t)(h * 3600000L + m * 60000L + ms);
        fix->has |= INS_NMEA_TIME;
    }
    next(c);
}

/// (d)ddmm.mmmm and its hemisphere: two fields. \return 1 if there.
static int coordinate(cursor_t* c, unsigned degree_digits, int32_t limit, ins_octet_t minus, ins_octet_t plus,
                      int32_t* e7)
{
    const int there = !empty(c);
    if (there)
    {
        const int32_t degrees = digits(c, degree_digits);
        const int32_t minutes = decimals(c, digits(c, 2), MINUTE_DIGITS);
        c->fine &= degrees < limit || (degrees == limit && minutes == 0);
        c->fine &= minutes < 600000000L;
        *e7 = c->fine ? (int32_t)(degrees * 10000000L + (minutes + 30) / 60) : 0;
    }
    next(c);
    const ins_octet_t side = letter(c);
    c->fine &= there ? side == minus || side == plus : side == 0 || side == minus || side == plus;
    if (there && side == minus)
    {
        *e7 = -*e7;
    }
    next(c);
    return there;
}

static void position(cursor_t* c, ins_nmea_fix_t* fix)
{
    const int lat = coordinate(c, 2, 90, 'S', 'N', &fix->lat_e7);
    const int lon = coordinate(c, 3, 180, 'W', 'E', &fix->lon_e7);
    c->fine &= lat == lon;
    fix->has |= lat ? INS_NMEA_POSITION : 0;
}

/// A figure in thousandths into fix, whose bit is then set.
static void figure(cursor_t* c, ins_nmea_fix_t* fix, int32_t* value, unsigned bit)
{
    fix->has |= (uint16_t)(thousandths(c, value) ? bit : 0);
    next(c);
}

static void unit_letter(cursor_t* c, ins_octet_t want)
{
    const ins_octet_t got = letter(c);
    c->fine &= got == 0 || got == want;
    next(c);
}

static void gga(cursor_t* c, ins_nmea_fix_t* fix)
{
    time_of_day(c, fix);
    position(c, fix);
    fix->valid = small(c, &fix->quality) && fix->quality > 0;
    next(c);
    fix->has |= small(c, &fix->sats) ? INS_NMEA_SATS : 0;
    next(c);
    figure(c, fix, &fix->hdop_milli, INS_NMEA_HDOP);
    figure(c, fix, &fix->altitude_mm, INS_NMEA_ALTITUDE);
    unit_letter(c, 'M');
    figure(c, fix, &fix->geoid_mm, INS_NMEA_GEOID);
    unit_letter(c, 'M');
}

static void rmc(cursor_t* c, ins_nmea_fix_t* fix)
{
    time_of_day(c, fix);
    fix->valid = letter(c) == 'A';
    next(c);
    position(c, fix);
    figure(c, fix, &fix->speed_milliknot, INS_NMEA_SPEED);
    figure(c, fix, &fix->course_mdeg, INS_NMEA_COURSE);
    if (!empty(c))
    {
        for (unsigned i = 0; i < 3; i++)
        {
            fix->date[i] = (uint_least8_t)digits(c, 2);
        }
        c->fine &=
            c->at == c->end && fix->date[0] >= 1 && fix->date[0] <= 31 && fix->date[1] >= 1 && fix->date[1] <= 12;
        fix->has |= INS_NMEA_DATE;
    }
}

static void vtg(cursor_t* c, ins_nmea_fix_t* fix)
{
    figure(c, fix, &fix->course_mdeg, INS_NMEA_COURSE);
    unit_letter(c, 'T');
    next(c); // magnetic course
    unit_letter(c, 'M');
    figure(c, fix, &fix->speed_milliknot, INS_NMEA_SPEED);
    unit_letter(c, 'N');
    next(c); // km/h
    unit_letter(c, 'K');
    fix->valid = letter(c) != 'N' && (fix->has & INS_NMEA_SPEED) != 0;
}

static void read_fields(int type, cursor_t* c, ins_nmea_fix_t* fix)
{
    if (type == INS_NMEA_GGA)
    {
        gga(c, fix);
    }
    else if (type == INS_NMEA_RMC)
    {
        rmc(c, fix);
    }
    else
    {
        vtg(c, fix);
    }
}

/// The sentence whose checksum agreed.
static int sentence(ins_nmea_t* self)
{
    static const ins_nmea_fix_t nothing; // all 0
    static const ins_octet_t known[3][3] = {{'G', 'G', 'A'}, {'R', 'M', 'C'}, {'V', 'T', 'G'}};
    cursor_t c = {self->body, 0, 0, self->count, 1};
    find_end(&c);
    for (int type = INS_NMEA_GGA; type <= INS_NMEA_VTG; type++)
    {
        const ins_octet_t* const name = known[type - INS_NMEA_GGA];
        if (c.end == 5 && c.text[2] == name[0] && c.text[3] == name[1] && c.text[4] == name[2])
        {
            ins_nmea_fix_t fix;
            fix = nothing;
            next(&c);
            read_fields(type, &c, &fix);
            if (!c.fine)
            {
                self->malformed++;
                return INS_NMEA_NOTHING;
            }
            self->fix = fix;
            self->taken++;
            return type;
        }
    }
    self->other++;
    return INS_NMEA_NOTHING;
}

/// 0..15, or 16 if it is no hexadecimal digit.
static uint_least8_t hex(ins_octet_t octet)
{
    if (is_digit(octet))
    {
        return (uint_least8_t)(octet - '0');
    }
    octet &= 0xDFu; // capital
    return octet >= 'A' && octet <= 'F' ? (uint_least8_t)(octet - 'A' + 10) : 16;
}

int ins_nmea_rx(ins_nmea_t* self, ins_octet_t octet)
{
    octet &= 0xFFu;
    const uint_least8_t state = self->state;
    if (octet == '$')
    {
        self->cut += state != OUTSIDE;
        self->state = BODY;
        self->count = 0;
        self->sum = 0;
    }
    else if (state == BODY && octet == '*')
    {
        self->state = SUM_1;
    }
    else if (state == BODY)
    {
        if (octet < ' ' || octet > '~' || self->count == INS_NMEA_BODY_MAX)
        {
            self->cut++;
            self->state = OUTSIDE;
            return INS_NMEA_NOTHING;
        }
        self->body[self->count] = octet;
        self->count++;
        self->sum ^= octet;
    }
    else if (state == SUM_1)
    {
        self->sent = hex(octet);
        self->state = SUM_2;
    }
    else if (state == SUM_2)
    {
        const uint_least8_t low = hex(octet);
        self->sent = (uint_least8_t)(self->sent < 16 && low < 16 && self->sent * 16 + low == self->sum);
        self->state = END;
    }
    else if (state == END)
    {
        self->state = OUTSIDE;
        if (self->sent && (octet == '\r' || octet == '\n'))
        {
            return sentence(self);
        }
        self->bad_checksum++;
    }
    return INS_NMEA_NOTHING;
}
