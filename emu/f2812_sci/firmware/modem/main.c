/// A driver of a Hayes modem on SCI-A, 115200 Bd, with a console on SCI-B, 38400 Bd. The eZdsp F2812: OSCCLK 30 MHz, SYSCLKOUT 150 MHz,
/// LSPCLK 37.5 MHz. The watchdog is on and must be kicked.
/// SPDX-License-Identifier: MIT
#include "DSP28_Device.h"
#include "app.h"
#include "ticks.h"
#include "uart.h"

#define LSPCLK_HZ 37500000UL

void main(void)
{
    InitSysCtrl();
    EALLOW;
    GpioMuxRegs.GPFMUX.bit.SCITXDA_GPIOF4 = 1;
    GpioMuxRegs.GPFMUX.bit.SCIRXDA_GPIOF5 = 1;
    GpioMuxRegs.GPGMUX.bit.SCITXDB_GPIOG4 = 1;
    GpioMuxRegs.GPGMUX.bit.SCIRXDB_GPIOG5 = 1;
    EDIS;

    DINT;
    InitPieCtrl();
    IER = 0x0000;
    IFR = 0x0000;
    InitPieVectTable();
    EALLOW;
    PieVectTable.RXAINT = &uart_rxa_isr;
    PieVectTable.TXAINT = &uart_txa_isr;
    PieVectTable.RXBINT = &uart_rxb_isr;
    PieVectTable.TXBINT = &uart_txb_isr;
    PieVectTable.TINT0 = &ticks_isr;
    EDIS;

    uart_open(UART_MODEM, LSPCLK_HZ, 115200UL);
    uart_open(UART_CONSOLE, LSPCLK_HZ, 38400UL);
    ticks_open(150.0f);

    PieCtrl.PIECRTL.bit.ENPIE = 1;
    PieCtrl.PIEIER1.bit.INTx7 = 1; /* TINT0 */
    PieCtrl.PIEIER9.all = 0x000F;
    IER |= M_INT1 | M_INT9;
    EINT;
    ERTM;

    EALLOW;
    SysCtrlRegs.WDCR = 0x002F; /* on, OSCCLK / 512 / 64: 0.28 s */
    EDIS;
    app_open();
    for (;;)
    {
        KickDog();
        app_poll();
    }
}
