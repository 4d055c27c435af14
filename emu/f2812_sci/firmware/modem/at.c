/// Collects lines between CR LF, knows the final ones, and sends a command again when no answer comes.
/// SPDX-License-Identifier: MIT
#include "at.h"
#include "ticks.h"
#include "uart.h"
#include <string.h>

#define TRIES 3

static const struct
{
    const char* text;
    at_result_t result;
} finals[] = {
    {"OK", AT_OK},
    {"CONNECT", AT_CONNECT},
    {"ERROR", AT_ERROR},
    {"+CME ERROR", AT_ERROR},
    {"NO CARRIER", AT_NO_CARRIER},
    {"BUSY", AT_BUSY_TONE},
};

static struct
{
    at_line_fn on_line;
    at_result_t state;
    char command[AT_LINE_MAX];
    Uint32 timeout_ms;
    timeout_t timeout;
    Uint16 tries;
    Uint16 retries;
    char line[AT_LINE_MAX];
    Uint16 length;
    Uint16 online;
} at;

void at_open(at_line_fn on_line)
{
    memset(&at, 0, sizeof at);
    at.on_line = on_line;
    at.state = AT_IDLE;
}

static void transmit(void)
{
    uart_puts(UART_MODEM, at.command);
    uart_puts(UART_MODEM, "\r");
    timeout_set(&at.timeout, at.timeout_ms);
    at.tries++;
}

void at_send(const char* command, Uint32 timeout_ms)
{
    strncpy(at.command, command, AT_LINE_MAX - 1);
    at.command[AT_LINE_MAX - 1] = '\0';
    at.timeout_ms = timeout_ms;
    at.tries = 0;
    at.state = AT_BUSY;
    transmit();
}

static void take_line(void)
{
    Uint16 i;

    for (i = 0; i < sizeof finals / sizeof finals[0]; i++)
    {
        if (strncmp(at.line, finals[i].text, strlen(finals[i].text)) == 0)
        {
            if (at.state == AT_BUSY)
                at.state = finals[i].result;
            else if (at.on_line)
                at.on_line(at.line);
            return;
        }
    }
    if (strcmp(at.line, at.command) != 0 && at.on_line) /* an echo is no news */
        at.on_line(at.line);
}

static void take(int16 c)
{
    if (c == '\r' || c == '\n')
    {
        if (at.length > 0)
        {
            at.line[at.length] = '\0';
            at.length = 0;
            take_line();
        }
    }
    else if (at.length < AT_LINE_MAX - 1)
    {
        at.line[at.length++] = (char)c;
    }
}

at_result_t at_poll(void)
{
    at_result_t result;
    int16 c;

    while (!at.online && (c = uart_getc(UART_MODEM)) >= 0)
    {
        take(c);
        if (at.state > AT_BUSY)
            break;
    }
    if (at.state == AT_BUSY && timeout_over(&at.timeout))
    {
        if (at.tries < TRIES)
        {
            at.retries++;
            transmit();
        }
        else
            at.state = AT_TIMEOUT;
    }
    result = at.state;
    if (result > AT_BUSY)
        at.state = AT_IDLE;
    return result;
}

void at_online(Uint16 on)
{
    at.online = on;
    at.length = 0;
}

Uint16 at_retries(void)
{
    return at.retries;
}
