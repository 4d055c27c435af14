/// \file   vectors.c
/// \brief  Program: the reference vectors against what this machine computes (tape.h), with the limits of the tests on the host.
/// SPDX-License-Identifier: MIT
#include "tape.h"

int main(void)
{
    check_attitude();
    check_navigation();
    check_filters();
    check_vehicle();
    check_octets();
    return report_exit(checks_failed() + (tape_left() != 0));
}
