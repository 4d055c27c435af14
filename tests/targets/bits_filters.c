/// \file   bits_filters.c
/// \brief  Program: bit patterns from the filters (report.h).
/// SPDX-License-Identifier: MIT
#include "report.h"

int main(void)
{
    run_filters();
    run_vehicle();
    return report_exit(0);
}
