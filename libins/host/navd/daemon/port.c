/// \file   port.c
/// \brief  Opens the line to the board.
/// SPDX-License-Identifier: MIT
#include "port.h"
#include <errno.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#define CONNECT_MS 1000

static int speed_of(long baud, speed_t* speed)
{
    static const struct
    {
        long baud;
        speed_t speed;
    } speeds[] = {{1200, B1200},   {2400, B2400},   {4800, B4800},     {9600, B9600},    {19200, B19200},
                  {38400, B38400}, {57600, B57600}, {115200, B115200}, {230400, B230400}};
    for (size_t i = 0; i < sizeof speeds / sizeof speeds[0]; i++)
    {
        if (speeds[i].baud == baud)
        {
            *speed = speeds[i].speed;
            return 1;
        }
    }
    return 0;
}

int port_baud_known(long baud)
{
    speed_t speed;
    return speed_of(baud, &speed);
}

static const char* remedy(int reason)
{
    switch (reason)
    {
    case ENOENT:
    case ENODEV:
    case ENXIO:
        return ": is the board plugged in? `ls /dev/tty*` shows what there is; --wait waits for it";
    case EACCES:
        return ": add yourself to its group (often dialout) and log in again";
    case ENOTTY:
        return ": this is no serial device or pty";
    case EWOULDBLOCK:
        return ": another program has it open";
    default:
        return "";
    }
}

static int absent(int reason)
{
    return reason == ENOENT || reason == ENODEV || reason == ENXIO || reason == EIO || reason == ECONNREFUSED ||
           reason == ETIMEDOUT || reason == EHOSTUNREACH || reason == ENETUNREACH;
}

static int fail(int fd, const char* device, int reason, char* error, size_t size)
{
    if (fd >= 0)
    {
        (void)close(fd);
    }
    (void)snprintf(error, size, "cannot open %s: %s%s", device, strerror(reason), remedy(reason));
    return absent(reason) ? PORT_ABSENT : PORT_BAD;
}

static int open_serial(const char* device, long baud, char* error, size_t size)
{
    const int fd = open(device, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    struct termios t;
    speed_t speed = B9600;
    (void)speed_of(baud, &speed);
    if (fd < 0 || tcgetattr(fd, &t) != 0 || flock(fd, LOCK_EX | LOCK_NB) != 0)
    {
        return fail(fd, device, errno, error, size);
    }
    cfmakeraw(&t); // 8 data bits, no parity, no echo, no translation
    t.c_cflag &= (tcflag_t) ~(CSTOPB | CRTSCTS);
    t.c_cflag |= CLOCAL | CREAD;
    t.c_cc[VMIN] = 0;
    t.c_cc[VTIME] = 0;
    if (cfsetispeed(&t, speed) != 0 || cfsetospeed(&t, speed) != 0 || tcsetattr(fd, TCSANOW, &t) != 0 ||
        tcgetattr(fd, &t) != 0)
    {
        return fail(fd, device, errno, error, size);
    }
    if (cfgetospeed(&t) != speed)
    {
        (void)close(fd);
        (void)snprintf(error, size, "cannot open %s: it has no rate of %ld Bd", device, baud);
        return PORT_BAD;
    }
    return fd;
}

/// Non-blocking connect with a limit. \return 0 or an errno.
static int connect_within(int fd, const struct addrinfo* address)
{
    if (connect(fd, address->ai_addr, address->ai_addrlen) == 0)
    {
        return 0;
    }
    if (errno != EINPROGRESS)
    {
        return errno;
    }
    struct pollfd p = {fd, POLLOUT, 0};
    if (poll(&p, 1, CONNECT_MS) <= 0)
    {
        return ETIMEDOUT;
    }
    int reason = 0;
    socklen_t length = sizeof reason;
    return getsockopt(fd, SOL_SOCKET, SO_ERROR, &reason, &length) == 0 ? reason : errno;
}

static int open_tcp(const char* device, char* error, size_t size)
{
    char host[256];
    const char* const begin = device + strlen("tcp:");
    const char* const colon = strrchr(begin, ':');
    if (colon == NULL || colon == begin || colon[1] == '\0' || (size_t)(colon - begin) >= sizeof host)
    {
        (void)snprintf(error, size, "cannot open %s: write tcp:HOST:PORT", device);
        return PORT_BAD;
    }
    memcpy(host, begin, (size_t)(colon - begin));
    host[colon - begin] = '\0';
    const struct addrinfo hints = {.ai_family = AF_UNSPEC, .ai_socktype = SOCK_STREAM};
    struct addrinfo* found = NULL;
    const int unknown = getaddrinfo(host, colon + 1, &hints, &found);
    if (unknown != 0)
    {
        (void)snprintf(error, size, "cannot open %s: %s", device, gai_strerror(unknown));
        return PORT_BAD;
    }
    int reason = 0;
    int fd = -1;
    for (const struct addrinfo* a = found; a != NULL && fd < 0; a = a->ai_next)
    {
        fd = socket(a->ai_family, a->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, a->ai_protocol);
        reason = fd < 0 ? errno : connect_within(fd, a);
        if (fd >= 0 && reason != 0)
        {
            (void)close(fd);
            fd = -1;
        }
    }
    freeaddrinfo(found);
    if (fd < 0)
    {
        (void)snprintf(error, size, "cannot open %s: %s; is the other end running? --wait waits for it", device,
                       strerror(reason));
        return absent(reason) ? PORT_ABSENT : PORT_BAD;
    }
    const int one = 1;
    (void)setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one); // an octet of reply must not wait for more
    return fd;
}

int port_open(const char* device, long baud, char* error, size_t size)
{
    return strncmp(device, "tcp:", 4) == 0 ? open_tcp(device, error, size) : open_serial(device, baud, error, size);
}

ssize_t port_read(int fd, uint8_t* octets, size_t size)
{
    const ssize_t n = read(fd, octets, size);
    const int reason = errno;
    const int one = 1;
    (void)setsockopt(fd, IPPROTO_TCP, TCP_QUICKACK, &one,
                     sizeof one); // must be said again after each read; fails on a device
    errno = reason;
    return n;
}
