/// \file   main.c
/// \brief  The thesis's navigator on a TMS320F2812: GIMU on SCI-A, PC on SCI-B, CPU timer 0 as the clock, watchdog on.
///
/// 30 MHz crystal, SYSCLKOUT 150 MHz, LSPCLK 37.5 MHz. The main loop sleeps between octets and milliseconds; a packet is taken
/// when the line has been silent for a few octets' time, for nothing in it says how long it is.
/// Source: "GPS/INS System Design and Integration", master's thesis, Chung Hua University, 2009, chapter 4.
/// SPDX-License-Identifier: MIT
#include "navigate.h"
#include "report.h"
#include "thesis.h"

#define SYSCLK_MHZ 150
#define TICK_US    1000
#define SILENCE_MS 3      // an octet takes 0.52 ms
#define WDCR_ON    0x002F // WDCHK 101, 30 MHz / 512 / 64 / 256: 280 ms
#define WDCR_FLAG  0x0080 // the last reset was the watchdog's

// What it begins with; octets from the PC change it.
#ifndef THESIS_NULLS
#define THESIS_NULLS NULL_FRACTION
#endif
#ifndef THESIS_FILTER
#define THESIS_FILTER 1
#endif
#ifndef THESIS_LEVEL
#define THESIS_LEVEL 1
#endif

static volatile Uint32 Ticks;
static navigation_t Navigation;
static report_t Report;
static ins_gimu_t Gimu;

interrupt void Tick(void)
{
    Ticks++;
    PieCtrlRegs.PIEACK.all = PIEACK_GROUP1;
}

Uint32 Milliseconds(void)
{
    Uint32 Now;
    do
    {
        Now = Ticks;
    } while (Now != Ticks);
    return Now;
}

/// \return the watchdog's flag of before.
static Uint16 WatchdogOn(void)
{
    Uint16 Flag;
    EALLOW;
    Flag = SysCtrlRegs.WDCR & WDCR_FLAG;
    SysCtrlRegs.WDCR = WDCR_ON | WDCR_FLAG; // a 1 clears the flag
    EDIS;
    return Flag;
}

static void Start(void)
{
    DINT;
    InitSysCtrl();
    InitPieCtrl();
    IER = 0x0000;
    IFR = 0x0000;
    InitPieVectTable();
    InitGpio();
    InitCpuTimers();
    ConfigCpuTimer(&CpuTimer0, SYSCLK_MHZ, TICK_US);
    EALLOW;
    PieVectTable.TINT0 = &Tick;
    EDIS;
    PieCtrlRegs.PIEIER1.bit.INTx7 = 1;
    IER |= M_INT1;
    GimuInit();
    PcInit();
    PieCtrlRegs.PIECRTL.bit.ENPIE = 1;
    StartCpuTimer0();
    EINT;
    ERTM;
}

static void Command(Uint16 Octet)
{
    switch (Octet)
    {
    case COMMAND_NONE:
        break;
    case COMMAND_FILTER_ON:
    case COMMAND_FILTER_OFF:
        Navigation.filter = Octet == COMMAND_FILTER_ON;
        break;
    case COMMAND_LEVEL_ON:
    case COMMAND_LEVEL_OFF:
        Navigation.level = Octet == COMMAND_LEVEL_ON;
        break;
    default:
        navigation_begin(&Navigation, (null_mode_t)Octet);
    }
}

static void Packet(int Type, Uint16 Started)
{
    ins_nav_block_t Block;
    if (Type == INS_GIMU_NOTHING)
    {
        return;
    }
    navigation_packet(&Navigation, &Gimu.packet, Type, Milliseconds());
    navigation_block(&Navigation, &Block);
    Block.status |= GimuErrors() ? INS_NAV_BLOCK_LINE_ERROR : 0;
    Block.status |= Started;
    report_put(&Report, &Block);
}

int main(void)
{
    Uint16 Started;
    int Octet;
    Start();
    Started = WatchdogOn() ? INS_NAV_BLOCK_WATCHDOG : 0;
    ins_gimu_init(&Gimu, 1);
    report_begin(&Report);
    Navigation.filter = THESIS_FILTER;
    Navigation.level = THESIS_LEVEL;
    navigation_begin(&Navigation, THESIS_NULLS);
    for (;;)
    {
        ServiceDog();
        while ((Octet = GimuRead()) >= 0)
        {
            Packet(ins_gimu_rx(&Gimu, (ins_octet_t)Octet), Started);
        }
        if (Gimu.count >= INS_GIMU_T1_LEN && GimuSilence() > SILENCE_MS)
        {
            Packet(ins_gimu_flush(&Gimu), Started);
        }
        while ((Octet = PcRead()) >= 0)
        {
            Command(report_rx(&Report, (Uint16)Octet, (Uint16)Milliseconds()));
        }
        report_tick(&Report, (Uint16)Milliseconds());
        while (PcRoom() && (Octet = report_tx(&Report, (Uint16)Milliseconds())) >= 0)
        {
            PcWrite((Uint16)Octet);
        }
        asm(" IDLE"); // until the next octet or millisecond
    }
}
