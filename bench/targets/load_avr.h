/// \file   load_avr.h
/// \brief  Cycles of a call on an ATmega1284P, from timer 1 at the clock's rate, printed by UART 0: simavr counts cycles, not instructions.
/// SPDX-License-Identifier: MIT
#ifndef INS_BENCH_LOAD_AVR_H
#define INS_BENCH_LOAD_AVR_H
#include "ins/config.h"
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>

static uint16_t timer_started;
static ins_status_t timer_status;

static void uart_put(char c)
{
    UCSR0B = (uint_least8_t)(1u << TXEN0);
    while (((unsigned)UCSR0A & (1u << UDRE0)) == 0)
    {
    }
    UDR0 = (uint_least8_t)c;
}

static void uart_number(uint16_t n)
{
    if (n >= 10)
    {
        uart_number(n / 10);
    }
    uart_put((char)('0' + n % 10));
}

/// Prints the cycles since timer_started. \return the status of the call that took them.
static ins_status_t timer_report(void)
{
    const uint16_t stopped = TCNT1;
    uart_number((uint16_t)(stopped - timer_started));
    uart_put('\n');
    return timer_status;
}

/// simavr ends at a sleep with interrupts off.
static void power_off(void)
{
    cli();
    sleep_enable();
    sleep_cpu();
}

#define MEASURED(call) (TCCR1B = 1, timer_started = TCNT1, timer_status = (call), timer_report())
#define END(code)      (power_off(), (code))

#endif // INS_BENCH_LOAD_AVR_H
