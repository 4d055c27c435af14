/// TI TLC2543 at its edges. Source: SLAS079F (November 2001); where it is silent or unseen, the choice is marked (c).
///
/// | input byte  | D7-D4 address, D3-D2 length (01 = 8, x0 = 12, 11 = 16), D1 LSB first, D0 bipolar; first bit is D7, on rising edges |
/// | address     | 0..10 inputs; 11 (REF+ + REF-)/2, 12 REF-, 13 REF+; 14 power-down; 15 none: reported, converts to 0 (c)          |
/// | length      | that of the current transfer, and of the word its conversion gives; D1, D0: of that word only                   |
/// | word        | 8 bits: the upper 8; 16 bits: 4 zeros below (option pad); zeros after the last bit (c)                          |
/// | bipolar     | two's complement: the upper bit inverted (c)                                                                    |
/// | DATA OUT    | Z with /CS high; first bit of the previous result t_enable after /CS falls, next bit on each falling edge, no    |
/// |             | further delay (150 ns at most: less than any 8051 can see) (c); low during a conversion with /CS low             |
/// | sampling    | ends at the last falling edge: the volts of that instant                                                        |
/// | conversion  | EOC low t_eoc after the last falling edge, high t_conv later; clocks meanwhile are ignored (c) and reported      |
/// | abort       | /CS falling within t_abort of the last falling edge: EOC high at once, the previous result stays (c)             |
/// | early /CS   | rising inside a transfer: reported; nothing is latched, the previous result stays (c, early_cs_loses_result)    |
/// | power-down  | no conversion, EOC stays high, the result stays (c); the next valid address converts as usual (c, wake_lost)    |
/// | power-up    | the first word is random in silicon, power_up_code here (c); the first result is good (c, power_up_lost)        |
/// | limits      | /CS set-up, clock period, DATA IN set-up and hold: what breaks one is reported, and works all the same          |
/// | transfer    | code k is centred on k (REF+ - REF-) / 4096, clamped to 0 and 4095                                              |
/// SPDX-License-Identifier: MIT
#include "emu_8051/tlc2543.h"
#include <stdlib.h>

#define CODES        4096
#define POWER_UP     0xA5Au
#define INPUT_BITS   8u
#define LENGTH       0x0Cu
#define LENGTH_8     0x04u
#define LENGTH_16    0x0Cu
#define LSB_FIRST    0x02u
#define BIPOLAR      0x01u
#define ADDRESS_HALF 11u ///< self-test: half way, then REF-, then REF+
#define ADDRESS_LOW  12u
#define ADDRESS_HIGH 13u
#define ADDRESS_DOWN 14u

struct tlc2543_t
{
    tlc2543_config_t config;
    emu_sched_t* sched;
    emu_wire_t *eoc, *data_in, *data_out;
    int eoc_driver, out_driver;
    emu_event_t eoc_event, enable_event;
    bool selected, enabled, converting, eoc_low, down;
    bool eoc_missing; ///< in this conversion, which takes t_conv
    emu_time_t t_conv;
    uint8_t out;           ///< emu_drive_t on DATA OUT
    uint8_t lost;          ///< conversions to come that give no result
    uint8_t bits;          ///< of this transfer, known once the input byte is in
    unsigned rises, falls; ///< of this transfer
    uint8_t input;
    uint16_t word;    ///< the previous result as it goes out, first bit uppermost
    uint16_t pending; ///< the one in conversion
    emu_time_t cs_fall, last_rise, last_fall;
};

void tlc2543_default_config(tlc2543_config_t* config)
{
    *config = (tlc2543_config_t){
        .ref_plus_v = 5.0,
        .t_conv = 8 * EMU_PS_PER_US,
        .t_eoc = 3 * EMU_PS_PER_US / 2,
        .t_abort = 5 * EMU_PS_PER_US,
        .t_enable = 7 * EMU_PS_PER_US / 10,
        .t_cs = 1425 * EMU_PS_PER_US / 1000,
        .t_clock = EMU_PS_PER_US * 10 / 41,
        .t_setup = EMU_PS_PER_US / 10,
        .power_up_code = POWER_UP,
    };
}

static void report(const tlc2543_t* self, emu_report_kind_t kind, const char* text, uint32_t detail, emu_time_t at)
{
    if (self->config.report.put != NULL)
    {
        self->config.report.put(self->config.report.ctx, kind, text, detail, at);
    }
}

static unsigned length(uint8_t input)
{
    const unsigned bits = input & LENGTH;
    return bits == LENGTH_8 ? 8 : bits == LENGTH_16 ? 16 : 12;
}

static unsigned reversed(unsigned x)
{
    unsigned y = 0;
    for (unsigned i = 0; i < 16; i++)
    {
        y |= (x >> i & 1u) << (15 - i);
    }
    return y;
}

static uint16_t format(const tlc2543_t* self, uint16_t code, uint8_t input)
{
    const unsigned binary = (input & BIPOLAR) != 0 ? code ^ 0x800u : code;
    const unsigned bits = length(input);
    const unsigned value = bits == 8 ? binary >> 4 : bits == 16 ? binary << 4 | (self->config.pad & 15u) : binary;
    const unsigned word = (input & LSB_FIRST) != 0 ? reversed(value) : value << (16 - bits);
    return (uint16_t)word;
}

static void put_out(tlc2543_t* self, emu_drive_t drive, emu_time_t at)
{
    if (self->out != (uint8_t)drive)
    {
        self->out = (uint8_t)drive;
        emu_wire_drive(self->data_out, self->out_driver, drive, at);
    }
}

static void drive_out(tlc2543_t* self, emu_time_t at)
{
    if (self->enabled)
    {
        const bool one =
            !self->converting && self->falls < 16 && ((unsigned)self->word >> (15 - self->falls) & 1u) != 0;
        put_out(self, one ? EMU_STRONG1 : EMU_STRONG0, at);
    }
}

static void drive_eoc(tlc2543_t* self, bool low, emu_time_t at)
{
    self->eoc_low = low;
    emu_wire_drive(self->eoc, self->eoc_driver, low && !self->eoc_missing ? EMU_STRONG0 : EMU_STRONG1, at);
}

static double input_volts(const tlc2543_t* self, unsigned address, emu_time_t at)
{
    const double low = self->config.ref_minus_v, high = self->config.ref_plus_v;
    switch (address)
    {
    case ADDRESS_HALF:
        return low + (high - low) / 2;
    case ADDRESS_LOW:
        return low;
    case ADDRESS_HIGH:
        return high;
    default:
        return self->config.analog.volts != NULL
                   ? self->config.analog.volts(self->config.analog.ctx, self->config.first_channel + address, at)
                   : low;
    }
}

static uint16_t convert(const tlc2543_t* self, double volts)
{
    const tlc2543_config_t* const c = &self->config;
    const double x = (volts - c->ref_minus_v) / (c->ref_plus_v - c->ref_minus_v) * CODES;
    const double centred = x + c->offset_lsb + c->gain_lsb * x / CODES + 0.5;
    if (!(centred > 0.0))
    {
        return 0;
    }
    return centred < CODES ? (uint16_t)centred : CODES - 1;
}

static void next_transfer(tlc2543_t* self)
{
    self->rises = self->falls = 0;
    self->input = self->bits = 0;
}

/// The last falling edge of a transfer.
static void sample(tlc2543_t* self, emu_time_t at)
{
    const unsigned address = (unsigned)self->input >> 4;
    if (address == ADDRESS_DOWN)
    {
        self->down = true;
        next_transfer(self);
        drive_out(self, at);
        return;
    }
    tlc2543_outcome_t outcome = {.t_conv = self->config.t_conv};
    self->lost = self->down ? self->config.wake_lost : self->lost;
    self->down = false;
    if (address <= ADDRESS_HIGH)
    {
        const double volts = input_volts(self, address, at);
        if (volts != volts)
        {
            report(self, EMU_NOT_MODELLED, "TLC2543: the volts of this channel are not a number; converted as 0",
                   address, at);
        }
        const unsigned channel = self->config.first_channel + address;
        outcome.code = convert(self, volts);
        if (self->config.fault != NULL)
        {
            self->config.fault(self->config.fault_ctx, channel, at, &outcome);
        }
        if (self->config.sampled != NULL)
        {
            self->config.sampled(self->config.sampled_ctx, channel, outcome.code, volts, at);
        }
    }
    else
    {
        report(self, EMU_GUEST_ERROR, "TLC2543: address 1111 selects nothing; use 0000 to 1110", self->input, at);
    }
    self->pending = format(self, self->lost > 0 ? self->config.power_up_code : outcome.code, self->input);
    self->lost = (uint8_t)(self->lost - (self->lost > 0));
    self->t_conv = outcome.t_conv;
    self->eoc_missing = outcome.eoc_missing;
    self->converting = true;
    self->last_fall = at;
    drive_out(self, at);
    emu_sched_at(self->sched, &self->eoc_event, at + self->config.t_eoc);
}

static void eoc_edge(void* ctx, emu_time_t at)
{
    tlc2543_t* const self = ctx;
    if (!self->eoc_low)
    {
        drive_eoc(self, true, at);
        emu_sched_at(self->sched, &self->eoc_event, at + self->t_conv);
        return;
    }
    self->converting = false;
    self->word = self->pending;
    next_transfer(self);
    drive_out(self, at);
    drive_eoc(self, false, at);
}

/// What the data sheet asks of a rising edge.
static void check_rise(tlc2543_t* self, emu_time_t at)
{
    const tlc2543_config_t* const c = &self->config;
    const emu_time_t since_cs = at - self->cs_fall, period = at - self->last_rise, stable = at - self->data_in->changed;
    if (self->rises == 0 && since_cs < c->t_cs)
    {
        report(self, EMU_GUEST_ERROR, "TLC2543: first I/O CLOCK sooner than 1.425 us after /CS low; wait longer [ns]",
               (uint32_t)(since_cs / 1000), at);
    }
    if (self->rises > 0 && period < c->t_clock)
    {
        report(self, EMU_GUEST_ERROR, "TLC2543: I/O CLOCK is faster than 4.1 MHz; slow it down [ns a period]",
               (uint32_t)(period / 1000), at);
    }
    if (self->rises < INPUT_BITS && stable < c->t_setup)
    {
        report(self, EMU_GUEST_ERROR,
               "TLC2543: DATA IN changed less than 100 ns before I/O CLOCK rose; set it sooner [ns]",
               (uint32_t)(stable / 1000), at);
    }
}

/// DATA IN has to stay as it was at the rising edge.
static void check_hold(tlc2543_t* self, emu_time_t at)
{
    const emu_time_t held = self->data_in->changed - self->last_rise;
    if (self->rises <= INPUT_BITS && held >= 0 && held <= self->config.t_hold &&
        self->data_in->level != ((self->input & 1u) != 0))
    {
        report(self, EMU_GUEST_ERROR,
               "TLC2543: DATA IN changed as I/O CLOCK rose; change it after the clock is low [ns]",
               (uint32_t)(held / 1000), at);
    }
}

static void clock_rise(tlc2543_t* self, emu_time_t at)
{
    check_rise(self, at);
    if (self->rises < INPUT_BITS)
    {
        self->input = (uint8_t)((unsigned)self->input << 1 | self->data_in->level);
        self->bits = self->rises == INPUT_BITS - 1u ? (uint8_t)length(self->input) : 0;
    }
    self->rises++;
    self->last_rise = at;
}

static void clock_fall(tlc2543_t* self, emu_time_t at)
{
    check_hold(self, at);
    self->falls++;
    if (self->falls == self->bits)
    {
        sample(self, at);
    }
    else
    {
        drive_out(self, at);
    }
}

static void clock_edge(void* ctx, bool level, emu_time_t at)
{
    tlc2543_t* const self = ctx;
    if (!self->selected)
    {
        return;
    }
    if (self->converting)
    {
        if (level)
        {
            report(self, EMU_GUEST_ERROR, "TLC2543: I/O CLOCK during a conversion is ignored; wait for EOC high", 0,
                   at);
        }
    }
    else if (level)
    {
        clock_rise(self, at);
    }
    else if (self->falls < self->rises)
    {
        clock_fall(self, at);
    }
}

static void enable(void* ctx, emu_time_t at)
{
    tlc2543_t* const self = ctx;
    self->enabled = true;
    drive_out(self, at);
}

static void cs_edge(void* ctx, bool level, emu_time_t at)
{
    tlc2543_t* const self = ctx;
    self->selected = !level;
    if (level)
    {
        if (self->rises > 0 && !self->converting)
        {
            report(self, EMU_GUEST_ERROR,
                   "TLC2543: /CS rose inside a transfer, nothing was converted; give all 8, 12 or 16 clocks [given]",
                   self->falls, at);
            self->word = self->config.early_cs_loses_result ? 0 : self->word;
        }
        self->enabled = false;
        emu_sched_cancel(self->sched, &self->enable_event);
        put_out(self, EMU_Z, at);
        return;
    }
    if (self->converting && at - self->last_fall <= self->config.t_abort)
    {
        self->converting = false;
        emu_sched_cancel(self->sched, &self->eoc_event);
        drive_eoc(self, false, at);
    }
    self->cs_fall = at;
    next_transfer(self);
    emu_sched_at(self->sched, &self->enable_event, at + self->config.t_enable);
}

tlc2543_t* tlc2543_create(const tlc2543_config_t* config, emu_sched_t* sched, emu_wire_t* eoc, emu_wire_t* io_clock,
                          emu_wire_t* data_in, emu_wire_t* data_out, emu_wire_t* cs_n)
{
    if (!(config->ref_plus_v > config->ref_minus_v))
    {
        return NULL;
    }
    tlc2543_t* const self = calloc(1, sizeof *self);
    if (self == NULL)
    {
        return NULL;
    }
    self->config = *config;
    self->sched = sched;
    self->eoc = eoc;
    self->data_in = data_in;
    self->data_out = data_out;
    self->eoc_event = (emu_event_t){.fire = eoc_edge, .ctx = self};
    self->enable_event = (emu_event_t){.fire = enable, .ctx = self};
    self->word = (uint16_t)(config->power_up_code << 4);
    self->lost = config->power_up_lost;
    self->eoc_driver = emu_wire_add_driver(eoc);
    self->out_driver = emu_wire_add_driver(data_out);
    if (self->eoc_driver < 0 || self->out_driver < 0 || emu_wire_watch(io_clock, clock_edge, self) != 0 ||
        emu_wire_watch(cs_n, cs_edge, self) != 0)
    {
        free(self);
        return NULL;
    }
    drive_eoc(self, false, sched->now);
    return self;
}

void tlc2543_destroy(tlc2543_t* self)
{
    if (self != NULL)
    {
        emu_sched_cancel(self->sched, &self->eoc_event);
        emu_sched_cancel(self->sched, &self->enable_event);
        free(self);
    }
}

void tlc2543_state(tlc2543_t* self, emu_state_t* io)
{
    uint32_t rises = self->rises, falls = self->falls;
    emu_state_tag(io, "2543", 2);
    emu_event_state(self->sched, &self->eoc_event, io);
    emu_event_state(self->sched, &self->enable_event, io);
    emu_state_bool(io, &self->selected);
    emu_state_bool(io, &self->enabled);
    emu_state_bool(io, &self->converting);
    emu_state_bool(io, &self->eoc_low);
    emu_state_bool(io, &self->down);
    emu_state_u8(io, &self->out);
    emu_state_u8(io, &self->lost);
    emu_state_u8(io, &self->bits);
    emu_state_bool(io, &self->eoc_missing);
    emu_state_i64(io, &self->t_conv);
    emu_state_u32(io, &rises);
    emu_state_u32(io, &falls);
    emu_state_u8(io, &self->input);
    emu_state_u16(io, &self->word);
    emu_state_u16(io, &self->pending);
    emu_state_i64(io, &self->cs_fall);
    emu_state_i64(io, &self->last_rise);
    emu_state_i64(io, &self->last_fall);
    emu_state_check(io, self->out <= EMU_STRONG1 && emu_state_time(self->t_conv) && emu_state_time(self->cs_fall) &&
                            emu_state_time(self->last_rise) && emu_state_time(self->last_fall));
    if (!io->bad)
    {
        self->rises = rises;
        self->falls = falls;
    }
}
