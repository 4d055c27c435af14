"""Nothing of the core is left out, both modules have one surface, and its types hold under mypy --strict."""

import inspect
import re
import subprocess
import sys
from pathlib import Path

from reference import ROOT, both

from libins import core, coref

HEADERS = ROOT / "libins/core/include/ins"
BINDINGS = ROOT / "bindings/python/src/core"
_SCALE = "ins replay runs it natively (noise.scale_g, noise.scale_a)"
NOT_BOUND = {
    "ins_gps_ins_scale_init": _SCALE,
    "ins_kf15_scale_init": _SCALE,
    "ins_kf15_scale_propagate": _SCALE,
    "ins_kf15_scale_update": _SCALE,
}
"""C function -> why Python does not need it."""


def sources() -> str:
    return "\n".join(p.read_text(encoding="utf-8") for p in sorted(BINDINGS.glob("*.?pp")))


def test_every_function_of_the_core_is_called():
    declared = set()
    for header in HEADERS.glob("*.h"):
        text = re.sub(r"//.*", "", header.read_text(encoding="utf-8"))
        declared |= set(re.findall(r"^INS_API [^;({]*?\b(ins_\w+)\(", text, re.MULTILINE))
    assert len(declared) > 100
    used = set(re.findall(r"\b(ins_\w+)\b", sources()))
    # INS_ABI_CHECK() is the macro over ins_abi_check().
    assert sorted(declared - used - set(NOT_BOUND)) == []
    assert sorted(set(NOT_BOUND) - declared) == []


def test_one_surface():
    def surface(module):
        return {
            (name, member)
            for name, value in inspect.getmembers(module)
            if not name.startswith("__") and name != "real"
            for member in ("", *(dir(value) if inspect.isclass(value) else ()))
        }

    assert surface(core) == surface(coref)


@both
def test_everything_is_documented(ins):
    bare = []
    for name, value in inspect.getmembers(ins):
        if callable(value) and not name.startswith("_"):
            bare += [name] if not (value.__doc__ or "").strip() else []
            for member, attribute in vars(value).items() if inspect.isclass(value) else ():
                if not member.startswith("_") and not (attribute.__doc__ or "").strip():
                    bare.append(f"{name}.{member}")
    assert bare == []


USE = """
import numpy as np
from numpy.typing import NDArray
from libins import {module} as ins

q: NDArray[np.{dtype}] = ins.quat_from_rotvec([[0.1, 0.0, 0.0]])
attitude: ins.Attitude = ins.Attitude(ins.CONING_HIST2_OPT, q[0])
track: NDArray[np.{dtype}] = attitude.step(np.zeros((10, 3), dtype=ins.real))
n: int = attitude.count
replies, blocks = ins.HsHost(block_len=6, retries=1, reply_timeout=40, octet_timeout=10).rx(b"", 0)
octets: bytes = replies + blocks[0][0]
try:
    ins.Linfit(3).solve()
except ins.StateError as error:
    print(error)
"""


def test_types(tmp_path: Path):
    """Right use of both modules passes, each wrong one is an error. One run of mypy: NumPy's stubs take their time."""
    good = {m: USE.format(module=m, dtype=d) for m, d in (("core", "float64"), ("coref", "float32"))}
    programs = {
        "right_core": good["core"],
        "right_coref": good["coref"],
        "wrong_type": good["core"].replace("n: int", "n: str"),
        "wrong_name": good["core"].replace("attitude.step", "attitude.stp"),
        "wrong_argument": good["core"].replace("block_len=6", "block_length=6"),
    }
    for name, text in programs.items():
        (tmp_path / f"{name}.py").write_text(text, encoding="utf-8")
    options = ["--strict", "--config-file", "", "--cache-dir", str(tmp_path / "cache")]
    command = [sys.executable, "-m", "mypy", *options, *(f"{name}.py" for name in programs)]
    package = Path(core.__file__).parents[1]
    done = subprocess.run(command, cwd=tmp_path, env={"MYPYPATH": str(package)}, capture_output=True, text=True)
    found = [line.split(".py:")[0] for line in done.stdout.splitlines() if ": error:" in line]
    assert sorted(set(found)) == ["wrong_argument", "wrong_name", "wrong_type"], done.stdout + done.stderr


@both
def test_the_module_exports_its_entry_alone(ins):
    """The library inside is hidden: neither module can call into the other's, nor into a libins of the process."""
    nm = subprocess.run(["nm", "-D", "--defined-only", ins.__file__], capture_output=True, text=True, check=True).stdout
    c_symbols = [line.split()[-1] for line in nm.splitlines() if not line.split()[-1].startswith("_Z")]
    assert c_symbols == [f"PyInit_{ins.__name__.split('.')[-1]}"]
