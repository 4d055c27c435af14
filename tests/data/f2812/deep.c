#include "DSP281x_Device.h"

static Uint16 deep(Uint16 k)
{
    volatile Uint16 local[500];
    local[0] = k;
    return deep(k + 1) + local[0];
}

void main(void)
{
    deep(0);
}
