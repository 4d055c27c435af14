/// \file   main.c
/// \brief  ins-navd: samples from a board's serial line to attitude, or what a navigating board says, as JSON lines and over DDS.
///
/// Two threads, after Zheng and Zhou (2010), section 3.4: one receives and answers, one computes and hands on. Their shared variable,
/// which overwrites, is a bounded queue here. Exit codes: 0 done, 1 time-out or output failed, 2 bad usage, device or DDS.
/// SPDX-License-Identifier: MIT
#include "output.h"
#include "port.h"
#include "receive.h"
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

static atomic_int stop = RUNNING;

static void on_signal(int number)
{
    (void)number;
    int running = RUNNING;
    (void)atomic_compare_exchange_strong(&stop, &running, STOP_SIGNAL);
}

static void set_signals(void)
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    (void)sigemptyset(&action.sa_mask);
    action.sa_handler = on_signal;
    (void)sigaction(SIGINT, &action, NULL);
    (void)sigaction(SIGTERM, &action, NULL);
    action.sa_handler = SIG_IGN; // a closed pipe is a failed write
    (void)sigaction(SIGPIPE, &action, NULL);
}

typedef struct totals_t
{
    uint64_t states;
    uint64_t missed;
    double age_sum_s; ///< from the last octet of a block to its state handed on
    double age_max_s;
} totals_t;

typedef struct solvers_t
{
    ins_nav_solver_t gyros;
    ins_nav_six_t six;
} solvers_t;

static int unusable(const queue_item_t* item)
{
    fprintf(stderr, "ins-navd: sample %llu could not be used\n", (unsigned long long)item->is.sample.index);
    return 0;
}

/// \return as hand_on().
static int navigate_six(const queue_item_t* item, ins_nav_six_t* solver, output_t* output, totals_t* totals,
                        char* error, size_t size)
{
    ins_nav_six_state_t state;
    ins_navigation_t navigation;
    if (ins_nav_six_step(solver, &item->is.sample, &state) != INS_OK)
    {
        return unusable(item);
    }
    totals->missed = state.nav.missed;
    ins_nav_six_navigation(solver, &state, wall_ns(item->arrived_ns), &navigation);
    return output_six(output, &state, &navigation, &stop, error, size) == 0 ? 1 : -1;
}

/// \return 1 handed on; 0 the sample could not be used; -1 with the reason in error.
static int hand_on(const queue_item_t* item, solvers_t* solvers, output_t* output, const options_t* options,
                   totals_t* totals, char* error, size_t size)
{
    const int64_t time_ns = wall_ns(item->arrived_ns);
    ins_navigation_t navigation;
    if (options->input == INPUT_NAV)
    {
        totals->missed += item->is.solution.lost;
        ins_navigation_from_solution(&item->is.solution, time_ns, &navigation);
        return output_solution(output, &item->is.solution, &navigation, &stop, error, size) == 0 ? 1 : -1;
    }
    if (options->input == INPUT_SIX)
    {
        return navigate_six(item, &solvers->six, output, totals, error, size);
    }
    output_sample(output, &item->is.sample, &options->nav, time_ns);
    ins_nav_state_t state;
    if (ins_nav_solver_step(&solvers->gyros, &item->is.sample, &state) != INS_OK)
    {
        return unusable(item);
    }
    totals->missed = state.missed;
    ins_navigation_from_state(&state, time_ns, &navigation);
    return output_state(output, &state, &navigation, &stop, error, size) == 0 ? 1 : -1;
}

/// The computing half, until the queue is closed, the limit is reached or the output fails.
static void compute(queue_t* queue, solvers_t* solvers, output_t* output, const options_t* options, totals_t* totals)
{
    queue_item_t item;
    char error[512];
    while (queue_get(queue, &item))
    {
        int running = RUNNING;
        const int done = hand_on(&item, solvers, output, options, totals, error, sizeof error);
        if (done < 0)
        {
            fprintf(stderr, "ins-navd: %s\n", error);
            (void)atomic_compare_exchange_strong(&stop, &running, STOP_OUTPUT);
            return;
        }
        if (done == 0)
        {
            continue;
        }
        const double age_s = (double)(now_ns() - item.arrived_ns) * 1e-9;
        totals->age_sum_s += age_s;
        totals->age_max_s = age_s > totals->age_max_s ? age_s : totals->age_max_s;
        if (++totals->states == options->limit)
        {
            (void)atomic_compare_exchange_strong(&stop, &running, STOP_LIMIT);
            return;
        }
    }
}

static void summary(const receiver_t* r, const output_t* output, const totals_t* t, stop_t reason)
{
    static const char* const reasons[] = {"", "signal", "limit", "timeout", "output"};
    const ins_nav_counts_t* c = receiver_counts(r);
    event(r->options, "summary",
          ",\"reason\":\"%s\",\"states\":%llu,\"missed\":%llu,\"overruns\":%llu,\"octets\":%llu,\"reopens\":%llu,"
          "\"unsent\":%llu,"
          "\"accepted\":%llu,\"lost\":%llu,\"invalid\":%llu,\"duplicates\":%llu,\"corrupt\":%llu,\"timeouts\":%llu,"
          "\"stray\":%llu,"
          "\"published\":%llu,\"unpublished\":%llu,\"dropped\":%llu,\"unwritten\":%llu,\"age_mean_ms\":%.3f,\"age_max_"
          "ms\":%.3f",
          reasons[reason], (unsigned long long)t->states, (unsigned long long)t->missed,
          (unsigned long long)r->overruns, (unsigned long long)r->octets, (unsigned long long)r->reopens,
          (unsigned long long)r->unsent, (unsigned long long)c->accepted, (unsigned long long)c->lost,
          (unsigned long long)c->invalid, (unsigned long long)c->duplicates, (unsigned long long)c->corrupt,
          (unsigned long long)c->timeouts, (unsigned long long)c->stray, (unsigned long long)output->counts.published,
          (unsigned long long)output->counts.refused, (unsigned long long)output->counts.dropped,
          (unsigned long long)output->unwritten, t->states > 0 ? t->age_sum_s / (double)t->states * 1e3 : 0.0,
          t->age_max_s * 1e3);
}

static int run(const options_t* options, receiver_t* receiver, queue_t* queue, output_t* output)
{
    solvers_t solvers;
    totals_t totals = {0};
    pthread_t thread;
    (void)ins_nav_solver_init(&solvers.gyros, &options->nav); // options_parse() has checked nav and six
    if (options->input == INPUT_SIX)
    {
        (void)ins_nav_six_init(&solvers.six, &options->six);
    }
    (void)ins_nav_link_init(&receiver->link, &options->nav);
    ins_nav_input_config_t input;
    ins_nav_input_config_default(&input);
    input.octet_timeout_ms = options->nav.octet_timeout_ms;
    (void)ins_nav_input_init(&receiver->input, &input);
    receiver->options = options;
    receiver->queue = queue;
    receiver->stop = &stop;
    if (pthread_create(&thread, NULL, receive_thread, receiver) != 0)
    {
        fprintf(stderr, "ins-navd: cannot start the receiving thread\n");
        output_close(output);
        return 2;
    }
    compute(queue, &solvers, output, options, &totals);
    (void)pthread_join(thread, NULL);
    const stop_t reason = (stop_t)atomic_load(&stop);
    if (reason == STOP_TIMEOUT)
    {
        fprintf(stderr, "ins-navd: no sample for %g s from %s: %s\n", options->timeout_s, options->device,
                receiver->octets == 0 ? "not one octet came; is the board powered, are its lines the right way round?"
                : options->input == INPUT_NAV
                    ? "octets came, but no right block; compare --baud and --input with the firmware"
                    : "octets came, but no right block; compare --baud, --block-len and --seq with the firmware");
    }
    output_close(output); // publishes what waits, so that it counts
    summary(receiver, output, &totals, reason);
    return reason == STOP_TIMEOUT || reason == STOP_OUTPUT ? 1 : 0;
}

int main(int argc, char** argv)
{
    options_t options;
    const int code = options_parse(argc, argv, &options);
    if (code >= 0)
    {
        return code;
    }
    set_signals();
    char error[1280];
    char text[600];
    output_t output;
    queue_t queue;
    receiver_t receiver;
    memset(&receiver, 0, sizeof receiver);
    receiver.fd = port_open(options.device, options.baud, error, sizeof error);
    if (receiver.fd == PORT_BAD || (receiver.fd < 0 && !options.wait))
    {
        fprintf(stderr, "ins-navd: %s\n", error);
        return 2;
    }
    event(&options, receiver.fd < 0 ? "waiting" : "open", ",\"device\":\"%s\"",
          quoted(options.device, text, sizeof text));
    if (output_open(&output, &options, error, sizeof error) != 0)
    {
        fprintf(stderr, "ins-navd: %s\n", error);
        return 2;
    }
    if (queue_init(&queue, options.queue) != 0)
    {
        fprintf(stderr, "ins-navd: memory is out\n");
        return 2;
    }
    const int result = run(&options, &receiver, &queue, &output);
    queue_destroy(&queue);
    return result;
}
