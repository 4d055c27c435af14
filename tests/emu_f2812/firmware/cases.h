/// \file   cases.h
/// \brief  What the cases of cases.c are called by; a case is chosen in TIMER1PRDH and tells its results in TIMER1PRD.
/// SPDX-License-Identifier: MIT
#ifndef F2812_CASES_H_INCLUDED
#define F2812_CASES_H_INCLUDED

#define CASE_RETURN         1  ///< returns from main() at once
#define CASE_FIELDS         2  ///< bit-fields, bytes, |= on registers
#define CASE_ATOMIC         3  ///< x += 1 here and in an interrupt
#define CASE_IER            4  ///< IER, IFR, INTM
#define CASE_EALLOW         5  ///< PieVectTable without EALLOW
#define CASE_NESTED         6  ///< a slow interrupt function that lets another in
#define CASE_WAITS          7  ///< waiting loops of every kind
#define CASE_NO_FUNCTION    8  ///< an interrupt whose vector is not set
#define CASE_ASM            9  ///< an instruction that is not known
#define CASE_DOG            10 ///< the watchdog is let bite
#define CASE_FOREVER        11 ///< for(;;); with an interrupt each millisecond
#define CASE_IDLE           12 ///< IDLE until an interrupt
#define CASE_NOT_WAITS      13 ///< loops that look like waiting and are not
#define CASE_COST           14 ///< time of known pieces
#define CASE_INTERRUPT_COST 15 ///< an interrupt function that does two things

#endif // F2812_CASES_H_INCLUDED
