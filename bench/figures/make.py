"""Draws the figures of docs and fills their tables: errors of the core on known motions, the experiments of the papers.

    python bench/figures/make.py            # runs build/release/bench/figures, writes docs/figures and the tables
    python bench/figures/make.py --check    # writes nothing, compares with what is committed

The points are in docs/figures/points.csv; a figure is a function of its points alone, to the byte.
"""

import argparse
import csv
import io
import math
import re
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import sixacc

matplotlib.use("svg")
from matplotlib import pyplot  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
FIGURES = ROOT / "docs/figures"
POINTS = FIGURES / "points.csv"
ACCURACY = ROOT / "docs/accuracy.md"
THESIS = ROOT / "docs/experiments_thesis.md"
SIXACC = ROOT / "docs/experiments_sixacc.md"
GYRO_FREE = ROOT / "docs/gyro_free.md"
Points = dict[str, dict[str, dict[float, float]]]  # figure, curve, x

SAME = 0.05  # relative, of a point that is a formula's error
NEAR_ZERO = {"table_thesis_turns": 2e-3}  # absolute, beside SAME: figures that are 0 but for the sensors' noise
ROUNDING_DECADES = 1.0  # of the largest point of a curve that is rounding: another compiler rounds elsewhere


@dataclass(frozen=True)
class Figure:
    """Axes, and which curves are rounding alone."""

    x: str
    y: str
    rounding: str = r"^$"
    x_scale: str = "log"
    y_scale: str = "log"


SPECS = {
    "coning_drift": Figure("rotation of the cone in one increment, μ [rad]", "drift / (a² Ω), a = 0.5°"),
    "coning_step": Figure("increment's length T [s]", "largest attitude error in 24 s, motion B [rad]"),
    "rotvec": Figure("|Φ| [rad]", "largest error of a component", rounding="."),
    "euler_pole": Figure("pitch, from the pole [rad]", "largest error of the pitch [rad]", rounding="."),
    "rates_step": Figure("sampling period T [s]", "largest attitude error in 24 s, motion B [rad]"),
    "skew": Figure("vibration [Hz], 1°, one channel 0.3 ms late", "false drift [°/h]"),
    "fiter_step": Figure("increment or sampling period T [s]", "largest attitude error in 24 s, motion B [rad]"),
    "order_step": Figure("increment or sampling period T [s]", "largest attitude error in 24 s, tumbling [rad]"),
    "thesis_step": Figure("increment or sampling period T [s]", "largest attitude error in 24 s, motion B [rad]"),
    "q31_size": Figure("largest increment [rad]", "largest error in 10 minutes at 100 Hz [rad]", rounding="."),
    "sculling_step": Figure(
        "phase in one increment, μ [rad]: 2°, 10 m/s², 5 Hz", "error of the mean acceleration [m/s²]"
    ),
    "strapdown_step": Figure("step [s]", "error after 120 s", rounding="float"),
    "gravity_height": Figure("height [m]", "largest error of all latitudes [m/s²]"),
    "geodesy_height": Figure("height [m]", "there and back, largest of all latitudes [m]", rounding="."),
    "tm_distance": Figure(
        "from the central meridian [°]", "largest error, latitudes 5° to 75° [m]", rounding="Krueger"
    ),
    "sixacc_step": Figure("sampling period [s]", "largest error in 2 s"),
    "align_null": Figure("samples of 0.9 code of noise", "error of the null [codes], rms of 400 runs"),
    "kalman_prior": Figure("P₀ / R", "largest relative error of the gain", rounding="."),
    "pva_gain": Figure("epoch of 50 ms", "relative distance from the settled gain", x_scale="linear"),
    "markov_step": Figure("T / τ", "relative error of the settled variance", rounding="exact"),
    "singer_noise": Figure("T / τ", "relative error of the position's Q", rounding="."),
    "dr_step": Figure("step [s]", "position error after 60 s of slalom [m]"),
    "thesis_rest": Figure("time at rest [s]", "largest of |P|, |Q|, |R| [°]", x_scale="linear", y_scale="linear"),
    "thesis_kalman": Figure("step of 0.05 s", "error of the position [m]", x_scale="linear"),
    "thesis_drive": Figure("time [s]", "error of the position [m]", x_scale="linear"),
    "sixacc_paper_outputs": Figure("accelerometer", "error of an output [m/s²]", rounding="^map", x_scale="linear"),
    "sixacc_paper_angular": Figure(
        "time [s]", "error of the angular acceleration [rad/s²]", rounding="^map", x_scale="linear"
    ),
    "sixacc_paper_linear": Figure("time [s]", "error of the acceleration [m/s²]", rounding="^map", x_scale="linear"),
    "gyro_free_map": Figure("arm ρ [m]", "attitude, worst axis, 1.96 σ [°]"),
    "link_undetected": Figure("bit error rate", "frames taken though wrong"),
}
# Of middle lightness: they stand out on a white page and on a black one.
INK = "#808080"
COLOURS = ["#d1495b", "#2e86c1", "#2a9d5c", "#c77d0a", "#9b59b6", "#16a0a0", "#8d6e63", "#d45fa5"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "*"]


PROGRAMS = ("figures_f64", "figures_f32", "figures_order", "figures_thesis", "figures_sixacc", "figures_gyro_free")
MAP = ("gyro_free_map", "table_gyro_free_said", "table_gyro_free_found")
"""Of many flights, a minute and more: `run` may make a part of it, the rest is as committed."""


def run(build: Path, few: bool = False) -> Points:
    """Points of both number types and of the papers' systems, rounded to four figures."""
    points: Points = {figure: curves for figure, curves in read_points().items() if few and figure in MAP}
    for program in PROGRAMS:
        path = build / "bench/figures" / program
        if not path.exists():
            raise SystemExit(f"{path} is missing: run ./dev test, or cmake --build --preset release --target {program}")
        part = ["few"] if few and program == "figures_gyro_free" else []
        done = subprocess.run([path, *part], capture_output=True, text=True, check=True)
        for line in done.stdout.splitlines():
            figure, curve, x, y = line.split("\t")
            points.setdefault(figure, {}).setdefault(curve, {})[float(x)] = float(f"{float(y):.{digits(figure)}e}")
    for curve, value in sixacc.board(build).items():
        points.setdefault(sixacc.BOARD, {})[curve] = {0.0: float(f"{value:.{digits(sixacc.BOARD)}e}")}
    return points


def digits(figure: str) -> int:
    """After the point: the paper's table 7 has five figures."""
    return 5 if figure in sixacc.TABLE_7 else 3


def to_text(points: Points) -> str:
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["figure", "curve", "x", "y"])
    for figure in sorted(points):
        for curve, values in points[figure].items():
            for x, y in sorted(values.items()):
                writer.writerow([figure, curve, f"{x:.6g}", f"{y:.{digits(figure)}e}"])
    return out.getvalue()


def read_points() -> Points:
    points: Points = {}
    for row in csv.DictReader(POINTS.read_text(encoding="utf-8").splitlines()):
        points.setdefault(row["figure"], {}).setdefault(row["curve"], {})[float(row["x"])] = float(row["y"])
    return points


def draw(name: str, curves: dict[str, dict[float, float]]) -> str:
    spec = SPECS[name]
    style = {
        "svg.hashsalt": "libins",
        "svg.fonttype": "none",
        "font.family": "sans-serif",
        "font.size": 9,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "grid.alpha": 0.35,
        "lines.linewidth": 1.3,
        "lines.markersize": 3.5,
    } | {
        key: INK
        for key in ("text.color", "axes.labelcolor", "axes.edgecolor", "xtick.color", "ytick.color", "grid.color")
    }
    with matplotlib.rc_context(style):
        figure, axes = pyplot.subplots(figsize=(7.4, 3.7))
        # A quantity has one colour in both number types; float is dashed.
        quantities = list(dict.fromkeys(re.sub(", (double|float)$", "", curve) for curve in curves))
        for curve, values in curves.items():
            i = quantities.index(re.sub(", (double|float)$", "", curve))
            dashed = i >= len(COLOURS) or curve.endswith("float")
            x, y = zip(*sorted(values.items()), strict=True)
            axes.plot(
                x, y, "--" if dashed else "-", color=COLOURS[i % len(COLOURS)], marker=MARKERS[i % 8], label=curve
            )
        axes.set_xscale(spec.x_scale)
        axes.set_yscale(spec.y_scale)
        axes.set_xlabel(spec.x)
        axes.set_ylabel(spec.y)
        axes.grid(True)
        axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), frameon=False)
        out = io.StringIO()
        figure.savefig(
            out, format="svg", transparent=True, bbox_inches="tight", metadata={"Date": None, "Creator": None}
        )
        pyplot.close(figure)
    hundredths = re.sub(r"(\d\.\d\d)\d+", r"\1", out.getvalue())  # of a point: a third of the octets
    return re.sub(r"\s*\n\s*", "\n", re.sub(r" *\n(?=[LMCQz])", " ", hundredths))


def coning_cell(value: float) -> str:
    if value < 1e-3:
        return f"{value:.2e}".replace("e-0", "e-")
    return f"{value:#.3g}".rstrip(".") if value < 1000 else f"{float(f'{value:.2e}'):.0f}"


def motion_cell(value: float) -> str:
    return f"{value:.1e}".replace("e-0", "e-").replace("e+00", "")


def table(curves: dict[str, dict[float, float]], names: dict[str, str], cell: Callable[[float], str]) -> str:
    return "\n".join(
        f"| {label} | " + " | ".join(cell(y) for _, y in sorted(curves[curve].items())) + " |"
        for curve, label in names.items()
    )


CONING_ROWS = {
    "ONE": "`ONE`",
    "BLOCK2": "`BLOCK2`",
    "BLOCK3_FIT": "`BLOCK3_FIT` (Zheng and Zhou, 5)",
    "BLOCK3_OPT": "`BLOCK3_OPT`",
    "BLOCK4_FIT": "`BLOCK4_FIT`",
    "BLOCK4_OPT": "`BLOCK4_OPT`",
    "HIST1": "`HIST1` (thesis, 2-17)",
    "HIST2_FIT": "`HIST2_FIT`",
    "HIST2_OPT": "**`HIST2_OPT`**",
    "HIST3_FIT": "`HIST3_FIT`",
    "HIST3_OPT": "`HIST3_OPT`",
    "HIST2_MU03": "`HIST2_MU03`",
    "HIST2_MU06": "`HIST2_MU06`",
    "HIST2_MU10": "`HIST2_MU10`",
    "misread": "equation 5 on every increment (misread)",
}
MOTION_ROWS = {
    "one": "`ONE`",
    "two": "`BLOCK2`",
    "three_poly": "`BLOCK3_FIT`",
    "three_opt": "`BLOCK3_OPT`",
    "four_poly": "`BLOCK4_FIT`",
    "four_opt": "`BLOCK4_OPT`",
    "reuse_fit": "sample reuse, three chains",
    "naive_reuse": "sample reuse as printed",
    "thesis": "thesis's update",
    "hist1": "`HIST1`",
    "hist2_poly": "`HIST2_FIT`",
    "hist2_opt": "**`HIST2_OPT`**",
    "hist3_poly": "`HIST3_FIT`",
    "hist3_opt": "`HIST3_OPT`",
    "fiter_block3": "iteration, `BLOCK3`",
    "fhist2": "iteration, `HIST2`",
    "fhist3": "iteration, `HIST3`",
    "fhist4": "iteration, `HIST4`",
}
RATE_ROWS = {
    "rectangle": "rectangle + `HIST2_OPT`",
    "AM2": "order 2 + `HIST2_OPT`",
    "AM3": "order 3 + `HIST2_OPT`",
    "AM4": "order 4 + `HIST2_OPT`",
    "AM5": "order 5 + `HIST2_OPT`",
    "rk4_2T": "RK4, steps of 2 T",
    "rk4_T": "RK4, steps of T (a sample in the middle too)",
    "rate4": "iteration, `RATE4`",
    "rate5": "iteration, `RATE5`",
}
NOISE_ROWS = {"rectangle": "rectangle", "AM2": "order 2", "AM3": "order 3", "AM4": "order 4"}


REST_ROWS = {
    "null 2047": "none: 2047",
    "integer null": "mean, rounded to a code",
    "fractional null": "**mean of 180 packets**",
}
DRIVE_ROWS = {
    "rest, dead reckoning": "at rest, INS alone",
    "rest, filter": "at rest, P-V-A filter",
    "rest, filter that levels": "**at rest, P-V-A filter, fixes level the attitude**",
    "circle, dead reckoning": "circle, INS alone",
    "circle, filter": "circle, P-V-A filter",
    "circle, filter that levels": "**circle, P-V-A filter, fixes level the attitude**",
}
# (S1, S2, S3) as the thesis prints them, figures 4.30 to 4.41.
THESIS_TURNS = {
    "P +90": "-0.0619, 0.9981, 0.0004",
    "P back": "0.9990, 0.0455, 0.0000",
    "P -90": "-0.0559, -0.9984, -0.0030",
    "P back again": "0.9969, 0.0784, 0.0025",
    "Q +90": "0.9862, 0.1048, 0.1286",
    "Q back": "0.9980, -0.0634, 0.0011",
    "Q -90": "0.9975, -0.0642, 0.0301",
    "Q back again": "1.0000, 0.0048, -0.0031",
    "R +90": "-0.0545, 0.9985, 0.0076",
    "R back": "0.9996, 0.0277, -0.0014",
    "R -90": "0.0607, -0.9908, -0.1211",
    "R back again": "0.9998, 0.0173, -0.0051",
}
KALMAN_ROWS = {
    "1000 steps": "1000 steps",
    "3000 steps": "3000 steps",
    "3000 steps, signal x 10": "3000 steps, signal × 10",
}


def gyro_free(points: Points) -> str:
    """What the filter says, and what the errors were; bold within 5 degrees by both."""
    rows = []
    for name, said in points["table_gyro_free_said"].items():
        cells = []
        for column, value in sorted(said.items()):
            found = points["table_gyro_free_found"][name][column]
            mark = "**" if max(value, found) <= WITHIN_DEG else ""
            cells.append(f"{mark}{value:.1f}{mark} ({found:.1f})")
        rows.append(f"| {' | '.join([*name.split(', '), *cells])} |")
    return "\n".join(rows)


def orders(points: Points) -> str:
    rows = {**MOTION_ROWS, **RATE_ROWS}
    return "\n".join(
        f"| {rows[curve]} | {motion_cell(values[0])} | {values[1]:.2f} |"
        for curve, values in points["table_order"].items()
    )


def degrees_cell(value: float) -> str:
    return f"{value:.1f}"


def turns(points: Points) -> str:
    rows = []
    for name, printed in THESIS_TURNS.items():
        *ours, off = (y for _, y in sorted(points["table_thesis_turns"][name].items()))
        ideal = "1, 0, 0" if "Q" in name or "back" in name else "0, 1, 0" if "+" in name else "0, -1, 0"
        here = ", ".join(f"{round(y, 4) + 0.0:.4f}" for y in ours)  # + 0.0: or -0.0 would show as -0.0000
        rows.append(f"| {name} | {ideal} | {printed} | {here} | {round(off, 1) + 0.0:.1f} |")
    return "\n".join(rows)


WITHIN_DEG = 5.0


def tables(points: Points) -> dict[Path, dict[str, str]]:
    """Page, name of the table there, its rows."""
    return {
        ACCURACY: {
            "coning": table(points["table_coning"], CONING_ROWS, coning_cell),
            "increments": table(points["table_motion"], MOTION_ROWS, motion_cell),
            "rates": table(points["table_motion"], RATE_ROWS, motion_cell),
            "noise": table(points["table_noise"], NOISE_ROWS, motion_cell),
            "order": orders(points),
        },
        THESIS: {
            "rest": table(points["table_thesis_rest"], REST_ROWS, degrees_cell),
            "turns": turns(points),
            "kalman": table(points["table_thesis_kalman"], KALMAN_ROWS, coning_cell),
            "gain": table(points["table_thesis_gain"], KALMAN_ROWS, lambda y: f"{y:.4f}"),
            "drive": table(points["table_thesis_drive"], DRIVE_ROWS, coning_cell),
        },
        SIXACC: sixacc.tables(points),
        GYRO_FREE: {"map": gyro_free(points)},
    }


def filled(path: Path, rows: dict[str, str]) -> str:
    """The page with each table between its markers made anew."""
    page = path.read_text(encoding="utf-8")
    for name, text in rows.items():
        pattern = rf"(<!-- rows: {name} -->\n(?:\|.*\n){{2}})(?:\|.*\n)*"
        page, found = re.subn(pattern, lambda m, text=text: m[1] + text + "\n", page)
        if found != 1:
            raise SystemExit(f"{path}: '<!-- rows: {name} -->' with two lines of table head must be there once")
    return page


def differences(got: Points, want: Points) -> list[str]:
    """Points that differ by more than may be: SAME in a formula's error, ROUNDING_DECADES in a curve of rounding."""
    found = []
    for figure in sorted(got.keys() | want.keys()):
        for curve in sorted(got.get(figure, {}).keys() | want.get(figure, {}).keys()):
            new, old = got.get(figure, {}).get(curve, {}), want.get(figure, {}).get(curve, {})
            place = f"{figure}, {curve}"
            if figure in SPECS and re.search(SPECS[figure].rounding, curve):
                most, was = max(new.values(), default=0), max(old.values(), default=0)
                if not most or not was or abs(math.log10(most / was)) > ROUNDING_DECADES:
                    found.append(f"{place}: largest {most:g}, committed {was:g}")
            elif new.keys() != old.keys():
                found.append(f"{place}: {len(new)} points, committed {len(old)}")
            else:
                found += [
                    f"{place} at {x:g}: {new[x]:g}, committed {old[x]:g}"
                    for x in new
                    if abs(new[x] - old[x]) > SAME * abs(old[x]) + NEAR_ZERO.get(figure, 0.0)
                ]
    return found


def stale() -> list[str]:
    """Committed files that are not what the committed points make."""
    points = read_points()
    found = [str(POINTS.relative_to(ROOT))] if to_text(points) != POINTS.read_text(encoding="utf-8") else []
    for name in SPECS:
        path = FIGURES / f"{name}.svg"
        if not path.exists() or path.read_text(encoding="utf-8") != draw(name, points[name]):
            found.append(str(path.relative_to(ROOT)))
    for page, rows in tables(points).items():
        if filled(page, rows) != page.read_text(encoding="utf-8"):
            found.append(str(page.relative_to(ROOT)))
    return found


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--build", type=Path, default=ROOT / "build/release", metavar="DIR")
    parser.add_argument("--check", action="store_true", help="write nothing; exit code 1 if what is committed differs")
    options = parser.parse_args()
    points = run(options.build)
    if options.check:
        wrong = differences(points, read_points()) + [f"{name} is not made from points.csv" for name in stale()]
        print("\n".join(wrong) or "figures and tables are as committed")
        return 1 if wrong else 0
    FIGURES.mkdir(exist_ok=True)
    POINTS.write_text(to_text(points), encoding="utf-8")
    points = read_points()
    for name in SPECS:
        (FIGURES / f"{name}.svg").write_text(draw(name, points[name]), encoding="utf-8")
    for page, rows in tables(points).items():
        page.write_text(filled(page, rows), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
