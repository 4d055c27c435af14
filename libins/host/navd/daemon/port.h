/// \file   port.h
/// \brief  The line to the board: a serial device or pty (termios, 8N1, raw), or a TCP connection.
/// SPDX-License-Identifier: MIT
#ifndef NAVD_PORT_H_INCLUDED
#define NAVD_PORT_H_INCLUDED
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

#define PORT_ABSENT (-1) ///< not there now, may come
#define PORT_BAD    (-2) ///< there is something wrong with it

/// 1 if this system has the rate.
int port_baud_known(long baud);
/// \param[in] device a path, or tcp:HOST:PORT (then baud is not used). \return a non-blocking descriptor; PORT_ABSENT or PORT_BAD with the
/// reason in error.
int port_open(const char* device, long baud, char* error, size_t size);

/// As read(). On a TCP connection it also acknowledges at once: a sender that waits for that between its octets (Nagle) would leave
/// gaps of 40 ms in a block.
ssize_t port_read(int fd, uint8_t* octets, size_t size);

#endif // NAVD_PORT_H_INCLUDED
