/// \file   board.c
/// \brief  A sampling board on a pty, paced by this machine's clock: a block each PERIOD_US until it is ended. Prints the pty's name.
///         bench_dds_board PERIOD_US
/// SPDX-License-Identifier: MIT
#include "ins/handshake.h"
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#define CODE_AT_REST 2048

static int64_t now_ns(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

/// Octets both ways until the line has been silent up to `until_ns`.
static void serve(ins_hs_board_t* board, int fd, int64_t until_ns)
{
    for (;;)
    {
        const int64_t left_ns = until_ns - now_ns();
        const uint16_t now_ms = (uint16_t)(now_ns() / 1000000);
        const int16_t out = ins_hs_board_tx(board, now_ms);
        if (out >= 0)
        {
            const ins_octet_t octet = (ins_octet_t)out;
            (void)!write(fd, &octet, 1);
            continue;
        }
        if (left_ns <= 0)
        {
            return;
        }
        struct pollfd p = {fd, POLLIN, 0};
        const struct timespec wait = {left_ns / 1000000000, left_ns % 1000000000};
        ins_octet_t in;
        if (ppoll(&p, 1, &wait, NULL) == 1 && (p.revents & POLLIN) != 0 && read(fd, &in, 1) == 1)
        {
            ins_hs_board_rx(board, in, now_ms);
        }
        ins_hs_board_tick(board, now_ms);
    }
}

int main(int argc, char** argv)
{
    const long period_us = argc == 2 ? atol(argv[1]) : 0;
    const int fd = posix_openpt(O_RDWR | O_NOCTTY);
    struct termios line;
    if (period_us < 1 || fd < 0 || grantpt(fd) != 0 || unlockpt(fd) != 0 || tcgetattr(fd, &line) != 0)
    {
        perror("bench_dds_board PERIOD_US");
        return 2;
    }
    cfmakeraw(&line);
    (void)tcsetattr(fd, TCSANOW, &line);
    (void)open(ptsname(fd), O_RDWR | O_NOCTTY); // held, so that the line lives before and after a daemon
    printf("%s\n", ptsname(fd));
    (void)fflush(stdout);
    const ins_hs_config_t cfg = {6, 1, 3, 50, 20};
    const uint16_t codes[3] = {CODE_AT_REST, CODE_AT_REST + 1, CODE_AT_REST - 1};
    ins_hs_board_t board;
    ins_octet_t block[6];
    (void)ins_hs_board_init(&board, &cfg);
    ins_hs_block_put(codes, block);
    int64_t due_ns = now_ns();
    for (uint8_t seq = 0;; seq++)
    {
        due_ns += (int64_t)period_us * 1000;
        serve(&board, fd, due_ns);
        (void)ins_hs_board_offer(&board, block, seq, (uint16_t)(now_ns() / 1000000));
    }
}
