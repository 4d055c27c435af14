/* Calls what f2812-cc did not compile and what does not come back. SPDX-License-Identifier: MIT */
#include "DSP281x_Device.h"

extern int poll(void* none, unsigned long count, int timeout);

void main(void)
{
    for (;;)
    {
        poll(0, 0, -1);
    }
}
