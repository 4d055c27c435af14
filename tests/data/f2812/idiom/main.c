// Loops 200 octets through SCI-A by its receive interrupt. The vector table is copied as 128 words of 32 bits, which wants -m32.
// Names are those that a host's C library has too; `this` is no keyword in C.
#include "MYDEVICE.H"

#pragma CODE_SECTION(rx, "ramfuncs");
interrupt void rx(void);
interrupt void unused(void) { asm ("      ESTOP0"); for(;;); }

static uint8_t read, write;
static Uint16 time;
volatile Uint16 wrong;

static const Uint32* table(struct PIE_VECT_TABLE* this)
{
   Uint16 i;
   for (i = 0; i < 128; i++)
      this->ENTRY[i] = unused;
   this->ENTRY[96] = rx; // 9.1
   return (const Uint32*)this;
}

interrupt void rx(void)
{
   if ((SciaRegs.SCIRXBUF & 0xFF) != (read++ & 0xFF))
      wrong++;
   time++;
   PieCtrlRegs.PIEACK = 0x0100;
}

void main(void)
{
   static struct PIE_VECT_TABLE init;
   const Uint32* Source = table(&init);
   Uint32* Dest = (Uint32*)&PieVectTable;
   int16 i;

   EALLOW;
   SysCtrlRegs.WDCR = 0x0068;
   SysCtrlRegs.PCLKCR = 0x0400;
   EDIS;
   EALLOW;
   for (i = 0; i < 128; i++)
      *Dest++ = *Source++;
   EDIS;
   SciaRegs.SCICCR.all = 0x0007;
   SciaRegs.SCICCR.bit.LOOPBKENA = 1;
   SciaRegs.SCILBAUD = 15;
   SciaRegs.SCICTL2 = 0x0002;
   SciaRegs.SCICTL1 = 0x0023;
   PieCtrlRegs.GROUP[8].IER_ = 1;
   PieCtrlRegs.PIECRTL = 1;
   IER |= 0x0100;
   EINT;
   while (time < 200)
   {
      if ((SciaRegs.SCICTL2 & 0x80) && write == time)
         SciaRegs.SCITXBUF = write++ & 0xFF;
   }
   if (wrong)
      ESTOP0;
}
