// A board for tests of ins-navd: the handshake machine of ins_core on a pty or a TCP socket, in a thread, as fast as the host answers.
// SPDX-License-Identifier: MIT
#ifndef TESTS_NAVD_BOARD_HPP
#define TESTS_NAVD_BOARD_HPP
#include "ins/handshake.h"
#include "ins/nav_block.h"
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <fcntl.h>
#include <functional>
#include <poll.h>
#include <stdexcept>
#include <stdlib.h>
#include <string>
#include <termios.h>
#include <thread>
#include <unistd.h>
#include <vector>

inline double seconds_now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Sample k of the motion that all tests feed: three sinusoids, 12 bits.
inline std::array<uint16_t, 3> sample(uint64_t k)
{
    std::array<uint16_t, 3> code;
    for (size_t i = 0; i < 3; i++)
    {
        const double phase = 0.02 * static_cast<double>(k) * (1.0 + 0.3 * static_cast<double>(i));
        code[i] = static_cast<uint16_t>(std::lround(2048 + 1500 * std::sin(phase + static_cast<double>(i))));
    }
    return code;
}

using Octets = std::vector<ins_octet_t>;

/// The block of sample k: XH XL YH YL ZH ZL.
inline Octets code_block(uint64_t k)
{
    Octets block;
    for (const uint16_t code : sample(k))
    {
        block.push_back(static_cast<ins_octet_t>(code >> 8));
        block.push_back(static_cast<ins_octet_t>(code & 0xFF));
    }
    return block;
}

/// Block k of a navigating board that drives north-east and turns.
inline ins_nav_block_t nav_of(uint64_t k)
{
    const double heading = 0.01 * static_cast<double>(k);
    ins_nav_block_t nav = {};
    nav.time_ms = static_cast<uint32_t>(167 * k);
    nav.status = INS_NAV_BLOCK_ALIGNED | INS_NAV_BLOCK_FRACTION | INS_NAV_BLOCK_POSITION | INS_NAV_BLOCK_FILTER;
    nav.sats = 8;
    nav.fix_age = static_cast<uint_least8_t>(k % 10);
    nav.en_cm[0] = 24700000 + static_cast<int32_t>(k);
    nav.en_cm[1] = 274000000 + static_cast<int32_t>(k);
    nav.v_en[0] = nav.v_en[1] = 0.0625;
    nav.q_nb[0] = std::cos(heading / 2);
    nav.q_nb[3] = std::sin(heading / 2);
    return nav;
}

inline Octets nav_block(uint64_t k)
{
    Octets block(INS_NAV_BLOCK_LEN);
    const ins_nav_block_t nav = nav_of(k);
    if (ins_nav_block_put(&nav, block.data()) != INS_OK)
    {
        throw std::runtime_error("no navigation block");
    }
    return block;
}

/// The master side of a pty, raw.
class Pty
{
  public:
    Pty() : fd(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC))
    {
        char name[64];
        if (fd < 0 || grantpt(fd) != 0 || unlockpt(fd) != 0 || ptsname_r(fd, name, sizeof name) != 0)
        {
            throw std::runtime_error("no pty");
        }
        path = name;
        termios t;
        (void)tcgetattr(fd, &t);
        cfmakeraw(&t); // no echo before the daemon has opened it
        (void)tcsetattr(fd, TCSANOW, &t);
    }
    ~Pty() { close(fd); }
    Pty(const Pty&) = delete;
    Pty& operator=(const Pty&) = delete;

    const int fd;
    std::string path;
};

/// Sends blocks first, first + 1, ... until `last` or stopped. The descriptor stays the caller's.
class Board
{
  public:
    /// \param[in] block_  what block k holds
    Board(int fd_, uint64_t first, uint64_t count, std::function<Octets(uint64_t)> block_ = code_block)
        : fd(fd_), next(first), last(first + count), block_of(std::move(block_)), thread([this] { run(); })
    {
    }
    ~Board() { stop(); }
    Board(const Board&) = delete;
    Board& operator=(const Board&) = delete;

    void stop()
    {
        stopping = true;
        if (thread.joinable())
        {
            thread.join();
        }
    }
    /// Number of the next sample. Samples before it were acknowledged.
    uint64_t sent() const { return next; }
    bool wait_sent(uint64_t number, double limit_s) const
    {
        for (const double end = seconds_now() + limit_s; next < number && seconds_now() < end;)
        {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return next >= number;
    }

  private:
    void run()
    {
        ins_hs_config_t cfg = {};
        cfg.block_len = static_cast<uint_least8_t>(block_of(0).size());
        cfg.seq = 1;
        cfg.retries = 200;
        cfg.octet_timeout = 20;
        cfg.reply_timeout = 50;
        ins_hs_board_t board;
        if (ins_hs_board_init(&board, &cfg) != INS_OK)
        {
            return;
        }
        uint16_t acknowledged = 0;
        bool offered = false;
        while (!stopping && next < last)
        {
            const auto now = static_cast<uint16_t>(static_cast<uint64_t>(seconds_now() * 1000) & 0xFFFF);
            if (!offered)
            {
                const Octets block = block_of(next);
                offered = ins_hs_board_offer(&board, block.data(), static_cast<uint8_t>(next & 0xFF), now) == INS_OK;
            }
            for (int16_t o = ins_hs_board_tx(&board, now); o >= 0; o = ins_hs_board_tx(&board, now))
            {
                const auto octet = static_cast<uint8_t>(o);
                (void)!write(fd, &octet, 1); // what is lost is sent again
            }
            pollfd p = {fd, POLLIN, 0};
            uint8_t octet;
            if (poll(&p, 1, 5) == 1 && (p.revents & POLLIN) != 0 && read(fd, &octet, 1) == 1)
            {
                ins_hs_board_rx(&board, octet, now);
            }
            else if (p.revents != 0) // nobody has the other end open
            {
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
            }
            ins_hs_board_tick(&board, now);
            if (board.sent != acknowledged)
            {
                acknowledged = board.sent;
                offered = false;
                next++;
            }
            offered = offered && ins_hs_board_busy(&board);
        }
    }

    const int fd;
    std::atomic<uint64_t> next;
    const uint64_t last;
    const std::function<Octets(uint64_t)> block_of;
    std::atomic<bool> stopping{false};
    std::thread thread;
};
#endif // TESTS_NAVD_BOARD_HPP
