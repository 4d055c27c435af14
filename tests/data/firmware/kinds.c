/* Every kind of symbol that SDCC writes into a .cdb file; tests/system/test_cdb.py knows this file's lines. SPDX-License-Identifier: MIT */
#include <8051.h>
#include <stdbool.h>

struct node
{
    struct node* next;
    union
    {
        unsigned int word;
        char octets[2];
    } content[2];
};
struct fields
{
    unsigned low : 3;
    unsigned high : 5;
};

__xdata struct node nodes[3];
__idata int table[3][4];
volatile unsigned long total = 123456;
const __code char text[] = "ins";
float ratio;
bool valid;
long long wide;
struct fields fields;
__bit flag;
int (*__xdata callback)(int);
__xdata __at(0x4000) volatile unsigned char latch;
__sfr __at(0x8E) AUXR;

static int helper(int n) __reentrant
{
    int squares[3];
    int i;
    for (i = 0; i < 3; i++)
    {
        squares[i] = n * i;
    }
    return squares[2];
}

void tick(void) __interrupt(TF0_VECTOR) __using(1)
{
    static unsigned char count;
    count++;
    if (count == 3)
    {
        flag = 1;
    }
}

unsigned char pause(void) __naked
{
    __asm
        mov     dpl,#7
        ret
    __endasm;
}

void main(void)
{
    int total = helper(2);
    valid = total > 3;
    ratio = total;
    wide += pause();
    while (1)
    {
        PCON |= 1;
    }
}
