/// \file   busy.c
/// \brief  AT89S52 firmware that keeps everything moving at once: timers, serial port, interrupts of two priorities, watchdog, idle, power-down,
///         capture and clock-out of timer 2, external RAM. For the test of snapshots.
/// SPDX-License-Identifier: MIT
#include <8052.h>

__sfr __at(0xA6) WDTRST;
__sfr __at(0xC9) T2MOD;

static volatile unsigned char ticks, falls, sent, captured;
static volatile __bit slow;
static __xdata unsigned char received[256];
static unsigned char count;
static unsigned long sum;

void external(void) __interrupt(0)
{
    ++falls;
}

void tick(void) __interrupt(1)
{
    TH0 = 0xFE;
    if (!(++ticks & 7))
    {
        P2 = ticks;
        slow = 1;
    }
}

void serial(void) __interrupt(4)
{
    if (RI)
    {
        RI = 0;
        received[count++] = SBUF;
    }
    if (TI)
    {
        TI = 0;
        SBUF = sent;
        sent += 37;
    }
}

void capture(void) __interrupt(5)
{
    TF2 = 0;
    EXF2 = 0;
    captured += RCAP2L;
}

void main(void)
{
    unsigned char i = 0, turn = 0;
    WDTRST = 0x1E;
    WDTRST = 0xE1;
    TMOD = 0x21;
    TH0 = 0xFE;
    TH1 = 0xFD;
    SCON = 0x50;
    T2CON = 0x0D;
    TCON = 0x51;
    IP = 0x02;
    IE = 0xB3;
    TI = 1;
    for (;;)
    {
        sum = sum * 33 + received[i++] + falls + captured;
        P1 = (unsigned char)sum | 0x03;
        if (slow)
        {
            slow = 0;
            WDTRST = 0x1E;
            WDTRST = 0xE1;
            ++turn;
            if (!(turn & 7))
            {
                SCON = turn & 8 ? 0x82 : 0x52;
            }
            T2MOD ^= 0x02;
            PCON |= turn & 15 ? 0x01 : 0x02;
        }
    }
}
