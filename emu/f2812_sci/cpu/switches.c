/// What an F2812 is made with, by name.
/// SPDX-License-Identifier: MIT
#include "emu_f2812/f2812_config.h"
#include <stddef.h>
#include <string.h>

#define VALUES 4 ///< at most

/// Names of the values, beginning with that of 0.
static const struct
{
    const char* name;
    size_t offset;
    const char* values[VALUES];
} switches[] = {
    {"clock_off", offsetof(f2812_switches_t, clock_off), {"drop", "take"}},
    {"sci_start_count", offsetof(f2812_switches_t, sci_start_count), {"1", "0"}},
    {"sci_break_bits", offsetof(f2812_switches_t, sci_break_bits), {"10", "9.625"}},
    {"sci_break_hold", offsetof(f2812_switches_t, sci_break_hold), {"swreset", "off"}},
    {"sci_rxffovf", offsetof(f2812_switches_t, sci_rxffovf), {"first", "newest"}},
    {"sci_tx_load", offsetof(f2812_switches_t, sci_tx_load), {"write", "start"}},
    {"sci_fftxdly", offsetof(f2812_switches_t, sci_fftxdly), {"255", "256"}},
    {"sci_ffint", offsetof(f2812_switches_t, sci_ffint), {"level", "event"}},
    {"sci_errors", offsetof(f2812_switches_t, sci_errors), {"swreset", "read"}},
    {"sci_addr_erratum", offsetof(f2812_switches_t, sci_addr_erratum), {"on", "off"}},
    {"sci_abd", offsetof(f2812_switches_t, sci_abd), {"blocks", "passes"}},
    {"sci_loop_txd", offsetof(f2812_switches_t, sci_loop_txd), {"sends", "idle"}},
    {"sci_loop_rxd", offsetof(f2812_switches_t, sci_loop_rxd), {"cut", "joined"}},
};

const char* f2812_switch_set(f2812_switches_t* self, const char* name, const char* value)
{
    for (size_t i = 0; i < sizeof switches / sizeof switches[0]; i++)
    {
        if (strcmp(switches[i].name, name) != 0)
        {
            continue;
        }
        for (unsigned v = 0; v < VALUES && switches[i].values[v] != NULL; v++)
        {
            if (strcmp(switches[i].values[v], value) == 0)
            {
                ((uint8_t*)self)[switches[i].offset] = (uint8_t)v;
                return NULL;
            }
        }
        return "this switch has no such value (its values are in emu_f2812/f2812_config.h and docs/f2812.md)";
    }
    return "there is no such switch (they are in emu_f2812/f2812_config.h and docs/f2812.md)";
}

void f2812_default_config(f2812_config_t* config)
{
    *config = (f2812_config_t){.oscclk_hz = F2812_OSCCLK_HZ};
}
