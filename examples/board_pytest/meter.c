/// A voltmeter for the acquisition board (AT89S51 at 11.0592 MHz, TLC2543 on P1.0..P1.4), 9600 Bd. It says READY a quarter of a second
/// after reset; `?` measures ("AIN0 1250 mV"), `0`..`9` choose the input, the lamp on P2.0 (low: on) shows limit_mv exceeded, the key on
/// P3.2 (low: pressed) says KEY once a press. SPDX-License-Identifier: MIT
#include <8051.h>
#include <stdint.h>

#define SELF_TEST_TICKS 250 ///< of 1 ms
#define TICK_CYCLES     922 ///< 1 ms is 921.6 machine cycles
#define REFERENCE_MV    5000UL

uint16_t limit_mv = 4000;
uint16_t measured; ///< how often
uint8_t input;

static void put(char c)
{
    SBUF = (uint8_t)c;
    while (!TI)
    {
    }
    TI = 0;
}

static void say(const char* text)
{
    while (*text != '\0')
    {
        put(*text++);
    }
    put('\r');
    put('\n');
}

/// One transfer of 12 clocks: the input to take next goes out, the result of the transfer before comes in.
static uint16_t transfer(uint8_t next)
{
    uint16_t result = 0;
    while (!P1_0) // EOC
    {
    }
    P1_4 = 0;
    for (uint8_t i = 0; i < 12; i++)
    {
        result = (uint16_t)(result << 1) | P1_3;
        P1_2 = (next & 0x80) != 0;
        next = (uint8_t)(next << 1);
        P1_1 = 1;
        P1_1 = 0;
    }
    P1_4 = 1;
    return result;
}

static void measure(void)
{
    const uint8_t address = (uint8_t)(input << 4);
    transfer(address);
    const uint16_t mv = (uint16_t)((transfer(address) * REFERENCE_MV + 2048) / 4096);
    char text[13] = "AIN0 0000 mV";
    text[3] = (char)('0' + input);
    uint16_t rest = mv;
    for (uint8_t at = 8; at > 4; at--)
    {
        text[at] = (char)('0' + rest % 10);
        rest /= 10;
    }
    measured++;
    P2_0 = mv <= limit_mv;
    say(text);
}

static void self_test(void)
{
    TR0 = 1;
    for (uint8_t tick = 0; tick < SELF_TEST_TICKS; tick++)
    {
        TF0 = 0;
        TH0 = (uint8_t)((65536 - TICK_CYCLES) >> 8);
        TL0 = (uint8_t)(65536 - TICK_CYCLES);
        while (!TF0)
        {
        }
    }
    TR0 = 0;
}

void main(void)
{
    __bit key_was = 1;
    P1_1 = 0;
    TMOD = 0x21; // timer 1: auto-reload, the baud; timer 0: 16 bits
    TH1 = 0xFD;
    TL1 = 0xFD;
    TR1 = 1;
    SCON = 0x50;
    self_test();
    say("READY");
    for (;;)
    {
        if (RI)
        {
            const uint8_t command = SBUF;
            RI = 0;
            if (command == '?')
            {
                measure();
            }
            else if (command >= '0' && command <= '9')
            {
                input = command - '0';
            }
        }
        const __bit key = P3_2; // read once: it may change between two reads
        if (!key && key_was)
        {
            say("KEY");
        }
        key_was = key;
    }
}
