/* What a debugger steps through; tests/system/test_debugger.py knows the comments at the ends of its lines. SPDX-License-Identifier: MIT */
#include <8051.h>

struct point
{
    int x;
    int y;
};

volatile unsigned char ticks;
volatile unsigned int total;
__idata struct point point = {-3, 4};
__xdata unsigned char far[4];
unsigned char values[4] = {10, 20, 30, 40};
const __code char text[] = "ins";
struct point* pointer;
unsigned int (*chosen)(unsigned char);

void tick(void) __interrupt(TF0_VECTOR)
{
    ticks++; /* in tick */
}

static unsigned int twice(unsigned char n)
{
    unsigned int result = n; /* twice 1 */
    result += n;             /* twice 2 */
    return result;           /* twice 3 */
}

static unsigned char depth(unsigned char n) __reentrant
{
    if (n == 0) /* depth 1 */
    {
        return 0; /* bottom */
    }
    return depth(n - 1) + 1; /* down */
}

static void count(void)
{
    total += twice(3);  /* count 1 */
    total += chosen(5); /* by pointer */
    values[1]++;        /* count 3 */
}

void main(void)
{
    TMOD = 0x22; /* first */
    TH0 = 0;
    ET0 = 1;
    TH1 = 0xFD; /* 9600 Bd */
    SCON = 0x50;
    TR1 = 1;
    chosen = twice;
    pointer = (struct point*)&point;
    EA = 1;
    TR0 = 1; /* last */
    while (1)
    {
        count();            /* loop 1 */
        far[0] += depth(3); /* loop 2 */
        P1_0 = !P1_0;       /* loop 3 */
        if (RI)             /* loop 4 */
        {
            SBUF = SBUF + 1; /* echo */
            RI = 0;
        }
    }
}
