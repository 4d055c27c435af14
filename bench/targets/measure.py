# SPDX-License-Identifier: MIT
"""Instructions, octets of code, state and stack of an attitude step on the targets.

    measure.py [--machines m0,m3] [--loads attitude.f32,q31] [--flags=-O2,-Os] [--json F]

Instructions are counted by QEMU from the step's entry to its return, soft float included; they are not cycles: no wait
states, no dual issue. .text is what a program that calls init and step takes of the core, constants included, soft
float not; step, the step function alone. Stack is what the call stored to, soft float included.
"""

import argparse
import json
import re
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path

from machines import CORE, MACHINES, NUMBER, ROOT, Machine, MachineError, need, tell

WARM_UP = 16  # calls
LOADS = {
    "attitude.f64": ("ins_attitude_step", "LOAD_ATTITUDE", "f64"),
    "attitude.f32": ("ins_attitude_step", "LOAD_ATTITUDE", "f32"),
    "q31": ("ins_q31_step", "LOAD_Q31", "f32"),
    "q31w": ("ins_q31w_step", "LOAD_Q31W", "f32"),
}


@dataclass(frozen=True)
class Figure:
    machine: str
    load: str
    flags: str
    instructions: float
    most: int
    text: int
    step: int
    state: int
    stack: int


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


def measure(machine: Machine, load: str, flags: str, folder: Path, counter: Path) -> Figure:
    function, define, number = LOADS[load]
    options = [flags, *NUMBER[number]]
    (folder / "core").mkdir(parents=True)
    objects = []
    for source in sorted((CORE / "src").glob("*.c")):
        if re.match("q31" if load.startswith("q31") else "attitude|coning|rotvec|quat", source.name):
            objects.append(folder / "core" / f"{source.stem}.o")
            machine.compile(source, objects[-1], options)
    main = folder / "load.o"
    machine.compile(ROOT / "bench/targets/load.c", main, [*options, f"-D{define}"])
    program, linker_map = folder / "load.elf", folder / "load.map"
    machine.connect([main, *objects, Path(f"-Wl,-Map={linker_map}")], program)
    known = symbols(machine, program)
    low, size = known["main"]
    stack = known["__stack"][0]
    assert machine.memory is not None
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
        raise MachineError(f"{machine.name} {load} {flags}: exit code {code}\n{printed}")
    calls = [[int(word) for word in line.split()] for line in out.read_text().splitlines()][WARM_UP:]
    assert len(calls) > WARM_UP, f"{out}: {len(calls)} calls"
    counts = [call[0] for call in calls]
    return Figure(
        machine.name,
        load,
        flags,
        round(sum(counts) / len(counts), 1),
        max(counts),
        core_size(linker_map.read_text(), folder),
        known[function][1],
        known["state"][1],
        max(call[1] for call in calls),
    )


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--machines", default="m0,m3,m4f,m7,arm926")
    parser.add_argument("--loads", default=",".join(LOADS))
    parser.add_argument("--flags", default="-O2,-Os")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch, ThreadPoolExecutor(2) as pool:
        folder = Path(scratch)
        counter = plugin(folder)
        waiting = [
            pool.submit(measure, MACHINES[name], load, flags, folder / f"{name}.{load}{flags}", counter)
            for name in options.machines.split(",")
            for load in options.loads.split(",")
            for flags in options.flags.split(",")
        ]
        print("machine   load          flags instructions   most  .text   step  state  stack")
        figures = []
        for future in waiting:
            f = future.result()
            figures.append(f)
            sizes = f"{f.text:>6} {f.step:>6} {f.state:>6} {f.stack:>6}"
            print(f"{f.machine:<9} {f.load:<13} {f.flags:<5} {f.instructions:>12} {f.most:>6} {sizes}", flush=True)
    if options.json is not None:
        options.json.write_text(json.dumps([asdict(f) for f in figures], indent=2) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except MachineError as error:
        sys.exit(str(error))
