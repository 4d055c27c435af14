"""`ins debug --dap`: one session over standard input and output, or with one client on a port of the loopback."""

import os
import queue
import socket
import sys
import threading
from collections.abc import Callable
from typing import Any

from libins.dap import Session
from libins.dap_wire import FrameError, Framer, frame
from libins.errors import UsageError

CHUNK = 65536
LOOPBACK = "127.0.0.1"
EXIT_OK, EXIT_BROKEN = 0, 1

Arrived = dict[str, Any] | FrameError | None
"""A message, what is none, or the end."""


class Server:
    """Feeds a session with what a thread reads, in order, also while the board runs."""

    def __init__(self, read: Callable[[], bytes], write: Callable[[bytes], object]) -> None:
        """`read` blocks, and gives nothing at the end."""
        self._read, self._write = read, write
        self._sent = 0
        self._arrived: queue.SimpleQueue[Arrived] = queue.SimpleQueue()
        self._session = Session(self._send, self._poll)
        self._broken = False

    def run(self) -> int:
        """Until the client leaves. Returns the exit code."""
        threading.Thread(target=_listen, args=(self._read, self._arrived), daemon=True).start()
        while not self._session.finished:
            self._take(self._arrived.get())
        return EXIT_BROKEN if self._broken else EXIT_OK

    def _poll(self) -> None:
        while not self._session.finished and not self._arrived.empty():
            self._take(self._arrived.get())

    def _take(self, message: Arrived) -> None:
        if message is None:
            self._session.leave()
        elif isinstance(message, FrameError):
            self._broken |= message.fatal
            self._session.broken(str(message))
        else:
            self._session.handle(message)

    def _send(self, message: dict[str, Any]) -> None:
        self._sent += 1
        try:
            self._write(frame({"seq": self._sent, **message}))
        except OSError:
            self._session.leave()


def _listen(read: Callable[[], bytes], arrived: "queue.SimpleQueue[Arrived]") -> None:
    framer = Framer()
    try:
        while octets := read():
            for message in framer.feed(octets):
                arrived.put(message)
                if isinstance(message, FrameError) and message.fatal:
                    return
    except OSError:
        pass  # the client is gone
    finally:
        arrived.put(None)


def serve(port: int | None) -> int:
    """Serve one client; port None: on standard input and output. Raises UsageError."""
    if port is None:
        output = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
        os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # what anything prints must not come between frames

        def write(octets: bytes) -> None:
            output.write(octets)
            output.flush()

        return Server(lambda: os.read(sys.stdin.fileno(), CHUNK), write).run()
    if not 0 <= port <= 65535:
        raise UsageError(f"--dap-port {port}: 0 to 65535 is possible (0: any that is free)")
    with socket.socket() as listener:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind((LOOPBACK, port))
        except OSError as error:
            raise UsageError(f"--dap-port {port}: {error.strerror}; choose another, or 0") from error
        listener.listen(1)
        print(f"listens on {LOOPBACK}:{listener.getsockname()[1]}", flush=True)
        client, _ = listener.accept()
    with client:
        return Server(lambda: client.recv(CHUNK), client.sendall).run()
