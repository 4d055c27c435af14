"""A recording behind a page: the solution of `ins replay` (CSV), or MCAP of `ins record`, played by the clock."""

import csv
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from libins import core, score
from libins.errors import UsageError
from libins.machine import PS_PER_S, Array
from libins.view_session import Asked, Json, Move

SOLUTION = ("time_gps_s", "latitude_deg", "longitude_deg")
"""The first columns of a solution."""
SUFFIXES = (".csv", ".mcap")
PATH_POINTS = 4000
"""Of the whole path, in the hello; more are thinned."""


@dataclass(frozen=True)
class Track:
    """What is shown: instants since the first [s], and a row of each for every instant; None: not recorded."""

    t_s: Array
    q_nb: Array
    llh: Array | None
    """rad, rad, m"""
    text: str
    """What it is, for people."""


def read_solution(path: Path) -> Track:
    """Of `ins replay --csv`. Raises UsageError."""
    try:
        with path.open(newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        names = tuple(rows[0])[:3] if rows else ()
        if names != SOLUTION:
            raise UsageError(
                f"{path}:1: found {','.join(names)}, but {','.join(SOLUTION)}, ... of ins replay is needed"
            )
        columns = {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
        height = next(name for name in columns if name.startswith("height"))
        q = np.column_stack([columns[f"q_{axis}"] for axis in "wxyz"])
    except (OSError, UnicodeDecodeError) as error:
        raise UsageError(f"{path}: cannot be read: {error}") from error
    except (ValueError, TypeError, KeyError, StopIteration) as error:
        raise UsageError(f"{path}: no solution of ins replay: {error}") from error
    llh = np.column_stack([np.deg2rad(columns[name]) for name in SOLUTION[1:]] + [columns[height]])
    return _checked(path, Track(columns[SOLUTION[0]] - columns[SOLUTION[0]][0], q, llh, f"solution of {len(q)} states"))


def read_mcap(path: Path) -> Track:
    """The first topic of it that has an attitude. Raises UsageError."""
    try:
        from libins.recording_mcap import Recording
    except ImportError as error:
        raise UsageError(f"{path}: recordings need {error.name}: pip install 'libins[record]'") from error
    with Recording(path) as recording:
        for name in recording.chosen([]):
            columns = recording.arrays(name)
            q = _attitude(columns)
            if q is not None and len(q):
                t_s = (columns["log_time_ns"] - columns["log_time_ns"][0]) * 1e-9
                return _checked(path, Track(t_s, q, _place(columns), f"{name}, {len(q)} messages"))
        topics = ", ".join(recording.topics) or "none"
    raise UsageError(f"{path}: no topic has an attitude (q_nb, or an orientation); topics: {topics}")


def _attitude(columns: Mapping[str, Array]) -> Array | None:
    if "q_nb" in columns:
        return columns["q_nb"]
    prefix = next((name.removesuffix("orientation.w") for name in columns if name.endswith("orientation.w")), None)
    if prefix is None:
        return None
    return np.column_stack([columns[f"{prefix}orientation.{axis}"] for axis in "wxyz"])


def _place(columns: Mapping[str, Array]) -> Array | None:
    llh = next((value for name, value in columns.items() if name.startswith("llh")), None)
    if llh is not None:
        return llh if np.isfinite(llh).all() else None
    both = next((value for name, value in columns.items() if name.startswith("lat_lon")), None)
    return None if both is None else np.column_stack([both, np.zeros(len(both))])


def _checked(path: Path, track: Track) -> Track:
    lengths = np.linalg.norm(track.q_nb, axis=1)
    if len(track.t_s) < 2 or (np.diff(track.t_s) < 0).any():
        raise UsageError(f"{path}: two rows or more, with times that do not go back, are needed")
    if not (np.abs(lengths - 1.0) < 1e-3).all():
        row = int(np.argmax(~(np.abs(lengths - 1.0) < 1e-3)))
        raise UsageError(f"{path}: row {row + 1}: its quaternion has length {lengths[row]:g}, but 1 is needed")
    return track


class RecordingEngine:
    """One recording; see view_session.Engine."""

    def __init__(self, path: Path) -> None:
        """At its begin. Raises UsageError."""
        self._path = path
        self._track = read_mcap(path) if path.suffix == ".mcap" else read_solution(path)
        self._now_ps = 0
        self._end_ps = round(float(self._track.t_s[-1]) * PS_PER_S)
        self._slice_ps = PS_PER_S // 100
        self._stop: Json | None = None
        self._rewound: int | None = None
        self.moves: Mapping[str, Move] = {"run": self._run, "to": self._to}
        self.commands: Mapping[str, Callable[[Asked], Json]] = {"reset": self._reset}

    @property
    def now_ps(self) -> int:
        """See Engine."""
        return self._now_ps

    def slice(self, ps: int) -> None:
        """See Engine."""
        self._slice_ps = ps

    def close(self) -> None:
        """See Engine."""

    def hello(self) -> Json:
        """See Engine."""
        nothing: Json = dict.fromkeys(
            ("wires", "parts", "lines", "knobs", "files", "functions", "registers", "memories"), []
        )
        return {
            **nothing,
            "title": f"{self._path.name}: {self._track.text}",
            "kind": "recording",
            "clock_hz": None,
            "stop_s": self._end_ps / PS_PER_S,
            "bauds": {},
            "faults": {},
            "has_source": False,
            "can_step": False,
            "navigator": True,
            "scenario_text": "",
            "path": self._path_en(),
        }

    def _path_en(self) -> list[list[float]]:
        """East and north of all of it [m]."""
        if self._track.llh is None:
            return []
        thinned = self._track.llh[:: max(1, len(self._track.llh) // PATH_POINTS)]
        return [self._en(llh) for llh in thinned]

    def _en(self, llh: Array) -> list[float]:
        assert self._track.llh is not None
        north, east = score.away_m(float(llh[0]), float(llh[1]), self._track.llh[0])
        return [east, north]

    def frame(self, whole: bool) -> Json:
        """See Engine."""
        track = self._track
        i = max(0, int(np.searchsorted(track.t_s, self._now_ps / PS_PER_S, side="right")) - 1)
        q = track.q_nb[i]
        euler = core.quat_to_euler(np.ascontiguousarray(q[None, :]))[0].tolist()
        told: Json = {
            "t_ps": self._now_ps,
            "stop": self._stop,
            "truth": None,
            "estimate": {"t_s": float(track.t_s[i]), "q": q.tolist(), "euler": euler, "w": None},
            "error": None,
            "position": None,
            "row": i,
        }
        if track.llh is not None and math.isfinite(track.llh[i, 0]):
            en = self._en(track.llh[i])
            told["position"] = {"llh": track.llh[i].tolist(), "en": en, "estimate": {"en": en}}
        if not whole and self._rewound is not None:
            told["rewound"], self._rewound = self._rewound, None
        return told

    def _run(self, asked: Asked, between: Callable[[], bool]) -> Json:
        self._stop, kind = None, "end"
        while self._now_ps < self._end_ps:
            self._now_ps = min(self._end_ps, self._now_ps + self._slice_ps)
            if between():
                kind = "interrupted"
                break
        self._stop = {"kind": kind, "notes": []}
        return {"stop": self._stop}

    def _to(self, asked: Asked, between: Callable[[], bool]) -> Json:
        self._seek(asked.whole("t_ps", 0, self._end_ps))
        self._stop = {"kind": "limit", "notes": []}
        return {"stop": self._stop}

    def _reset(self, asked: Asked) -> Json:
        self._seek(0)
        return {}

    def _seek(self, t_ps: int) -> None:
        if t_ps < self._now_ps:
            self._rewound = t_ps if self._rewound is None else min(self._rewound, t_ps)
        self._now_ps = t_ps
