/// \file   bits_attitude.c
/// \brief  Program: bit patterns from the attitude modules and the parsers (report.h), and the core's self-test.
///
/// One of three, because all of it is more than an ATmega1284P's flash holds.
/// SPDX-License-Identifier: MIT
#include "report.h"

int main(void)
{
    run_attitude();
    run_attitude_other();
    run_octets();
    return report_exit(ins_selftest());
}
