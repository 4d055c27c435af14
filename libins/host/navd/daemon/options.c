/// \file   options.c
/// \brief  The command line of ins-navd.
/// SPDX-License-Identifier: MIT
#include "arguments.h"
#include "ins/version.h"
#include "options_internal.h"
#include "port.h"
#include <getopt.h>
#include <stdio.h>
#include <string.h>

static const char* const help_input =
    "usage: ins-navd --device PATH|tcp:HOST:PORT [options]\n"
    "Receives gyro samples from a sampling board over its handshake link, integrates the attitude, prints and "
    "publishes it.\n"
    "With --input nav: receives what a navigating board has computed, prints and publishes it.\n"
    "With --input six: receives samples of six accelerometers and navigates with these alone (docs/gyro_free.md).\n"
    "\n"
    "link\n"
    "  -d, --device PATH         serial device or pty; or tcp:HOST:PORT\n"
    "      --input codes|nav|six what the board sends: gyro codes, position, velocity and attitude, or codes of six\n"
    "                            accelerometers; codes\n"
    "  -b, --baud N              9600, with --input nav 19200, six 57600 (8 data bits, no parity, 1 stop bit, raw)\n"
    "  -w, --wait                wait for a device that is missing at the start\n"
    "      --block-len N         octets of a block, 6 to 32; 6, with --input six 12\n"
    "      --seq, --no-seq       sequence number in the spare bits of X and Y, or not; --seq\n"
    "      --octet-timeout-ms N  longest silence inside a block, below the board's wait for a reply;\n"
    "                            0.3 periods, at least 3 octets; with --input nav 30 ms, at least 3 octets\n"
    "sensor (--input codes and six, as --block-len and --seq)\n"
    "  -p, --period S            the firmware's sampling period; 0.02, with --input six 0.01\n"
    "      --lsb-deg-s V[,V,V]   rate per code (codes); 180/4096\n"
    "      --lsb-m-s2 V          reading per code (six); 4 g / 4096\n"
    "      --null-code V[,V,V]   code at rest; 2048\n"
    "      --code-max N          full scale; 4095\n"
    "      --skew-us X,Y,Z       delay of each channel within a scan, of six: six; 0 (no compensation)\n"
    "      --skew-order N        1 to 3; 2\n"
    "      --accel-arm-m V       arm of the six of Hung and others; 0.1\n"
    "      --accel K,B,A,A,A,R,R,R  accelerometer K, 1 to 6, as calibrated: bias [m/s^2], axis, place [m]\n"
    "      --noise-m-s2 V        of a reading, quantisation included; 0.58 codes\n"
    "      --bias-m-s2 V         of a reading, standard deviation at the start; 0.02\n"
    "navigation (--input codes and six)\n"
    "  -a, --attitude-deg R,P,Y  roll, pitch, yaw at the first sample; 0,0,0\n"
    "      --form NAME           one, hist1, hist2-fit, hist2-opt, hist3-fit, hist3-opt; hist2-opt\n"
    "      --rate-order N        2 (trapezoid) to 5; 4\n"
    "      --sigma-attitude-deg V[,V,V]  of it, about north, east, down (six); 0.57\n"
    "      --position-deg LAT,LON,H  at the first sample, height in metres (six)\n"
    "      --still-s S           it stands still so long from the first sample (six); 10\n"
    "      --bridge-max N        lost samples in a row before the state says long_gap; 50\n";
static const char* const help_output =
    "output\n"
    "  -j, --json FILE|-         one JSON line per sample; standard output, unless --dds or --ros is given\n"
    "      --dds[=DOMAIN]        publish libins::NavState and Status, of gyros RawImu, with --input nav NavSolution;\n"
    "                            domain 0, loopback only\n"
    "      --dds-config FILE     Cyclone DDS configuration (XML) in place of loopback\n"
    "      --dds-env             configuration from CYCLONEDDS_URI in place of loopback\n"
    "      --dds-interface IF    network interface in place of loopback, by multicast\n"
    "      --dds-peer ADDR[,...] on --dds-interface: these are asked, nothing is multicast\n"
    "      --topic NAME          libins/nav_state, with --input nav libins/nav_solution\n"
    "      --partition NAME      none\n"
    "      --strength N          of several daemons of one source only the strongest alive is heard; 0: all are\n"
    "      --security FOLDER     DDS Security with the files that `ins keys` made there, or six paths\n"
    "      --lease-s S           it counts as gone after S seconds without a sign of life; 1\n"
    "      --qos TOPIC=PROFILE   nav_state, nav_solution, status or raw_imu: default, sensor_data, latched or "
    "reliable\n"
    "      --decimate N          one state in N on libins/nav_state_decimated too\n"
    "      --source ID           key of the published states; ins-navd\n"
    "      --ros[=NAMESPACE]     publish ROS 2 topics (imu/data, /tf, /diagnostics; with --input nav gnss/fix, "
    "odometry, twist\n"
    "                            too) as node ins_navd; the domain is ROS_DOMAIN_ID, else that of --dds; loopback "
    "only\n"
    "      --queue N             samples that may wait between the two threads; 64. A sample that finds it full is\n"
    "                            dropped and counted, and the next one bridges the gap\n"
    "run\n"
    "  -n, --limit N             stop after N samples\n"
    "  -t, --timeout-s S         stop, with exit code 1, when no sample came for S seconds\n"
    "  -q, --quiet               no event lines on standard error\n"
    "  -h, --help    -V, --version\n"
    "exit code: 0 done, 1 time-out or output failed, 2 bad usage, device or DDS\n";

static const struct option known[] = {
    {"device", required_argument, NULL, 'd'},
    {"input", required_argument, NULL, O_INPUT},
    {"baud", required_argument, NULL, 'b'},
    {"wait", no_argument, NULL, 'w'},
    {"block-len", required_argument, NULL, O_BLOCK_LEN},
    {"seq", no_argument, NULL, O_SEQ},
    {"no-seq", no_argument, NULL, O_NO_SEQ},
    {"octet-timeout-ms", required_argument, NULL, O_OCTET_TIMEOUT},
    {"period", required_argument, NULL, 'p'},
    {"lsb-deg-s", required_argument, NULL, O_LSB},
    {"null-code", required_argument, NULL, O_NULL},
    {"code-max", required_argument, NULL, O_CODE_MAX},
    {"skew-us", required_argument, NULL, O_SKEW},
    {"skew-order", required_argument, NULL, O_SKEW_ORDER},
    {"attitude-deg", required_argument, NULL, 'a'},
    {"form", required_argument, NULL, O_FORM},
    {"rate-order", required_argument, NULL, O_RATE_ORDER},
    {"bridge-max", required_argument, NULL, O_BRIDGE_MAX},
    {"accel-arm-m", required_argument, NULL, O_ARM},
    {"accel", required_argument, NULL, O_ACCEL},
    {"lsb-m-s2", required_argument, NULL, O_LSB_FORCE},
    {"noise-m-s2", required_argument, NULL, O_NOISE},
    {"bias-m-s2", required_argument, NULL, O_BIAS},
    {"sigma-attitude-deg", required_argument, NULL, O_SIGMA_ATTITUDE},
    {"position-deg", required_argument, NULL, O_POSITION},
    {"still-s", required_argument, NULL, O_STILL},
    {"json", required_argument, NULL, 'j'},
    {"dds", optional_argument, NULL, O_DDS},
    {"dds-config", required_argument, NULL, O_DDS_CONFIG},
    {"dds-env", no_argument, NULL, O_DDS_ENV},
    {"dds-interface", required_argument, NULL, O_DDS_INTERFACE},
    {"dds-peer", required_argument, NULL, O_DDS_PEER},
    {"strength", required_argument, NULL, O_STRENGTH},
    {"security", required_argument, NULL, O_SECURITY},
    {"qos", required_argument, NULL, O_QOS},
    {"decimate", required_argument, NULL, O_DECIMATE},
    {"lease-s", required_argument, NULL, O_LEASE},
    {"ros", optional_argument, NULL, O_ROS},
    {"topic", required_argument, NULL, O_TOPIC},
    {"partition", required_argument, NULL, O_PARTITION},
    {"source", required_argument, NULL, O_SOURCE},
    {"queue", required_argument, NULL, O_QUEUE},
    {"limit", required_argument, NULL, 'n'},
    {"timeout-s", required_argument, NULL, 't'},
    {"quiet", no_argument, NULL, 'q'},
    {"help", no_argument, NULL, 'h'},
    {"version", no_argument, NULL, 'V'},
    {NULL, 0, NULL, 0},
};

static const char* option_name(int code)
{
    const struct option* o = known;
    while (o->name != NULL && o->val != code)
    {
        o++;
    }
    return o->name;
}

static int input(const char* text, input_t* out)
{
    static const char* const names[INPUT_COUNT] = {"codes", "nav", "six"};
    for (int i = 0; i < INPUT_COUNT; i++)
    {
        if (strcmp(text, names[i]) == 0)
        {
            *out = (input_t)i;
            return 1;
        }
    }
    fprintf(stderr, "ins-navd: --input: '%s' is none of codes, nav, six\n", text);
    return 0;
}

static int options_qos(options_t* o, const char* text)
{
    if (o->qos_count == QOS_MAX)
    {
        fprintf(stderr, "ins-navd: --qos: '%s' is one too many: %u are enough for every topic\n", text, QOS_MAX);
        return 0;
    }
    o->qos[o->qos_count++] = text;
    return 1;
}

/// One option. \return 1; 0 after a message.
static int take(options_t* o, int code, const char* text)
{
    const char* const name = option_name(code);
    uint64_t n = 0;
    int good = sensor_take(o, code, name, text);
    if (good >= 0)
    {
        return good;
    }
    good = 1;
    switch (code)
    {
    case O_INPUT:
        good = input(text, &o->input);
        break;
    case 'd':
        o->device = text;
        break;
    case 'b':
        good = argument_whole(name, text, 1, 100000000, &n);
        o->baud = (long)n;
        break;
    case 'w':
        o->wait = 1;
        break;
    case O_OCTET_TIMEOUT:
        good = argument_whole(name, text, 1, 32000, &n);
        o->nav.octet_timeout_ms = (uint16_t)n;
        break;
    case 'j':
        o->json = text;
        break;
    case O_DDS:
        o->dds = 1;
        good = text == NULL || argument_whole(name, text, 0, 230, &n);
        o->domain = (uint32_t)n;
        break;
    case O_DDS_CONFIG:
        o->dds_config = text;
        break;
    case O_DDS_ENV:
        o->dds_environment = 1;
        break;
    case O_DDS_INTERFACE:
        o->dds_interface = text;
        break;
    case O_DDS_PEER:
        o->dds_peers = text;
        break;
    case O_STRENGTH:
        good = argument_whole(name, text, 0, INT32_MAX, &n);
        o->strength = (int32_t)n;
        break;
    case O_LEASE:
        good = argument_above_zero(name, text, &o->lease_s);
        break;
    case O_SECURITY:
        o->security = text;
        break;
    case O_QOS:
        good = options_qos(o, text);
        break;
    case O_DECIMATE:
        good = argument_whole(name, text, 1, 1000000, &n);
        o->decimate = (uint32_t)n;
        break;
    case O_ROS:
        o->ros = text != NULL ? text : "/";
        break;
    case O_TOPIC:
        o->topic = text;
        break;
    case O_PARTITION:
        o->partition = text;
        break;
    case O_SOURCE:
        o->source = text;
        break;
    case O_QUEUE:
        good = argument_whole(name, text, 1, 1000000, &n);
        o->queue = (uint32_t)n;
        break;
    case 'n':
        good = argument_whole(name, text, 1, UINT64_MAX, &o->limit);
        break;
    case 't':
        good = argument_above_zero(name, text, &o->timeout_s);
        break;
    case 'q':
        o->quiet = 1;
        break;
    default:
        fprintf(stderr, "ins-navd: try --help\n"); // getopt_long has named the option
        good = 0;
    }
    return good;
}

static const char* problem(const options_t* o)
{
    if (o->device == NULL)
    {
        return "no device: give --device PATH or --device tcp:HOST:PORT";
    }
    if (!port_baud_known(o->baud))
    {
        return "--baud: not a rate of this system; use 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200 or 230400";
    }
    if (!o->dds && (o->topic != NULL || o->partition != NULL || o->strength != 0 || o->lease_s > 0.0 ||
                    o->qos_count > 0 || o->decimate > 0))
    {
        return "--topic, --partition, --strength, --lease-s, --qos and --decimate want --dds";
    }
    if (!o->dds && o->ros == NULL &&
        (o->dds_config != NULL || o->dds_environment || o->dds_interface != NULL || o->security != NULL))
    {
        return "--dds-config, --dds-env, --dds-interface and --security want --dds or --ros";
    }
    return options_network_problem(o);
}

int options_parse(int argc, char** argv, options_t* options)
{
    memset(options, 0, sizeof *options);
    sensor_default(options);
    options->baud = 0;
    options->queue = 64;
    options->source = "ins-navd";
    for (;;)
    {
        const int code = getopt_long(argc, argv, "d:b:wp:a:j:n:t:qhV", known, NULL);
        if (code == -1)
        {
            break;
        }
        if (code == 'h' || code == 'V')
        {
            if (code == 'h')
            {
                fputs(help_input, stdout);
                fputs(help_output, stdout);
            }
            else
            {
                printf("ins-navd %d.%d.%d\n", INS_VERSION_MAJOR, INS_VERSION_MINOR, INS_VERSION_PATCH);
            }
            return 0;
        }
        if (!take(options, code, optarg))
        {
            return 2;
        }
    }
    static const long usual_baud[INPUT_COUNT] = {[INPUT_CODES] = 9600, [INPUT_NAV] = 19200, [INPUT_SIX] = 57600};
    options->baud = options->baud == 0 ? usual_baud[options->input] : options->baud;
    const char* wrong = optind < argc ? "an argument too many; try --help" : problem(options);
    wrong = wrong == NULL ? sensor_finish(options) : wrong;
    if (wrong != NULL)
    {
        fprintf(stderr, "ins-navd: %s\n", wrong);
        return 2;
    }
    options->json = options->json == NULL && !options->dds && options->ros == NULL ? "-" : options->json;
    return -1;
}
