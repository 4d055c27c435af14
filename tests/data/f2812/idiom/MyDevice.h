// Headers of another hand, in the other idiom: types behind the usual guard, unions in full, definitions placed by pragmas, C++ considered.
#ifndef MY_DEVICE_H
#define MY_DEVICE_H
#ifdef __cplusplus
extern "C" {
#endif

#ifndef DSP28_DATA_TYPES
#define DSP28_DATA_TYPES
typedef int int16;
typedef long int32;
typedef unsigned int Uint16;
typedef unsigned long Uint32;
typedef float float32;
typedef long double float64;
#endif
typedef unsigned short int uint8_t;

extern cregister volatile unsigned int IFR;
extern cregister volatile unsigned int IER;
#define EINT   asm(" clrc INTM")
#define DINT   asm(" setc INTM")
#define EALLOW asm(" EALLOW")
#define EDIS   asm(" EDIS")
#define ESTOP0 asm(" ESTOP0")

struct SCICCR_BITS {        // bit    description
   Uint16 SCICHAR:3;        // 2:0    Character length control
   Uint16 ADDRIDLE_MODE:1;  // 3      ADDR/IDLE Mode control
   Uint16 LOOPBKENA:1;      // 4      Loop Back enable
   Uint16 PARITYENA:1;      // 5      Parity enable
   Uint16 PARITY:1;         // 6      Even or Odd Parity
   Uint16 STOPBITS:1;       // 7      Number of Stop Bits
   Uint16 rsvd1:8;          // 15:8   reserved
};
union SCICCR_REG {
   Uint16              all;
   struct SCICCR_BITS  bit;
};
struct SCI_REGS {
   union SCICCR_REG SCICCR;
   Uint16 SCICTL1, SCIHBAUD, SCILBAUD, SCICTL2, SCIRXST, SCIRXEMU, SCIRXBUF, rsvd1, SCITXBUF, SCIFFTX, SCIFFRX, SCIFFCT;
   Uint16 rsvd2[2];
   Uint16 SCIPRI;
};
struct SYS_CTRL_REGS {
   Uint16 rsvd1[12];
   Uint16 PCLKCR;
   Uint16 rsvd2[12];
   Uint16 WDCR;
   Uint16 rsvd3[6];
};
struct PIE_CTRL_REGS {
   Uint16 PIECRTL, PIEACK;
   struct { Uint16 IER_, IFR_; } GROUP[12];
};
typedef interrupt void(*PINT)(void);
struct PIE_VECT_TABLE {
   PINT ENTRY[128];
};

extern volatile struct SCI_REGS SciaRegs;
extern volatile struct SYS_CTRL_REGS SysCtrlRegs;
extern volatile struct PIE_CTRL_REGS PieCtrlRegs;
extern struct PIE_VECT_TABLE PieVectTable;

#ifdef __cplusplus
}
#endif
#endif
