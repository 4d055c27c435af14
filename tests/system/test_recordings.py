"""Recordings: every format gives the same fixes, units and axes that cannot be are refused, damage is counted."""

import calendar
import gzip
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
import pytest
from libins.errors import UsageError
from libins.replay_config import GnssFile, ImuFile, WheelsFile

from libins import (
    recording,
    recording_check,
    recording_csv,
    recording_gnss,
    recording_imu,
)

WALK = Path(__file__).resolve().parents[1] / "data/walk_0827"
LEAP_S = 18.0
G = 9.80665
INSTANT = calendar.timegm((2025, 8, 28, 17, 30, 40, 0, 0, 0))
"""Of the first of the fixes below, on UTC's clock."""


def imu_file(path, rows=2000, period=0.01, change=None):
    """At rest, sensor x forward, y left, z up, in g and deg/s."""
    rng = np.random.default_rng(7)
    table = np.column_stack(
        [
            INSTANT + LEAP_S + np.arange(rows) * period,
            rng.normal(0, 1e-3, (rows, 2)),
            1.0 + rng.normal(0, 1e-3, rows),
            rng.normal(0, 0.1, (rows, 3)),
        ]
    )
    if change is not None:
        change(table)
    np.savetxt(path, table, delimiter=",", fmt="%.6f")
    return table


def load_imu(path, findings=None, **keys):
    given = {"force_unit": "g", "rate_unit": "deg/s", "axes": "x,-y,-z"} | keys
    return recording_imu.load(path, ImuFile(csv=path.name, **given), LEAP_S, findings or recording.Findings())


def test_an_imu_in_its_units_and_axes(tmp_path):
    table = imu_file(tmp_path / "imu.csv")
    imu = load_imu(tmp_path / "imu.csv")
    assert np.array_equal(imu.t, np.round(table[:, 0], 6))
    assert np.allclose(imu.force, table[:, 1:4] * G * [1, -1, -1], atol=1e-5)
    assert np.allclose(imu.rate, np.deg2rad(table[:, 4:7]) * [1, -1, -1], atol=1e-7)
    (tmp_path / "imu.csv.gz").write_bytes(gzip.compress((tmp_path / "imu.csv").read_bytes()))
    assert np.array_equal(load_imu(tmp_path / "imu.csv.gz").force, imu.force)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"force_unit": "m/s^2"}, ("imu.force_unit", "0.102 times", 'force_unit = "g" fits')),
        ({"axes": "x,y,z"}, ("imu.axes", 'axes = "x,-y,-z" would be')),
        ({"axes": "x,y,-z"}, ("is a reflection", "forward, right and down")),
        ({"axes": "forward"}, ("is no rotation", "'forward'")),
        ({"time_scale": 1e3}, ("imu.time", "10 s apart", "time_scale = 1e-3")),
        ({"columns": ["time", "fx", "fy", "fz", "wx", "wy", "gz"]}, ("'gz' is not known", "wz")),
        ({"columns": ["time", "fx", "fy", "fz", "wx", "wy"]}, ("wz missing",)),
    ],
)
def test_what_cannot_be_is_refused(tmp_path, keys, words):
    imu_file(tmp_path / "imu.csv")
    with pytest.raises(UsageError) as caught:
        load_imu(tmp_path / "imu.csv", **keys)
    for word in (str(tmp_path / "imu.csv"), *words):
        assert word in str(caught.value)


def test_degrees_taken_for_radians_are_refused(tmp_path):
    def turn(table):
        table[:, 6] = 40.0 * np.sin(np.arange(len(table)) / 50.0)

    imu_file(tmp_path / "imu.csv", change=turn)
    load_imu(tmp_path / "imu.csv")
    with pytest.raises(UsageError, match='rate_unit = "deg/s" may be right'):
        load_imu(tmp_path / "imu.csv", rate_unit="rad/s")


def test_damage_is_counted_and_survived(tmp_path):
    def damage(table):
        table[100, 2] = np.nan
        table[200:300, 0] += 0.2
        table[300:, 0] += 0.9
        table[400, 0] = table[399, 0]
        table[500:510, 0] -= 3.004
        table[600, 0] += 1e6
        table[700:900, 5] = 0.25

    path = tmp_path / "imu.csv"
    imu_file(path, change=damage)
    lines = path.read_text().splitlines()
    lines[50] = "power lost"
    path.write_text("\n".join(lines) + "\n")
    findings = recording.Findings()
    imu = load_imu(path, findings)
    assert np.all(np.diff(imu.t) > 0)
    assert len(imu.t) == 2000 - 1 - 1 - 1 - 10 - 1
    assert dict(findings.counts) == {
        "imu.csv: lines that cannot be read": 1,
        "imu.csv: rows that are not numbers": 1,
        "imu.csv: times that repeat": 1,
        "imu.csv: times that step back": 11,
        "imu.csv: gaps": 3,
        "imu.csv: wy stuck": 1,
    }
    assert "first line 51" in findings.notes[0]


def test_a_file_of_another_kind_is_refused(tmp_path):
    path = tmp_path / "imu.csv"
    path.write_text("time,a,b\n" + "1,2,3\n" * 10)
    with pytest.raises(UsageError, match=r"imu.csv:2: found '1,2,3', but 7 numbers"):
        load_imu(path)
    path.write_text("nothing\n")
    with pytest.raises(UsageError, match="holds no table of numbers"):
        load_imu(path)
    with pytest.raises(UsageError, match="cannot be read"):
        recording_csv.text_of(tmp_path / "none.csv")


def nmea_of(t, lat, lon, height, speed, course):
    """GGA and RMC of an instant on UTC's clock."""

    def sentence(body):
        total = 0
        for octet in body.encode():
            total ^= octet
        return f"${body}*{total:02X}\r\n"

    def angle(value, digits, halves):
        whole = int(abs(value))
        return f"{whole:0{digits}d}{(abs(value) - whole) * 60:010.7f},{halves[value < 0]}"

    clock = datetime.fromtimestamp(t, UTC)
    hms = clock.strftime("%H%M%S.") + f"{clock.microsecond // 10000:02d}"
    place = f"{angle(lat, 2, 'NS')},{angle(lon, 3, 'EW')}"
    return sentence(f"GNGGA,{hms},{place},4,17,0.8,{height + 17.0:.3f},M,-17.000,M,1.0,0000") + sentence(
        f"GNRMC,{hms},A,{place},{speed / (1852 / 3600):.3f},{course:.3f},{clock.strftime('%d%m%y')},,,R"
    )


def fixes():
    """Rows of t (UTC), latitude, longitude [deg], height, v_n, v_e, v_d."""
    k = np.arange(60)
    course = 0.3 + 0.05 * k
    v = np.column_stack([3.0 * np.cos(course), 3.0 * np.sin(course), np.zeros(60)])
    return np.column_stack([INSTANT + 0.25 * k, 40.0966916 + 1e-6 * k, -105.1471665 - 2e-6 * k, 1601.4 + 0.01 * k, v])


def write_pos(path, rows, utc=False, week=False):
    base = "UTC " if utc else "GPST"
    lines = [
        f"%  {base}  latitude(deg) longitude(deg)  height(m)   Q  ns   sdn(m)   sde(m)   sdu(m)  sdne(m)  sdeu(m) "
        "sdun(m) age(s)  ratio    vn(m/s)    ve(m/s)    vu(m/s)      sdvn     sdve     sdvu    sdvne    sdveu    sdvun"
    ]
    for t, lat, lon, height, vn, ve, vd in rows.tolist():
        t += 0.0 if utc else LEAP_S
        clock = datetime.fromtimestamp(t, UTC).strftime("%Y/%m/%d %H:%M:%S.%f")[:-3]
        since = t - recording.GPS_EPOCH_S
        stamp = f"{int(since // recording.WEEK_S)} {since % recording.WEEK_S:.3f}" if week else clock
        lines.append(
            f"{stamp} {lat:.9f} {lon:.9f} {height:.4f} 1 17 0.012 0.013 0.025 0 0 0 1.0 50.0 {vn:.5f} {ve:.5f} "
            f"{-vd:.5f} 0.03 0.04 0.06 0 0 0"
        )
    path.write_text("\n".join(lines) + "\n")


def write_ubx(path, rows):
    from pyubx2 import GET, UBXMessage

    out = b"$GNTXT,01,01,02,hello*00\r\n"
    for t, lat, lon, height, vn, ve, vd in rows.tolist():
        clock = datetime.fromtimestamp(round(t), UTC)
        nano = round((t - round(t)) * 1e9)
        out += UBXMessage(
            "NAV", "NAV-PVT", GET, year=clock.year, month=clock.month, day=clock.day, hour=clock.hour, min=clock.minute,
            second=clock.second, nano=nano, validDate=1, validTime=1, fixType=3, gnssFixOk=1, carrSoln=2, numSV=17,
            lat=lat, lon=lon, height=round(height * 1e3), hAcc=17, vAcc=25, velN=round(vn * 1e3), velE=round(ve * 1e3),
            velD=round(vd * 1e3), sAcc=60, pDOP=1.2,
        ).serialize()  # fmt: skip
    path.write_bytes(out)


def load_gnss(path, **keys):
    return recording_gnss.load(path, GnssFile(file=path.name, **keys), LEAP_S, recording.Findings())


@pytest.mark.parametrize("kind", ["pos", "pos_utc", "pos_week", "nmea", "ubx", "csv", "csv_ecef"])
def test_every_format_gives_the_same_fixes(tmp_path, kind):
    rows, path, keys = fixes(), tmp_path / f"fixes.{kind}", {}
    if kind.startswith("pos"):
        write_pos(path, rows, utc=kind == "pos_utc", week=kind == "pos_week")
    elif kind == "nmea":
        course = np.rad2deg(np.arctan2(rows[:, 5], rows[:, 4])) % 360
        path.write_text("".join(nmea_of(*row[:4], 3.0, c) for row, c in zip(rows.tolist(), course, strict=True)))
    elif kind == "ubx":
        write_ubx(path, rows)
    elif kind == "csv":
        np.savetxt(path, rows, delimiter=";", fmt="%.9f", header="a header")
        keys = {"columns": ["time", "latitude_deg", "longitude_deg", "height_m", "vn", "ve", "vd"], "time": "unix_utc"}
    else:
        from libins import core

        llh = np.column_stack([np.deg2rad(rows[:, 1:3]), rows[:, 3]])
        np.savetxt(path, np.column_stack([rows[:, 0], core.geodesy_to_ecef(core.WGS84, llh)]), fmt="%.6f")
        keys = {"columns": ["time", "x_ecef_m", "y_ecef_m", "z_ecef_m"], "time": "unix_utc"}
    gnss = load_gnss(path, **keys)
    assert np.allclose(gnss.t, rows[:, 0] + LEAP_S, atol=1e-6)
    metres = np.abs(gnss.position - np.column_stack([np.deg2rad(rows[:, 1:3]), rows[:, 3]])) * [6.4e6, 6.4e6, 1.0]
    assert metres.max() < 0.02
    if kind != "csv_ecef":
        known = gnss.sigma_v > 0
        assert known[:, :2].all()
        assert known[:, 2].all() == (kind != "nmea")
        assert np.abs((gnss.velocity - rows[:, 4:7])[known]).max() < 2e-3
    if kind.startswith("pos"):
        assert np.allclose(gnss.sigma_p, [0.012, 0.013, 0.025])
        assert np.allclose(gnss.sigma_v, [0.03, 0.04, 0.06])
    if kind in ("nmea", "ubx"):
        assert set(gnss.quality) == {1.0}


def test_fixes_that_are_nowhere(tmp_path):
    rows = fixes()
    rows[:, 1:3] *= 1e7
    path = tmp_path / "fixes.csv"
    np.savetxt(path, rows, delimiter=",")
    with pytest.raises(UsageError, match="nowhere on Earth"):
        load_gnss(path, columns=["time", "latitude_deg", "longitude_deg", "height_m", "vn", "ve", "vd"])
    rows[:, 1:3] /= 1e7
    rows[10, 1] = 0.0
    rows[10, 2] = 0.0
    np.savetxt(path, rows, delimiter=",")
    assert len(load_gnss(path, columns=["time", "latitude_deg", "longitude_deg", "height_m"]).t) == 59


def test_a_week_number_that_rolled_over_and_one_time_base_against_the_other(tmp_path):
    imu_file(tmp_path / "imu.csv")
    imu = load_imu(tmp_path / "imu.csv")
    write_pos(tmp_path / "fixes.pos", fixes())
    gnss = load_gnss(tmp_path / "fixes.pos")
    findings = recording.Findings()
    old = recording.shifted(gnss, -recording.ROLLOVER_S)
    back = recording_check.rollover(old, imu.t, findings)
    assert np.allclose(back.t, gnss.t)
    assert findings.counts == {"fixes.pos: periods of 1024 weeks that its times were moved by": 1}
    recording_check.overlap(back, imu)
    with pytest.raises(UsageError, match="0.0 s in common"):
        recording_check.overlap(recording.shifted(gnss, 3600.0), imu)


def walk():
    keys = {"columns": ["time", "fx", "fy", "fz", "wx", "wy", "wz"], "rate_unit": "rad/s"}
    return load_imu(WALK / "imu_1730_sf.csv.gz", **keys), load_gnss(WALK / "gnss_1730_sf.pos")


def test_clocks_and_senses_against_the_course():
    imu, gnss = walk()
    assert "correlation 0.89" in recording_check.yaw_against_course(gnss, imu)
    late = recording.shifted(imu, 18.0)
    with pytest.raises(UsageError, match=r"come \+18\.\d s after the course.*time_offset_s = -18"):
        recording_check.yaw_against_course(gnss, late)
    mirrored = recording.Imu(imu.path, imu.t, imu.force, imu.rate * [1, 1, -1], False)
    with pytest.raises(UsageError, match="go against the course"):
        recording_check.yaw_against_course(gnss, mirrored)
    degrees = recording.Imu(imu.path, imu.t, imu.force, np.rad2deg(imu.rate), False)
    with pytest.raises(UsageError, match="rate_unit.*deg/s fits"):
        recording_check.yaw_against_course(gnss, degrees)


def test_a_receiver_whose_velocities_are_late():
    _, gnss = walk()
    late, told = recording_check.velocity_late(gnss)
    assert 0.11 <= late <= 0.14  # means over 0.25 s
    assert "older than its places" in told
    even = recording.Gnss(
        **(vars(gnss) | {"velocity": np.gradient(gnss.position, gnss.t, axis=0) * [6.36e6, 4.87e6, -1]})
    )
    assert recording_check.velocity_late(even) == (0.0, "")


def test_wheels(tmp_path):
    t = INSTANT + np.arange(50) * 0.1
    path = tmp_path / "wheels.csv"
    np.savetxt(path, np.column_stack([t, np.arange(50) * 20, np.full(50, -0.1)]), delimiter=",", fmt="%.3f")
    config = WheelsFile(
        csv="wheels.csv", columns=["time", "counts", "yaw_rate"], metres_per_count=0.05, yaw_rate_positive="left",
        time="unix_utc",
    )  # fmt: skip
    wheels = recording_imu.load_wheels(path, config, LEAP_S, recording.Findings())
    assert np.allclose(wheels.t, t + LEAP_S, atol=1e-3)
    assert np.allclose(wheels.speed[1:], 10.0, rtol=1e-3)
    assert np.allclose(wheels.yaw_rate, 0.1)
    with pytest.raises(UsageError, match="km/h"):
        recording_imu.load_wheels(path, WheelsFile(csv="", columns=["time", "speed", "-"]), 0.0, recording.Findings())


def test_the_longest_increasing_part():
    given = np.array([1.0, 2.0, 9.0, 3.0, 4.0, 4.0, 3.5, 5.0])
    assert given[recording.increasing(given)].tolist() in ([1, 2, 3, 4, 5], [1, 2, 3, 3.5, 5])
    tow = np.array([604799.0, 604799.5, 0.0, 0.5])
    assert np.diff(recording.unwrapped_tow(tow)).tolist() == [0.5, 0.5, 0.5]
