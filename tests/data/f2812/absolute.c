#include "DSP281x_Device.h"

void main(void)
{
    *(volatile Uint16*)0x7050 = 7;
}
