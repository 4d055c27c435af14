# SPDX-License-Identifier: MIT
"""The machines that the core is proven on: how to compile for each, and how to run what came out.

Bare metal is picolibc with semihosting: no start-up code or linker script of ours; QEMU exits with what main returns.
"""

import os
import re
import shutil
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CORE = ROOT / "libins/core"
RUN_LIMIT_S = 60
WARNINGS = ("-Wall", "-Wextra", "-Werror", "-Wconversion", "-Wdouble-promotion", "-Wshadow", "-Wpedantic")
# No contraction: the same bits everywhere (docs/design/determinism.md).
FLAGS = ("-std=c11", "-ffp-contract=off", "-ffunction-sections", "-fdata-sections")
NUMBER = {"f64": (), "f32": ("-DINS_REAL_FLOAT",)}
PICOLIBC = ("--specs=picolibc.specs", "--oslib=semihost", "--crt0=hosted")
SEMIHOSTED = ("-nographic", "-monitor", "none", "-serial", "none", "-audiodev", "none,id=none")
SEMIHOSTED += ("-semihosting-config", "enable=on,target=native", "-kernel")


class MachineError(Exception):
    """A tool is missing, a build failed or a run did not end; the text says where and what to do."""


@dataclass(frozen=True)
class Memory:
    flash: int
    flash_size: int
    ram: int
    ram_size: int
    stack_size: int = 0x1000

    def flags(self) -> tuple[str, ...]:
        parts = ("flash", "flash_size", "ram", "ram_size", "stack_size")
        return tuple(f"-Wl,--defsym=__{part}={getattr(self, part):#x}" for part in parts)


@dataclass(frozen=True)
class Machine:
    name: str
    prefix: str  # of gcc and the binutils
    cpu: tuple[str, ...]
    run: tuple[str, ...]  # then the program
    packages: str  # Debian's names
    memory: Memory | None = None
    numbers: tuple[str, ...] = ("f64", "f32")

    def tool(self, name: str) -> str:
        return need(self.prefix + name, self.packages)

    def link(self) -> tuple[str, ...]:
        return (*PICOLIBC, *self.memory.flags()) if self.memory else ("-static",)

    def compile(self, source: Path, out: Path, options: Sequence[str]) -> None:
        picolibc = PICOLIBC[:1] if self.memory else ()
        include = (f"-I{CORE / 'include'}",)
        tell(self.tool("gcc"), *self.cpu, *picolibc, *FLAGS, *options, *include, "-c", source, "-o", out)

    def connect(self, objects: Sequence[Path], out: Path) -> None:
        tell(self.tool("gcc"), *self.cpu, *self.link(), "-Wl,--gc-sections", *objects, "-lm", "-o", out)

    def start(self, program: Path, extra: Sequence[str] = (), limit_s: float = RUN_LIMIT_S) -> tuple[int, str]:
        """(Exit code, what it printed); extra goes to the emulator."""
        if not self.run:
            command = [str(program)]
        else:
            command = [need(self.run[0], self.packages), *extra, *self.run[1:], str(program)]
        try:
            done = subprocess.run(
                command,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                timeout=limit_s,
            )
        except subprocess.TimeoutExpired as error:
            raise MachineError(
                f"{self.name}: no end after {limit_s} s (a trap hangs QEMU); look with -d int: {' '.join(command)}"
            ) from error
        # simavr colours what the UART sends, and ends each line with a full stop.
        return done.returncode, re.sub(r"\x1b\[\d*m", "", done.stdout)


def need(tool: str, packages: str) -> str:
    found = shutil.which(tool)
    if found is None:
        raise MachineError(f"{tool} is missing; run: apt-get install --no-install-recommends {packages}")
    return found


def tell(*command: object) -> str:
    """Run a build tool; its output, or MachineError with it."""
    words = [str(word) for word in command]
    done = subprocess.run(words, capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"})
    if done.returncode != 0:
        raise MachineError(f"{' '.join(words)}\n{done.stdout}{done.stderr}")
    return done.stdout


_ARM = "gcc-arm-none-eabi picolibc-arm-none-eabi qemu-system-arm"
_RISCV = "gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf qemu-system-misc"
_MPS2 = Memory(0, 0x400000, 0x20000000, 0x400000)
_VERSATILE = Memory(0x10000, 0x100000, 0x200000, 0x400000)


def _arm(name: str, cpu: tuple[str, ...], board: tuple[str, ...], memory: Memory) -> Machine:
    return Machine(name, "arm-none-eabi-", cpu, ("qemu-system-arm", "-M", *board, *SEMIHOSTED), _ARM, memory)


_THUMB = ("-mthumb",)
MACHINES = {
    machine.name: machine
    for machine in (
        _arm("m0", ("-mcpu=cortex-m0", *_THUMB), ("microbit",), Memory(0, 0x40000, 0x20000000, 0x4000)),
        _arm("m3", ("-mcpu=cortex-m3", *_THUMB), ("mps2-an385",), _MPS2),
        _arm("m4f", ("-mcpu=cortex-m4", *_THUMB, "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"), ("mps2-an386",), _MPS2),
        _arm("m7", ("-mcpu=cortex-m7", *_THUMB, "-mfloat-abi=hard", "-mfpu=fpv5-d16"), ("mps2-an500",), _MPS2),
        _arm("arm926", ("-mcpu=arm926ej-s", "-marm"), ("versatilepb",), _VERSATILE),
        _arm("arm920t", ("-march=armv4t", "-marm"), ("versatilepb", "-cpu", "ti925t"), _VERSATILE),
        Machine(
            "rv32imac",
            "riscv64-unknown-elf-",
            ("-march=rv32imac", "-mabi=ilp32", "-mcmodel=medany"),
            ("qemu-system-riscv32", "-M", "virt", "-bios", "none", *SEMIHOSTED),
            _RISCV,
            Memory(0x80000000, 0x400000, 0x80400000, 0x200000),
        ),
        Machine(
            "avr",
            "avr-",
            ("-mmcu=atmega1284p", "-DF_CPU=16000000UL"),
            ("simavr", "-m", "atmega1284p", "-f", "16000000"),
            "gcc-avr avr-libc simavr",
            numbers=("f32",),  # its double has 32 bits
        ),
        Machine(
            "armel",
            "arm-linux-gnueabi-",
            ("-march=armv5te", "-mfloat-abi=soft"),
            ("qemu-arm", "-cpu", "arm926"),
            "gcc-arm-linux-gnueabi libc6-dev-armel-cross qemu-user",
        ),
        Machine(
            "s390x",
            "s390x-linux-gnu-",
            ("-fexcess-precision=fast",),  # else gcc computes float in double here (FLT_EVAL_METHOD 1 in strict C11)
            ("qemu-s390x",),
            "gcc-s390x-linux-gnu libc6-dev-s390x-cross qemu-user",
        ),
        Machine("i686", "i686-linux-gnu-", ("-msse2", "-mfpmath=sse"), (), "gcc-i686-linux-gnu libc6-dev-i386-cross"),
        Machine("x86_64", "", (), (), "gcc libc6-dev"),
    )
}
