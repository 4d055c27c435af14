/// Ring buffers between interrupts and the program. Each index has one writer, so there is no critical section but around TXFFIENA.
/// SPDX-License-Identifier: MIT
#include "uart.h"

#define RING_SIZE  256 /* a power of two */
#define RING_MASK  (RING_SIZE - 1)
#define FIFO_DEPTH 16
#define RX_LEVEL   1
#define TX_LEVEL   0

typedef struct
{
    volatile struct SCI_REGS* regs;
    volatile char rx[RING_SIZE];
    volatile Uint16 rx_head, rx_tail;
    volatile char tx[RING_SIZE];
    volatile Uint16 tx_head, tx_tail;
    uart_stats_t stats;
} uart_t;

static uart_t uarts[2] = {{&SciaRegs}, {&ScibRegs}};

void uart_open(uart_port_t port, Uint32 lspclk_hz, Uint32 baud)
{
    uart_t* u = &uarts[port];
    Uint32 brr = (lspclk_hz / 8 + baud / 2) / baud - 1;

    u->rx_head = u->rx_tail = u->tx_head = u->tx_tail = 0;
    u->regs->SCICTL1.all = 0x0000;
    u->regs->SCICCR.all = 0x0007;
    u->regs->SCIHBAUD = (Uint16)(brr >> 8) & 0xFF;
    u->regs->SCILBAUD = (Uint16)brr & 0xFF;
    u->regs->SCICTL2.all = 0x0000;
    u->regs->SCICTL2.bit.RXBKINTENA = 1;
    u->regs->SCIFFCT.all = 0x0000;
    u->regs->SCIFFTX.all = 0x8000; /* FIFOs in reset */
    u->regs->SCIFFRX.all = 0x0000;
    u->regs->SCIFFTX.bit.SCIFFENA = 1;
    u->regs->SCIFFTX.bit.TXFFILIL = TX_LEVEL;
    u->regs->SCIFFTX.bit.TXFIFOXRESET = 1;
    u->regs->SCIFFRX.bit.RXFFIL = RX_LEVEL;
    u->regs->SCIFFRX.bit.RXFFOVRCLR = 1;
    u->regs->SCIFFRX.bit.RXFFIENA = 1;
    u->regs->SCIFFRX.bit.RXFIFORESET = 1;
    u->regs->SCICTL1.all = 0x0023;
}

int16 uart_getc(uart_port_t port)
{
    uart_t* u = &uarts[port];
    char c;

    if (u->rx_tail == u->rx_head)
        return -1;
    c = u->rx[u->rx_tail];
    u->rx_tail = (u->rx_tail + 1) & RING_MASK;
    return c & 0xFF;
}

int16 uart_putc(uart_port_t port, char c)
{
    uart_t* u = &uarts[port];
    Uint16 next = (u->tx_head + 1) & RING_MASK;

    if (next == u->tx_tail)
        return 0;
    u->tx[u->tx_head] = c;
    u->tx_head = next;
    u->regs->SCIFFTX.bit.TXFFIENA = 1; /* the FIFO is at its level: comes at once */
    return 1;
}

void uart_puts(uart_port_t port, const char* text)
{
    while (*text != '\0')
    {
        if (uart_putc(port, *text))
            text++;
    }
}

void uart_put_number(uart_port_t port, Uint32 value)
{
    char digits[11];
    Uint16 n = 0;

    do
    {
        digits[n++] = (char)('0' + value % 10);
        value /= 10;
    } while (value != 0);
    while (n > 0)
    {
        if (uart_putc(port, digits[n - 1]))
            n--;
    }
}

Uint16 uart_tx_idle(uart_port_t port)
{
    uart_t* u = &uarts[port];

    return u->tx_head == u->tx_tail && u->regs->SCIFFTX.bit.TXFFST == 0 && u->regs->SCICTL2.bit.TXEMPTY;
}

const uart_stats_t* uart_stats(uart_port_t port)
{
    return &uarts[port].stats;
}

static void receive(uart_t* u)
{
    Uint16 next, word;

    if (u->regs->SCIRXST.bit.RXERROR)
    {
        u->stats.rx_errors++;
        u->regs->SCICTL1.bit.SWRESET = 0;
        u->regs->SCICTL1.bit.SWRESET = 1;
    }
    if (u->regs->SCIFFRX.bit.RXFFOVF)
    {
        u->stats.rx_lost++;
        u->regs->SCIFFRX.bit.RXFFOVRCLR = 1;
    }
    while (u->regs->SCIFFRX.bit.RXFIFST != 0)
    {
        word = u->regs->SCIRXBUF.all;
        if (word & 0xC000)
            continue; /* with a framing or parity error */
        next = (u->rx_head + 1) & RING_MASK;
        if (next == u->rx_tail)
        {
            u->stats.rx_lost++;
            continue;
        }
        u->rx[u->rx_head] = (char)(word & 0xFF);
        u->rx_head = next;
        u->stats.rx_octets++;
    }
    u->regs->SCIFFRX.bit.RXFFINTCLR = 1;
}

static void transmit(uart_t* u)
{
    while (u->tx_tail != u->tx_head && u->regs->SCIFFTX.bit.TXFFST < FIFO_DEPTH)
    {
        u->regs->SCITXBUF = u->tx[u->tx_tail] & 0xFF;
        u->tx_tail = (u->tx_tail + 1) & RING_MASK;
        u->stats.tx_octets++;
    }
    if (u->tx_tail == u->tx_head)
        u->regs->SCIFFTX.bit.TXFFIENA = 0;
    u->regs->SCIFFTX.bit.TXINTCLR = 1;
}

interrupt void uart_rxa_isr(void)
{
    receive(&uarts[UART_MODEM]);
    PieCtrlRegs.PIEACK.all = PIEACK_GROUP9;
}

interrupt void uart_txa_isr(void)
{
    transmit(&uarts[UART_MODEM]);
    PieCtrlRegs.PIEACK.all = PIEACK_GROUP9;
}

interrupt void uart_rxb_isr(void)
{
    receive(&uarts[UART_CONSOLE]);
    PieCtrlRegs.PIEACK.all = PIEACK_GROUP9;
}

interrupt void uart_txb_isr(void)
{
    transmit(&uarts[UART_CONSOLE]);
    PieCtrlRegs.PIEACK.all = PIEACK_GROUP9;
}
