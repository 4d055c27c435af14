/// \file   fault.h
/// \brief  Faults of the firmware in a board program end it with a message and exit status 4. Not installed.
/// SPDX-License-Identifier: MIT
#ifndef F2812_FAULT_H_INCLUDED
#define F2812_FAULT_H_INCLUDED

void f2812_catch_faults(const char* program);

#endif // F2812_FAULT_H_INCLUDED
