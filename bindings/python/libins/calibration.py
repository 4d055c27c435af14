"""Calibration of accelerometers and triads: from a declaration and its data to what is applied. SI, frame b."""

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from libins import calib_data, core
from libins.calib_data import Array
from libins.calib_tables import FULL_NAMES, Declaration, Known, Triad
from libins.errors import UsageError

Progress = Callable[[str], None]
"""Told the name of each step as it begins."""
CHI2_9_95 = 16.919
"""95 % of chi-square with nine degrees of freedom, the parameters of a triad."""
PLACE_BIT = 5


@dataclass(frozen=True)
class Result:
    """tables: what is written and applied; figures: how good it is; residuals: (rows, sensors) and their unit."""

    method: str
    tables: dict[str, Any]
    figures: dict[str, Any]
    residuals: Array
    unit: str
    labels: list[str]
    raw: Mapping[str, Any]


def _native() -> Any:
    try:
        from libins import _calib
    except ImportError as error:
        raise UsageError(
            "this build has no calibration: install libceres-dev (Debian, Ubuntu), then configure and build again; "
            "cmake says whether it found Ceres"
        ) from error
    return _calib


def run(path: Path, declared: Declaration, progress: Progress = lambda _: None) -> Result:
    """Raises UsageError: what poses do not fix, and which to add, is in its text."""
    native = _native()
    methods: dict[str, Callable[..., Result]] = {"linear": _linear, "paper": _paper, "full": _full, "triad": _triad}
    try:
        return methods[declared.method](native, path.parent, declared, progress)
    except ValueError as error:
        raise UsageError(f"{path}: {error}") from error


def accelerometers(path: Path) -> tuple[Array, Array, Array]:
    """Bias, axis and place of a file that `ins calib` wrote, as core.Sixacc takes them. Raises UsageError."""
    try:
        rows = tomllib.loads(path.read_text(encoding="utf-8"))["accelerometer"]
        return tuple(np.array([row[key] for row in rows], float) for key in ("bias", "axis", "place_m"))  # type: ignore[return-value]
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {error.strerror}") from error
    except (KeyError, ValueError, TypeError) as error:
        raise UsageError(f"{path}: is no calibration of accelerometers by ins calib: {error!r}") from error


def quadratic(path: Path) -> Array:
    """Their quadratic terms in such a file [s^2/m], as core.accel_linear takes them; 0 where it has none."""
    rows = tomllib.loads(path.read_text(encoding="utf-8"))["accelerometer"]
    return np.array([row.get("k2_s2_m", 0.0) for row in rows], float)


def _poses(folder: Path, known: Known) -> tuple[Array, Array]:
    """(n, 9) up, rate, angular acceleration, and the readings."""
    given = known.poses
    names = [*given.up, *given.rate, *given.readings]
    data = calib_data.read(folder / given.file, names)
    length = np.linalg.norm(data[:, :3], axis=1)
    if not np.all(length > 0):
        row = int(np.argmin(length)) + 1
        raise UsageError(f"{folder / given.file}: row {row}: {', '.join(given.up)} are all 0; give where up is in b")
    poses = np.zeros((len(data), 9))
    poses[:, :3] = data[:, :3] / length[:, None]
    if given.rate:
        poses[:, 3:6] = data[:, 3:6] * (np.pi / 180 if given.rate_unit == "deg/s" else 1.0)
    return poses, np.ascontiguousarray(data[:, len(names) - len(given.readings) :])


def _linear(native: Any, folder: Path, known: Known, progress: Progress) -> Result:
    progress("reading")
    poses, readings = _poses(folder, known)
    if np.any(poses[:, 3:6]):
        raise UsageError(f"{folder / known.poses.file}: the linear map takes poses at rest; spins need method = 'full'")
    progress("fitting")
    fit = native.linear(known.g_m_s2 * poses[:, :3], readings)
    rows = [
        {"bias": m[0], "axis": m[1:], "place_m": np.zeros(3), "deviation": s}
        for m, s in zip(fit["map"], fit["deviation"], strict=True)
    ]
    figures = {"residual rms": np.max(fit["rms"]), "poses": len(poses)}
    return Result(
        "linear", {"accelerometer": rows}, figures, fit["residual"], "reading", list(known.poses.readings), fit
    )


def _paper(native: Any, folder: Path, known: Known, progress: Progress) -> Result:
    progress("reading")
    readings = calib_data.read(folder / known.poses.file, known.poses.readings)
    if len(readings) != 6:
        raise UsageError(
            f"{folder / known.poses.file}: {len(readings)} rows; the estimator takes the paper's six, in order"
        )
    progress("fitting")
    fit = native.paper(known.paper.numbers, known.g_m_s2, known.paper.T_s, np.ascontiguousarray(readings.T))
    rows = [
        {"number": int(number), "bias": m[0], "axis": m[1:], "place_m": np.zeros(3), "scale": sf, "b_m_s2": b}
        for number, m, sf, b in zip(str(known.paper.numbers), fit["map"], fit["sf"], fit["bias"], strict=True)
    ]
    angles = dict(zip(("xy", "xz", "yx", "yz", "zx", "zy"), np.degrees(fit["angles"]), strict=True))
    figures = {f"angle {name} [deg]": value for name, value in angles.items()}
    figures["residual rms"] = float(np.sqrt(np.mean(fit["residual"] ** 2)))
    return Result(
        "paper", {"accelerometer": rows}, figures, fit["residual"].T, "reading / T", list(known.poses.readings), fit
    )


def _nominal(known: Known) -> tuple[Array, Array]:
    """Unit axes and places."""
    if known.rho_m is not None:
        _, axis, place = core.sixacc_paper(known.rho_m)
        return np.array(axis), np.array(place)
    axes = np.array([a.axis for a in known.accelerometer])
    return axes / np.linalg.norm(axes, axis=1, keepdims=True), np.array([a.place_m for a in known.accelerometer])


def _leaning(axis: Array) -> tuple[Array, Array]:
    """Two directions square to an axis: away from the coordinate axis that is nearest to square to it."""
    e2 = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    e2 /= np.linalg.norm(e2)
    return np.cross(e2, axis), e2


def _full(native: Any, folder: Path, known: Known, progress: Progress) -> Result:
    progress("reading")
    poses, readings = _poses(folder, known)
    axes, places = _nominal(known)
    model = known.full
    bits = sum(1 << i for i, name in enumerate(FULL_NAMES[:PLACE_BIT]) if name in model.fixed)
    bits |= 7 << PLACE_BIT if "r" in model.fixed else 0
    progress("guessing")
    # Scale factors are in the readings' unit, the noise in m/s^2: the linear map says how they compare.
    w = poses[:, 3:6]
    sigma = []
    for j, r in enumerate(places):
        force = known.g_m_s2 * poses[:, :3] + np.cross(w, np.cross(w, r))
        guess = native.linear(force, readings[:, j : j + 1])["map"][0]
        sigma.append(model.noise_m_s2 * np.linalg.norm(guess[1:]))
    sensors = np.array(
        [
            np.concatenate([axis, *_leaning(axis), place, [s]])
            for axis, place, s in zip(axes, places, sigma, strict=True)
        ]
    )
    progress("fitting")
    fit = native.full(sensors, poses, readings, known.g_m_s2, np.radians(model.fixture_deg), model.robust_sigmas, bits)
    deviation = np.sqrt(np.diag(fit["covariance"])).reshape(-1, 8)
    rows = []
    for sensor, p, s in zip(sensors, fit["p"], deviation, strict=True):
        u = sensor[:3] + p[2] * sensor[3:6] + p[3] * sensor[6:9]
        rows.append(
            {
                "bias": p[1] * p[0],
                "axis": p[1] * u / np.linalg.norm(u),
                "place_m": p[5:],
                "b_m_s2": p[0],
                "scale": p[1],
                "misalignment_rad": p[2:4],
                "k2_s2_m": p[4],
                "deviation": s,
            }
        )
    figures = {
        "residual rms [sigma]": float(np.sqrt(np.mean((fit["residual"] / sensors[:, 12]) ** 2))),
        "chi-square": fit["chi2"],
        "chi-square expected": fit["chi2_expected"],
        "condition": np.max(fit["condition"]),
        "combinations fixed by priors alone": fit["from_prior"],
        "iterations": fit["iterations"],
    }
    residuals = fit["residual"] / sensors[:, 12]
    return Result("full", {"accelerometer": rows}, figures, residuals, "sigma", list(known.poses.readings), fit)


def _triad(native: Any, folder: Path, triad: Triad, progress: Progress) -> Result:
    progress("reading")
    path = folder / triad.accel.file
    accel = calib_data.read(path, [triad.accel.time, *triad.accel.columns])
    period = calib_data.period(path, accel[:, 0])
    gyro = None
    if triad.gyro is not None:
        given = calib_data.read(folder / triad.gyro.file, [triad.gyro.time, *triad.gyro.columns])
        if len(given) != len(accel) or np.max(np.abs(given[:, 0] - accel[:, 0])) > period / 2:
            raise UsageError(f"{folder / triad.gyro.file}: samples at other times than {path}; give both at the same")
        gyro = np.ascontiguousarray(given[:, 1:])

    def fit(part: int, parts: int) -> Any:
        scale = triad.gyro.scale_rad_s if triad.gyro else 0.0
        settings = (period, triad.g_m_s2, triad.still.initial_s, triad.still.window_s, scale)
        return native.triad(np.ascontiguousarray(accel[:, 1:]), gyro, *settings, part, parts)

    progress("fitting")
    whole = fit(0, 1)
    figures = {
        "still poses": len(whole["poses"]),
        "|f| - g rms [m/s^2]": whole["accel"]["rms"],
        "|f| - g rms with one scale factor [m/s^2]": whole["accel"]["rms_scale"],
        "|f| - g rms uncalibrated [m/s^2]": whole["rms_raw"],
        "condition, accelerometers": whole["accel"]["condition"],
    }
    tables = {"accel": _applied(whole["accel"], native.ACCEL_NAMES)}
    if gyro is not None:
        figures |= {
            "gravity turned by gyros, rms [deg]": np.degrees(whole["gyro"]["rms"]),
            "the same with one scale factor [deg]": np.degrees(whole["gyro"]["rms_scale"]),
            "gyro bias in poses, rms [counts]": whole["bias_rms"],
            "the same without sensitivity to f [counts]": whole["bias_rms_constant"],
            "condition, gyros": whole["gyro"]["condition"],
        }
        tables["gyro"] = _applied(whole["gyro"], native.GYRO_NAMES) | {"g_sensitivity": whole["g_sensitivity"]}
    progress("halves")
    try:
        halves = [fit(0, 2), fit(1, 2)]
    except ValueError as error:
        figures["halves"] = str(error)
    else:
        for name in tables:
            d = halves[0][name]["p"] - halves[1][name]["p"]
            spread = halves[0][name]["covariance"] + halves[1][name]["covariance"]
            figures[f"halves differ, {name}: chi-square of 9 (95 %: {CHI2_9_95:.1f})"] = d @ np.linalg.solve(spread, d)
    columns = [1e3 * whole["residual"]] + ([1e3 * whole["angle"]] if gyro is not None else [])
    labels = ["|f| - g [mm/s^2]", "gravity turned by the gyros [mrad]"][: len(columns)]
    return Result("triad", tables, figures, np.column_stack(columns), "", labels, whole)


def _applied(axes: Mapping[str, Any], names: tuple[str, ...]) -> dict[str, Any]:
    deviation = np.sqrt(np.diag(axes["covariance"]))
    return {
        "matrix": axes["matrix"],
        "bias": axes["bias"],
        "parameters": dict(zip(names, axes["p"], strict=True)),
        "deviation": dict(zip(names, deviation, strict=True)),
    }
