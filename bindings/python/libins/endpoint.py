"""The outer end of a board's UART: a pty, a loopback TCP port, or a file that takes what the board sends."""

import contextlib
import os
import select
import socket
import tty
from collections.abc import Sequence
from pathlib import Path
from typing import Protocol

from libins.errors import UsageError


class Endpoint(Protocol):
    """Octets in and out, never blocking."""

    label: str

    def connected(self) -> bool:
        """Whether somebody is there."""
        ...

    def read(self) -> bytes:
        """What the outside has sent since the last call."""
        ...

    def write(self, octets: bytes) -> None:
        """Octets the board sent. What nobody takes is lost, as on a cable."""
        ...

    def close(self) -> None:
        """Let go of the device."""
        ...


class Pty:
    """A pseudo-terminal; the board holds the master, anybody opens the slave by its path, and may come and go."""

    def __init__(self, link: str = "") -> None:
        """Open. link: a path at which a symbolic link to the slave is kept."""
        self._master, slave = os.openpty()
        tty.setraw(slave)
        os.set_blocking(self._master, False)
        self.path = os.ttyname(slave)
        os.close(slave)
        self._poll = select.poll()
        self._poll.register(self._master, select.POLLHUP)
        self._link = Path(link) if link else None
        if self._link is not None:
            try:
                if self._link.is_symlink():
                    self._link.unlink()
                self._link.symlink_to(self.path)
            except OSError as error:
                self.close()
                raise UsageError(f"{link}: no link to the pty can be made here: {error.strerror}") from error
        self.label = f"pty {self.path}" + (f" ({link})" if link else "")

    def connected(self) -> bool:
        """See Endpoint."""
        return not self._poll.poll(0)

    def read(self) -> bytes:
        """See Endpoint."""
        try:
            return os.read(self._master, 4096)
        except OSError:  # nothing there, or nobody
            return b""

    def write(self, octets: bytes) -> None:
        """See Endpoint."""
        if self.connected():  # the kernel would keep them for whoever comes
            with contextlib.suppress(OSError):
                os.write(self._master, octets)

    def close(self) -> None:
        """See Endpoint."""
        if self._link is not None and self._link.is_symlink():
            self._link.unlink()
        os.close(self._master)


class Tcp:
    """A listening port on 127.0.0.1; one client at a time, who may come and go."""

    def __init__(self, port: int) -> None:
        """Listen. Port 0 takes a free one."""
        self._server = socket.socket()
        self._server.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            self._server.bind(("127.0.0.1", port))
        except OSError as error:
            self._server.close()
            raise UsageError(
                f"tcp:{port}: cannot listen on 127.0.0.1: {error.strerror}; choose another port"
            ) from error
        self._server.listen(1)
        self._server.setblocking(False)
        self._client: socket.socket | None = None
        self.port = int(self._server.getsockname()[1])
        self.label = f"tcp 127.0.0.1:{self.port}"

    def connected(self) -> bool:
        """See Endpoint."""
        if self._client is None and select.select([self._server], [], [], 0)[0]:
            self._client, _ = self._server.accept()
            self._client.setblocking(False)
            self._client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return self._client is not None

    def read(self) -> bytes:
        """See Endpoint."""
        if not self.connected() or self._client is None:
            return b""
        try:
            octets = self._client.recv(4096)
        except BlockingIOError:
            return b""
        except OSError:
            octets = b""
        if not octets:
            self._client.close()
            self._client = None
        return octets

    def write(self, octets: bytes) -> None:
        """See Endpoint."""
        if self._client is not None:
            with contextlib.suppress(OSError):
                self._client.send(octets)

    def close(self) -> None:
        """See Endpoint."""
        if self._client is not None:
            self._client.close()
        self._server.close()


class File:
    """Takes what the board sends; nobody answers."""

    def __init__(self, path: str) -> None:
        """Open for writing, replacing what was there."""
        try:
            self._file = Path(path).open("wb", buffering=0)  # noqa: SIM115
        except OSError as error:
            raise UsageError(f"{path}: cannot be written: {error.strerror}") from error
        self.label = f"file {path}"

    def connected(self) -> bool:
        """See Endpoint."""
        return True

    def read(self) -> bytes:
        """See Endpoint."""
        return b""

    def write(self, octets: bytes) -> None:
        """See Endpoint."""
        self._file.write(octets)

    def close(self) -> None:
        """See Endpoint."""
        self._file.close()


def open_endpoint(option: str, names: Sequence[str]) -> tuple[str, Endpoint]:
    """From `NAME=pty[:LINK]`, `NAME=tcp:PORT` or `NAME=file:PATH`; names: those that there are. Raises UsageError."""
    name, _, rest = option.partition("=")
    if name not in names:
        known = f"its only one is {names[0]!r}" if len(names) == 1 else f"there are {', '.join(map(repr, names))}"
        raise UsageError(
            f"--serial {option}: this board has no serial line {name!r}; {known if names else 'it has none'}"
        )
    return name, opened(f"--serial {option}", rest)


def opened(option: str, rest: str) -> Endpoint:
    """From `pty[:LINK]`, `tcp:PORT` or `file:PATH`; option: how it was given. Raises UsageError."""
    kind, _, argument = rest.partition(":")
    if kind == "pty":
        return Pty(argument)
    if kind == "tcp" and argument.isdigit() and int(argument) < 65536:
        return Tcp(int(argument))
    if kind == "file" and argument:
        return File(argument)
    raise UsageError(f"{option}: found {rest!r}, but pty, pty:LINK, tcp:PORT or file:PATH is needed")
