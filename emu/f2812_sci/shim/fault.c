/// What firmware does that a host's memory does not allow: an absolute address, a wild pointer, a stack that is full.
/// SPDX-License-Identifier: MIT
#define _XOPEN_SOURCE 700
#include "fault.h"
#include "emu_f2812/registers.h"
#include "shim_internal.h"
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#define EXIT_FAULT   4
#define STACK_OCTETS 65536 ///< of the handler, which may not use the firmware's
#define WORD_SPACE   0x10000u

static const char* program;

static void tell(uintptr_t at)
{
    const char* const name = at < WORD_SPACE ? f2812_register_name((uint16_t)at) : NULL;
    if (f2812_shim_overflows(at))
    {
        fprintf(stderr, "%s: the firmware's stack is full (1 MiB)\n", program);
    }
    else if (name != NULL)
    {
        fprintf(stderr,
                "%s: the firmware used the absolute address %04lX (%s); on the host registers are reached by the "
                "objects of "
                "the DSP281x headers alone, such as SciaRegs\n",
                program, (unsigned long)at, name);
    }
    else
    {
        fprintf(stderr, "%s: the firmware used the address %lX, where it has no memory\n", program, (unsigned long)at);
    }
}

static void fault(int number, siginfo_t* info, void* context)
{
    (void)number;
    (void)context;
    tell((uintptr_t)info->si_addr);
    if (f2812_shim_current != NULL)
    {
        fprintf(stderr, "  at %.9f s of simulated time, cycle %llu\n",
                (double)f2812_shim_current->sched->now / (double)EMU_PS_PER_S,
                (unsigned long long)f2812_cycle(f2812_shim_current->device));
    }
    _exit(EXIT_FAULT);
}

void f2812_catch_faults(const char* name)
{
    static uint8_t stack[STACK_OCTETS];
    const stack_t other = {.ss_sp = stack, .ss_size = sizeof stack};
    struct sigaction action = {.sa_sigaction = fault, .sa_flags = SA_SIGINFO | SA_ONSTACK};
    program = name;
    (void)sigemptyset(&action.sa_mask);
    (void)sigaltstack(&other, NULL);
    (void)sigaction(SIGSEGV, &action, NULL);
    (void)sigaction(SIGBUS, &action, NULL);
}
