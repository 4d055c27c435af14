/// The objects that stand for the device's registers. Where each lies is in shim/program.c.
/// SPDX-License-Identifier: MIT
#include "DSP281x_Device.h"

volatile struct ADC_REGS AdcRegs;
volatile struct CPUTIMER_REGS CpuTimer0Regs;
volatile struct CPUTIMER_REGS CpuTimer1Regs;
volatile struct CPUTIMER_REGS CpuTimer2Regs;
volatile struct CSM_PWL CsmPwl;
volatile struct CSM_REGS CsmRegs;
volatile struct DEV_EMU_REGS DevEmuRegs;
volatile struct ECAN_REGS ECanaRegs;
volatile struct ECAN_MBOXES ECanaMboxes;
volatile struct LAM_REGS ECanaLAMRegs;
volatile struct MOTS_REGS ECanaMOTSRegs;
volatile struct MOTO_REGS ECanaMOTORegs;
volatile struct EVA_REGS EvaRegs;
volatile struct EVB_REGS EvbRegs;
volatile struct FLASH_REGS FlashRegs;
volatile struct GPIO_DATA_REGS GpioDataRegs;
volatile struct GPIO_MUX_REGS GpioMuxRegs;
volatile struct MCBSP_REGS McbspaRegs;
volatile struct PIE_CTRL_REGS PieCtrlRegs;
struct PIE_VECT_TABLE PieVectTable;
volatile struct SCI_REGS SciaRegs;
volatile struct SCI_REGS ScibRegs;
volatile struct SPI_REGS SpiaRegs;
volatile struct SYS_CTRL_REGS SysCtrlRegs;
volatile struct XINTF_REGS XintfRegs;
volatile struct XINTRUPT_REGS XIntruptRegs;
