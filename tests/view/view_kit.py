"""`ins view` in a process of its own, and a client of its WebSocket."""

import asyncio
import json
import os
import signal
import sys
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from typing import Any

import aiohttp

WALL_LIMIT_S = 120.0

Json = dict[str, Any]


class Client:
    """One page."""

    def __init__(self, socket: aiohttp.ClientWebSocketResponse) -> None:
        self._socket = socket
        self._number = 0
        self.hello: Json = {}
        self.frame: Json = {}
        self.frames = 0
        self.edges: list[list[int]] = []
        """As a page keeps them."""

    async def take(self) -> Json:
        """The next message; frames are noted."""
        message = await asyncio.wait_for(self._socket.receive(), WALL_LIMIT_S)
        assert message.type is aiohttp.WSMsgType.TEXT, message
        data: Json = json.loads(message.data)
        if "frame" in data:
            self.frame = data["frame"]
            self.frames += 1
            if "rewound" in self.frame:
                self.edges = [edge for edge in self.edges if edge[0] <= self.frame["rewound"]]
            self.edges += self.frame.get("edges", [])
        elif "hello" in data:
            self.hello = data["hello"]
        return data

    async def ask(self, name: str, /, **arguments: Any) -> Json:
        """The answer, or {"error": ...}."""
        self._number += 1
        await self._socket.send_str(json.dumps({"do": name, **arguments, "id": self._number}))
        while True:
            answer = await self.take()
            if answer.get("id") == self._number:
                return answer

    async def done(self, name: str, /, **arguments: Any) -> Json:
        """The answer of what must not fail, and the frame after it."""
        answer = await self.ask(name, **arguments)
        assert "error" not in answer, answer
        seen = self.frames
        while self.frames == seen:
            await self.take()
        return answer

    async def until(self, true: Callable[[Json], bool]) -> Json:
        """The first frame of which that is so."""
        while not true(self.frame):
            await self.take()
        return self.frame

    async def run_to(self, t_s: float) -> Json:
        """Let it run there, and stand."""
        await self.done("to", t_ps=round(t_s * 1e12))
        return self.frame


class Server:
    """The process."""

    def __init__(self, process: asyncio.subprocess.Process, address: str, http: aiohttp.ClientSession) -> None:
        self.process, self.http = process, http
        self.base, _, self.token = address.partition("?token=")
        self.host = self.base.removeprefix("http://").rstrip("/")

    @property
    def bearer(self) -> dict[str, str]:
        return {"Authorization": f"Bearer {self.token}"}

    async def status(self, path: str = "", **headers: str) -> int:
        async with self.http.get(self.base + path, headers=headers, allow_redirects=False) as answer:
            return answer.status

    @asynccontextmanager
    async def page(self, **headers: str) -> AsyncIterator[Client]:
        """A client that has the hello and its first frame."""
        async with self.http.ws_connect(self.base + "ws", headers={**self.bearer, **headers}, max_msg_size=0) as socket:
            client = Client(socket)
            await client.until(lambda frame: bool(frame))
            yield client

    async def end(self, number: int = signal.SIGINT) -> tuple[int, str]:
        """Exit code and standard error."""
        self.process.send_signal(number)
        _, error = await asyncio.wait_for(self.process.communicate(), WALL_LIMIT_S)
        assert self.process.returncode is not None
        return self.process.returncode, error.decode()


@asynccontextmanager
async def viewing(*arguments: str) -> AsyncIterator[Server]:
    """`ins view ARGUMENTS` until the end of the with statement."""
    command = (sys.executable, "-m", "libins", "view", "--no-browser", *arguments)
    pipe = asyncio.subprocess.PIPE
    process = await asyncio.create_subprocess_exec(*command, stdout=pipe, stderr=pipe, env=dict(os.environ))
    try:
        assert process.stdout is not None and process.stderr is not None
        address = (await asyncio.wait_for(process.stdout.readline(), WALL_LIMIT_S)).decode().strip()
        if not address:
            raise AssertionError((await process.stderr.read()).decode())
        async with aiohttp.ClientSession(cookie_jar=aiohttp.DummyCookieJar()) as http:
            yield Server(process, address, http)
    finally:
        if process.returncode is None:
            process.kill()
            await process.wait()


def played(scene: Callable[[Server], Awaitable[None]], *arguments: str) -> None:
    """A scene against a server of its own."""

    async def play() -> None:
        async with viewing(*arguments) as server:
            await scene(server)

    asyncio.run(play())
