/// State machine: set up, wait for the network, ready, dialling, online, hanging up. Online, console and modem are connected; the escape is
/// three '+' with half a second of silence before and after.
/// SPDX-License-Identifier: MIT
#include "app.h"
#include "at.h"
#include "console.h"
#include "ticks.h"
#include "uart.h"
#include <string.h>

#define COMMAND_MS  300
#define DIAL_MS     60000UL
#define REGISTER_MS 500
#define RETRY_MS    1000
#define GUARD_MS    500

typedef enum
{
    ST_SETUP,
    ST_REGISTER,
    ST_REGISTER_WAIT,
    ST_READY,
    ST_COMMAND,
    ST_DIALLING,
    ST_ONLINE,
    ST_ESCAPING,
    ST_HANGUP,
    ST_FAILED
} state_t;

static const char* const setup[] = {"ATZ", "ATE0", "AT+CMEE=1", "AT&D0", 0};
static const char* const names[] = {"setup",    "register", "register", "ready",  "command",
                                    "dialling", "online",   "escaping", "hangup", "failed"};

static state_t state;
static Uint16 step;
static Uint16 registered;
static Uint16 calls;
static Uint16 rings;
static timeout_t wait_for;
static timeout_t silence;
static Uint16 pluses;
static Uint16 line_feed; /* the one behind CONNECT is still to come */

static void go(state_t next)
{
    state = next;
}

static void on_line(const char* text)
{
    if (strncmp(text, "+CREG:", 6) == 0)
    {
        const char* comma = strchr(text, ',');
        registered = comma != 0 && (comma[1] == '1' || comma[1] == '5');
    }
    else if (strcmp(text, "RING") == 0)
    {
        rings++;
        console_say("[ring]");
    }
    else
    {
        console_say(text);
    }
}

void app_open(void)
{
    at_open(on_line);
    console_say("modem driver");
    step = 0;
    at_send(setup[0], COMMAND_MS);
    go(ST_SETUP);
}

static void status(void)
{
    uart_puts(UART_CONSOLE, "state ");
    console_say(names[state]);
    console_number("calls", calls);
    console_number("rings", rings);
    console_number("retries", at_retries());
    console_number("modem-rx", uart_stats(UART_MODEM)->rx_octets);
    console_number("modem-errors", uart_stats(UART_MODEM)->rx_errors);
    console_number("modem-lost", uart_stats(UART_MODEM)->rx_lost);
}

static void dial(const char* number)
{
    char command[AT_LINE_MAX];

    if (strlen(number) == 0 || strlen(number) > 20 || strspn(number, "0123456789*#+") != strlen(number))
    {
        console_say("bad number");
        console_prompt();
        return;
    }
    strcpy(command, "ATD");
    strcat(command, number);
    at_send(command, DIAL_MS);
    go(ST_DIALLING);
}

static void order(const char* text)
{
    if (strncmp(text, "dial ", 5) == 0)
        dial(text + 5);
    else if (strncmp(text, "at", 2) == 0)
    {
        at_send(text, COMMAND_MS);
        go(ST_COMMAND);
    }
    else
    {
        if (strcmp(text, "status") == 0)
            status();
        else if (strcmp(text, "help") == 0)
            console_say("dial N, at..., status, help");
        else if (*text != '\0')
            console_say("what?");
        console_prompt();
    }
}

static void poll_setup(at_result_t result)
{
    if (result == AT_OK)
    {
        step++;
        if (setup[step] == 0)
            go(ST_REGISTER);
        else
            at_send(setup[step], COMMAND_MS);
    }
    else if (result != AT_BUSY)
    {
        console_say("no modem");
        timeout_set(&wait_for, RETRY_MS);
        go(ST_FAILED);
    }
}

static void poll_register(at_result_t result)
{
    if (state == ST_REGISTER)
    {
        at_send("AT+CREG?", COMMAND_MS);
        go(ST_REGISTER_WAIT);
    }
    else if (registered && result != AT_BUSY)
    {
        console_say("ready");
        console_prompt();
        go(ST_READY);
    }
    else if (result == AT_OK || result == AT_ERROR || result == AT_TIMEOUT)
        timeout_set(&wait_for, REGISTER_MS);
    else if (result == AT_IDLE && timeout_over(&wait_for))
        go(ST_REGISTER);
}

static void poll_dialling(at_result_t result)
{
    if (result == AT_BUSY)
        return;
    if (result == AT_CONNECT)
    {
        calls++;
        console_say("connected");
        at_online(1);
        pluses = 0;
        line_feed = 1;
        timeout_set(&silence, GUARD_MS);
        go(ST_ONLINE);
        return;
    }
    console_say(result == AT_BUSY_TONE ? "busy" : result == AT_NO_CARRIER ? "no carrier" : "failed");
    console_prompt();
    go(ST_READY);
}

static void poll_online(void)
{
    int16 c;

    while ((c = uart_getc(UART_MODEM)) >= 0)
    {
        while ((c != '\n' || !line_feed) && !uart_putc(UART_CONSOLE, (char)c))
            ;
        line_feed = 0;
    }
    while ((c = uart_getc(UART_CONSOLE)) >= 0)
    {
        if (c == '+' && (pluses > 0 || timeout_over(&silence)))
            pluses++;
        else
            pluses = 0;
        line_feed = 1;
        timeout_set(&silence, GUARD_MS);
        while (!uart_putc(UART_MODEM, (char)c))
            ;
    }
    if (pluses == 3 && timeout_over(&silence))
    {
        at_online(0);
        timeout_set(&wait_for, GUARD_MS);
        go(ST_ESCAPING);
    }
}

void app_poll(void)
{
    const char* line;
    at_result_t result = at_poll();

    switch (state)
    {
    case ST_SETUP:
        poll_setup(result);
        break;
    case ST_REGISTER:
    case ST_REGISTER_WAIT:
        poll_register(result);
        break;
    case ST_READY:
        line = console_poll();
        if (line != 0)
            order(line);
        break;
    case ST_COMMAND:
        if (result != AT_BUSY)
        {
            console_say(result == AT_OK ? "ok" : result == AT_TIMEOUT ? "no answer" : "error");
            console_prompt();
            go(ST_READY);
        }
        break;
    case ST_DIALLING:
        poll_dialling(result);
        break;
    case ST_ONLINE:
        poll_online();
        break;
    case ST_ESCAPING:
        if (timeout_over(&wait_for))
        {
            at_send("ATH", COMMAND_MS);
            go(ST_HANGUP);
        }
        break;
    case ST_HANGUP:
        if (result != AT_BUSY)
        {
            console_say("hung up");
            console_prompt();
            go(ST_READY);
        }
        break;
    case ST_FAILED:
        if (timeout_over(&wait_for))
            app_open();
        break;
    }
}
