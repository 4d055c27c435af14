/// \file   console.h
/// \brief  A line of input at a time, with echo and backspace.
/// SPDX-License-Identifier: MIT
#ifndef CONSOLE_H
#define CONSOLE_H

/* \return a whole line without its end, valid until the next call; 0: not yet. */
const char* console_poll(void);
void console_prompt(void);
void console_say(const char* text);
void console_number(const char* name, unsigned long value);

#endif /* CONSOLE_H */
