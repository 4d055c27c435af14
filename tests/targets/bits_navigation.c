/// \file   bits_navigation.c
/// \brief  Program: bit patterns from navigation and what ends in libm (report.h).
/// SPDX-License-Identifier: MIT
#include "report.h"

int main(void)
{
    run_navigation();
    run_libm();
    return report_exit(0);
}
