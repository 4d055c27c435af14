/// Acquisition firmware of the board of Zheng and Zhou (2010), AT89S51 at 11.0592 MHz: samples X, Y, Z of a TLC2543, or six
/// accelerometers on AIN0 to AIN5, at an exact period and hands each sample to the host by the handshake of the core library
/// (ins/handshake.h).
///
/// Sampling is paced by timer 0, whose interrupt is the only one of high priority: the reload adds to the running count, so that no
/// latency is lost or gained, and the scan then waits until a fixed count after the overflow: the sampling instants are a fixed number
/// of machine cycles apart. A scan is ACQ_CHANNELS + 1 transfers of 12 clocks, because the TLC2543 gives the result of the transfer
/// before.
/// The main loop serves the handshake and idles. While the host is silent the newest sample replaces the one that waits.
///
/// Counters for a debugger, by symbol: sampled = link.sent + lost + those not yet offered or on their way.
/// SPDX-License-Identifier: MIT
#include "acq_config.h"
#include "ins/handshake.h"
#include <8051.h>
#include <stddef.h>

#define AIN_X 0x00 ///< D7-D4 input, then 12 bits, MSB first, unipolar
#define AIN_Y 0x10
#define AIN_Z 0x20
#define AIN_3 0x30
#define AIN_4 0x40
#define AIN_5 0x50

#define RELOAD       (65536 - ACQ_TICK_CYCLES)
#define STOPPED      7  ///< cycles from CLR TR0 to SETB TR0, in which timer 0 counts nothing
#define ALIGN_AT     54 ///< cycles after the overflow at which the scan may go on, whatever the latency was ...
#define ALIGN_WITHIN 16 ///< ... if it has come at most this much sooner
#define EOC_POLLS    10 ///< of 4 cycles: the conversion takes 12.2 us at most, and is over at the first

volatile uint16_t sampled;     ///< scans taken
uint16_t lost;                 ///< samples replaced before they were offered, or given up by the handshake
volatile uint8_t adc_timeouts; ///< conversions that did not end
INS_HS_MEM ins_hs_board_t link;
const __code uint8_t link_counters = offsetof(ins_hs_board_t, sent); ///< sent, resent, given_up begin here in link

static INS_HS_MEM uint16_t codes[ACQ_CHANNELS];
static INS_HS_MEM ins_octet_t block[ACQ_BLOCK_LEN];
static volatile uint8_t ticks;
static uint8_t ticks_left;
static volatile uint8_t rx_octet, tx_octet;
static volatile __bit rx_full, tx_full, tx_idle, event;

/// One transfer: the next address out, the previous result in. The EOC wait comes first, where it is over in any case.
static uint16_t transfer(uint8_t address) __naked __using(1)
{
    (void)address;
    // clang-format off
    __asm
        mov     b,#EOC_POLLS
    00001$:
        jb      _P1_0,00002$
        djnz    b,00001$
        inc     _adc_timeouts
    00002$:
        clr     _P1_4           ; /CS low: 1.425 us to the first clock
        mov     a,dpl
        mov     b,#8
    00003$:
        mov     c,_P1_3         ; DATA OUT, valid since the last falling edge
        rlc     a
        mov     _P1_2,c         ; DATA IN
        setb    _P1_1
        clr     _P1_1
        djnz    b,00003$
        mov     dph,a           ; the upper eight bits
        clr     a
        mov     b,#4
    00004$:
        mov     c,_P1_3
        rlc     a
        setb    _P1_1
        clr     _P1_1
        djnz    b,00004$
        setb    _P1_4
        mov     dpl,a           ; dptr = dph << 4 | a
        mov     a,dph
        swap    a
        anl     a,#0xF0
        orl     dpl,a
        mov     a,dph
        swap    a
        anl     a,#0x0F
        mov     dph,a
        ret
    __endasm;
    // clang-format on
}

void tick(void) __interrupt(TF0_VECTOR) __using(1)
{
    // clang-format off
    __asm
        clr     _TR0
        mov     a,#<(RELOAD + STOPPED)
        add     a,_TL0
        mov     _TL0,a
        mov     a,#>(RELOAD + STOPPED)
        addc    a,_TH0
        mov     _TH0,a
        setb    _TR0
    __endasm;
    // clang-format on
    ticks++;
    event = 1;
    if (--ticks_left != 0)
    {
        return;
    }
    ticks_left = ACQ_TICKS;
    // clang-format off
    __asm
        mov     a,#<(RELOAD + ALIGN_AT)
        clr     c
        subb    a,_TL0          ; cycles to wait
        cjne    a,#ALIGN_WITHIN,00001$
    00001$:
        jnc     00005$
        rrc     a
        jnc     00002$
        nop
    00002$:
        rrc     a
        jnc     00003$
        nop
        nop
    00003$:
        rrc     a
        jnc     00004$
        nop
        nop
        nop
        nop
    00004$:
        rrc     a
        jnc     00005$
        nop
        nop
        nop
        nop
        nop
        nop
        nop
        nop
    00005$:
    __endasm;
    // clang-format on
    transfer(AIN_X);
    codes[0] = transfer(AIN_Y);
    codes[1] = transfer(AIN_Z);
#if ACQ_CHANNELS == 6
    codes[2] = transfer(AIN_3);
    codes[3] = transfer(AIN_4);
    codes[4] = transfer(AIN_5);
#endif
    codes[ACQ_CHANNELS - 1] = transfer(AIN_X);
    sampled++;
}

void serial(void) __interrupt(SI0_VECTOR)
{
    if (RI)
    {
        RI = 0;
        rx_octet = SBUF;
        rx_full = 1;
    }
    if (TI)
    {
        TI = 0;
        if (tx_full)
        {
            SBUF = tx_octet;
            tx_full = 0;
        }
        else
        {
            tx_idle = 1;
        }
    }
    event = 1;
}

/// Offer the newest sample when the handshake is free. The copy is taken again if a scan ran into it.
static void offer(uint16_t now)
{
    static uint8_t taken;
    static uint16_t given_up;
    uint8_t number;
    if (ins_hs_board_busy(&link))
    {
        return;
    }
    lost += link.given_up - given_up;
    given_up = link.given_up;
    if ((uint8_t)sampled == taken)
    {
        return;
    }
    do
    {
        number = (uint8_t)sampled;
        ins_hs_block_put(codes, block);
#if ACQ_CHANNELS == 6
        ins_hs_block_put(codes + 3, block + 6);
#endif
    } while (number != (uint8_t)sampled);
    lost += (uint8_t)(number - taken - 1);
    taken = number;
    ins_hs_board_offer(&link, block, number, now);
}

/// Keep one octet ready behind the one in the shift register, so that a block goes out without gaps.
static void transmit(uint16_t now)
{
    int16_t octet;
    if (tx_full)
    {
        return;
    }
    octet = ins_hs_board_tx(&link, now);
    if (octet >= 0)
    {
        tx_octet = (uint8_t)octet;
        tx_full = 1;
        if (tx_idle)
        {
            tx_idle = 0;
            TI = 1;
        }
    }
}

void main(void)
{
    static const __code ins_hs_config_t config = {ACQ_BLOCK_LEN, ACQ_SEQ, ACQ_RETRIES, ACQ_REPLY_TICKS, 0};
    uint16_t now = 0;
    uint8_t seen = 0, step;
    P1_1 = 0;
    ins_hs_board_init(&link, &config);
    tx_idle = 1;
    ticks_left = ACQ_TICKS;
    TMOD = 0x21; // timer 0: 16 bits; timer 1: 8 bits with reload, the baud
    TH0 = (uint8_t)(RELOAD >> 8);
    TL0 = (uint8_t)(RELOAD & 0xFF);
    TH1 = (uint8_t)(256 - ACQ_BAUD_DIVISOR);
    TL1 = (uint8_t)(256 - ACQ_BAUD_DIVISOR);
    PCON = 0x80; // SMOD
    SCON = 0x70; // mode 1, receiver on, octets without a stop bit are dropped
    TR0 = 1;
    TR1 = 1;
    PT0 = 1;
    IE = 0x92; // timer 0, serial
    for (;;)
    {
        event = 0;
        step = ticks - seen;
        seen += step;
        now += step;
        if (rx_full)
        {
            rx_full = 0;
            ins_hs_board_rx(&link, rx_octet, now);
        }
        ins_hs_board_tick(&link, now);
        offer(now);
        transmit(now);
        EA = 0;
        if (!event)
        {
            EA = 1; // the instruction after this one runs before any interrupt: no event falls between test and sleep
            PCON |= 0x01;
        }
        EA = 1;
    }
}
