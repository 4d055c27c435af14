/// \file   shim/pipe.h
/// \brief  The program's side of emu_f2812/wirelink.h: a board program that a run drives over a socket.
///
/// The run says when virtual time may go on, how far, and what comes in on wires; the program answers with what went out. It ends when the
/// other end of the socket is closed, whatever the firmware does.
/// SPDX-License-Identifier: MIT
#ifndef F2812_PIPE_H_INCLUDED
#define F2812_PIPE_H_INCLUDED
#include "shim.h"

/// Be driven over fd, a SOCK_SEQPACKET socket. \return exit status of the program: 0 when its other end was closed, 1 when what came was no message
/// or could not be answered (said on stderr).
int f2812_pipe_main(int fd, const f2812_program_t* program);

#endif // F2812_PIPE_H_INCLUDED
