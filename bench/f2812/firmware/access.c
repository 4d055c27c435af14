/// N rounds of ACCESSES accesses of one register in a row: KIND 0 none, 1 reads, 2 writes, 3 writes of a bit-field.
/// SPDX-License-Identifier: MIT
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"

#if KIND == 1
#define ONE (void)SciaRegs.SCIRXST.all;
#elif KIND == 2
#define ONE SciaRegs.SCILBAUD = 7;
#elif KIND == 3
#define ONE SciaRegs.SCICTL2.bit.TXINTENA = 1;
#else
#define ONE
#endif
#define TEN ONE ONE ONE ONE ONE ONE ONE ONE ONE ONE

static void round_of_accesses(void)
{
    TEN TEN TEN TEN TEN TEN TEN TEN TEN TEN
}

void main(void)
{
    Uint32 i;

    DisableDog();
    InitPeripheralClocks();
    for (i = 0; i < N; i++)
    {
        round_of_accesses();
    }
}
