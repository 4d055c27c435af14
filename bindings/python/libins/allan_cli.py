"""The `ins allan` command: noise coefficients of a sensor that was recorded at rest."""

import argparse
import json
import math
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import Progress

from libins import allan, allan_data
from libins.allan_data import FORCES, RATES, AtRest, Declared
from libins.allan_model import TERMS
from libins.errors import UsageError
from libins.whole_file import write

MISSED = 5.0
"""Standard deviations that a point may be from the model before it is said."""
SYMBOLS = {"quantisation": "Q", "random_walk": "N", "bias_instability": "B", "rate_random_walk": "K", "rate_ramp": "R"}
POWERS = {"quantisation": 1, "random_walk": 0.5, "bias_instability": 0, "rate_random_walk": -0.5, "rate_ramp": -1}
"""Of the second, that the coefficient has beside the rate's unit."""
CUSTOMARY = {
    "rate": {
        "random_walk": (math.degrees(60), "deg/sqrt(h)"),
        "bias_instability": (math.degrees(3600), "deg/h"),
        "rate_random_walk": (math.degrees(3600) * 60, "deg/h/sqrt(h)"),
    },
    "force": {
        "random_walk": (60, "m/s/sqrt(h)"),
        "bias_instability": (1e6 / 9.80665, "ug"),
        "rate_random_walk": (1e6 / 9.80665 * 60, "ug/sqrt(h)"),
    },
}
"""Factor and unit of data sheets."""


def options(command: argparse.ArgumentParser) -> None:
    """Adds the grammar of `ins allan`."""
    command.add_argument("file", type=Path, help="a table of numbers (CSV, or with blanks), also gzipped")
    command.add_argument(
        "--columns",
        default="time,fx,fy,fz,wx,wy,wz",
        metavar="A,B,...",
        help="what the columns are: time, fx fy fz (specific force), wx wy wz (rate), - (unused) (%(default)s)",
    )
    command.add_argument("--force-unit", default="m/s^2", metavar="U", help="m/s^2, g, mg; of codes '0.0024 m/s^2'")
    command.add_argument("--rate-unit", default="rad/s", metavar="U", help="rad/s, deg/s; of codes '0.07 deg/s'")
    command.add_argument("--increments", action="store_true", help="columns hold integrals since the sample before")
    command.add_argument("--time-scale", type=float, default=1.0, metavar="S", help="seconds in one of `time` (1)")
    command.add_argument("--rate-hz", type=float, metavar="F", help="samples a second, where no column is the time")
    command.add_argument("--from-s", type=float, default=0.0, metavar="S", help="after the first sample (0)")
    command.add_argument("--to-s", type=float, default=math.inf, metavar="S", help="up to there (the end)")
    command.add_argument("--tau-s", metavar="A:B", help="fit to cluster times from A to B seconds only")
    which = command.add_mutually_exclusive_group()
    which.add_argument("--rest", action="store_true", help="of a recording that moves too, take what lies between")
    which.add_argument("--all", action="store_true", help="do not look for motion")
    command.add_argument("--json", type=Path, metavar="F", help="curves and coefficients ('-': standard output)")
    command.add_argument(
        "--toml", type=Path, metavar="F", help="[imu.gyro], [imu.accel] of ins sim, [noise] of ins replay"
    )
    command.add_argument("--report", type=Path, metavar="F.html", help="a page with the curves")


def _span(text: str | None) -> tuple[float, float]:
    if text is None:
        return 0.0, math.inf
    try:
        low, high = (float(part) for part in text.split(":"))
    except ValueError:
        low, high = 1.0, 0.0
    if not 0 <= low < high:
        raise UsageError(f"--tau-s {text}: two times in seconds are needed, as 0.1:100")
    return low, high


def unit_of(kind: str, term: str) -> str:
    """SI unit of a coefficient."""
    base = {"rate": "rad", "force": "m/s"}[kind]
    return base + {1: "", 0.5: "/sqrt(s)", 0: "/s", -0.5: "/s/sqrt(s)", -1: "/s^2"}[POWERS[term]]


def kind_of(column: str) -> str:
    """Of a column: rate or force."""
    return "rate" if column in RATES else "force"


def analyse(at_rest: AtRest, tau_s: tuple[float, float]) -> dict[str, Any]:
    """All of the result, as JSON holds it. Raises UsageError."""
    columns: dict[str, Any] = {}
    curves, fits = {}, {}
    with Progress(
        console=Console(stderr=True), transient=True, disable=not Console(stderr=True).is_terminal
    ) as progress:
        task = progress.add_task("Allan deviation", total=len(at_rest.stretches))
        for name, stretches in at_rest.stretches.items():
            try:
                curve = allan.deviation(stretches, at_rest.dt, *tau_s)
            except UsageError as error:
                raise UsageError(f"column {name}: {error}") from error
            fit = allan.coefficients(curve)
            low, high = fit.bars
            lowest = allan.minimum(curve)
            found = {
                term.name: {"value": c.value, "low": c.low, "high": c.high, "unit": unit_of(kind_of(name), term.name)}
                for term in TERMS
                for c in [fit[term.name]]
            }
            missed = [float(t) for t, z in zip(curve.tau, fit.misfit, strict=True) if abs(z) > MISSED]
            columns[name] = found | {
                "minimum": {"tau_s": lowest[0], "adev": lowest[1]},
                "lag_s": fit.lag_s,
                "missed_tau_s": missed,
                "tau_s": curve.tau.tolist(),
                "adev": curve.adev.tolist(),
                "low": low.tolist(),
                "high": high.tolist(),
                "model": fit.model.tolist(),
            }
            curves[name], fits[name] = curve, fit
            progress.advance(task)
    markov = {}
    for kind, names in (("gyro", RATES), ("accel", FORCES)):
        present = [name for name in names if name in curves]
        if present:
            m = allan.gauss_markov([curves[name] for name in present], [fits[name] for name in present])
            markov[kind] = {
                "columns": present,
                "random_walk": list(m.random_walk),
                "sigma": list(m.sigma),
                "tau_s": m.tau_s,
                "tau_at_limit": m.at_limit,
            }
    return {
        "rate_hz": 1 / at_rest.dt,
        "seconds": at_rest.seconds,
        "stretches": [
            {"start_s": start, "seconds": len(x) * at_rest.dt}
            for start, x in zip(at_rest.starts_s, next(iter(at_rest.stretches.values())), strict=True)
        ],
        "columns": columns,
        "markov": markov,
    }


def text(result: dict[str, Any]) -> str:
    """The result in lines."""
    lines = [
        f"{result['seconds']:.1f} s at rest in {len(result['stretches'])} stretches, {result['rate_hz']:.2f} Hz; "
        "95 % intervals"
    ]
    for name, column in result["columns"].items():
        for term, symbol in SYMBOLS.items():
            c = column[term]
            values = f"{c['value']:.3g} ({c['low']:.3g} .. {c['high']:.3g})" if c["low"] else f"below {c['high']:.3g}"
            factor, customary = CUSTOMARY[kind_of(name)].get(term, (0, ""))
            also = f" = {c['value'] * factor:.3g} {customary}" if factor and c["low"] else ""
            lines.append(f"{name}  {term.replace('_', ' '):17} {symbol}  {values} {c['unit']}{also}")
        lowest = column["minimum"]
        lines.append(f"{name}  lowest             {lowest['adev']:.3g} at {lowest['tau_s']:.3g} s")
        if column["lag_s"]:
            lines.append(f"{name}  its samples have passed a low pass of {column['lag_s'] * 1e3:.3g} ms")
        if column["missed_tau_s"]:
            missed = column["missed_tau_s"]
            lines.append(
                f"{name}  the terms do not make the curve at {len(missed)} cluster times, {missed[0]:.3g} .. "
                f"{missed[-1]:.3g} s: vibration, or another filter; --tau-s leaves them out"
            )
    for kind, m in result["markov"].items():
        sigma = ", ".join(f"{value:.3g}" for value in m["sigma"])
        limit = " or longer: the bias still wanders at the end" if m["tau_at_limit"] else ""
        lines.append(f"{kind}  as Gauss-Markov bias: sigma {sigma}, tau {m['tau_s']:.3g} s{limit}")
    return "\n".join(lines)


def _triad(result: dict[str, Any], names: tuple[str, ...], term: str) -> list[float]:
    """Values of three axes; of one that was not recorded, those that were, in the mean square."""
    values = [result["columns"][name][term]["value"] for name in names if name in result["columns"]]
    mean = math.sqrt(sum(v * v for v in values) / len(values))
    return [result["columns"][name][term]["value"] if name in result["columns"] else mean for name in names]


def toml(result: dict[str, Any], source: str) -> str:
    """Noise for `ins sim` (the curve as it is) and for `ins replay` (a filter's Gauss-Markov bias)."""
    lines = [f"# ins allan {source}: {result['seconds']:.1f} s at rest, {result['rate_hz']:.2f} Hz"]
    noise = []
    for triad, names, walk, letter, unit_name in (
        ("gyro", RATES, "arw_rad_rts", "g", "rad_s"),
        ("accel", FORCES, "vrw_m_s_rts", "a", "m_s2"),
    ):
        if triad not in result["markov"]:
            continue
        lines += ["", f"[imu.{triad}]"]
        for term in ("random_walk", "bias_instability", "rate_random_walk"):
            lines.append(f"{term} = [{', '.join(f'{v:.4g}' for v in _triad(result, names, term))}]")
        q = _triad(result, names, "quantisation")
        lines.append(f"quantum = {math.sqrt(12 * sum(v * v for v in q) / 3):.4g}")
        m = result["markov"][triad]
        if any(m["random_walk"]):
            noise.append(f"{walk} = {_rms(m['random_walk']):.4g}")
        if any(m["sigma"]):
            noise += [f"bias_{letter}_{unit_name} = {_rms(m['sigma']):.4g}", f"tau_{letter}_s = {m['tau_s']:.4g}"]
    return "\n".join([*lines, "", "[noise]", *noise, ""])


def _rms(values: list[float]) -> float:
    return math.sqrt(sum(v * v for v in values) / len(values))


def run(parsed: argparse.Namespace) -> int:
    """Returns the exit code. Raises UsageError."""
    if parsed.rate_hz is not None and not 0 < parsed.rate_hz < 1e7:
        raise UsageError(f"--rate-hz {parsed.rate_hz}: samples a second are needed, above 0")
    columns = [name.strip() for name in parsed.columns.split(",")]
    declared = Declared(
        columns, parsed.force_unit, parsed.rate_unit, parsed.time_scale, parsed.rate_hz, parsed.increments
    )
    rest = None if parsed.all else parsed.rest
    at_rest = allan_data.load(parsed.file, declared, (parsed.from_s, parsed.to_s), rest)
    result = analyse(at_rest, _span(parsed.tau_s))
    if parsed.json is not None:
        write(parsed.json, json.dumps(result, indent=1) + "\n")
    if parsed.toml is not None:
        write(parsed.toml, toml(result, parsed.file.name))
    if parsed.report is not None:
        from libins import allan_page

        write(parsed.report, allan_page.html(parsed.file.name, result))
    if str(parsed.json) != "-":
        print(text(result))
    return 0
