/// \file   uart.h
/// \brief  Both SCIs behind ring buffers: interrupts fill and drain them, the FIFOs are used in both directions.
/// SPDX-License-Identifier: MIT
#ifndef UART_H
#define UART_H
#include "DSP281x_Device.h"

typedef enum
{
    UART_MODEM = 0,  /* SCI-A */
    UART_CONSOLE = 1 /* SCI-B */
} uart_port_t;

typedef struct
{
    Uint32 rx_octets;
    Uint32 tx_octets;
    Uint16 rx_lost;   /* ring full, or FIFO overflow */
    Uint16 rx_errors; /* break, framing, parity, overrun */
} uart_stats_t;

void uart_open(uart_port_t port, Uint32 lspclk_hz, Uint32 baud);
int16 uart_getc(uart_port_t port);                  /* -1: nothing there */
int16 uart_putc(uart_port_t port, char c);          /* 0: no room */
void uart_puts(uart_port_t port, const char* text); /* waits for room */
void uart_put_number(uart_port_t port, Uint32 value);
Uint16 uart_tx_idle(uart_port_t port); /* the last stop bit is out */
const uart_stats_t* uart_stats(uart_port_t port);

interrupt void uart_rxa_isr(void);
interrupt void uart_txa_isr(void);
interrupt void uart_rxb_isr(void);
interrupt void uart_txb_isr(void);

#endif /* UART_H */
