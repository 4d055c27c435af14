/* A counter on SCI-A, 9600-8-N-1: once a tenth of a second CPU timer 0 sends its value as a line; 'r' from the host sets it to 0. */
#include "DSP281x_Device.h"
#include "DSP281x_Examples.h"
#include <stdio.h>

static volatile Uint16 tick;

static interrupt void timer_isr(void)
{
    tick = 1;
    PieCtrlRegs.PIEACK.all = PIEACK_GROUP1;
}

void main(void)
{
    char line[16], *p;
    Uint16 count = 0;

    InitSysCtrl(); /* 150 MHz, LSPCLK 37.5 MHz */
    InitPieCtrl();
    InitPieVectTable();
    InitGpio();
    InitScia(); /* 9600 Bd, FIFOs */
    EALLOW;
    PieVectTable.TINT0 = &timer_isr;
    EDIS;
    InitCpuTimers();
    ConfigCpuTimer(&CpuTimer0, 150, 100000);
    StartCpuTimer0();
    PieCtrlRegs.PIECRTL.bit.ENPIE = 1;
    PieCtrlRegs.PIEIER1.bit.INTx7 = 1;
    IER |= M_INT1;
    EINT;

    for (;;)
    {
        while (!tick)
            if (SciaRegs.SCIFFRX.bit.RXFIFST != 0 && SciaRegs.SCIRXBUF.bit.RXDT == 'r')
                count = 0;
        tick = 0;
        sprintf(line, "count %u\r\n", count++);
        for (p = line; *p != '\0'; p++)
            SciaRegs.SCITXBUF = *p;
    }
}
