/// \file   port_avr.c
/// \brief  Characters to UART 0 of an ATmega1284P, which simavr prints.
///
/// simavr ends at a sleep with interrupts off; there is no exit code but the printed one.
/// SPDX-License-Identifier: MIT
#include "report.h"
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>

void port_put(char c)
{
    UCSR0B = (uint_least8_t)(1u << TXEN0);
    while (((unsigned)UCSR0A & (1u << UDRE0)) == 0)
    {
    }
    UDR0 = (uint_least8_t)c;
}

int port_exit(int code)
{
    cli();
    sleep_enable();
    sleep_cpu();
    return code;
}
