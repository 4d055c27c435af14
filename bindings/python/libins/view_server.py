"""The page's files and one WebSocket, on 127.0.0.1 alone, for who has the token.

The token comes once in the address, and from then on in a cookie that no other site's page can send. Requests for
another host (DNS rebinding) and from another origin are refused.
"""

import asyncio
import contextlib
import hmac
import json
import secrets
import signal
import socket
from collections.abc import Awaitable, Callable
from typing import Any

from aiohttp import WSCloseCode, WSMsgType, web

from libins.errors import UsageError
from libins.tables import PACKAGE
from libins.view_session import Engine, Json, Session

ADDRESS = "127.0.0.1"
NAMES = (ADDRESS, "localhost")
PAGE = PACKAGE / "view"
HEARTBEAT_S = 20.0
MESSAGE_MAX = 1 << 18
INCREMENTS = {"edges": 20_000, "analog": 5_000}
"""Of a frame, what adds up while a page is slow, and how much of it waits at most."""
Handler = Callable[[web.Request], Awaitable[web.StreamResponse]]


def merged(old: Json, new: Json) -> Json:
    """Two frames as one, for a page that did not take the first in time."""
    both = dict(new)
    rewound = new.get("rewound")
    for name, most in INCREMENTS.items():
        if name not in new:
            continue
        kept = [row for row in old.get(name, ()) if rewound is None or row[0] <= rewound]
        both[name] = kept + new[name]
        if len(both[name]) > most:
            if name == "edges":
                both["dropped"] = both.get("dropped", 0) + len(both[name]) - most
            both[name] = both[name][-most:]
    both["dropped"] = both.get("dropped", 0) + old.get("dropped", 0)
    if "rewound" in old:
        both["rewound"] = old["rewound"] if rewound is None else min(rewound, old["rewound"])
    for line, now in new.get("uart", {}).items():
        before = old.get("uart", {}).get(line)
        if before is not None:
            both["uart"] = {**both["uart"], line: {**now, **_joined(before, now, "tx"), **_joined(before, now, "rx")}}
    return both


def _joined(old: Json, new: Json, way: str) -> Json:
    """The octets of two frames; `from` is the number of the first."""
    begin, end = old[f"{way}_from"], new[f"{way}_from"]
    before = old[way][: 2 * max(0, end - begin)]
    return {way: before + new[way], f"{way}_from": min(begin, end)}


class Client:
    """One page: answers in order, and the newest frame."""

    def __init__(self, socket: web.WebSocketResponse) -> None:
        """Of a socket that is open."""
        self._socket = socket
        self._answers: list[str] = []
        self._frame: Json | None = None
        self._text: str | None = None
        self._wake = asyncio.Event()

    def answer(self, message: Json) -> None:
        """To be sent before the next frame."""
        self._answers.append(json.dumps(message))
        self._wake.set()

    def push(self, frame: Json, text: str) -> None:
        """text: of the message with the frame."""
        if self._frame is None:
            self._frame, self._text = frame, text
        else:
            self._frame, self._text = merged(self._frame, frame), None
        self._wake.set()

    async def write(self) -> None:
        """Send what there is, as fast as the page takes it."""
        while True:
            await self._wake.wait()
            self._wake.clear()
            answers, frame, text = self._answers, self._frame, self._text
            self._answers, self._frame, self._text = [], None, None
            for each in answers:
                await self._socket.send_str(each)
            if frame is not None:
                await self._socket.send_str(text or json.dumps({"frame": frame}))


class Server:
    """Serves one engine to any number of pages; all see the same."""

    def __init__(self, engine: Engine, port: int, speed: float | None) -> None:
        """Listens at once; port 0 takes a free one. Raises UsageError."""
        self._listener = socket.socket()
        self._listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            self._listener.bind((ADDRESS, port))
        except (OSError, OverflowError) as error:
            self._listener.close()
            raise UsageError(f"--port {port}: cannot listen on {ADDRESS}: {error}; choose another, or 0") from error
        self.port = int(self._listener.getsockname()[1])
        self.token = secrets.token_urlsafe(24)
        self._cookie = f"ins_view_{self.port}"
        self._hosts = tuple(f"{name}:{self.port}" for name in NAMES)
        self._clients: set[Client] = set()
        self._loop = asyncio.new_event_loop()
        self._session = Session(engine, speed, self._publish)
        self._ended = asyncio.Event()

    @property
    def url(self) -> str:
        """Where the page is, with the token."""
        return f"http://{ADDRESS}:{self.port}/?token={self.token}"

    def serve(self, started: Callable[[], object]) -> None:
        """Until SIGINT or SIGTERM."""
        self._session.start()
        try:
            self._loop.run_until_complete(self._serve(started))
        finally:
            self._session.close()
            self._loop.close()

    async def _serve(self, started: Callable[[], object]) -> None:
        for number in (signal.SIGINT, signal.SIGTERM):
            self._loop.add_signal_handler(number, self._ended.set)
        app = web.Application(middlewares=[self._guard])
        app.router.add_get("/", self._index)
        app.router.add_get("/ws", self._socket)
        app.router.add_static("/", PAGE)
        runner = web.AppRunner(app, handler_cancellation=True, shutdown_timeout=1.0)
        await runner.setup()
        await web.SockSite(runner, self._listener).start()
        started()
        await self._ended.wait()
        await runner.cleanup()

    # Who may

    @web.middleware
    async def _guard(self, request: web.Request, handler: Handler) -> web.StreamResponse:
        response = self._refusal(request) or await handler(request)
        if not response.prepared:
            response.headers.update(self._headers())
        return response

    def _refusal(self, request: web.Request) -> web.Response | None:
        if request.headers.get("Host") not in self._hosts:
            return web.Response(status=403, text=f"This host is {self._hosts[0]}.\n")
        origin = request.headers.get("Origin")
        if origin is not None and origin not in [f"http://{host}" for host in self._hosts]:
            return web.Response(status=403, text="Another site's page may not look at this one.\n")
        bearer = request.headers.get("Authorization", "").removeprefix("Bearer ")
        given = (request.cookies.get(self._cookie, ""), bearer, self._in_address(request))
        if not any(hmac.compare_digest(each.encode(), self.token.encode()) for each in given):
            return web.Response(status=403, text="Open the address that ins view printed: it has the token.\n")
        return None

    def _in_address(self, request: web.Request) -> str:
        return request.query.get("token", "") if request.path == "/" else ""

    def _headers(self) -> dict[str, str]:
        sockets = " ".join(f"ws://{host}" for host in self._hosts)
        return {
            "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: "
            f"blob:; connect-src 'self' {sockets}; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
            "X-Content-Type-Options": "nosniff",
            "Referrer-Policy": "no-referrer",
            "Cross-Origin-Opener-Policy": "same-origin",
            "Cross-Origin-Resource-Policy": "same-origin",
            "Cache-Control": "no-store",
        }

    # What there is

    async def _index(self, request: web.Request) -> web.StreamResponse:
        if not self._in_address(request):
            return web.FileResponse(PAGE / "index.html")
        response = web.Response(status=303, headers={"Location": "/"})  # and the token is in no history
        response.set_cookie(self._cookie, self.token, httponly=True, samesite="Strict", path="/")
        return response

    async def _socket(self, request: web.Request) -> web.StreamResponse:
        page = web.WebSocketResponse(heartbeat=HEARTBEAT_S, max_msg_size=MESSAGE_MAX)
        page.headers.update(self._headers())
        await page.prepare(request)
        client = Client(page)
        writer = asyncio.create_task(client.write())
        self._ask({"do": "attach"}, lambda answer: self._attached(client, answer))
        closing = asyncio.create_task(self._ended.wait())
        try:
            while not self._ended.is_set():
                reading = asyncio.ensure_future(page.receive())
                await asyncio.wait({reading, writer, closing}, return_when=asyncio.FIRST_COMPLETED)
                if not reading.done():
                    reading.cancel()
                    break
                message = reading.result()
                if message.type != WSMsgType.TEXT:
                    break
                self._asked(client, message.data)
        finally:
            self._clients.discard(client)
            for task in (writer, closing):
                task.cancel()
                with contextlib.suppress(asyncio.CancelledError, ConnectionError):
                    await task
            await page.close(code=WSCloseCode.GOING_AWAY, message=b"ins view has ended")
        return page

    def _attached(self, client: Client, answer: Json) -> None:
        client.answer({"hello": answer["hello"]} if "hello" in answer else answer)
        if "frame" in answer:
            client.answer({"frame": answer["frame"]})
            self._clients.add(client)

    def _asked(self, client: Client, text: str) -> None:
        """Carry a page's message out, or say what is wrong with it."""
        try:
            message: Any = json.loads(text)
        except (ValueError, RecursionError) as error:
            client.answer({"id": None, "error": f"no JSON: {error}"})
            return
        if not isinstance(message, dict):
            client.answer({"id": None, "error": f"found {message!r:.80}, but an object is needed"})
            return
        number = message.get("id")
        self._ask(message, lambda answer: client.answer({"id": number, **answer}))

    def _ask(self, message: Json, reply: Callable[[Json], None]) -> None:
        """The session answers on its own thread; the reply runs on this one, in the order of the frames."""
        self._session.submit(message, lambda answer: self._call(lambda: reply(answer)))

    def _publish(self, frame: Json) -> None:
        self._call(lambda: self._push(frame))

    def _push(self, frame: Json) -> None:
        if self._clients:
            text = json.dumps({"frame": frame})
            for client in self._clients:
                client.push(frame, text)

    def _call(self, what: Callable[[], None]) -> None:
        with contextlib.suppress(RuntimeError):  # the loop is closed: the page has gone
            self._loop.call_soon_threadsafe(what)
