# SPDX-License-Identifier: MIT
"""Instructions, octets of code, state and stack of an attitude step on the targets, and their budgets.

    measure.py [--machines m0,m3] [--loads attitude.q31] [--flags=-O2,-Os] [--write | --check] [--json F]

Instructions are counted by QEMU from the step's entry to its return, soft float included; they are not cycles: no wait
states, no dual issue. On AVR they are simavr's cycles. text is what a program that calls init and step takes of the
core, constants included, soft float not; step, the step function alone. stack is the most that a call stored to, at
start-up and with a large increment too, soft float included; interrupts come on top.

Without --flags each module is built with -O2 or what BEST has. budgets.toml holds what was measured; --check fails if a
figure is more than 2 % above it, --write writes it anew, with the table in docs/targets.md.
"""

import argparse
import json
import math
import re
import sys
import tempfile
import tomllib
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from machines import CORE, MACHINES, NUMBER, ROOT, Machine, MachineError, need, tell

WARM_UP, STEADY = 16, 64  # calls
GROWTH = 1.02
BUDGETS = Path(__file__).with_name("budgets.toml")
PAGE = ROOT / "docs/targets.md"
LOADS = {
    "attitude.hist2.f64": ("ins_attitude_step", "LOAD_ATTITUDE", "f64"),
    "attitude.hist2.f32": ("ins_attitude_step", "LOAD_ATTITUDE", "f32"),
    "attitude.lean.f64": ("ins_hist2_step", "LOAD_LEAN", "f64"),
    "attitude.lean.f32": ("ins_hist2_step", "LOAD_LEAN", "f32"),
    "attitude.q31": ("ins_q31_step", "LOAD_Q31", "f32"),
    "attitude.q31w": ("ins_q31w_step", "LOAD_Q31W", "f32"),
    "kf15.propagate.f32": ("ins_kf15_propagate", "LOAD_KF15", "f32"),
    "kf15.update6.f32": ("load_kf15_update6", "LOAD_KF15_UPDATE6", "f32"),
    "kf15_ud.propagate.f32": ("ins_kf15_ud_propagate", "LOAD_KF15_UD", "f32"),
    "kf15_ud.update6.f32": ("load_kf15_update6", "LOAD_KF15_UD_UPDATE6", "f32"),
}
SOURCES = {"attitude": "attitude|coning|rotvec|quat", "hist2": "hist2", "q31": "q31", "q31w": "q31"}
SOURCES["kf15"] = "kf15|markov|elementary"
FPU_ONLY = ("m4f",)  # where loads of the covariance are measured
MEASURED = ("m0", "m3", "m4f", "m7", "arm926", "arm920t", "rv32imac", "avr")
# Where -O2 is not the build to take: fixed point on M0 has fewer instructions and a third of the code; lean is meant
# for small flash.
BEST = {("m0", "attitude.q31"): "-Os", ("m0", "attitude.q31w"): "-Os"}
BEST |= {(machine, f"attitude.lean.{number}"): "-Os" for machine in MEASURED for number in ("f64", "f32")}
QUANTITIES = {"instructions": "instructions", "text": "octets", "step": "octets", "state": "octets", "stack": "octets"}


@dataclass(frozen=True)
class Figure:
    machine: str
    load: str
    flags: str
    instructions: float  # mean of the calls; on AVR cycles
    most: int
    text: int
    step: int
    state: int
    stack: int | None  # not measured on AVR

    def name(self) -> str:
        return f"{self.load}.{self.machine}"


def plugin(folder: Path) -> Path:
    out = folder / "insncount.so"
    tell(need("gcc", "gcc"), "-O2", "-fPIC", "-shared", ROOT / "tools/insncount.c", "-o", out)
    return out


def symbols(machine: Machine, program: Path) -> dict[str, tuple[int, int]]:
    """Address and size by name; the Thumb bit taken off."""
    found = {}
    for line in tell(machine.tool("nm"), "-S", program).splitlines():
        fields = line.split()
        if len(fields) == 4:
            found[fields[3]] = (int(fields[0], 16) & ~1, int(fields[1], 16))
        elif len(fields) == 3:
            found[fields[2]] = (int(fields[0], 16), 0)
    return found


def core_size(linker_map: str, folder: Path) -> int:
    """Octets of .text and .rodata that the linker took from the core's objects."""
    used = linker_map.split("Linker script and memory map")[1]
    piece = re.compile(r"^ \.(?:text|rodata)\S*\s+0x[0-9a-f]+\s+0x([0-9a-f]+) " + re.escape(f"{folder}/core/"), re.M)
    return sum(int(size, 16) for size in piece.findall(used))


def calls(machine: Machine, program: Path, function: str, folder: Path, counter: Path) -> list[list[int]]:
    """What each call of the function cost: instructions and stack, or cycles."""
    if machine.memory is None:
        lines = re.findall(r"^(\d+)\.*$", machine.start(program)[1], re.M)
        return [[int(line)] for line in lines]
    known = symbols(machine, program)
    low, size = known["main"]
    stack = known["__stack"][0]
    arguments = {
        "entry": known[function][0],
        "caller_low": low,
        "caller_high": low + size,
        "stack_low": stack - machine.memory.stack_size,
        "stack_high": stack,
    }
    out = folder / "calls.txt"
    option = ",".join([str(counter), *(f"{key}={value:#x}" for key, value in arguments.items()), f"out={out}"])
    code, printed = machine.start(program, ("-plugin", option))
    if code != 0:
        raise MachineError(f"{machine.name} {function}: exit code {code}\n{printed}")
    return [[int(word) for word in line.split()] for line in out.read_text().splitlines()]


def measure(machine: Machine, load: str, flags: str, folder: Path, counter: Path) -> Figure:
    function, define, number = LOADS[load]
    options = [flags, *NUMBER[number]]
    (folder / "core").mkdir(parents=True)
    objects = []
    for source in sorted((CORE / "src").glob("*.c")):
        if re.match(SOURCES[function.split("_")[1]], source.name):
            objects.append(folder / "core" / f"{source.stem}.o")
            machine.compile(source, objects[-1], options)
    main = folder / "load.o"
    source = "load_kf15.c" if load.startswith("kf15") else "load.c"
    machine.compile(ROOT / "bench/targets" / source, main, [*options, f"-D{define}"])
    program, linker_map = folder / "load.elf", folder / "load.map"
    machine.connect([main, *objects, Path(f"-Wl,-Map={linker_map}")], program)
    all_calls = calls(machine, program, function, folder, counter)
    steady = all_calls[WARM_UP:][:STEADY]
    assert len(steady) == STEADY, f"{machine.name} {load}: {len(all_calls)} calls"
    known = symbols(machine, program)
    return Figure(
        machine.name,
        load,
        flags,
        round(sum(call[0] for call in steady) / len(steady), 1),
        max(call[0] for call in steady),
        core_size(linker_map.read_text(), folder),
        known[function][1],
        known["state"][1],
        None if machine.memory is None else max(call[1] for call in all_calls[1:]),  # the first may be init's own,
    )


def is_measured(machine: str, load: str) -> bool:
    return LOADS[load][2] in MACHINES[machine].numbers and (machine in FPU_ONLY or not load.startswith("kf15"))


def figures(machines: Iterable[str], loads: Iterable[str], flags: Iterable[str] = ()) -> Iterator[Figure]:
    """Without flags, each module's best."""
    chosen = [(name, load) for name in machines for load in loads if is_measured(name, load)]
    with tempfile.TemporaryDirectory() as scratch, ThreadPoolExecutor(2) as pool:
        folder = Path(scratch)
        counter = plugin(folder)
        waiting = [
            pool.submit(measure, MACHINES[name], load, flag, folder / f"{name}.{load}{flag}", counter)
            for name, load in chosen
            for flag in (flags or [BEST.get((name, load), "-O2")])
        ]
        for future in waiting:
            yield future.result()


def growth(figure: Figure) -> list[str]:
    """What is more than 2 % above its budget."""
    budget: dict[str, object] = tomllib.loads(BUDGETS.read_text(encoding="utf-8"))
    entry = budget.get(figure.name())
    if not isinstance(entry, dict):
        return [f"{figure.name()}: not in {BUDGETS.name}; run {Path(__file__).name} --write"]
    found = []
    for quantity in QUANTITIES:
        value, limit = getattr(figure, quantity), entry.get(quantity)
        if value is not None and not (limit is not None and value <= limit * GROWTH):
            found.append(f"{figure.name()}.{quantity}: {value}, budget {limit} + 2 %")
    return found


def rows(found: Iterable[Figure]) -> list[dict[str, object]]:
    """For bench/run.py; the budget is what was committed and 2 %."""
    budget: dict[str, dict[str, float]] = tomllib.loads(BUDGETS.read_text(encoding="utf-8"))
    out: list[dict[str, object]] = []
    for figure in found:
        for quantity, unit in QUANTITIES.items():
            value = getattr(figure, quantity)
            if value is not None:
                limit = math.floor(10 * GROWTH * budget[figure.name()][quantity]) / 10
                shown = "cycles" if figure.machine == "avr" and quantity == "instructions" else unit
                row = {"name": f"{figure.name()}.{quantity}", "value": value, "unit": shown, "budget": limit}
                out.append({**row, "peer": None, "peer_value": None})
    return out


def budgets_text(found: Iterable[Figure]) -> str:
    tools = "gcc 12.2, avr-gcc 5.4, picolibc 1.8, -ffp-contract=off"
    lines = [f"# What measure.py --write found ({tools}). Growth above 2 % fails."]
    for figure in found:
        lines += ["", f'["{figure.name()}"]', f'flags = "{figure.flags}"']
        values = {quantity: getattr(figure, quantity) for quantity in QUANTITIES}
        lines += [f"{quantity} = {value}" for quantity, value in values.items() if value is not None]
    return "\n".join(lines) + "\n"


def table() -> str:
    """The budgets as docs/targets.md has them."""
    lines = ["| | instructions | text | step | state | stack |", "|---|---|---|---|---|---|"]
    for name, entry in tomllib.loads(BUDGETS.read_text(encoding="utf-8")).items():
        values = (entry.get(quantity) for quantity in QUANTITIES)
        cells = ["-" if value is None else f"{round(value):,}" for value in values]
        unit = " cycles" if name.endswith(".avr") else ""
        lines.append(f"| {name.removeprefix('attitude.')} | {cells[0]}{unit} | {' | '.join(cells[1:])} |")
    return "\n".join(lines) + "\n"


def write(found: Iterable[Figure]) -> None:
    BUDGETS.write_text(budgets_text(found), encoding="utf-8")
    page = PAGE.read_text(encoding="utf-8")
    start = page.index("| | instructions |")
    PAGE.write_text(page[:start] + table() + page[page.index("\n\n", start) + 1 :], encoding="utf-8")


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--machines", default=",".join(MEASURED))
    parser.add_argument("--loads", default=",".join(LOADS))
    parser.add_argument("--flags", default="", help="comma-separated; default: each module's best")
    parser.add_argument("--json", type=Path, help="write rows for bench/run.py")
    todo = parser.add_mutually_exclusive_group()
    todo.add_argument("--write", action="store_true")
    todo.add_argument("--check", action="store_true")
    options = parser.parse_args()
    flags = options.flags.split(",") if options.flags else []
    machines, loads = options.machines.split(","), options.loads.split(",")
    if options.write and (flags or machines != list(MEASURED) or loads != list(LOADS)):
        parser.error("--write takes all machines and loads, with their own flags")
    print("machine   load                flags instructions   most   text   step  state  stack")
    found = []
    for f in figures(machines, loads, flags):
        found.append(f)
        sizes = f"{f.text:>6} {f.step:>6} {f.state:>6} {'-' if f.stack is None else f.stack:>6}"
        print(f"{f.machine:<9} {f.load:<19} {f.flags:<5} {f.instructions:>12} {f.most:>6} {sizes}", flush=True)
    if options.write:
        write(found)
    if options.json is not None:
        options.json.write_text(json.dumps(rows(found), indent=2) + "\n", encoding="utf-8")
    too_much = [line for figure in found for line in growth(figure)] if options.check else []
    print(*too_much, sep="\n", end="" if not too_much else "\n")
    return 1 if too_much else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except MachineError as error:
        sys.exit(str(error))
