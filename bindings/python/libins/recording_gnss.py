"""A receiver's fixes: RTKLIB's .pos, NMEA, u-blox NAV-PVT, or CSV whose columns the configuration names."""

import calendar
import io
import re
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from libins import core, recording_csv
from libins.errors import UsageError
from libins.recording import GPS_EPOCH_S, WEEK_S, Array, Findings, Gnss, in_order
from libins.replay_config import GnssFile, Reference

KNOT = 1852.0 / 3600.0
QUALITY_OF_GGA = {1: 5, 2: 4, 3: 5, 4: 1, 5: 2}
SIGMA_OF_QUALITY = {1: 0.02, 2: 0.3, 3: 1.0, 4: 1.0, 5: 3.0, 6: 0.2}
"""Horizontal at HDOP 1, of fixes that do not say their own [m]; the vertical one is VERTICAL times that."""
VERTICAL = 1.5
SIGMA_VELOCITY = 0.1
"""Of receivers that do not say it [m/s]."""
SPEED_MAX = 1000.0
HEIGHT = (-500.0, 1e5)
POS_COLUMNS = [
    "latitude(deg)", "longitude(deg)", "height(m)", "Q", "ns", "sdn(m)", "sde(m)", "sdu(m)", "sdne(m)", "sdeu(m)",
    "sdun(m)", "age(s)", "ratio", "vn(m/s)", "ve(m/s)", "vu(m/s)", "sdvn", "sdve", "sdvu", "sdvne", "sdveu", "sdvun",
]  # fmt: skip
"""Of a .pos file without a header."""
CSV_COLUMNS = (
    "time", "week", "tow", "latitude_deg", "longitude_deg", "height_m", "x_ecef_m", "y_ecef_m", "z_ecef_m", "sigma_m",
    "sigma_n_m", "sigma_e_m", "sigma_d_m", "vn", "ve", "vd", "vu", "sigma_v", "speed", "course_deg", "quality", "sats",
    "hdop",
)  # fmt: skip


def _gnss(path: Path, t: Array, position: Array, found: dict[str, Array]) -> Gnss:
    """Out of columns that may be there, by their names in a CSV."""
    rows = len(t)
    zero = np.zeros(rows)

    def named(*names: str) -> Array:
        return np.asarray(np.nan_to_num(np.column_stack([found.get(name, zero) for name in names])))

    quality = np.nan_to_num(found.get("quality", zero))
    if "sigma_n_m" in found:
        sigma_p = named("sigma_n_m", "sigma_e_m", "sigma_d_m")
    elif "sigma_m" in found:
        sigma_p = found["sigma_m"][:, None] / np.sqrt(3.0) * np.ones(3)
    else:
        level = np.array([SIGMA_OF_QUALITY.get(int(q), SIGMA_OF_QUALITY[5]) for q in quality])
        level = level * np.maximum(1.0, np.nan_to_num(found.get("hdop", zero)))
        sigma_p = np.column_stack([level, level, VERTICAL * level])
    velocity, sigma_v = np.zeros((rows, 3)), np.zeros((rows, 3))
    if "vn" in found and "ve" in found:
        down = found["vd"] if "vd" in found else -found.get("vu", np.full(rows, np.nan))
        velocity = np.column_stack([found["vn"], found["ve"], down])
    elif "speed" in found and "course_deg" in found:
        course = np.deg2rad(found["course_deg"])
        along = np.column_stack([np.cos(course), np.sin(course)])
        velocity = np.column_stack([found["speed"][:, None] * along, np.full(rows, np.nan)])
    if velocity.any():
        given = found.get("sigma_v", zero)
        stated = named("sigma_vn", "sigma_ve", "sigma_vd") if "sigma_vn" in found else np.tile(given, (3, 1)).T
        sigma_v = np.where(np.isfinite(velocity), np.where(stated > 0.0, stated, SIGMA_VELOCITY), 0.0)
    return Gnss(
        path, t, position, sigma_p, np.nan_to_num(velocity), sigma_v, quality, found.get("sats", zero),
        found.get("hdop", zero),
    )  # fmt: skip


def _geodetic(x: Array, y: Array, z: Array) -> Array:
    return np.asarray(core.geodesy_from_ecef(core.WGS84, np.column_stack([x, y, z])))


def _degrees(latitude: Array, longitude: Array, height: Array) -> Array:
    return np.column_stack([np.deg2rad(latitude), np.deg2rad(longitude), height])


def _pos_time(first: str, second: str) -> float:
    if "/" in first:
        year, month, day = (int(part) for part in first.split("/"))
        hour, minute, seconds = second.split(":")
        return calendar.timegm((year, month, day, int(hour), int(minute), 0)) + float(seconds)
    return GPS_EPOCH_S + WEEK_S * int(first) + float(second)


def _pos(path: Path, leap_s: float, time: str | None, findings: Findings) -> Gnss:
    """RTKLIB's, in latitude and longitude or in ECEF; the time base stands in its header."""
    names, utc = POS_COLUMNS, time == "unix_utc"
    rows: list[list[float]] = []
    bad: list[int] = []
    for number, line in enumerate(recording_csv.text_of(path).splitlines(), start=1):
        fields = re.split(r"[,;\s]+", line.strip())
        if line.startswith("%"):
            if len(fields) > 3 and any(name.startswith(("latitude", "x-ecef")) for name in fields):
                fields = fields[1:] if fields[0] == "%" else [fields[0].lstrip("%"), *fields[1:]]
                utc = utc or (time is None and fields[0] == "UTC")
                names = fields[1:]
        elif line.strip():
            try:
                rows.append([_pos_time(fields[0], fields[1]), *map(float, fields[2 : 2 + len(names)])])
                if len(rows[-1]) != 1 + len(names):
                    raise ValueError
            except (ValueError, IndexError):
                rows = rows if not rows or len(rows[-1]) == 1 + len(names) else rows[:-1]
                bad.append(number)
    if len(rows) < 2 or len(bad) > max(1.0, recording_csv.BAD_SHARE_MAX * len(rows)):
        line_number = bad[0] if bad else 1
        raise UsageError(
            f"{path}:{line_number}: not RTKLIB's .pos with the columns {', '.join(names)}; {len(bad)} lines are not "
            "like that. Is it another format (gnss.format), or angles in degrees, minutes and seconds?"
        )
    findings.add(f"{path.name}: lines that cannot be read", len(bad), f"first line {bad[0]}" if bad else "")
    values = np.array(rows)
    column = {name: values[:, 1 + i] for i, name in enumerate(names)}
    if "x-ecef(m)" in column:
        position = _geodetic(column["x-ecef(m)"], column["y-ecef(m)"], column["z-ecef(m)"])
        both = np.sqrt(sum(column.get(f"sd{axis}(m)", np.zeros(len(rows))) ** 2 for axis in "xyz"))
        found = {"sigma_m": both}
    else:
        position = _degrees(column["latitude(deg)"], column["longitude(deg)"], column["height(m)"])
        found = {
            f"sigma_{to}_m": column[f"sd{of}(m)"] for to, of in zip("ned", "neu", strict=True) if f"sd{of}(m)" in column
        }
        for axis, sign in (("n", 1.0), ("e", 1.0), ("u", -1.0)):
            if f"v{axis}(m/s)" in column:
                found["vd" if axis == "u" else f"v{axis}"] = sign * column[f"v{axis}(m/s)"]
            if f"sdv{axis}" in column:
                found["sigma_vd" if axis == "u" else f"sigma_v{axis}"] = column[f"sdv{axis}"]
    found |= {"quality": column.get("Q", np.zeros(len(rows))), "sats": column.get("ns", np.zeros(len(rows)))}
    return _gnss(path, values[:, 0] + (leap_s if utc else 0.0), position, found)


def _nmea(path: Path, leap_s: float, findings: Findings) -> Gnss:
    """GGA for place, RMC for date and velocity of the same time."""
    reader = core.Nmea()
    places: dict[int, tuple[float, ...]] = {}
    motions: dict[int, tuple[float, float]] = {}
    days: dict[int, tuple[int, int, int]] = {}
    order: list[int] = []
    day, last = -1, 86_400_000
    for fix in reader.rx(path.read_bytes()):
        if not fix.has & core.NMEA_TIME:
            continue
        if fix.time_ms < last - 43_200_000 or day < 0:
            day += 1  # midnight
        last = fix.time_ms
        key = day * 86_400_000 + fix.time_ms
        if fix.type == core.NMEA_GGA and fix.valid and fix.has & core.NMEA_POSITION and fix.has & core.NMEA_ALTITUDE:
            height = (fix.altitude_mm + (fix.geoid_mm if fix.has & core.NMEA_GEOID else 0)) * 1e-3
            places[key] = (fix.lat_e7 * 1e-7, fix.lon_e7 * 1e-7, height, QUALITY_OF_GGA.get(fix.quality, 5), fix.sats,
                           fix.hdop_milli * 1e-3)  # fmt: skip
            order.append(key)
        elif fix.type == core.NMEA_RMC and fix.valid:
            if fix.has & core.NMEA_SPEED:
                course = fix.course_mdeg * 1e-3 if fix.has & core.NMEA_COURSE else 0.0
                motions[key] = (fix.speed_milliknot * 1e-3 * KNOT, course)
            if fix.has & core.NMEA_DATE:
                days[day] = fix.date
    findings.add(f"{path.name}: sentences with a wrong checksum", reader.bad_checksum)
    findings.add(f"{path.name}: sentences that cannot be read", reader.malformed + reader.cut)
    if len(order) < 2:
        raise UsageError(f"{path}: {len(order)} usable GGA sentences; is it NMEA, and is there a fix in it?")
    if not days:
        raise UsageError(f"{path}: no RMC sentence says the date; record RMC beside GGA")
    known = min(days)
    date = days[known]
    midnight = calendar.timegm((2000 + date[2], date[1], date[0], 0, 0, 0)) - 86400.0 * known
    values = np.array([places[key] for key in order])
    motion = np.array([motions.get(key, (np.nan, np.nan)) for key in order])
    found = {"quality": values[:, 3], "sats": values[:, 4], "hdop": values[:, 5]}
    if motions:
        found |= {"speed": motion[:, 0], "course_deg": motion[:, 1]}
    return _gnss(path, midnight + np.array(order) * 1e-3 + leap_s, _degrees(*values[:, :3].T), found)


def _ubx(path: Path, leap_s: float, findings: Findings) -> Gnss:
    """NAV-PVT messages, whatever else lies between them."""
    try:
        from pyubx2 import ERR_IGNORE, UBX_PROTOCOL, UBXReader
    except ImportError as error:
        raise UsageError(f"{path}: reading UBX needs pyubx2: pip install pyubx2") from error
    rows: list[tuple[float, ...]] = []
    without = 0
    for _, message in UBXReader(io.BytesIO(path.read_bytes()), protfilter=UBX_PROTOCOL, quitonerror=ERR_IGNORE):
        if message is None or message.identity != "NAV-PVT":
            continue
        m = message
        if m.fixType not in (2, 3, 4) or not m.gnssFixOk or not (m.validDate and m.validTime):
            without += 1
            continue
        instant = datetime(m.year, m.month, m.day, m.hour, m.min, min(m.second, 59), tzinfo=UTC).timestamp()
        quality = {2: 1, 1: 2}.get(m.carrSoln, 4 if m.diffSoln else 5)
        rows.append(
            (
                instant + m.nano * 1e-9 + leap_s,
                m.lat,
                m.lon,
                m.height * 1e-3,
                quality,
                m.numSV,
                m.pDOP,
                m.hAcc * 1e-3 / np.sqrt(2.0),
                m.vAcc * 1e-3,
                m.velN * 1e-3,
                m.velE * 1e-3,
                m.velD * 1e-3,
                m.sAcc * 1e-3 / np.sqrt(3.0),
            )  # fmt: skip
        )
    findings.add(f"{path.name}: NAV-PVT without a fix or a date", without)
    if len(rows) < 2:
        raise UsageError(f"{path}: {len(rows)} usable NAV-PVT messages; is it UBX, and is there a fix in it?")
    v = np.array(rows)
    names = ("quality", "sats", "hdop", "sigma_n_m", "sigma_d_m", "vn", "ve", "vd", "sigma_v")
    found = dict(zip(names, v[:, 4:].T, strict=True))
    return _gnss(path, v[:, 0], _degrees(*v[:, 1:4].T), found | {"sigma_e_m": found["sigma_n_m"]})


def _csv(path: Path, config: GnssFile | Reference, leap_s: float, findings: Findings) -> Gnss:
    if not config.columns:
        raise UsageError(f"{path}: columns is missing; a CSV needs it: {', '.join(CSV_COLUMNS)}, '-' (unused)")
    found = recording_csv.table(path, config.columns, CSV_COLUMNS, findings)
    t = recording_csv.times(path, found, config.time or "unix_gps", leap_s)
    if "x_ecef_m" in found:
        position = _geodetic(*recording_csv.need(path, found, "x_ecef_m", "y_ecef_m", "z_ecef_m"))
    else:
        position = _degrees(*recording_csv.need(path, found, "latitude_deg", "longitude_deg", "height_m"))
    return _gnss(path, t, position, found)


def _format(path: Path) -> str:
    """By its first octets. Raises UsageError."""
    try:
        with path.open("rb") as file:
            head = file.read(4096)
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {error.strerror}; give the path of a recording") from error
    if b"\xb5\x62" in head:
        return "ubx"
    if re.search(rb"^\$[A-Z]{2}(GGA|RMC|VTG|GSA|GSV|GLL|TXT),", head, re.MULTILINE):
        return "nmea"
    if head.startswith(b"%") or re.match(rb"\s*\d{4}/\d\d/\d\d\s+\d\d:", head):
        return "pos"
    return "csv"


def load(path: Path, config: GnssFile | Reference, leap_s: float, findings: Findings) -> Gnss:
    """Read, convert, check. Raises UsageError."""
    kind = _format(path) if config.format == "auto" else config.format
    if kind == "pos":
        gnss = _pos(path, leap_s, config.time, findings)
    elif kind == "nmea":
        gnss = _nmea(path, leap_s, findings)
    elif kind == "ubx":
        gnss = _ubx(path, leap_s, findings)
    else:
        gnss = _csv(path, config, leap_s, findings)
    at = gnss.position
    wrong = (
        (np.abs(at[:, 0]) > np.pi / 2)
        | (np.abs(at[:, 1]) > 2 * np.pi)
        | (at[:, 2] < HEIGHT[0])
        | (at[:, 2] > HEIGHT[1])
    )
    wrong |= (at[:, :2] == 0.0).all(axis=1) | (np.linalg.norm(gnss.velocity, axis=1) > SPEED_MAX)
    if wrong.mean() > 0.5:
        first = np.rad2deg(at[wrong][0, :2]).round(7).tolist()
        raise UsageError(
            f"{path}: {wrong.sum()} of {len(wrong)} fixes are nowhere on Earth, the first at latitude, longitude "
            f"{first} deg, height {at[wrong][0, 2]:.1f} m; latitude and longitude are needed in degrees, height in m"
        )
    at[wrong] = np.nan
    gnss = in_order(gnss, findings)
    return type(gnss)(**(vars(gnss) | {"t": gnss.t + config.time_offset_s}))
