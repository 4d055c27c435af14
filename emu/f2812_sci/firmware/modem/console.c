/// Line editor of the console.
/// SPDX-License-Identifier: MIT
#include "console.h"
#include "uart.h"

#define LINE_MAX  64
#define BACKSPACE 0x08
#define RUBOUT    0x7F

static char line[LINE_MAX];
static Uint16 length;

void console_say(const char* text)
{
    uart_puts(UART_CONSOLE, text);
    uart_puts(UART_CONSOLE, "\r\n");
}

void console_number(const char* name, unsigned long value)
{
    uart_puts(UART_CONSOLE, name);
    uart_puts(UART_CONSOLE, " ");
    uart_put_number(UART_CONSOLE, value);
    uart_puts(UART_CONSOLE, "\r\n");
}

void console_prompt(void)
{
    uart_puts(UART_CONSOLE, "> ");
}

const char* console_poll(void)
{
    int16 c;

    while ((c = uart_getc(UART_CONSOLE)) >= 0)
    {
        if (c == '\r')
        {
            line[length] = '\0';
            length = 0;
            uart_puts(UART_CONSOLE, "\r\n");
            return line;
        }
        if ((c == BACKSPACE || c == RUBOUT) && length > 0)
        {
            length--;
            uart_puts(UART_CONSOLE, "\b \b");
        }
        else if (c >= ' ' && c < RUBOUT && length < LINE_MAX - 1)
        {
            line[length++] = (char)c;
            uart_putc(UART_CONSOLE, (char)c);
        }
    }
    return 0;
}
