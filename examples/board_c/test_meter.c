/// Tests of ../board_pytest/meter.c on the emulated board, by its C API alone: test_meter IMAGE.bin reading|lamp|key. Time is simulated.
/// SPDX-License-Identifier: MIT
#include "emu/serial.h"
#include "emu_8051/acq_board.h"
#include <stdio.h>
#include <string.h>

#define FLASH 4096
#define BAUD  9600
#define MS    (EMU_PS_PER_S / 1000)

typedef struct rig_t
{
    emu_sched_t sched;
    acq_board_t* board;
    emu_serial_end_t host; ///< our end of the serial line
    char said[256];
    size_t count;
    double volts; ///< at AIN0
} rig_t;

static double volts(void* ctx, unsigned channel, int64_t t_ps)
{
    (void)t_ps;
    return channel == 0 ? ((const rig_t*)ctx)->volts : 0.0;
}

static void received(void* ctx, uint8_t octet, bool framing_ok, emu_time_t at)
{
    rig_t* const self = ctx;
    (void)at;
    if (framing_ok && self->count + 1 < sizeof self->said)
    {
        self->said[self->count++] = (char)octet;
        mcs51_stop(acq_board_cpu(self->board)); // so that say() looks at once
    }
}

static bool power_on(rig_t* self, const char* path)
{
    static uint8_t image[FLASH];
    FILE* const file = fopen(path, "rb");
    const size_t size = file != NULL ? fread(image, 1, sizeof image, file) : 0;
    acq_board_config_t config;
    if (file != NULL)
    {
        fclose(file);
    }
    emu_sched_init(&self->sched);
    acq_board_default_config(&config);
    config.adc.analog = (emu_analog_t){volts, self};
    self->board = acq_board_create(&config, &self->sched);
    return size > 0 && self->board != NULL && mcs51_load(acq_board_cpu(self->board), 0, image, size) == 0 &&
           emu_serial_end_init(&self->host, &self->sched, acq_board_wire(self->board, "RXD"),
                               acq_board_wire(self->board, "TXD"), BAUD, received, self) == 0;
}

/// Run until the board has said the text, and forget it; false when it has not within some milliseconds.
static bool says(rig_t* self, const char* text, int within_ms)
{
    const emu_time_t end = self->sched.now + within_ms * MS;
    while (strstr(self->said, text) == NULL)
    {
        if (self->sched.now >= end)
        {
            fprintf(stderr, "'%s' did not come within %d ms, but '%s'\n", text, within_ms, self->said);
            return false;
        }
        acq_board_run(self->board, end);
    }
    memset(self->said, 0, sizeof self->said);
    self->count = 0;
    return true;
}

static bool measures(rig_t* self, double v, const char* text)
{
    self->volts = v;
    return emu_serial_end_send(&self->host, '?') && says(self, text, 50);
}

static bool test_reading(rig_t* self)
{
    return measures(self, 1.25, "AIN0 1250 mV\r\n") && measures(self, 0.0, "AIN0 0000 mV\r\n") &&
           measures(self, 6.0, "AIN0 4999 mV\r\n"); // full scale is one step less than the reference
}

static bool test_lamp(rig_t* self)
{
    return measures(self, 4.5, "mV") && !acq_board_pin(self->board, 2, 0) && measures(self, 3.9, "mV") &&
           acq_board_pin(self->board, 2, 0);
}

static bool test_key(rig_t* self)
{
    acq_board_drive_pin(self->board, 3, 2, EMU_STRONG0);
    return says(self, "KEY\r\n", 10);
}

int main(int argc, char** argv)
{
    static const struct
    {
        const char* name;
        bool (*test)(rig_t* self);
    } tests[] = {{"reading", test_reading}, {"lamp", test_lamp}, {"key", test_key}};
    static rig_t rig;
    bool good = argc == 3 && power_on(&rig, argv[1]) && says(&rig, "READY\r\n", 500);
    size_t which = 0;
    while (good && which < sizeof tests / sizeof tests[0] && strcmp(tests[which].name, argv[2]) != 0)
    {
        which++;
    }
    good = good && which < sizeof tests / sizeof tests[0] && tests[which].test(&rig);
    acq_board_destroy(rig.board);
    return good ? 0 : 1;
}
