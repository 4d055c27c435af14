/// A board program on its own: its lines idle, looped back, or with files at their other ends. See usage[].
/// SPDX-License-Identifier: MIT
#define _XOPEN_SOURCE 700
#include "emu/serial.h"
#include "emu_f2812/registers.h"
#include "fault.h"
#include "pipe.h"
#include "summary.h"
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PORTS       2u
#define LINES_MAX   4u
#define EXIT_USAGE  2
#define EXIT_STRICT 3
#define SLICE       (10 * 1000 * EMU_PS_PER_US) ///< how often files are looked at
#define HOST_BEGINS 0.1                         ///< [s] the firmware has set up its ports by then

static const char usage[] =
    "Runs this firmware on an emulated TMS320F2812 and prints a summary as JSON.\n"
    "  --stop-s S                simulated time [s]; without it, until ESTOP0 or the end of main()\n"
    "  --loop A | B | AB         connect SCITXDA to SCIRXDA, B to B, or A and B with each other\n"
    "  --host A:BAUD:IN[:OUT]    a host on SCI-A (or B): sends the octets of file IN (- none), writes what it receives "
    "to OUT\n"
    "  --host-at-s S             when hosts begin to send (0.1)\n"
    "  --log FILE                each access of a register and each interrupt, as lines\n"
    "  --switch NAME=VALUE       a switch of emu_f2812/f2812_config.h\n"
    "  --osc-hz HZ               crystal (30e6)\n"
    "  --no-skip                 execute each turn of waiting loops\n"
    "  --strict                  exit status 3 if the firmware did something wrong\n"
    "  --json FILE               the summary there, not on standard output\n"
    "  --pipe FD                 alone: a run of several boards drives it over this socket (emu_f2812/wirelink.h)\n";

typedef struct host_t
{
    emu_serial_end_t end;
    FILE *in, *out;
} host_t;

typedef struct run_t
{
    emu_sched_t sched;
    f2812_config_t config;
    f2812_t* device;
    double stop_s, host_at_s;
    bool no_skip, strict;
    FILE *log, *json;
    const char* loop;
    const char* hosts[PORTS];
    host_t host[PORTS];
    emu_serial_line_t line[LINES_MAX];
    unsigned lines;
    f2812_notes_t notes;
} run_t;

extern const f2812_program_t f2812_program;

static void die(const char* what, const char* which)
{
    fprintf(stderr, "%s: %s%s\n", f2812_program.name, what, which);
    exit(EXIT_USAGE);
}

static void log_access(void* ctx, uint16_t address, uint16_t value, bool write, emu_time_t at)
{
    const char* const name = f2812_register_name(address);
    char number[8];
    (void)snprintf(number, sizeof number, "%04X", address);
    fprintf(((run_t*)ctx)->log, "%" PRId64 " %c %s %04X\n", at, write ? 'W' : 'R', name != NULL ? name : number, value);
}

static void log_interrupt(void* ctx, unsigned vector, bool enter, emu_time_t at)
{
    fprintf(((run_t*)ctx)->log, "%" PRId64 " %s %u\n", at, enter ? "INT" : "IRET", vector);
}

static void received(void* ctx, uint8_t octet, bool framing_ok, emu_time_t at)
{
    const host_t* const host = ctx;
    (void)at;
    if (framing_ok && host->out != NULL)
    {
        (void)fputc(octet, host->out);
    }
}

static void wire(run_t* run, const char* from, const char* to)
{
    const emu_serial_faults_t none = {0};
    if (emu_serial_line_init(&run->line[run->lines++], &run->sched, f2812_wire(run->device, from),
                             f2812_wire(run->device, to), &none) != 0)
    {
        die("no room on the wire ", to);
    }
}

static FILE* open_file(const char* path, const char* mode)
{
    FILE* const file = strcmp(path, "-") == 0 ? NULL : fopen(path, mode);
    if (file == NULL && strcmp(path, "-") != 0)
    {
        fprintf(stderr, "%s: %s: %s\n", f2812_program.name, path, strerror(errno));
        exit(EXIT_USAGE);
    }
    return file;
}

static void connect_host(run_t* run, unsigned port, const char* text)
{
    char copy[512];
    (void)snprintf(copy, sizeof copy, "%s", text + 2);
    char* const in = strchr(copy, ':');
    char* const out = in != NULL ? strchr(in + 1, ':') : NULL;
    if (in != NULL)
    {
        *in = '\0';
    }
    if (out != NULL)
    {
        *out = '\0';
    }
    char* rest;
    const double baud = strtod(copy, &rest);
    host_t* const host = &run->host[port];
    host->in = open_file(in != NULL ? in + 1 : "-", "rb");
    host->out = open_file(out != NULL ? out + 1 : "-", "wb");
    if (*rest != '\0' ||
        emu_serial_end_init(&host->end, &run->sched, f2812_wire(run->device, port == 0 ? "SCIRXDA" : "SCIRXDB"),
                            f2812_wire(run->device, port == 0 ? "SCITXDA" : "SCITXDB"), baud, received, host) != 0)
    {
        die("--host wants A:BAUD:IN[:OUT], a baud of 50 to 4e6, and a line that is not looped: ", text);
    }
}

static void feed(run_t* run)
{
    for (unsigned port = 0; port < PORTS; port++)
    {
        host_t* const host = &run->host[port];
        while (host->in != NULL && host->end.fifo_count < EMU_SERIAL_FIFO)
        {
            const int octet = fgetc(host->in);
            if (octet == EOF)
            {
                (void)fclose(host->in);
                host->in = NULL;
            }
            else
            {
                (void)emu_serial_end_send(&host->end, (uint8_t)octet);
            }
        }
    }
}

static double number(const char* option, const char* text)
{
    char* rest;
    const double value = strtod(text, &rest);
    if (*text == '\0' || *rest != '\0' || !(value >= 0 && value < 1e7))
    {
        fprintf(stderr, "%s: %s wants a number from 0 to 1e7, not \"%s\"\n", f2812_program.name, option, text);
        exit(EXIT_USAGE);
    }
    return value;
}

static void set_switch(run_t* run, char* text)
{
    char* const value = strchr(text, '=');
    if (value == NULL)
    {
        die("--switch wants NAME=VALUE, not ", text);
    }
    *value = '\0';
    const char* const wrong = f2812_switch_set(&run->config.switches, text, value + 1);
    if (wrong != NULL)
    {
        die("--switch: ", wrong);
    }
}

static void set_option(run_t* run, const char* option, char* value)
{
    if (strcmp(option, "--stop-s") == 0)
    {
        run->stop_s = number(option, value);
    }
    else if (strcmp(option, "--host-at-s") == 0)
    {
        run->host_at_s = number(option, value);
    }
    else if (strcmp(option, "--osc-hz") == 0)
    {
        run->config.oscclk_hz = (uint64_t)strtod(value, NULL);
    }
    else if (strcmp(option, "--loop") == 0 &&
             (strcmp(value, "A") == 0 || strcmp(value, "B") == 0 || strcmp(value, "AB") == 0))
    {
        run->loop = value;
    }
    else if (strcmp(option, "--host") == 0 && (value[0] == 'A' || value[0] == 'B') && value[1] == ':')
    {
        run->hosts[value[0] - 'A'] = value;
    }
    else if (strcmp(option, "--log") == 0)
    {
        run->log = open_file(value, "w");
    }
    else if (strcmp(option, "--json") == 0)
    {
        run->json = open_file(value, "w");
    }
    else if (strcmp(option, "--switch") == 0)
    {
        set_switch(run, value);
    }
    else
    {
        fprintf(stderr, "%s: %s %s: no such option or value\n%s", f2812_program.name, option, value, usage);
        exit(EXIT_USAGE);
    }
}

static void parse(run_t* run, int argc, char** argv)
{
    for (int i = 1; i < argc; i++)
    {
        if (strcmp(argv[i], "--no-skip") == 0)
        {
            run->no_skip = true;
        }
        else if (strcmp(argv[i], "--strict") == 0)
        {
            run->strict = true;
        }
        else if (strcmp(argv[i], "--help") == 0)
        {
            (void)fputs(usage, stdout);
            exit(0);
        }
        else if (i + 1 < argc)
        {
            set_option(run, argv[i], argv[i + 1]);
            i++;
        }
        else
        {
            fprintf(stderr, "%s: %s: no such option, or its value is missing\n%s", f2812_program.name, argv[i], usage);
            exit(EXIT_USAGE);
        }
    }
}

static void connect(run_t* run)
{
    if (run->loop != NULL && strcmp(run->loop, "AB") == 0)
    {
        wire(run, "SCITXDA", "SCIRXDB");
        wire(run, "SCITXDB", "SCIRXDA");
    }
    else if (run->loop != NULL)
    {
        wire(run, *run->loop == 'A' ? "SCITXDA" : "SCITXDB", *run->loop == 'A' ? "SCIRXDA" : "SCIRXDB");
    }
    for (unsigned port = 0; port < PORTS; port++)
    {
        if (run->hosts[port] != NULL)
        {
            connect_host(run, port, run->hosts[port]);
        }
    }
    if (run->log != NULL)
    {
        const f2812_observer_t observer = {.ctx = run, .access = log_access, .interrupt = log_interrupt};
        f2812_observe(run->device, &observer);
    }
}

static void go(run_t* run, f2812_shim_t* shim)
{
    const emu_time_t stop = (emu_time_t)(run->stop_s * (double)EMU_PS_PER_S);
    const emu_time_t begins = (emu_time_t)(run->host_at_s * (double)EMU_PS_PER_S);
    while (run->sched.now < stop)
    {
        const emu_time_t next = run->sched.now + SLICE;
        if (f2812_shim_run(shim, next < stop ? next : stop) == F2812_ENDED)
        {
            return;
        }
        if (run->sched.now >= begins)
        {
            feed(run);
        }
    }
}

int main(int argc, char** argv)
{
    static run_t run = {.stop_s = 1e6, .host_at_s = HOST_BEGINS};
    f2812_catch_faults(f2812_program.name);
    if (argc == 3 && strcmp(argv[1], "--pipe") == 0)
    {
        return f2812_pipe_main((int)number(argv[1], argv[2]), &f2812_program);
    }
    f2812_default_config(&run.config);
    run.config.report = (emu_report_t){f2812_take_note, &run.notes};
    parse(&run, argc, argv);
    emu_sched_init(&run.sched);
    run.device = f2812_create(&run.config, &run.sched);
    f2812_shim_t* const shim =
        run.device != NULL ? f2812_shim_create(run.device, &run.sched, &f2812_program, &run.config.report) : NULL;
    if (shim == NULL)
    {
        die("no memory, or a crystal outside 4 to 150 MHz", "");
    }
    connect(&run);
    f2812_shim_set_skip(shim, !run.no_skip);
    go(&run, shim);
    f2812_print_summary(run.json != NULL ? run.json : stdout, f2812_program.name, run.device, shim, &run.notes);
    f2812_shim_destroy(shim);
    f2812_destroy(run.device);
    return run.strict && run.notes.wrong > 0 ? EXIT_STRICT : 0;
}
