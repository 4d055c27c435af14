/// \file   port.c
/// \brief  Characters to standard output, semihosted or hosted.
/// SPDX-License-Identifier: MIT
#include "report.h"
#include <stdio.h>

void port_put(char c)
{
    (void)putchar(c);
}

int port_exit(int code)
{
    return code;
}
