/// \file   gimu.c
/// \brief  GIMU packets: framing by look-ahead in a window of 25 octets, scaling.
/// SPDX-License-Identifier: MIT
#include "ins/gimu.h"

#define HEADER_1   0xAAu
#define HEADER_2   0x55u
#define SATS_MAX   32u
#define DEGREE     1000000UL ///< of a coordinate
#define MINUTE_END 600000UL
#define DEGREES    180UL
#define POLE       (90UL * DEGREE)
#define RAD        INS_C(0.01745329251994329577)

void ins_gimu_init(ins_gimu_t* self, int check_12_bits)
{
    static const ins_gimu_t zero = {0};
    *self = zero;
    self->check_12_bits = check_12_bits != 0;
}

static uint32_t word32(const ins_octet_t* at)
{
    return ((uint32_t)at[0] << 24) | ((uint32_t)at[1] << 16) | ((uint32_t)at[2] << 8) | at[3];
}

static int plausible(uint32_t coordinate)
{
    return coordinate / DEGREE <= DEGREES && coordinate % DEGREE < MINUTE_END;
}

/// Is a header at this place, or, at the end, can one still come?
static int header_at(const ins_gimu_t* self, unsigned at, int end)
{
    const unsigned n = self->count;
    return (at + 2 <= n && self->wait[at] == HEADER_1 && self->wait[at + 1] == HEADER_2) ||
           (end && (at == n || (at + 1 == n && self->wait[at] == HEADER_1)));
}

enum
{
    MORE = -1, ///< not to be told yet
    SKIP = 0   ///< no packet begins here
};

/// The length of the packet that begins the window, or one of the above.
static int judge(const ins_gimu_t* self, int end)
{
    const ins_octet_t* const w = self->wait;
    const unsigned n = self->count;
    if ((n > 0 && w[0] != HEADER_1) || (n > 1 && w[1] != HEADER_2))
    {
        return SKIP;
    }
    for (unsigned i = 2; self->check_12_bits && i < n && i < INS_GIMU_T1_LEN; i += 2)
    {
        if (w[i] > 0x0Fu)
        {
            return SKIP;
        }
    }
    if (n >= INS_GIMU_T2_LEN && header_at(self, INS_GIMU_T2_LEN, end) && plausible(word32(w + 14)) &&
        plausible(word32(w + 18)) && w[22] <= SATS_MAX)
    {
        return INS_GIMU_T2_LEN;
    }
    if (n >= INS_GIMU_T1_LEN && header_at(self, INS_GIMU_T1_LEN, end))
    {
        return INS_GIMU_T1_LEN;
    }
    return n == INS_GIMU_LOOK || end ? SKIP : MORE;
}

static void drop(ins_gimu_t* self, unsigned n)
{
    self->count = (uint_least8_t)(self->count - n);
    for (unsigned i = 0; i < self->count; i++)
    {
        self->wait[i] = self->wait[i + n];
    }
}

int32_t ins_gimu_e7(uint32_t coordinate)
{
    const uint32_t minutes = coordinate % DEGREE; // times 10^4; to 1e-7 degree: times 10^3/60
    return (int32_t)(coordinate / DEGREE * 10000000UL + (minutes * 50UL + 1) / 3);
}

static int take(ins_gimu_t* self, int length)
{
    static const ins_gimu_packet_t zero = {{0}, {0}, 0, 0, 0, 0};
    const ins_octet_t* const w = self->wait;
    ins_gimu_packet_t* const p = &self->packet;
    *p = zero;
    for (unsigned i = 0; i < 6; i++)
    {
        p->raw[i] = (uint16_t)(((uint16_t)w[2 + 2 * i] << 8) | w[3 + 2 * i]);
    }
    if (length == INS_GIMU_T1_LEN)
    {
        self->t1++;
        drop(self, INS_GIMU_T1_LEN);
        return INS_GIMU_T1;
    }
    p->coordinate[0] = word32(w + 14);
    p->coordinate[1] = word32(w + 18);
    p->sats = w[22];
    const unsigned swapped = p->coordinate[0] > POLE;
    if (p->coordinate[swapped] <= POLE)
    {
        p->lat_e7 = ins_gimu_e7(p->coordinate[swapped]);
        p->lon_e7 = ins_gimu_e7(p->coordinate[1 - swapped]);
        p->has_position = 1;
    }
    self->t2++;
    drop(self, INS_GIMU_T2_LEN);
    return INS_GIMU_T2;
}

/// Gives out the packet that begins the window, if it can be told, after dropping what begins none.
static int settle(ins_gimu_t* self, int end)
{
    while (self->count > 0)
    {
        const int length = judge(self, end && self->count >= INS_GIMU_T1_LEN);
        if (length == MORE)
        {
            break;
        }
        if (length != SKIP)
        {
            return take(self, length);
        }
        self->skipped++;
        drop(self, 1);
    }
    return INS_GIMU_NOTHING;
}

int ins_gimu_rx(ins_gimu_t* self, ins_octet_t octet)
{
    self->wait[self->count] = octet & 0xFFu;
    self->count++;
    return settle(self, 0);
}

int ins_gimu_flush(ins_gimu_t* self)
{
    return settle(self, 1);
}

void ins_gimu_scale_nominal(ins_gimu_scale_t* self)
{
    for (unsigned i = 0; i < 6; i++)
    {
        self->null[i] = INS_GIMU_NULL;
    }
    for (unsigned i = 0; i < 3; i++)
    {
        self->rate[i] = INS_GIMU_K_NOMINAL * RAD;
    }
    self->acceleration = INS_GIMU_G_NOMINAL * INS_GIMU_G;
}

void ins_gimu_scale_thesis(ins_gimu_scale_t* self)
{
    ins_gimu_scale_nominal(self);
    self->rate[0] = INS_GIMU_KP * RAD;
    self->rate[1] = INS_GIMU_KQ * RAD;
    self->rate[2] = INS_GIMU_KR * RAD;
}

void ins_gimu_increments(const ins_gimu_scale_t* self, const uint16_t* raw, ins_real dt, ins_real dtheta_b[3],
                         ins_real dv_b[3])
{
    for (unsigned i = 0; i < 3; i++)
    {
        dtheta_b[i] = self->rate[i] * ((ins_real)raw[i] - self->null[i]) * dt;
        dv_b[i] = self->acceleration * ((ins_real)raw[3 + i] - self->null[3 + i]) * dt;
    }
}
