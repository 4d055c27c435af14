/// \file   nav_block.c
/// \brief  Navigation result to and from 32 octets.
/// SPDX-License-Identifier: MIT
#include "ins/nav_block.h"
#include "ins/ins_math.h"
#include "ins/quat.h"

#define UNIT       INS_C(8388608.0) ///< 2^23, of a quaternion's component
#define MILLI      INS_C(1000.0)    ///< of a velocity
#define THREE_MAX  INS_C(0.750001)  ///< the squares of the three smaller components are at most 3/4
#define NORM2_LOW  INS_C(0.998)
#define NORM2_HIGH INS_C(1.002)
#define VELOCITY   16u
#define QUATERNION 22u

static void put(ins_octet_t* at, unsigned octets, uint32_t value)
{
    for (unsigned i = octets; i > 0; i--)
    {
        at[i - 1] = (ins_octet_t)(value & 0xFFu);
        value >>= 8;
    }
}

static uint32_t get(const ins_octet_t* at, unsigned octets)
{
    uint32_t value = 0;
    for (unsigned i = 0; i < octets; i++)
    {
        value = (value << 8) | (at[i] & 0xFFu);
    }
    return value;
}

/// Two's complement of `bits` bits, without a conversion that the language leaves to the machine.
static int32_t get_signed(const ins_octet_t* at, unsigned octets)
{
    const uint32_t sign = (uint32_t)0x80u << (8 * (octets - 1));
    const uint32_t value = get(at, octets);
    return (value & sign) == 0 ? (int32_t)value : -(int32_t)((sign - 1) - (value & (sign - 1))) - 1;
}

static void put_rounded(ins_octet_t* at, ins_real value)
{
    put(at, 3, (uint32_t)(int32_t)(value < 0 ? value - INS_C(0.5) : value + INS_C(0.5)));
}

ins_status_t ins_nav_block_put(const ins_nav_block_t* nav, ins_octet_t* block)
{
    ins_real q[4];
    ins_real norm2 = 0;
    unsigned largest = 0;
    for (unsigned i = 0; i < 4; i++)
    {
        q[i] = nav->q_nb[i];
        norm2 += q[i] * q[i];
        largest = ins_fabs(q[i]) > ins_fabs(q[largest]) ? i : largest;
    }
    if (!(norm2 > NORM2_LOW && norm2 < NORM2_HIGH) || !(ins_fabs(nav->v_en[0]) <= INS_NAV_BLOCK_V_MAX) ||
        !(ins_fabs(nav->v_en[1]) <= INS_NAV_BLOCK_V_MAX) || (nav->status & ~(unsigned)INS_NAV_BLOCK_STATUS_ALL) != 0)
    {
        return INS_E_RANGE;
    }
    (void)ins_quat_normalise(q);
    block[0] = (ins_octet_t)((unsigned)INS_NAV_BLOCK_VERSION << 2 | largest);
    block[1] = nav->sats & 0xFFu;
    put(block + 2, 2, nav->status);
    put(block + 4, 4, nav->time_ms);
    for (unsigned i = 0; i < 2; i++)
    {
        put(block + 8 + 4 * i, 4, (uint32_t)nav->en_cm[i]);
        put_rounded(block + VELOCITY + 3 * i, nav->v_en[i] * MILLI);
    }
    const ins_real scale = q[largest] < 0 ? -UNIT : UNIT;
    for (unsigned i = 0; i < 3; i++)
    {
        put_rounded(block + QUATERNION + 3 * i, q[i < largest ? i : i + 1] * scale);
    }
    block[31] = nav->fix_age & 0xFFu;
    return INS_OK;
}

ins_status_t ins_nav_block_get(const ins_octet_t* block, ins_nav_block_t* nav)
{
    const unsigned largest = block[0] & 3u;
    const uint32_t status = get(block + 2, 2);
    ins_real q[4];
    ins_real sum = 0;
    for (unsigned i = 0; i < 3; i++)
    {
        const ins_real c = (ins_real)get_signed(block + QUATERNION + 3 * i, 3) / UNIT;
        q[i < largest ? i : i + 1] = c;
        sum += c * c;
    }
    if ((block[0] & 0xFFu) >> 2 != INS_NAV_BLOCK_VERSION || (status & ~(uint32_t)INS_NAV_BLOCK_STATUS_ALL) != 0 ||
        sum > THREE_MAX)
    {
        return INS_E_RANGE;
    }
    q[largest] = ins_sqrt(1 - sum);
    nav->time_ms = get(block + 4, 4);
    nav->status = (uint16_t)status;
    nav->sats = block[1] & 0xFFu;
    nav->fix_age = block[31] & 0xFFu;
    for (unsigned i = 0; i < 4; i++)
    {
        nav->q_nb[i] = q[i];
    }
    for (unsigned i = 0; i < 2; i++)
    {
        nav->en_cm[i] = get_signed(block + 8 + 4 * i, 4);
        nav->v_en[i] = (ins_real)get_signed(block + VELOCITY + 3 * i, 3) / MILLI;
    }
    return INS_OK;
}
