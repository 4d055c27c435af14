"""Tables of docs/experiments_sixacc.md: the paper's figures beside those of the library, and of its emulated board."""

import json
import math
import os
import subprocess
import sys
from pathlib import Path

Table = dict[str, dict[float, float]]

BOARD = "table_sixacc_board"
TABLE_7 = (BOARD, "table_sixacc_sf", "table_sixacc_angles")
# Accelerometer: scale factor of table 6 (true), of table 7 (found there).
SCALE = {
    1: (0.5, "0.5"),
    2: (2.5, "2.4998"),
    3: (0.5, "0.4999"),
    4: (2.5, "2.4996"),
    5: (2.5, "2.4997"),
    6: (2.5, "2.4997"),
}
# Angle: table 6, table 7; the same for both groups.
ANGLES = {
    "xy": ("0.6", "0.5930"),
    "xz": ("0.5", "0.5042"),
    "yx": ("0.8", "0.8074"),
    "yz": ("0.7", "0.7001"),
    "zx": ("0.4", "0.4000"),
    "zy": ("0.8", "0.8001"),
}
GREEK = {"alpha": "α", "beta": "β"}
CALIBRATIONS = {"none": "none", "angles": "angles of table 7, put back into (13)", "map": "**linear map**"}


def board(build: Path) -> dict[str, float]:
    """Table 7 from the codes of the emulated board."""
    environment = {**os.environ, "PYTHONPATH": str(build / "python")}
    command = [sys.executable, "-m", "libins", "run", "s2_table7", "--json", "-"]
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    if done.returncode:
        raise SystemExit(f"{' '.join(command[1:])}: {done.stderr or done.stdout}")
    paper = json.loads(done.stdout)["calibration"]["paper"]
    return {f"{kind}.{name}": value for kind, values in paper.items() for name, value in values.items()}


def tables(points: dict[str, Table]) -> dict[str, str]:
    """Name of a table in the page, its rows."""
    found, from_board = points["table_sixacc_sf"], {name: row[0.0] for name, row in points[BOARD].items()}
    scale = [
        f"| {j} | {true} | {printed} | {found[f'#{j}'][0]:.4f} | {from_board[f'sf.{j}']:.4f} | {found[f'#{j}'][2]:.4f} "
        f"| {found[f'#{j}'][1]:.5f} | {from_board[f'bias_g.{j}']:.5f} |"
        for j, (true, printed) in SCALE.items()
    ]
    angles = [
        f"| Δ{GREEK[letter]}{name} | {true} | {printed} | {points['table_sixacc_angles'][f'{letter}_{name}'][0]:.4f} "
        f"| {from_board[f'angle_deg.{letter}_{name}']:.4f} |"
        for letter in GREEK
        for name, (true, printed) in ANGLES.items()
    ]
    return {
        "scale": "\n".join(scale),
        "angles": "\n".join(angles),
        "motion": "\n".join(map(_motion(points), CALIBRATIONS)),
    }


def _cell(value: float) -> str:
    """A value; of rounding alone, the decade that it stays below."""
    return f"{value:.2g}" if value >= 1e-9 else f"< 1e{math.ceil(math.log10(value)) + 1}"


def _motion(points: dict[str, Table]):
    def row(name: str) -> str:
        outputs = max(points["sixacc_paper_outputs"][name].values())
        values = [points["table_sixacc_motion"][name][x] for x in range(6)]
        cells = [_cell(value) for value in (outputs, *values)]
        return f"| {CALIBRATIONS[name]} | " + " | ".join(cells) + " |"

    return row
