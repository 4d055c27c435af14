# SPDX-License-Identifier: MIT
"""The reference vectors as C source for a target: the part of them that a Cortex-M0's and an ATmega1284P's flash holds.

    vectors_table.py OUT.c [--shift N]

They come from tests/data/vectors, or from the directory in INS_VECTOR_DIR. tape.h reads the numbers back in this order.
--shift N makes the Nth number wrong, an integer by 1, another by 1e-4 of its size, to see that the target notices.
"""

import argparse
import json
import math
import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
PIECE = 4096  # TAPE_PIECE
SHIFT = 1e-4
FORMS = {
    "one": 0,
    "hist1": 1,
    "hist2_poly": 2,
    "hist2_opt": 3,
    "hist3_poly": 4,
    "hist3_opt": 5,
    "two": 6,
    "three_poly": 7,
    "three_opt": 8,
    "four_poly": 9,
    "four_opt": 10,
}
BLOCK = {"two": 2, "three_poly": 3, "three_opt": 3, "four_poly": 4, "four_opt": 4}
HISTORY = {"one": 0, "hist1": 1, "hist2_poly": 2, "hist2_opt": 2, "hist3_poly": 3, "hist3_opt": 3}
NO_FAULT, SWAP = 99, 8
# Every so many of a list, or the first so many of a run: about 11,000 numbers.
EVERY = {"coning": 4, "products": 3, "euler": 4, "calib": 2, "ecef": 6, "grid": 5}
FIRST = {"sculling": 10, "sixacc": 8, "pva": 120, "gps": 80, "dr": 100, "unicycle": 100, "gimu": 14}
MOTION = 3  # which of the cases of attitude_motion.json

Json = Any


def load(name: str) -> Json:
    folder = Path(os.environ.get("INS_VECTOR_DIR", ROOT / "tests/data/vectors"))
    return json.loads((folder / f"{name}.json").read_text(encoding="utf-8"))


def flat(value: Json) -> list[float]:
    return [x for part in value for x in flat(part)] if isinstance(value, list) else [value]


def diagonal(matrix: Json) -> list[float]:
    return [row[i] for i, row in enumerate(matrix)]


def long(value: int) -> list[int]:
    """32 bits in two halves: a float holds 24."""
    bits = value & 0xFFFFFFFF
    return [bits >> 16, bits & 0xFFFF]


def section(records: Sequence[Iterable[float]]) -> list[float]:
    return [len(records), *(x for record in records for x in record)]


def phi(case: Json) -> list[list[float]]:
    records = []
    for name, want in case["phi_first"].items():
        if name in FORMS:
            first = [] if name in BLOCK else case["pre"][-HISTORY[name] :] if HISTORY[name] else []
            records.append([FORMS[name], *flat(first), *flat(case["incs"][: BLOCK.get(name, 1)]), *want])
    return records


def increments(case: Json, ends: dict[str, list[float]]) -> list[float]:
    names = [name for name in ends if name in FORMS]
    incs = case["incs"]
    head = [len(names), len(incs), *case["q_true"][0], *flat(case["pre"][-3:])]
    return [*head, *(FORMS[name] for name in names), *flat(incs), *flat([ends[name] for name in names])]


def rates(case: Json, order: int, result: str) -> list[float]:
    lead = -case["rates_first_k"]
    head = [order, case["T"], lead, len(case["rates"]), *case["q_true"][0]]
    return [*head, *flat(case["rates"]), *case["results"][result]["q_final"]]


def attitude() -> list[float]:
    coning = load("coning")["cases"][:: EVERY["coning"]]
    motion = load("attitude_motion")["cases"][MOTION]
    quaternion = load("quaternion")
    tape = section([record for case in coning for record in phi(case)])
    tape += section([increments(case, case["q_final"]) for case in coning])
    results = {name: result["q_final"] for name, result in motion["results"].items() if "q_final" in result}
    tape += section([increments(motion, results)])
    tape += section([rates(motion, 4, "rates_am4+hist2_opt")])
    products = quaternion["products"][:: EVERY["products"]]
    tape += section([flat([c[key] for key in ("a", "b", "ab", "v", "rot", "rv", "q_rv")]) for c in products])
    euler = quaternion["euler"][:: EVERY["euler"]]
    return tape + section([flat([c["roll"], c["pitch"], c["yaw"], c["q"], c["C_bn"], c["q"]]) for c in euler])


def navigation() -> list[float]:
    rows = ("theta", "v", "rot", "hist1", "hist2_opt")
    sculling = []
    for case in load("sculling")["cases"]:
        some = case["rows"][: FIRST["sculling"]]
        sculling.append([len(some), *flat(case["pre"][-2:]), *flat([[row[key] for key in rows] for row in some])])
    sixacc = []
    for case in load("sixacc")["cases"]:
        some = case["rows"][: FIRST["sixacc"]]
        numbers = [[row[key] for key in ("f", "w", "wd", "f_centre")] for row in some]
        sixacc.append([case["rho"], len(some), *flat(numbers)])
    calib = load("calib_linear")
    maps = []
    for case in calib["cases"][:: EVERY["calib"]]:
        attitudes = calib["attitudes"][case["group"]]
        record: list[float] = [len(attitudes)]
        for k, up in enumerate(attitudes):
            record += [x * case["g"] for x in up] + [case["P"][j][k] / case["T"] for j in range(3)]
        for j in range(3):
            record += [case["true"]["bias"][j] * case["true"]["SF"][j], *case["true_map"][j]]
        maps.append(record)
    geodesy = load("geodesy")
    llh = [math.radians(1), math.radians(1), 1]
    ecef, grid = [], []
    for p in [*geodesy["points"], *geodesy["ecef_global"]][:: EVERY["ecef"]]:
        ecef.append([p["lat_deg"] * llh[0], p["lon_deg"] * llh[1], p["h"], p["X"], p["Y"], p["Z"]])
    for p in geodesy["points"][:: EVERY["grid"]]:
        zone = 121 if p["epsg"] == 3826 else 119
        grid.append([zone, p["lat_deg"] * llh[0], p["lon_deg"] * llh[1], p["E"], p["N"]])
    return section(sculling) + section(sixacc) + section(maps) + section(ecef) + section(grid)


def filters() -> list[float]:
    file = load("kalman_pva")
    pva = []
    for run in file["runs"]:
        steps = {step["k"]: step for step in run["steps"]}
        r = (diagonal(run["R"]) + [1])[:2]
        count = FIRST["pva"]
        record = [file["T"], file["q"], len(run["H"]), *r, *diagonal(run["P0"]), count]
        for k, z in enumerate(run["z"][:count]):
            step = steps.get(k)
            record += [*flat(z), step is not None, *(flat([step["x"], step["P_diag"]]) if step else [])]
        pva.append(record)
    g = load("gps_dr")
    gps = g["gps"]
    steps = {step["k"]: step for step in gps["steps"]}
    sigma = [math.sqrt(gps["sigma_a2"]), math.sqrt(gps["sigma_eps2"])]
    record = [gps["T"], gps["tau_a"], gps["tau_eps"], *sigma, gps["R"], *diagonal(gps["P0"]), FIRST["gps"]]
    for k, z in enumerate(gps["z"][: FIRST["gps"]]):
        step = steps.get(k)
        record += [*flat(z), step is not None, *(flat([step[key] for key in ("x", "P_diag", "K")]) if step else [])]
    fusion = []
    for case in g["fusion"]:
        pairs = [[x, P] for x, P in zip(case["x"], case["P"], strict=True)]
        fusion.append([len(case["x_fused"]), len(pairs), *flat(pairs), *flat([case["x_fused"], case["P_fused"]])])
    s = g["switch"]
    choice = [s["params"][key] for key in ("hmax", "gate", "smin", "n_back")] + [len(s["epochs"])]
    for epoch, want in zip(s["epochs"], s["expected"], strict=True):
        choice += [epoch["valid"], epoch["sats"], epoch["hdop"], epoch["nis"] or 0, want["mode"] == "GPS", want["good"]]
    return section(pva) + section([record]) + section(fusion) + section([choice])


def vehicle() -> list[float]:
    g = load("gps_dr")
    keys = ("e", "n", "heading", "s", "dheading", "out")
    tape = section([flat([case[key] for key in keys]) for case in g["dead_reckoning"]])
    d = g["dr"]
    steps = {step["k"]: step for step in d["steps"]}
    sigma = [math.sqrt(x) for x in d["sigma2"]]
    record = [d["T"], d["tau_e"], d["tau_n"], *sigma, *diagonal(d["R"]), d["vmin"], d["vzero"]]
    record += [*d["x0"], *diagonal(d["P0"]), FIRST["dr"]]
    for k, z in enumerate(d["z"][: FIRST["dr"]], 1):
        step = steps.get(k)
        record += [*z, step is not None, *(flat([step["x"], step["P_diag"]]) if step else [])]
    u = g["dr_unicycle"]
    steps = {step["k"]: step for step in u["steps"]}
    other = [u[key] for key in ("T", "qv", "qb", "qk", "rw", "rs", "Rgps")]
    other += [*u["x0"], *diagonal(u["P0"]), FIRST["unicycle"]]
    for k, z in enumerate(u["z"][: FIRST["unicycle"]], 1):
        step = steps.get(k)
        other += [*z[:2], z[2] is not None, *(z[2] or []), step is not None]
        other += flat([step["x"], step["P_diag"]]) if step else []
    return tape + section([record]) + section([other])


def transcript(case: Json) -> list[float]:
    lines = case["transcript"]
    record = [*case["xyz"], len(lines) // 2]
    faults = iter(case["faults"])
    for (_, sent), (_, reply) in zip(lines[::2], lines[1::2], strict=True):
        octets = list(bytes.fromhex(sent))
        fault = next(faults, None) if len(octets) > 1 else None
        record += [len(octets)]
        record += [NO_FAULT, 0] if fault is None else [fault[1], SWAP if fault[0] == "swap" else fault[2]]
        record += [*octets, int(reply, 16)]
    accepted = case["accepted"]
    return [*record, accepted is not None, *(accepted or [])]


def stream(case: Json) -> list[float]:
    octets = bytes.fromhex(case["hex"])
    record: list[float] = [case["strict12"], len(case["packets"]), len(octets), *octets]
    for p in case["packets"]:
        record += [p["type"], *p["raw"]]
        if p["type"] == 2:
            lat, lon = sorted((p["f1_deg"], p["f2_deg"]))
            record += [*long(p["lat_raw"]), *long(p["lon_raw"]), p["sats"]]
            record += [*long(round(lat * 1e7)), *long(round(lon * 1e7))]
    return record


def octets() -> list[float]:
    file = load("gimu")
    conversions = []
    for c in file["conversions"]:
        degrees = [c[key] for key in ("dps_KP", "dps_KQ", "dps_KR")]
        conversions.append([c["raw"], c["null"], *(math.radians(x) for x in degrees)])
    tape = section([transcript(case) for case in load("handshake")["cases"]])
    return tape + section([stream(case) for case in file["streams"][: FIRST["gimu"]]]) + section(conversions)


def source(tape: Sequence[float]) -> str:
    lines = ['#include "tape.h"']
    pieces = [tape[i : i + PIECE] for i in range(0, len(tape), PIECE)]
    for number, piece in enumerate(pieces):
        lines.append(f"static const ins_real piece_{number}[] TAPE_FLASH = {{")
        lines += [", ".join(f"INS_C({float(x)!r})" for x in piece[i : i + 8]) + "," for i in range(0, len(piece), 8)]
        lines.append("};")
    lines.append(f"const ins_real* const tape_pieces[] = {{{', '.join(f'piece_{i}' for i in range(len(pieces)))}}};")
    lines.append(f"const uint16_t tape_length = {len(tape)};")
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--shift", type=int, metavar="N")
    options = parser.parse_args()
    tape = attitude() + navigation() + filters() + vehicle() + octets()
    if options.shift is not None:
        right = tape[options.shift]
        tape[options.shift] = right + 1 if right == int(right) else right * (1 + SHIFT)
    options.out.write_text(source(tape), encoding="utf-8")
    print(f"{len(tape)} numbers")


if __name__ == "__main__":
    main()
