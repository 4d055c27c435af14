# SPDX-License-Identifier: MIT
"""Random programs on our CPU and on uCsim: registers, RAM, instructions and cycles must be equal.

    differential.py RUN_BIN [--instructions N] [--seed S]

N is the CI count, or the longer one with INS_BENCH=1. What is not compared, and why: random_program.py.
Exit 0, 1 on a difference, 2 if it cannot run.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from random_program import Generator, opcodes_of

CI_INSTRUCTIONS, BENCH_INSTRUCTIONS = 2_000_000, 50_000_000
TURNS = 12
SFR = {
    "P0": 0x80,
    "SP": 0x81,
    "DPL": 0x82,
    "DPH": 0x83,
    "TCON": 0x88,
    "TMOD": 0x89,
    "TL0": 0x8A,
    "TL1": 0x8B,
    "TH0": 0x8C,
    "TH1": 0x8D,
    "P1": 0x90,
    "SCON": 0x98,
    "P2": 0xA0,
    "IE": 0xA8,
    "P3": 0xB0,
    "IP": 0xB8,
    "PSW": 0xD0,
    "ACC": 0xE0,
    "B": 0xF0,
}
TIMEOUT_S = 120


def fail(message):
    print(message, file=sys.stderr)
    sys.exit(2)


def state(pc, cycles, instructions, iram, sfr):
    result = {"PC": pc, "cycles": cycles, "instructions": instructions}
    result.update({name: sfr[address - 0x80] for name, address in SFR.items()})
    result.update({f"RAM {address:02X}": value for address, value in enumerate(iram)})
    return result


def run_ours(run_bin, image):
    out = subprocess.run([run_bin, image], capture_output=True, text=True, timeout=TIMEOUT_S, check=True)
    head, iram, sfr = out.stdout.splitlines()
    found = re.fullmatch(r"stop (\d) pc (\w+) cycles (\d+) instructions (\d+) interrupts (\d+)", head)
    if found[1] != "1":
        fail(f"our CPU did not reach the halt loop: {head}\n{out.stderr}")
    octets = [[int(x, 16) for x in line.split()[1:]] for line in (iram, sfr)]
    return state(int(found[2], 16), int(found[3]), int(found[4]), *octets), int(found[5]), out.stderr


def dump(text, first, last):
    rows = {
        int(a, 16): [int(x, 16) for x in octets.split()]
        for a, octets in re.findall(r"^0x([0-9a-f]{2}) ((?:[0-9a-f]{2} ){8})", text, re.M)
    }
    return [rows[a & ~7][a & 7] for a in range(first, last + 1)]


def run_ucsim(s51, ihx, halt):
    commands = f"""set console noninteractive
file "{ihx}"
fill xram 0 0xffff 0xff
break 0x{halt:x}
run
dump /h iram 0 0x7f
dump /h sfr 0x80 0xff
state
quit
"""
    out = subprocess.run([s51, "-t", "51"], input=commands, capture_output=True, text=True, timeout=TIMEOUT_S).stdout
    stop = re.search(r"Stop at 0x([0-9a-f]+): \(104\)", out)
    total = re.search(r"Total time since last reset= .*\((\d+) clks\)", out)
    count = re.search(r"Inst= (\d+)", out)
    if not (stop and total and count):
        fail(f"uCsim gave no state:\n{out[-2000:]}")
    # uCsim counts the instruction it stops on.
    return state(int(stop[1], 16), int(total[1]) // 12, int(count[1]) - 1, dump(out, 0, 0x7F), dump(out, 0x80, 0xFF))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("run_bin")
    count = BENCH_INSTRUCTIONS if os.environ.get("INS_BENCH") == "1" else CI_INSTRUCTIONS
    parser.add_argument("--instructions", type=int, default=count)
    parser.add_argument("--seed", type=int, default=51_000)
    options = parser.parse_args()
    tools = [shutil.which(name) for name in ("s51", "objcopy")]
    if not all(tools):
        fail("differential.py: s51 or objcopy is missing: apt-get install --no-install-recommends sdcc-ucsim binutils")
    s51, objcopy = tools
    instructions = interrupts = programs = 0
    seed = options.seed
    opcodes = set()
    with tempfile.TemporaryDirectory() as folder:
        image, ihx = Path(folder) / "p.bin", Path(folder) / "p.ihx"
        while instructions < options.instructions:
            code, halt, ram_end = Generator(seed, TURNS).program()
            image.write_bytes(code)
            subprocess.run([objcopy, "-I", "binary", "-O", "ihex", image, ihx], check=True)
            ours, taken, stderr = run_ours(options.run_bin, image)
            theirs = run_ucsim(s51, ihx, halt)
            theirs["cycles"] += taken
            for address in range(ram_end, 0x80):
                del ours[f"RAM {address:02X}"]
            different = {k: (v, theirs[k]) for k, v in ours.items() if v != theirs[k]}
            if different:
                kept = Path.cwd() / f"mcs51_differs_{seed}.bin"
                shutil.copy(image, kept)
                print(f"seed {seed}: ours differs from uCsim; image kept in {kept}")
                for name, (a, b) in different.items():
                    print(f"  {name}: ours {a:#x}, uCsim {b:#x}")
                print(stderr, end="")
                return 1
            opcodes |= opcodes_of(code, halt)
            instructions += ours["instructions"]
            interrupts += taken
            programs += 1
            seed += 1
    print(
        f"seeds {options.seed}..{seed - 1}: {programs} programs, {instructions} instructions, {interrupts} interrupts, "
        f"{len(opcodes)} opcodes: equal"
    )
    missing = set(range(256)) - {0xA5} - opcodes
    if missing or not interrupts:
        print(
            f"these programs hold no {' '.join(f'{x:02X}' for x in sorted(missing)) or 'interrupts'}: take more",
            file=sys.stderr,
        )
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
