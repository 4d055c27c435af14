"""A replay's path as CSV, KML and GeoJSON."""

import io
import json
from typing import Any

import numpy as np

from libins import _post, core
from libins.errors import UsageError
from libins.recording import Array
from libins.replay import STATE

PATH_POINTS = 5000
"""More are thinned, in KML and GeoJSON."""
MARK = ("roll_deg", "pitch_deg", "heading_deg", "withheld")


def csv(states: Array, epoch_s: float, hidden: Array) -> str:
    """One line a state; times on GPS's clock since 1970. Columns as docs/replay.md says."""
    out = io.StringIO()
    names = ["time_gps_s", *_post.STATE_COLUMNS[1:]]
    names[1:3] = ["latitude_deg", "longitude_deg"]
    out.write(",".join([*names, *MARK]) + "\n")
    degrees = np.rad2deg(states[:, 1:3])
    euler = np.rad2deg(core.quat_to_euler(np.ascontiguousarray(states[:, STATE["q_w"] : STATE["q_z"] + 1])))
    for row, place, angles, mark in zip(
        states.tolist(), degrees.tolist(), euler.tolist(), hidden.tolist(), strict=True
    ):
        figures = ",".join(f"{value:.9g}" for value in (*row[3:], *angles))
        out.write(f"{epoch_s + row[0]:.6f},{place[0]:.10f},{place[1]:.10f},{figures},{int(mark)}\n")
    return out.getvalue()


def _parts(states: Array, hidden: Array) -> list[tuple[bool, list[tuple[float, float, float]]]]:
    """Stretches of path, and whether fixes were withheld on them; each begins where the one before ends."""
    step = max(1, len(states) // PATH_POINTS)
    place, mark = states[::step, 1:4], hidden[::step]
    points = list(
        zip(np.rad2deg(place[:, 1]).tolist(), np.rad2deg(place[:, 0]).tolist(), place[:, 2].tolist(), strict=True)
    )
    edges = [0, *(np.flatnonzero(np.diff(mark.astype(int))) + 1).tolist(), len(points)]
    return [
        (bool(mark[begin]), points[max(begin - 1, 0) : end])
        for begin, end in zip(edges[:-1], edges[1:], strict=True)
        if end > begin
    ]


def geojson(states: Array, hidden: Array, properties: dict[str, Any]) -> str:
    """A FeatureCollection of LineStrings (RFC 7946): longitude, latitude, height."""
    features = [
        {
            "type": "Feature",
            "properties": {"withheld": mark},
            "geometry": {
                "type": "LineString",
                "coordinates": [[round(x, 9), round(y, 9), round(h, 3)] for x, y, h in part],
            },
        }
        for mark, part in _parts(states, hidden)
        if len(part) > 1
    ]
    return json.dumps({"type": "FeatureCollection", "properties": properties, "features": features}) + "\n"


def kml(states: Array, hidden: Array, name: str) -> str:
    """Lines, red where fixes were withheld."""
    try:
        import simplekml
    except ImportError as error:
        raise UsageError("KML needs simplekml: pip install simplekml, or write GeoJSON") from error
    document = simplekml.Kml(name=name)
    for mark, part in _parts(states, hidden):
        line = document.newlinestring(name="no fixes" if mark else "aided", coords=part)
        line.altitudemode = simplekml.AltitudeMode.absolute
        line.style.linestyle.color = simplekml.Color.red if mark else simplekml.Color.blue
        line.style.linestyle.width = 3
    return str(document.kml())
