/// \file   options.c
/// \brief  The command line of ins-gpsdr.
/// SPDX-License-Identifier: MIT
#include "options.h"
#include "../daemon/port.h"
#include "ins/version.h"
#include "ins_nav/vehicle.h"
#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define RAD_PER_DEG (3.14159265358979323846 / 180.0)

static const char* const help =
    "usage: ins-gpsdr --gps PATH|tcp:HOST:PORT [--board PATH|tcp:HOST:PORT] [options]\n"
    "Navigates a vehicle from a GPS receiver (NMEA) and a board that counts wheel pulses and samples a yaw-rate gyro:\n"
    "dead reckoning each 100 ms, fixes each second, in the board's time.\n"
    "\n"
    "lines\n"
    "  -g, --gps PATH            serial device or pty of the receiver (GGA, RMC, VTG); or tcp:HOST:PORT\n"
    "  -d, --board PATH          of the board ($PINSD); the same line, unless given\n"
    "      --gps-baud N          9600 (8 data bits, no parity, 1 stop bit, raw)\n"
    "  -b, --baud N              of the board; 9600\n"
    "sensors\n"
    "      --metres-per-count V  way of the odometer per count; 1\n"
    "      --lsb-deg-s V         yaw rate per code, clockwise positive; 180/4096\n"
    "      --null-code V         code at rest; 2048\n"
    "      --code-max N          full scale; 4095\n"
    "      --uere-m V            deviation of a fix per unit of HDOP; 5\n"
    "      --latency-s V         from a fix's instant to its sentence; 0\n"
    "filter\n"
    "  -f, --filter NAME         ours; paper-printed, paper-corrected for comparison\n"
    "      --tau-fix-s V         correlation time of a fix's error, 0: white; 20\n"
    "      --gyro-bias-deg-s V   deviation at the start; 0.29\n"
    "      --odometer-scale V    deviation of the odometer's scale at the start; 0.02\n"
    "output\n"
    "      --display             position, time, speed, heading and source on standard output, each second\n"
    "  -j, --json FILE|-         one JSON line per 100 ms; standard output, unless --display or --dds is given\n"
    "      --dds[=DOMAIN]        publish libins::NavSolution; domain 0, loopback only\n"
    "      --dds-config FILE     Cyclone DDS configuration (XML) in place of loopback\n"
    "      --dds-env             configuration from CYCLONEDDS_URI in place of loopback\n"
    "      --dds-interface IF    network interface in place of loopback, by multicast\n"
    "      --dds-peer ADDR[,...] on --dds-interface: these are asked, nothing is multicast\n"
    "      --topic NAME          libins/nav_solution\n"
    "      --partition NAME      none\n"
    "      --source ID           key of what is published; ins-gpsdr\n"
    "run\n"
    "  -n, --limit N             stop after N solutions\n"
    "  -t, --timeout-s S         stop, with exit code 1, when the board said nothing for S seconds\n"
    "  -q, --quiet               no event lines on standard error\n"
    "  -h, --help    -V, --version\n"
    "exit code: 0 done, 1 time-out or output failed, 2 bad usage, device or DDS\n";

enum
{
    O_GPS_BAUD = 256,
    O_METRES,
    O_LSB,
    O_NULL,
    O_CODE_MAX,
    O_UERE,
    O_LATENCY,
    O_TAU,
    O_BIAS,
    O_SCALE,
    O_DISPLAY,
    O_DDS,
    O_DDS_CONFIG,
    O_DDS_ENV,
    O_DDS_INTERFACE,
    O_DDS_PEER,
    O_TOPIC,
    O_PARTITION,
    O_SOURCE
};

static const struct option known[] = {
    {"gps", required_argument, NULL, 'g'},
    {"board", required_argument, NULL, 'd'},
    {"gps-baud", required_argument, NULL, O_GPS_BAUD},
    {"baud", required_argument, NULL, 'b'},
    {"metres-per-count", required_argument, NULL, O_METRES},
    {"lsb-deg-s", required_argument, NULL, O_LSB},
    {"null-code", required_argument, NULL, O_NULL},
    {"code-max", required_argument, NULL, O_CODE_MAX},
    {"uere-m", required_argument, NULL, O_UERE},
    {"latency-s", required_argument, NULL, O_LATENCY},
    {"filter", required_argument, NULL, 'f'},
    {"tau-fix-s", required_argument, NULL, O_TAU},
    {"gyro-bias-deg-s", required_argument, NULL, O_BIAS},
    {"odometer-scale", required_argument, NULL, O_SCALE},
    {"display", no_argument, NULL, O_DISPLAY},
    {"json", required_argument, NULL, 'j'},
    {"dds", optional_argument, NULL, O_DDS},
    {"dds-config", required_argument, NULL, O_DDS_CONFIG},
    {"dds-env", no_argument, NULL, O_DDS_ENV},
    {"dds-interface", required_argument, NULL, O_DDS_INTERFACE},
    {"dds-peer", required_argument, NULL, O_DDS_PEER},
    {"topic", required_argument, NULL, O_TOPIC},
    {"partition", required_argument, NULL, O_PARTITION},
    {"source", required_argument, NULL, O_SOURCE},
    {"limit", required_argument, NULL, 'n'},
    {"timeout-s", required_argument, NULL, 't'},
    {"quiet", no_argument, NULL, 'q'},
    {"help", no_argument, NULL, 'h'},
    {"version", no_argument, NULL, 'V'},
    {NULL, 0, NULL, 0},
};

/// A number within bounds. \return 1; 0 after a message.
static int number(int code, const char* text, double least, double most, double* out)
{
    char* end;
    errno = 0;
    const double value = strtod(text, &end);
    const struct option* o = known;
    while (o->val != code)
    {
        o++;
    }
    if (end == text || *end != '\0' || errno != 0 || !(value >= least && value <= most))
    {
        fprintf(stderr, "ins-gpsdr: --%s: '%s' is not a number from %g to %g\n", o->name, text, least, most);
        return 0;
    }
    *out = value;
    return 1;
}

static int filter(const char* text, int* out)
{
    static const char* const names[] = {"ours", "paper-printed", "paper-corrected"}; // INS_VEHICLE_OURS ...
    for (int i = 0; i < 3; i++)
    {
        if (strcmp(text, names[i]) == 0)
        {
            *out = i;
            return 1;
        }
    }
    fprintf(stderr, "ins-gpsdr: --filter: '%s' is none of ours, paper-printed, paper-corrected\n", text);
    return 0;
}

/// One option of lines, sensors and filter. \return 1; 0 after a message; -1 when it is none of these.
static int take_vehicle(gpsdr_options_t* o, int code, const char* text)
{
    ins_vehicle_config_t* const v = &o->vehicle;
    double n = 0.0;
    int good = 1;
    switch (code)
    {
    case 'g':
        o->device[0] = text;
        return 1;
    case 'd':
        o->device[1] = text;
        return 1;
    case O_GPS_BAUD:
    case 'b':
        good = number(code, text, 1, 1e8, &n);
        o->baud[code == 'b'] = (long)n;
        return good;
    case O_METRES:
        return number(code, text, 1e-9, 1e3, &v->metres_per_count);
    case O_LSB:
        good = number(code, text, -57, 57, &n);
        v->lsb_rad_s = n * RAD_PER_DEG;
        return good;
    case O_NULL:
        return number(code, text, 0, 1e9, &v->null_code);
    case O_CODE_MAX:
        good = number(code, text, 1, 1e9, &n);
        v->code_max = (uint32_t)n;
        return good;
    case O_UERE:
        return number(code, text, 1e-3, 1e4, &v->uere_m);
    case O_LATENCY:
        return number(code, text, 0, 10, &v->latency_s);
    case 'f':
        return filter(text, &v->filter);
    case O_TAU:
        return number(code, text, 0, 1e4, &v->car.tau_fix);
    case O_BIAS:
        good = number(code, text, 0, 57, &n);
        v->car.sigma_bias = n * RAD_PER_DEG;
        return good;
    case O_SCALE:
        return number(code, text, 0, 1, &v->car.sigma_scale);
    default:
        return -1;
    }
}

/// One option of output and run. \return 1; 0 after a message.
static int take_shared(gpsdr_options_t* o, int code, const char* text)
{
    options_t* const s = &o->shared;
    double n = 0.0;
    int good = 1;
    switch (code)
    {
    case O_DISPLAY:
        o->display = 1;
        break;
    case 'j':
        s->json = text;
        break;
    case O_DDS:
        s->dds = 1;
        good = text == NULL || number(code, text, 0, 230, &n);
        s->domain = (uint32_t)n;
        break;
    case O_DDS_CONFIG:
        s->dds_config = text;
        break;
    case O_DDS_ENV:
        s->dds_environment = 1;
        break;
    case O_DDS_INTERFACE:
        s->dds_interface = text;
        break;
    case O_DDS_PEER:
        s->dds_peers = text;
        break;
    case O_TOPIC:
        s->topic = text;
        break;
    case O_PARTITION:
        s->partition = text;
        break;
    case O_SOURCE:
        s->source = text;
        break;
    case 'n':
        good = number(code, text, 1, 1e15, &n);
        s->limit = (uint64_t)n;
        break;
    case 't':
        good = number(code, text, 1e-3, 1e6, &s->timeout_s);
        break;
    case 'q':
        s->quiet = 1;
        break;
    default:
        fprintf(stderr, "ins-gpsdr: try --help\n"); // getopt_long has named the option
        good = 0;
    }
    return good;
}

static const char* problem(const gpsdr_options_t* o)
{
    const options_t* const s = &o->shared;
    if (o->device[0] == NULL)
    {
        return "no receiver: give --gps PATH or --gps tcp:HOST:PORT";
    }
    if (!port_baud_known(o->baud[0]) || !port_baud_known(o->baud[1]))
    {
        return "--baud, --gps-baud: not a rate of this system; use 4800, 9600, 19200, 38400, 57600, 115200 or 230400";
    }
    if (!s->dds && (s->dds_config != NULL || s->dds_environment || s->dds_interface != NULL || s->topic != NULL ||
                    s->partition != NULL))
    {
        return "--dds-config, --dds-env, --dds-interface, --topic and --partition want --dds";
    }
    const char* const wrong = options_network_problem(s);
    if (wrong != NULL)
    {
        return wrong;
    }
    if (o->display && s->json != NULL && strcmp(s->json, "-") == 0)
    {
        return "--display and --json - would share standard output";
    }
    return ins_vehicle_config_problem(&o->vehicle);
}

int gpsdr_options_parse(int argc, char** argv, gpsdr_options_t* options)
{
    memset(options, 0, sizeof *options);
    ins_vehicle_config_default(&options->vehicle);
    options->baud[0] = options->baud[1] = 9600;
    options->shared.input = INPUT_NAV; // what is published is a NavSolution
    options->shared.source = "ins-gpsdr";
    for (;;)
    {
        const int code = getopt_long(argc, argv, "g:d:b:f:j:n:t:qhV", known, NULL);
        if (code == -1)
        {
            break;
        }
        if (code == 'h')
        {
            fputs(help, stdout);
            return 0;
        }
        if (code == 'V')
        {
            printf("ins-gpsdr %d.%d.%d\n", INS_VERSION_MAJOR, INS_VERSION_MINOR, INS_VERSION_PATCH);
            return 0;
        }
        const int taken = take_vehicle(options, code, optarg);
        if (taken == 0 || (taken < 0 && !take_shared(options, code, optarg)))
        {
            return 2;
        }
    }
    const char* wrong = optind < argc ? "an argument too many; try --help" : problem(options);
    if (wrong != NULL)
    {
        fprintf(stderr, "ins-gpsdr: %s\n", wrong);
        return 2;
    }
    options_t* const s = &options->shared;
    s->json = s->json == NULL && !s->dds && !options->display ? "-" : s->json;
    return -1;
}
