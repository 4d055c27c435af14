"""Debug Adapter Protocol over the debugger: the requests of one session, one method each.

Specification: Microsoft, Debug Adapter Protocol 1.68. Source-level debugging from SDCC's .cdb, stepping back, data and
instruction breakpoints, memory, disassembly. Attributes of launch: program (a scenario, an image or a snapshot),
firmware, set (a table of scenario keys), sourceDirs, navigator, stopOnEntry, cwd.
"""

from collections.abc import Callable
from pathlib import Path

from libins import dap_data, debug_views
from libins.breakpoints import Breakpoint, Stop
from libins.dap_data import THREAD, Data, Json, rows, text, whole
from libins.debugger import Debugger, open_scenario
from libins.errors import UsageError

CAPABILITIES = {
    name: True
    for name in (
        "supportsConfigurationDoneRequest",
        "supportsFunctionBreakpoints",
        "supportsConditionalBreakpoints",
        "supportsHitConditionalBreakpoints",
        "supportsStepBack",
        "supportsSetVariable",
        "supportsDataBreakpoints",
        "supportsInstructionBreakpoints",
        "supportsDisassembleRequest",
        "supportsReadMemoryRequest",
        "supportsWriteMemoryRequest",
        "supportsSteppingGranularity",
        "supportsEvaluateForHovers",
        "supportsTerminateRequest",
        "supportsGotoTargetsRequest",
    )
}
ACCESS = {"read": "read", "write": "write", "readWrite": "access"}
WHILE_RUNNING = {
    *("threads", "pause", "disconnect", "terminate", "setBreakpoints", "setFunctionBreakpoints"),
    *("setInstructionBreakpoints", "setDataBreakpoints", "setExceptionBreakpoints"),
}
"""Other requests must wait until the board stands."""
BEFORE_LAUNCH = {"initialize", "launch", "attach", "disconnect", "terminate"}
_WORDS = {"breakpoint": "breakpoint", "step": "step", "interrupted": "pause", "halted": "exception"}
_DESCRIPTIONS = {
    "end": "End of the scenario",
    "start": "No more history: as far back as it goes",
    "halted": "A jump to itself with interrupts off: nothing more will happen",
    "asleep": "Asleep: no instruction was executed",
}


class Session:
    """One client. `send` takes messages without their seq."""

    def __init__(self, send: Callable[[Json], None], poll: Callable[[], None]) -> None:
        """`poll` hands in what has arrived while the board runs."""
        self._send, self._poll = send, poll
        self._initialized = False
        self._configured = False
        self._stop_on_entry = False
        self._debugger: Debugger | None = None
        self._data: Data | None = None
        self._groups: dict[str, list[int]] = {}
        """Numbers of the breakpoints that one request sets, replaced as a whole."""
        self._next: Callable[[], None] | None = None
        self._running = False
        self._pause = False
        self.finished = False

    def handle(self, message: Json) -> None:
        """One message from the client; every request is answered."""
        request, command = message.get("seq"), message.get("command")
        answer: Json = {"type": "response", "request_seq": request if isinstance(request, int) else 0}
        answer |= {"command": command if isinstance(command, str) else ""}
        try:
            if message.get("type") != "request" or not isinstance(command, str) or not isinstance(request, int):
                raise UsageError("no request: type 'request', a whole number seq and a string command are needed")
            arguments = message.get("arguments")
            arguments = {} if arguments is None else arguments
            if not isinstance(arguments, dict):
                raise UsageError(f"{command}: arguments must be an object")
            body = self._method(command)(arguments)
        except (UsageError, OSError) as error:
            shown = {"error": {"id": 1, "format": str(error).replace("{", "(").replace("}", ")"), "showUser": True}}
            self._send({**answer, "success": False, "message": str(error), "body": shown})
            return
        self._send({**answer, "success": True, "body": body or {}})
        if not self._running:
            self._go_on()

    def broken(self, what: str) -> None:
        """Something arrived that is no message."""
        self._event("output", {"category": "stderr", "output": f"ins debug --dap: {what}\n"})

    def _go_on(self) -> None:
        """What follows the answer: the event, or the run."""
        while self._next is not None:
            following, self._next = self._next, None
            following()

    def _method(self, command: str) -> Callable[[Json], Json | None]:
        snake = "".join("_" + c.lower() if c.isupper() else c for c in command)
        method: Callable[[Json], Json | None] | None = getattr(self, f"_on_{snake}", None)
        if self._data is not None and method is None:
            method = {
                "stackTrace": self._data.stack_trace,
                "scopes": self._data.scopes,
                "variables": self._data.variables,
                "setVariable": self._data.set_variable,
                "evaluate": self._data.evaluate,
                "disassemble": self._data.disassemble,
                "readMemory": self._data.read_memory,
                "writeMemory": self._data.write_memory,
                "source": self._data.source,
            }.get(command)
        if not self._initialized and command not in ("initialize", "disconnect", "terminate"):
            raise UsageError(f"{command}: initialize must come first")
        if self._debugger is None and command not in BEFORE_LAUNCH:
            raise UsageError(f"{command}: launch must come first")
        if method is None:
            raise UsageError(f"{command}: this adapter does not have it")
        if self._running and command not in WHILE_RUNNING:
            raise UsageError(f"{command}: the board runs; pause first")
        return method

    def _event(self, name: str, body: Json) -> None:
        self._send({"type": "event", "event": name, "body": body})

    @property
    def _d(self) -> Debugger:
        assert self._debugger is not None
        return self._debugger

    # Begin and end

    def _on_initialize(self, arguments: Json) -> Json:
        if self._initialized:
            raise UsageError("initialize: came already")
        if arguments.get("linesStartAt1", True) is not True or arguments.get("columnsStartAt1", True) is not True:
            raise UsageError("initialize: lines and columns are counted from 1 here")
        self._initialized = True
        return dict(CAPABILITIES)

    def _on_launch(self, arguments: Json) -> None:
        if self._debugger is not None:
            raise UsageError("launch: came already")
        folder = Path(text(arguments, "cwd", "."))
        program, firmware = text(arguments, "program"), text(arguments, "firmware", "")
        settings = arguments.get("set", {})
        if not isinstance(settings, dict):
            raise UsageError("launch: set must be an object of scenario keys, as link.baud")
        folders = arguments.get("sourceDirs", [])
        if not isinstance(folders, list) or not all(isinstance(each, str) for each in folders):
            raise UsageError("launch: sourceDirs must be a list of folders")
        beside = folder / program
        image = folder / firmware if firmware else None
        debugger = open_scenario(
            str(beside if beside.exists() else program), image, settings, arguments.get("navigator") is not False
        )
        debugger.wants_to_stop = self._wants_to_stop
        self._data = Data(debugger, debug_views.Sources(debugger, [folder / each for each in folders]))
        self._stop_on_entry = arguments.get("stopOnEntry") is True
        self._debugger = debugger
        self._next = lambda: self._event("initialized", {})

    def _on_attach(self, arguments: Json) -> None:
        raise UsageError("attach: this adapter starts the board itself; use launch")

    def _on_configuration_done(self, arguments: Json) -> None:
        if self._configured:
            raise UsageError("configurationDone: came already")
        self._configured = True
        if self._stop_on_entry:
            self._next = lambda: self._stopped("entry")
        else:
            self._next = lambda: self._run(self._d.resume)

    def leave(self) -> None:
        """The client is gone, or goes."""
        self.finished = self._pause = True

    def _on_disconnect(self, arguments: Json) -> None:
        self.leave()

    def _on_terminate(self, arguments: Json) -> None:
        self._pause = True
        self._next = lambda: self._event("terminated", {})

    # Breakpoints

    def _replace(self, group: str, add: Callable[[Json], Breakpoint], asked: list[Json]) -> Json:
        for number in self._groups.pop(group, []):
            self._d.breakpoints.pop(number, None)
        numbers = self._groups.setdefault(group, [])
        shown: list[Json] = []
        for each in asked:
            try:
                added = add(each)
                hit = text(each, "hitCondition", "")
                added.ignore = max(0, int(self._d.expression(hit).number(self._d.memory)) - 1) if hit.strip() else 0
            except UsageError as error:
                shown.append({"verified": False, "message": str(error)})
                continue
            numbers.append(added.number)
            shown.append({"id": added.number, "verified": True, **self._place(added)})
        if self._running:
            self._d.rearm()
        return {"breakpoints": shown}

    def _place(self, added: Breakpoint) -> Json:
        if not added.addresses:
            return {}
        line = self._d.line(added.addresses[0])
        return {"instructionReference": f"{added.addresses[0]:#06x}"} | ({"line": line.number} if line else {})

    def _on_set_breakpoints(self, arguments: Json) -> Json:
        source = arguments.get("source")
        if not isinstance(source, dict):
            raise UsageError("setBreakpoints: a source is needed")
        file = Path(text(source, "path", source.get("name", ""))).name

        def add(each: Json) -> Breakpoint:
            if self._d.table is None:
                raise UsageError("no .cdb beside the image: only instructions can be stopped at")
            addresses = self._d.line_addresses(file, whole(each, "line"))
            return self._d.add_addresses(f"{file}:{whole(each, 'line')}", addresses, text(each, "condition", ""))

        return self._replace(f"source {file}", add, rows(arguments, "breakpoints"))

    def _on_set_function_breakpoints(self, arguments: Json) -> Json:
        def add(each: Json) -> Breakpoint:
            return self._d.add_code(text(each, "name"), condition=text(each, "condition", ""))

        return self._replace("functions", add, rows(arguments, "breakpoints"))

    def _on_set_instruction_breakpoints(self, arguments: Json) -> Json:
        def add(each: Json) -> Breakpoint:
            space, address = dap_data.reference(text(each, "instructionReference"))
            address += whole(each, "offset", 0)
            if space != "code" or not 0 <= address < dap_data.MEMORY_MAX:
                raise UsageError(f"{address:#x}: no instruction can be there")
            return self._d.add_addresses(f"*{address:#06x}", (address,), text(each, "condition", ""))

        return self._replace("instructions", add, rows(arguments, "breakpoints"))

    def _on_set_exception_breakpoints(self, arguments: Json) -> Json:
        return {}

    def _on_data_breakpoint_info(self, arguments: Json) -> Json:
        assert self._data is not None
        try:
            space, address, length, name = self._data.data_place(arguments)
        except UsageError as error:
            return {"dataId": None, "description": str(error)}
        shown = f"{name}, {length} octets at {space}:{address:#06x}"
        return {"dataId": f"{space}:{address:#06x}:{length}:{name}", "description": shown, "accessTypes": list(ACCESS)}

    def _on_set_data_breakpoints(self, arguments: Json) -> Json:
        def add(each: Json) -> Breakpoint:
            place, _, rest = text(each, "dataId").partition(":")
            address, _, rest = rest.partition(":")
            length, _, name = rest.partition(":")
            kind = ACCESS.get(text(each, "accessType", "write"))
            if kind is None or not length.isdigit() or len(length) > 5:
                raise UsageError(f"{text(each, 'dataId')}: no dataId of dataBreakpointInfo, or an unknown accessType")
            span = (*dap_data.reference(f"{place}:{address}"), int(length))
            return self._d.add_place(kind, name, span, text(each, "condition", ""))

        return self._replace("data", add, rows(arguments, "breakpoints"))

    # Running

    def _on_threads(self, arguments: Json) -> Json:
        return {"threads": [{"id": THREAD, "name": "8051"}]}

    def _on_pause(self, arguments: Json) -> None:
        if not self._running:
            raise UsageError("pause: the board does not run")
        self._pause = True

    def _start(self, go: Callable[[], Stop]) -> Json:
        if not self._configured:
            raise UsageError("configurationDone must come first")
        self._next = lambda: self._run(go)
        return {"allThreadsContinued": True}

    def _on_continue(self, arguments: Json) -> Json:
        if self._d.run.now_ps >= self._d.end_ps:
            self._next = lambda: self._event("terminated", {})
            return {}
        return self._start(self._d.resume)

    def _on_reverse_continue(self, arguments: Json) -> Json:
        return self._start(self._d.reverse_resume)

    def _on_next(self, arguments: Json) -> Json:
        return self._start(self._step(arguments, lambda: self._d.step(over=True), self._d.step_instruction))

    def _on_step_in(self, arguments: Json) -> Json:
        return self._start(self._step(arguments, self._d.step, self._d.step_instruction))

    def _on_step_out(self, arguments: Json) -> Json:
        return self._start(self._d.finish)

    def _on_step_back(self, arguments: Json) -> Json:
        back = self._d.reverse_step_instruction
        return self._start(self._step(arguments, lambda: self._d.reverse_step(over=True), back))

    def _step(self, arguments: Json, line: Callable[[], Stop], instruction: Callable[[], Stop]) -> Callable[[], Stop]:
        return instruction if arguments.get("granularity") == "instruction" else line

    def _on_goto_targets(self, arguments: Json) -> Json:
        source = arguments.get("source")
        file = Path(text(source, "path", source.get("name", ""))).name if isinstance(source, dict) else ""
        line = whole(arguments, "line")
        addresses = self._d.line_addresses(file, line) if self._d.table is not None else ()
        return {"targets": [{"id": a, "label": self._d.where(a), "line": line} for a in addresses]}

    def _on_goto(self, arguments: Json) -> None:
        target = whole(arguments, "targetId") & 0xFFFF
        self._d.do(lambda r: r.set_pc(target))
        self._next = lambda: self._stopped("goto")

    def _wants_to_stop(self) -> bool:
        self._poll()
        return self._pause

    def _run(self, go: Callable[[], Stop]) -> None:
        self._running, self._pause = True, False
        try:
            stop = go()
        except UsageError as error:  # a condition that has no value there
            stop = Stop("interrupted")
            self.broken(str(error))
        finally:
            self._running = False
        if self._next is None and not self.finished:
            kinds = {self._d.breakpoints[n].kind for n in stop.numbers if n in self._d.breakpoints}
            data = kinds & set(ACCESS.values())
            reason = "data breakpoint" if data else _WORDS.get(stop.reason, "pause")
            self._stopped(reason, stop)

    def _stopped(self, reason: str, stop: Stop | None = None) -> None:
        assert self._data is not None
        self._data.moved()
        body: Json = {"reason": reason, "threadId": THREAD, "allThreadsStopped": True}
        if stop is not None:
            body["hitBreakpointIds"] = stop.numbers
            if note := _DESCRIPTIONS.get(stop.reason, "; ".join(stop.notes)):
                body |= {"description": note, "text": note}
        self._event("stopped", body)
