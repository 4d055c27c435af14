/// \file   options.c
/// \brief  The command line of ins-navd.
/// SPDX-License-Identifier: MIT
#include "options.h"
#include "ins/coning.h"
#include "ins/version.h"
#include "port.h"
#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define RAD_PER_DEG (3.14159265358979323846 / 180.0)

static const char* const help =
    "usage: ins-navd --device PATH|tcp:HOST:PORT [options]\n"
    "Receives gyro samples from a sampling board over its handshake link, integrates the attitude, prints and "
    "publishes it.\n"
    "With --input nav: receives what a navigating board has computed, prints and publishes it.\n"
    "\n"
    "link\n"
    "  -d, --device PATH         serial device or pty; or tcp:HOST:PORT\n"
    "      --input codes|nav     what the board sends: gyro codes, or position, velocity and attitude; codes\n"
    "  -b, --baud N              9600, with --input nav 19200 (8 data bits, no parity, 1 stop bit, raw)\n"
    "  -w, --wait                wait for a device that is missing at the start\n"
    "      --block-len N         octets of a block, 6 to 32; 6\n"
    "      --seq, --no-seq       sequence number in the spare bits of X and Y, or not; --seq\n"
    "      --octet-timeout-ms N  longest silence inside a block, below the board's wait for a reply;\n"
    "                            0.3 periods, at least 3 octets; with --input nav 30 ms, at least 3 octets\n"
    "sensor (--input codes, as --block-len and --seq)\n"
    "  -p, --period S            the firmware's sampling period; 0.02\n"
    "      --lsb-deg-s V[,V,V]   rate per code; 180/4096\n"
    "      --null-code V[,V,V]   code at rest; 2048\n"
    "      --code-max N          full scale; 4095\n"
    "      --skew-us X,Y,Z       delay of each channel within a scan; 0,0,0 (no compensation)\n"
    "      --skew-order N        1 to 3; 2\n"
    "navigation (--input codes)\n"
    "  -a, --attitude-deg R,P,Y  roll, pitch, yaw at the first sample; 0,0,0\n"
    "      --form NAME           one, hist1, hist2-fit, hist2-opt, hist3-fit, hist3-opt; hist2-opt\n"
    "      --rate-order N        2 (trapezoid) to 5; 4\n"
    "      --bridge-max N        lost samples in a row before the state says long_gap; 50\n"
    "output\n"
    "  -j, --json FILE|-         one JSON line per sample; standard output, unless --dds or --ros is given\n"
    "      --dds[=DOMAIN]        publish libins::NavState, with --input nav libins::NavSolution; domain 0, loopback "
    "only\n"
    "      --dds-config FILE     Cyclone DDS configuration (XML) in place of loopback\n"
    "      --dds-env             configuration from CYCLONEDDS_URI in place of loopback\n"
    "      --dds-interface IF    network interface in place of loopback, by multicast\n"
    "      --dds-peer ADDR[,...] on --dds-interface: these are asked, nothing is multicast\n"
    "      --topic NAME          libins/nav_state, with --input nav libins/nav_solution\n"
    "      --partition NAME      none\n"
    "      --strength N          of several daemons of one source only the strongest alive is heard; 0: all are\n"
    "      --security FOLDER     DDS Security with the files that `ins keys` made there, or six paths\n"
    "      --lease-s S           it counts as gone after S seconds without a sign of life; 1\n"
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

enum
{
    O_INPUT = 256,
    O_BLOCK_LEN,
    O_SEQ,
    O_NO_SEQ,
    O_OCTET_TIMEOUT,
    O_LSB,
    O_NULL,
    O_CODE_MAX,
    O_SKEW,
    O_SKEW_ORDER,
    O_FORM,
    O_RATE_ORDER,
    O_BRIDGE_MAX,
    O_DDS,
    O_DDS_CONFIG,
    O_DDS_ENV,
    O_DDS_INTERFACE,
    O_DDS_PEER,
    O_STRENGTH,
    O_LEASE,
    O_SECURITY,
    O_ROS,
    O_TOPIC,
    O_PARTITION,
    O_SOURCE,
    O_QUEUE
};

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
    {"json", required_argument, NULL, 'j'},
    {"dds", optional_argument, NULL, O_DDS},
    {"dds-config", required_argument, NULL, O_DDS_CONFIG},
    {"dds-env", no_argument, NULL, O_DDS_ENV},
    {"dds-interface", required_argument, NULL, O_DDS_INTERFACE},
    {"dds-peer", required_argument, NULL, O_DDS_PEER},
    {"strength", required_argument, NULL, O_STRENGTH},
    {"security", required_argument, NULL, O_SECURITY},
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

/// 1 to `want` reals with commas between; one alone stands for all. \return 1; 0 after a message.
static int reals(int code, const char* text, int want, int one_for_all, double scale, double* out)
{
    const char* at = text;
    int count = 0;
    for (;;)
    {
        char* end;
        const double value = strtod(at, &end);
        if (end == at || count >= want || (*end != ',' && *end != '\0') ||
            !(value - value == 0.0)) // not a number, infinite
        {
            count = 0;
            break;
        }
        out[count++] = value * scale;
        if (*end == '\0')
        {
            break;
        }
        at = end + 1;
    }
    if (count == 1 && one_for_all)
    {
        for (; count < want; count++)
        {
            out[count] = out[0];
        }
    }
    if (count != want)
    {
        fprintf(stderr, "ins-navd: --%s: '%s' is not %s%s\n", option_name(code), text,
                want == 1 ? "a number" : "three numbers with commas between",
                want > 1 && one_for_all ? ", nor one for all three" : "");
        return 0;
    }
    return 1;
}

static int above_zero(int code, const char* text, double* out)
{
    if (!reals(code, text, 1, 0, 1.0, out))
    {
        return 0;
    }
    if (!(*out > 0.0))
    {
        fprintf(stderr, "ins-navd: --%s: '%s' is not above 0\n", option_name(code), text);
        return 0;
    }
    return 1;
}

static int whole(int code, const char* text, uint64_t least, uint64_t most, uint64_t* out)
{
    char* end;
    errno = 0;
    const unsigned long long value = strtoull(text, &end, 10);
    if (text[0] < '0' || text[0] > '9' || *end != '\0' || errno != 0 || value < least || value > most)
    {
        fprintf(stderr, "ins-navd: --%s: '%s' is not a whole number from %llu to %llu\n", option_name(code), text,
                (unsigned long long)least, (unsigned long long)most);
        return 0;
    }
    *out = value;
    return 1;
}

static int form(const char* text, int* out)
{
    static const struct
    {
        const char* name;
        int form;
    } forms[] = {{"one", INS_CONING_ONE},
                 {"hist1", INS_CONING_HIST1},
                 {"hist2-fit", INS_CONING_HIST2_FIT},
                 {"hist2-opt", INS_CONING_HIST2_OPT},
                 {"hist3-fit", INS_CONING_HIST3_FIT},
                 {"hist3-opt", INS_CONING_HIST3_OPT}};
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++)
    {
        if (strcmp(text, forms[i].name) == 0)
        {
            *out = forms[i].form;
            return 1;
        }
    }
    fprintf(stderr, "ins-navd: --form: '%s' is none of one, hist1, hist2-fit, hist2-opt, hist3-fit, hist3-opt\n", text);
    return 0;
}

static int input(const char* text, input_t* out)
{
    *out = strcmp(text, "nav") == 0 ? INPUT_NAV : INPUT_CODES;
    if (*out == INPUT_CODES && strcmp(text, "codes") != 0)
    {
        fprintf(stderr, "ins-navd: --input: '%s' is neither codes nor nav\n", text);
        return 0;
    }
    return 1;
}

/// Options about samples and their integration.
static int only_for_codes(int code)
{
    return code == 'p' || code == 'a' || (code >= O_LSB && code <= O_BRIDGE_MAX) || code == O_BLOCK_LEN ||
           code == O_SEQ || code == O_NO_SEQ;
}

/// One option. \return 1; 0 after a message.
static int take(options_t* o, int code, const char* text)
{
    uint64_t n = 0;
    int good = 1;
    double angle[3];
    o->codes_option = only_for_codes(code) ? option_name(code) : o->codes_option;
    switch (code)
    {
    case O_INPUT:
        good = input(text, &o->input);
        break;
    case 'd':
        o->device = text;
        break;
    case 'b':
        good = whole(code, text, 1, 100000000, &n);
        o->baud = (long)n;
        break;
    case 'w':
        o->wait = 1;
        break;
    case O_BLOCK_LEN:
        good = whole(code, text, 6, INS_HS_BLOCK_MAX, &n);
        o->nav.block_len = (uint8_t)n;
        break;
    case O_SEQ:
        o->nav.seq = 1;
        break;
    case O_NO_SEQ:
        o->nav.seq = 0;
        break;
    case O_OCTET_TIMEOUT:
        good = whole(code, text, 1, 32000, &n);
        o->nav.octet_timeout_ms = (uint16_t)n;
        break;
    case 'p':
        good = reals(code, text, 1, 0, 1.0, &o->nav.period_s);
        break;
    case O_LSB:
        good = reals(code, text, 3, 1, RAD_PER_DEG, o->nav.lsb_rad_s);
        break;
    case O_NULL:
        good = reals(code, text, 3, 1, 1.0, o->nav.null_code);
        break;
    case O_CODE_MAX:
        good = whole(code, text, 1, UINT16_MAX, &n);
        o->nav.code_max = (uint16_t)n;
        break;
    case O_SKEW:
        good = reals(code, text, 3, 0, 1e-6, o->nav.delay_s);
        break;
    case O_SKEW_ORDER:
        good = whole(code, text, 1, 3, &n);
        o->nav.skew_order = (uint8_t)n;
        break;
    case 'a':
        good = reals(code, text, 3, 0, RAD_PER_DEG, angle);
        if (good && ins_nav_config_attitude(&o->nav, angle) != INS_OK)
        {
            fprintf(stderr, "ins-navd: --attitude-deg: '%s' is out of range: use -360 to 360\n", text);
            good = 0;
        }
        break;
    case O_FORM:
        good = form(text, &o->nav.form);
        break;
    case O_RATE_ORDER:
        good = whole(code, text, 2, 5, &n);
        o->nav.rate_order = (uint8_t)n;
        break;
    case O_BRIDGE_MAX:
        good = whole(code, text, 0, UINT32_MAX, &n);
        o->nav.bridge_max = (uint32_t)n;
        break;
    case 'j':
        o->json = text;
        break;
    case O_DDS:
        o->dds = 1;
        good = text == NULL || whole(code, text, 0, 230, &n);
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
        good = whole(code, text, 0, INT32_MAX, &n);
        o->strength = (int32_t)n;
        break;
    case O_LEASE:
        good = above_zero(code, text, &o->lease_s);
        break;
    case O_SECURITY:
        o->security = text;
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
        good = whole(code, text, 1, 1000000, &n);
        o->queue = (uint32_t)n;
        break;
    case 'n':
        good = whole(code, text, 1, UINT64_MAX, &o->limit);
        break;
    case 't':
        good = above_zero(code, text, &o->timeout_s);
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

/// The sampling boards of this project wait two fifths of a period for a reply, at least five octets' time; the navigating one 100 ms.
static uint16_t usual_octet_timeout_ms(const options_t* o)
{
    const double octet_ms = 10e3 / (double)o->baud;
    const double usual_ms = o->input == INPUT_NAV ? 30.0 : 300.0 * o->nav.period_s;
    const double wanted_ms = usual_ms > 3.0 * octet_ms ? usual_ms : 3.0 * octet_ms;
    return (uint16_t)(wanted_ms < 2.0 ? 2.0 : wanted_ms < 1000.0 ? wanted_ms : 1000.0);
}

static const char* problem(const options_t* o)
{
    static char text[96];
    if (o->device == NULL)
    {
        return "no device: give --device PATH or --device tcp:HOST:PORT";
    }
    if (o->input == INPUT_NAV && o->codes_option != NULL)
    {
        (void)snprintf(text, sizeof text, "--%s is for --input codes: a navigating board says all that itself",
                       o->codes_option);
        return text;
    }
    if (!port_baud_known(o->baud))
    {
        return "--baud: not a rate of this system; use 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200 or 230400";
    }
    if (!o->dds && (o->topic != NULL || o->partition != NULL || o->strength != 0 || o->lease_s > 0.0))
    {
        return "--topic, --partition, --strength and --lease-s want --dds";
    }
    if (!o->dds && o->ros == NULL &&
        (o->dds_config != NULL || o->dds_environment || o->dds_interface != NULL || o->security != NULL))
    {
        return "--dds-config, --dds-env, --dds-interface and --security want --dds or --ros";
    }
    const char* const wrong = options_network_problem(o);
    if (wrong != NULL)
    {
        return wrong;
    }
    return ins_nav_config_problem(&o->nav);
}

int options_parse(int argc, char** argv, options_t* options)
{
    memset(options, 0, sizeof *options);
    ins_nav_config_default(&options->nav);
    options->nav.octet_timeout_ms = 0; // not given
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
                fputs(help, stdout);
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
    if (options->baud == 0)
    {
        options->baud = options->input == INPUT_NAV ? 19200 : 9600;
    }
    if (options->nav.octet_timeout_ms == 0)
    {
        options->nav.octet_timeout_ms = usual_octet_timeout_ms(options);
    }
    const char* wrong = optind < argc ? "an argument too many; try --help" : problem(options);
    if (wrong != NULL)
    {
        fprintf(stderr, "ins-navd: %s\n", wrong);
        return 2;
    }
    options->json = options->json == NULL && !options->dds && options->ros == NULL ? "-" : options->json;
    return -1;
}
