/* What tests/system/test_observe.py knows to the cycle. Timer 1 interrupts timer 0's handler. SPDX-License-Identifier: MIT */
#include <8051.h>

#define SPINS 50

volatile unsigned char done, never, sum;

/* Vector and LJMP 4, then 2 + 2 + 2 * SPINS + 2 + 2. */
void slow(void) __interrupt(TF0_VECTOR) __naked
{
    __asm
        push    b
        mov     b,#SPINS
    00001$:
        djnz    b,00001$
        pop     b
        reti
    __endasm;
}

/* Vector and LJMP 4, then 1 + 1 + 2. */
void quick(void) __interrupt(TF1_VECTOR) __naked
{
    __asm
        nop
        nop
        reti
    __endasm;
}

static unsigned char down(unsigned char n) __reentrant
{
    if (n == 0)
    {
        return 0;
    }
    return n + down(n - 1);
}

/* MUL 4, RET 2. */
void second(void) __naked
{
    __asm
        mul     ab
        ret
    __endasm;
}

/* NOP 1, LJMP 2, and what it goes on as. */
void first(void) __naked
{
    __asm
        nop
        ljmp    _second
    __endasm;
}

static void choose(unsigned char x)
{
    if (x > 3)
    {
        never = 1;
    }
    else
    {
        done = 1;
    }
}

void untouched(void)
{
    never = 2;
}

void main(void)
{
    unsigned char i;
    sum = down(4);
    first();
    for (i = 0; i < 3; i++)
    {
        choose(i);
    }
    TMOD = 0x22;
    TH0 = TL0 = 0;
    TH1 = TL1 = 6;
    PT1 = 1;
    IE = 0x8A;
    TR0 = 1;
    TR1 = 1;
    while (1)
    {
        PCON |= 1;
    }
}
