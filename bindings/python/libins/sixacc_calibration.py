"""Six accelerometers calibrated from the codes that their board scanned in a fixture: linear map, paper's estimator.

Hung, Fang, Wang and Lee, sections 5 and 6: equations 21 to 25 on the attitudes of their tables 3 and 4, table 7.
"""

from typing import TYPE_CHECKING, Any

import numpy as np

from libins import fixture, sixacc
from libins.errors import UsageError
from libins.schema import Document
from libins.sixacc_tables import COUNT, Calibration, SixAcc
from libins.tables import Motion

if TYPE_CHECKING:
    from libins.scenario import Scenario

Array = np.ndarray[Any, np.dtype[np.float64]]

NULL_CODE = 2048
POSES = 6
"""Of a group."""
GROUPS = ((235, "beta", (2, 3, 5)), (146, "alpha", (1, 4, 6)))
"""Group, letter of its angles, its accelerometers; the fixture takes the attitudes in this order."""
ANGLES = ("xy", "xz", "yx", "yz", "zx", "zy")
T_S = 1.0
NUMBERS = tuple(str(j) for j in range(1, COUNT + 1))


def check(document: Document, table: Calibration, motion: Motion, six: SixAcc | None) -> None:
    """What the keys alone cannot show. Raises UsageError."""
    if six is None or motion.kind != "fixture":
        raise document.refuse(("calibration",), 'needs a [sixacc] table and motion.kind = "fixture"')
    if table.settle_s >= motion.rest_s:
        raise document.refuse(("calibration", "settle_s"), f"found {table.settle_s}, which is all of motion.rest_s")
    if table.paper:
        calib = _calib()
        want = np.concatenate([calib.paper_attitudes(group, 1.0) for group, _, _ in GROUPS])
        up = np.array(motion.up_b) / np.linalg.norm(motion.up_b, axis=1, keepdims=True)
        if up.shape != want.shape or np.abs(up - want).max() > 1e-6:
            wrong = next(
                (i for i, row in enumerate(want) if i >= len(up) or np.abs(up[i] - row).max() > 1e-6), len(want)
            )
            needed = f"{want[wrong].round(6).tolist()}" if wrong < len(want) else "nothing more"
            raise document.refuse(
                ("motion", "up_b"),
                f"entry {wrong} must be {needed}: the paper's twelve attitudes, table 3, then table 4",
            )


def _calib() -> Any:
    try:
        from libins import _calib
    except ImportError as error:
        raise UsageError(
            "this build has no calibration: install libceres-dev and build with INS_BUILD_CALIB=ON"
        ) from error
    return _calib


def _readings(scans: Array, rests: list[tuple[float, float]], settle_s: float, lsb: float) -> tuple[Array, int]:
    """Means of each rest [m/s^2], and the least number of scans in one. Raises UsageError."""
    t, codes = scans[:, :COUNT], scans[:, COUNT:]
    means, counts = [], []
    for begin, end in rests:
        inside = (t >= begin + settle_s).all(axis=1) & (t <= end).all(axis=1)
        if not inside.any():
            raise UsageError(
                f"calibration: no scan lies in the rest from {begin:g} to {end:g} s; stop_s must reach {rests[-1][1]:g}"
            )
        means.append((codes[inside].mean(axis=0) - NULL_CODE) * lsb)
        counts.append(int(inside.sum()))
    return np.array(means), min(counts)


def measured(scenario: "Scenario", seed: int, track: Any, run: Any) -> dict[str, Any]:
    """The summary's `calibration`. Raises UsageError."""
    table, six, calib = scenario.tables.calibration, scenario.tables.sixacc, _calib()
    assert table is not None and six is not None
    rests = fixture.rests(scenario.tables.motion)
    readings, count = _readings(np.array(run.scans()), rests, table.settle_s, six.lsb_m_s2)
    f_b = np.array([track.at((begin + end) / 2)["f_b"] for begin, end in rests])
    found = calib.linear(f_b, readings)
    sensors = sixacc.accels_of(six, seed)
    scale = 1 + np.array(six.scale_error)
    axis = scale[:, None] * np.array(sensors.axis)
    off = found["map"][:, 1:] - axis
    return {
        "scans": count,
        "lsb_m_s2": six.lsb_m_s2,
        "bias_error_m_s2": _named(np.abs(found["map"][:, 0] - six.bias_m_s2)),
        "axis_error": _named(np.linalg.norm(off, axis=1) / np.linalg.norm(axis, axis=1)),
        "residual_rms_m_s2": _named(found["rms"]),
        **({"paper": _paper(calib, f_b, readings)} if table.paper else {}),
    }


def _named(values: Any) -> dict[str, float]:
    return dict(zip(NUMBERS, map(float, values), strict=True))


def _paper(calib: Any, f_b: Array, readings: Array) -> dict[str, Any]:
    """Table 7."""
    g = float(np.linalg.norm(f_b, axis=1).mean())
    sf, bias = dict.fromkeys(NUMBERS, 0.0), dict.fromkeys(NUMBERS, 0.0)
    angles: dict[str, float] = {}
    for place, (group, letter, numbers) in enumerate(GROUPS):
        of_group = readings[POSES * place : POSES * (place + 1), [j - 1 for j in numbers]]
        found = calib.paper(group, g, T_S, np.ascontiguousarray(of_group.T))
        for i, j in enumerate(numbers):
            sf[str(j)], bias[str(j)] = float(found["sf"][i]), float(found["bias"][i]) / g
        angles |= {f"{letter}_{name}": float(np.degrees(a)) for name, a in zip(ANGLES, found["angles"], strict=True)}
    return {"sf": sf, "bias_g": bias, "angle_deg": angles}
