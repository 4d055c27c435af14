/// \file   app.h
/// \brief  The modem from its start to a call, under orders of the console.
/// SPDX-License-Identifier: MIT
#ifndef APP_H
#define APP_H

void app_open(void);
void app_poll(void);

#endif /* APP_H */
