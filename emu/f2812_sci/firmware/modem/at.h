/// \file   at.h
/// \brief  Hayes commands to a modem: one at a time, answered by lines of which the last says how it went (ITU-T V.250).
/// SPDX-License-Identifier: MIT
#ifndef AT_H
#define AT_H
#include "DSP281x_Device.h"

#define AT_LINE_MAX 80

typedef enum
{
    AT_IDLE,
    AT_BUSY,
    AT_OK,
    AT_CONNECT,
    AT_ERROR,
    AT_NO_CARRIER,
    AT_BUSY_TONE,
    AT_TIMEOUT
} at_result_t;

/* A line that is no final result: information, or unsolicited such as RING. */
typedef void (*at_line_fn)(const char* line);

void at_open(at_line_fn on_line);
void at_send(const char* command, Uint32 timeout_ms);
at_result_t at_poll(void); /* AT_IDLE and AT_BUSY stay; a result is given once */
void at_online(Uint16 on); /* octets of the modem are data, not lines */
Uint16 at_retries(void);   /* commands sent again, since the start */

#endif /* AT_H */
