"""Where the cycles of firmware go, from an Observer and the .cdb: functions, lines, interrupts, stack.

Every machine cycle of the run is in one place: `cycles` of a function, of `elsewhere` (start-up, vectors with the
two cycles of the hardware's call, SDCC's library) or `asleep`. `inclusive` adds what a function calls, and leaves
interrupts out.
"""

from typing import Any

import numpy as np

from libins.cdb import Cdb, Function
from libins.disasm import SFR_NAMES

RESET_SP = 7
CYCLE_OSCILLATIONS = 12
INTERRUPTS = ("external 0", "timer 0", "external 1", "timer 1", "serial", "timer 2")
TEXT_LINES = 20


def function_names(table: Cdb) -> dict[int, str]:
    """By begin; a name that two modules use has its module before it."""
    names = [f.name for f in table.functions]
    return {f.begin: f.name if names.count(f.name) == 1 else f"{f.module}.{f.name}" for f in table.functions}


def interrupt_name(table: Cdb | None, irq: int) -> str:
    """The handler's name, or what raises the interrupt."""
    handlers = [f.name for f in table.functions if f.interrupt == irq] if table else []
    return handlers[0] if handlers else INTERRUPTS[irq]


def functions(table: Cdb, observer: Any) -> dict[str, dict[str, int]]:
    """Calls, exclusive and inclusive cycles of each function that ran; most cycles first."""
    cycles = observer.cycles()
    calls = observer.calls()
    names = function_names(table)
    rows: dict[str, dict[str, int]] = {}
    for f in table.functions:
        count, inclusive = calls.get(f.begin, (0, 0))
        own = int(cycles[f.begin : f.end].sum())
        if own:
            rows[names[f.begin]] = {"calls": count, "cycles": own, "inclusive": inclusive}
    return dict(sorted(rows.items(), key=lambda row: -row[1]["cycles"]))


def lines(table: Cdb, observer: Any) -> list[dict[str, Any]]:
    """Cycles and executions of each C line that ran; most cycles first."""
    cycles, executions = observer.cycles(), observer.executions()
    rows: dict[tuple[str, int], list[int]] = {}
    begins = {line.address for line in table.c_lines}
    for instruction in table.asm_lines:
        line = table.line_at(instruction.address)
        if line is not None and cycles[instruction.address]:
            row = rows.setdefault((line.file, line.number), [0, 0])
            row[0] += int(cycles[instruction.address])
            row[1] += int(executions[instruction.address]) if instruction.address in begins else 0
    ordered = sorted(rows.items(), key=lambda row: (-row[1][0], row[0]))
    return [{"file": f, "line": n, "cycles": c, "executions": e} for (f, n), (c, e) in ordered]


def interrupts(table: Cdb | None, observer: Any) -> dict[str, dict[str, int]]:
    """From vector to the end of RETI: `worst` with what interrupted it, `worst_alone` and `cycles` without."""
    return {interrupt_name(table, irq): values for irq, values in sorted(observer.interrupts().items())}


def stack(table: Cdb | None, observer: Any) -> dict[str, Any]:
    """`begin`: SP of an empty stack; `top`: its highest value, `octets` above it, and the function that went there."""
    begin = RESET_SP if observer.stack_base < 0 else observer.stack_base
    function: Function | None = table.function_at(observer.stack_top_pc) if table else None
    where = function.name if function else f"{observer.stack_top_pc:#06x}"
    return {"begin": begin, "top": observer.stack_top, "octets": observer.stack_top - begin, "in": where}


def sfrs(observer: Any) -> dict[str, dict[str, int]]:
    """Reads and writes of each SFR that instructions name; a read-modify-write is both."""
    return {
        SFR_NAMES.get(address, f"{address:#04x}"): {"reads": reads, "writes": writes}
        for address, (reads, writes) in sorted(observer.sfrs().items())
    }


def sampling(scans: Any, crystal_hz: int) -> dict[str, Any] | None:
    """Sampling instants in machine cycles: periods of the first channel, and delays of the others behind it."""
    if len(scans) < 2:
        return None
    channels = scans.shape[1] // 2
    at = np.rint(scans[:, :channels] * (crystal_hz / CYCLE_OSCILLATIONS)).astype(np.int64)
    periods = np.diff(at[:, 0])
    return {
        "period_cycles": {"min": int(periods.min()), "max": int(periods.max())},
        "jitter_cycles": int(periods.max() - periods.min()),
        "delay_cycles": [{"min": int(d.min()), "max": int(d.max())} for d in (at[:, 1:] - at[:, :1]).T],
    }


def text(observed: dict[str, Any]) -> str:
    """The profile for a terminal."""
    total = observed["cycles"]
    out = [f"{'cycles':>12} {'%':>6} {'inclusive':>12} {'calls':>9}  function"]
    for name, row in observed["functions"].items():
        out.append(
            f"{row['cycles']:>12} {_percent(row['cycles'], total)} {row['inclusive']:>12} {row['calls']:>9}  {name}"
        )
    out.append(f"{observed['elsewhere']:>12} {_percent(observed['elsewhere'], total)} {'':>22}  elsewhere")
    out.append(f"{observed['asleep']:>12} {_percent(observed['asleep'], total)} {'':>22}  asleep")
    out.append(f"{total:>12} {_percent(total, total)} {'':>22}  in all")
    out += ["", f"{'cycles':>12} {'%':>6} {'executions':>12}  line"]
    for row in observed["lines"][:TEXT_LINES]:
        place = f"{row['file']}:{row['line']}"
        out.append(f"{row['cycles']:>12} {_percent(row['cycles'], total)} {row['executions']:>12}  {place}")
    out += ["", f"{'count':>12} {'cycles':>12} {'worst':>9} {'alone':>9}  interrupt"]
    for name, row in observed["interrupts"].items():
        out.append(f"{row['count']:>12} {row['cycles']:>12} {row['worst']:>9} {row['worst_alone']:>9}  {name}")
    s = observed["stack"]
    out += ["", f"stack      {s['octets']} octets, from {s['begin'] + 1:02X}h to {s['top']:02X}h in {s['in']}"]
    if (t := observed["sampling"]) is not None:
        period = t["period_cycles"]
        out.append(f"sampling   every {period['min']} to {period['max']} cycles, jitter {t['jitter_cycles']}")
    out.append(
        "SFRs       " + ", ".join(f"{name} {r['reads']}r {r['writes']}w" for name, r in observed["sfrs"].items())
    )
    return "\n".join(out) + "\n"


def _percent(part: int, total: int) -> str:
    return f"{100 * part / total if total else 0.0:6.2f}"
