/// \file   fuzz_wirelink.c
/// \brief  libFuzzer: the input is a message between a run and a board program; one that is taken has only this form.
/// SPDX-License-Identifier: MIT
#include "emu_f2812/wirelink.h"
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const unsigned char* data, size_t size);

int LLVMFuzzerTestOneInput(const unsigned char* data, size_t size)
{
    static f2812_link_t message;
    static uint8_t octets[F2812_LINK_OCTETS];
    emu_state_t from = {.from = data, .size = size};
    emu_state_t to = {.to = octets, .size = sizeof octets};
    if (f2812_link_walk(&message, &from) == 0)
    {
        return 0;
    }
    if (f2812_link_walk(&message, &to) != size || memcmp(octets, data, size) != 0)
    {
        abort();
    }
    return 0;
}
