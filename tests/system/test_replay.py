"""`ins replay`: a real walk, drives through a town, damaged recordings, the smoother and every file that it writes."""

import json
import os
import shutil
import xml.etree.ElementTree
from pathlib import Path

import drive_kit
import numpy as np
import pytest
from libins.errors import UsageError

from libins import _post, alignment, replay, replay_config, replay_score

WALK = Path(__file__).resolve().parents[1] / "data/walk_0827"
POTSDAMER = WALK.parent / "smartloc_potsdamer/potsdamer.toml"
BENCH = "INS_BENCH" in os.environ
SEEDS = range(1, 13 if BENCH else 2)
SECONDS = 549.0 if BENCH else 200.0
KF_GINS_MEDIAN_M, KF_GINS_MAX_M = 2.17, 15.03
"""Of 15-s outages on another car's drive with the same kind of sensors: what ours must stay below on ours."""


def quiet(_share):
    pass


def solved(path, **overrides):
    config = replay_config.load(path, overrides)
    drive = replay.read(config, path.parent)
    solution = replay.solve(config, drive, quiet)
    return config, drive, solution, replay_score.summary(config, drive, solution)


@pytest.fixture(scope="module")
def walk():
    return solved(WALK / "walk.toml", smooth=True, **{"outages.phases": 10})


def test_a_walk_with_outages(walk):
    result = walk[3]
    outages = result["outages"]
    assert outages["count"] == 31
    assert outages["median_m"] < 2.5
    assert outages["max_m"] < 5.0
    assert result["aided"]["horizontal_rms_m"] < 0.03
    assert result["innovation"]["horizontal_rms_m"] < 0.3
    assert all(0.1 < result["nis"][name]["mean"] < 1.2 for name in ("n", "e", "d", "vn", "ve", "vd"))
    moving = [o for o in outages["list"] if o["speed_m_s"] > 0.5]
    normalised = np.array([o["end_m"] / o["sigma_m"] for o in moving])
    assert np.sqrt(np.mean(normalised**2)) < 2.0, "the filter is surer than it may be"
    assert result["files"] == {}


def test_the_smoother_bridges_outages(walk):
    _, _, solution, result = walk
    ends = [o["end_m"] for o in result["outages"]["list"] if o["phase"] == 0 and o["speed_m_s"] > 0.5]
    assert min(ends) > 1.0
    assert result["smoothed"]["withheld_max_m"] < 0.2 * max(ends)
    assert result["smoothed"]["aided_rms_m"] < 0.03
    smoothed, states = solution.runs[0].smoothed, solution.runs[0].states
    columns = [replay.STATE[f"sigma_{axis}_m"] for axis in "ned"]
    for column in columns:
        narrowed = np.interp(states[:, 0], smoothed[:, 0], smoothed[:, column])
        assert np.all(narrowed <= 1.05 * states[:, column] + 1e-3), "more measurements, and less sure"
    assert smoothed[-1, 0] >= states[-1, 0]
    assert np.allclose(smoothed[-1, 4:11], states[-1, 4:11], atol=1e-3), "both end alike, at rest"


@pytest.mark.parametrize("seed", SEEDS)
def test_drives_never_seen(tmp_path, seed):
    """The default configuration: no figure of it is of these drives."""
    *_, result = solved(drive_kit.write(tmp_path, seed, SECONDS))
    outages = result["outages"]
    print(
        f"seed {seed}: {outages['count']} outages, end median {outages['median_m']:.2f} m, max {outages['max_m']:.2f} m"
    )
    assert outages["count"] >= (11 if BENCH else 3)
    assert outages["median_m"] < KF_GINS_MEDIAN_M
    assert outages["max_m"] < KF_GINS_MAX_M / 2
    assert result["aided"]["horizontal_rms_m"] < 0.3
    assert any("ahead of the axle; slips" in note for note in result["notes"])


def test_scale_factors_are_found(tmp_path, monkeypatch):
    """Gyros that read 1.5 % too much about all axes: the vertical one turns the car."""
    usual = drive_kit.imu_config

    def wrong(seed):
        config = usual(seed)
        config.gyro.scale = [0.015] * 3
        return config

    monkeypatch.setattr(drive_kit, "imu_config", wrong)
    path = drive_kit.write(tmp_path, 5, SECONDS)
    result = solved(path, **{"noise.scale_g": 0.01, "noise.scale_a": 0.005})[3]
    notes = [note for note in result["notes"] if "too much" in note]
    assert [note.split()[0] for note in notes] == ["gyros", "accelerometers"]
    found, to = (float(part.split(",")[2].split()[0]) for part in notes[0].split(" too much, to "))
    print(notes[0])
    assert to < 0.3
    assert abs(found - 1.5) < 3.0 * to


def test_wheels_hold_an_outage(tmp_path):
    path = drive_kit.write(tmp_path, 2, SECONDS)
    alone = solved(path)[3]["outages"]
    helped = solved(path, wheels={"csv": "wheels.csv"})[3]["outages"]
    assert helped["count"] == alone["count"]
    assert helped["rms_m"] < 0.7 * alone["rms_m"]


def test_another_axis_called_forward(tmp_path):
    """The sensor's right as forward: a car that seems to drive sideways is turned as it drives."""
    path = drive_kit.write(tmp_path, 3, SECONDS)
    *_, result = solved(path, **{"imu.axes": "-y,-x,-z", "gnss.lever_arm_m": [0.0, 0.4, -1.1]})
    told = next(note for note in result["notes"] if note.startswith("mounted"))
    truth = np.rad2deg(drive_kit.mounting(3))
    assert float(told.split()[1]) == pytest.approx(truth[2] + 90.0, abs=0.6)
    assert result["outages"]["median_m"] < KF_GINS_MEDIAN_M


def test_how_the_imu_is_mounted(tmp_path):
    config, drive, _, result = solved(drive_kit.write(tmp_path, 3, SECONDS))
    truth = np.rad2deg(drive_kit.mounting(3))
    told = next(note for note in result["notes"] if note.startswith("mounted"))
    words = told.replace("mounted ", "").split(", ")
    assert float(words[0].split()[0]) == pytest.approx(truth[2], abs=0.4)
    assert float(words[1].split()[0]) == pytest.approx(truth[1], abs=0.4)
    assert float(words[2].split()[0]) == pytest.approx(drive_kit.AHEAD_M, abs=0.6)


def damaged_walk(folder, change_imu=None, change_pos=None):
    import gzip

    for name in ("walk.toml", "gnss_1730_sf.pos"):
        shutil.copy(WALK / name, folder / name)
    lines = gzip.decompress((WALK / "imu_1730_sf.csv.gz").read_bytes()).decode().splitlines()
    if change_imu is not None:
        change_imu(lines)
    (folder / "imu_1730_sf.csv.gz").write_bytes(gzip.compress("\n".join(lines).encode(), compresslevel=1))
    if change_pos is not None:
        path = folder / "gnss_1730_sf.pos"
        fixes = path.read_text().splitlines()
        change_pos(fixes)
        path.write_text("\n".join(fixes) + "\n")
    return folder / "walk.toml"


def test_damaged_recordings_are_survived(tmp_path):
    def imu(lines):
        lines[8000:8060] = []  # 0.4 s
        lines[9000] = lines[8990]
        lines[10000] = "1756402300.1,nan,0,1,0,0,0,0,0,0,0"
        lines[11000] = "garbage"
        stuck = [line.split(",") for line in lines[12000:12300]]
        lines[12000:12300] = [",".join([*row[:4], "0.2000000", *row[5:]]) for row in stuck]

    def pos(fixes):
        fixes[200] = fixes[200].replace(" 40.0", " 41.0", 1)  # 100 km off
        fixes[300] = fixes[299]
        fixes[310] = "% a comment"

    *_, result = solved(damaged_walk(tmp_path, imu, pos))
    files, filter_counts = result["files"], result["filter_counts"]
    assert files["imu_1730_sf.csv.gz: gaps"] == 1
    backward = [files.get(f"imu_1730_sf.csv.gz: times that {how}", 0) for how in ("step back", "repeat")]
    assert sum(backward) == 1
    assert files["imu_1730_sf.csv.gz: rows that are not numbers"] == 1
    assert files["imu_1730_sf.csv.gz: lines that cannot be read"] == 1
    assert files["imu_1730_sf.csv.gz: wx stuck"] == 1
    assert files["gnss_1730_sf.pos: times that repeat"] == 1
    assert filter_counts["positions outside the gate"] >= 1
    assert filter_counts["axes that went dead"] == 1
    assert filter_counts["gaps bridged"] >= 1
    assert result["outages"]["max_m"] < 15.0
    assert result["aided"]["horizontal_rms_m"] < 0.2
    assert result["aided"]["refused"] >= 1


def test_a_long_gap_starts_again(tmp_path):
    def imu(lines):
        lines[10000:11000] = []  # 6.5 s

    *_, result = solved(damaged_walk(tmp_path, imu), **{"outages.start_s": 90.0})
    assert len(result["starts"]) == 2
    assert result["aided"]["horizontal_rms_m"] < 0.1


def test_a_drive_that_does_not_move_is_refused(tmp_path):
    def imu(lines):
        del lines[1600:]

    with pytest.raises(UsageError, match="velocity has to change"):
        solved(damaged_walk(tmp_path, imu))


def test_outage_windows(tmp_path):
    config = replay_config.load(WALK / "walk.toml", {"outages.phases": 3, "outage": [{"from_s": 1.0, "to_s": 4.0}]})
    drive = replay.read(config, WALK)
    first, last = drive.span
    spans = replay.windows(config, drive, replay.phases(config.outages)[1])
    assert spans[0] == (first + 1.0, first + 4.0)
    assert spans[1:] == [(first + 40.0 + 30.0 * k, first + 50.0 + 30.0 * k) for k in range(3)]
    assert spans[-1][1] <= last


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("outages.period_s", "5", ("outages.period_s", "nothing would be left")),
        ("gnss.lever_arm_m", "[1.0]", ("gnss.lever_arm_m", "3 numbers")),
        ("imu.force_unit", '"furlong"', ("imu.force_unit", "'m/s^2', 'g', 'mg'")),
        ("imu.csv", '"none.csv"', ("none.csv", "cannot be read")),
        ("filter", '"magic"', ("filter", "'gps_ins'")),
        ("noise.scale_g", "0.2", ("noise.scale_g", "0.1")),
    ],
)
def test_a_wrong_configuration(ins, key, value, words):
    done = ins("replay", WALK / "walk.toml", "--set", f"{key}={value}")
    assert done.returncode == 2, done.stderr
    assert "Traceback" not in done.stderr
    for word in words:
        assert word in done.stderr


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("--smooth",), ("smooth", "no smoother", "gps_ins")),
        (("--set", 'filter="gps_ins"'), ("imu", "is missing", "gps_dr")),
        (("--set", 'wheels.columns=["time", "speed", "-"]'), ("odometry.csv", "no yaw_rate")),
        (("--set", "gps_dr.uere_m=0"), ("gps_dr.uere_m", "0")),
        (("--set", "gps_dr.tau_fix_s=nan"), ("gps_dr.tau_fix_s", "nan")),
    ],
)
def test_what_dead_reckoning_cannot_do(ins, change, words):
    done = ins("replay", POTSDAMER, *change)
    assert done.returncode == 2, done.stderr
    assert "Traceback" not in done.stderr
    for word in words:
        assert word in done.stderr


def test_dead_reckoning_needs_wheels(ins):
    done = ins("replay", WALK / "walk.toml", "--set", 'filter="gps_dr"')
    assert done.returncode == 2
    assert "wheels: is missing" in done.stderr


def test_every_file_of_dead_reckoning(ins, tmp_path):
    names = {name: tmp_path / f"drive.{name}" for name in ("csv", "geojson", "html", "json")}
    done = ins("replay", POTSDAMER, *(part for name, path in names.items() for part in (f"--{name}", path)))
    assert done.returncode == 0, done.stderr
    table = np.genfromtxt(names["csv"], delimiter=",", names=True)
    assert np.isfinite(table["heading_deg"]).all()
    assert np.isnan(table["ba_x_m_s2"]).all(), "not estimated"
    assert len(table) > 2800
    json.loads(names["json"].read_text(), parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))
    assert names["html"].read_text().count("<svg") == 3


def test_the_smoother_refuses_scale_factors():
    with pytest.raises(UsageError, match=r"noise\.scale_a.*found 0\.01, but the smoother"):
        replay_config.load(WALK / "walk.toml", {"smooth": True, "noise.scale_a": 0.01})


def test_every_file(ins, tmp_path):
    names = {name: tmp_path / f"walk.{name}" for name in ("csv", "kml", "geojson", "html", "json")}
    options = [part for name, path in names.items() for part in (f"--{name}", path)]
    done = ins("replay", WALK / "walk.toml", "--smooth", *options)
    assert done.returncode == 0, done.stderr
    assert "outages   4: error at the end median" in done.stdout
    result = json.loads(names["json"].read_text())
    table = np.genfromtxt(names["csv"], delimiter=",", names=True)
    assert np.all(np.diff(table["time_gps_s"]) > 0)
    assert abs(table["latitude_deg"] - 40.0967).max() < 1e-3
    assert table["withheld"].max() == 1.0
    assert len(table) > 10 * result["seconds"] - 20
    collection = json.loads(names["geojson"].read_text())
    marks = [feature["properties"]["withheld"] for feature in collection["features"]]
    assert sum(marks) == 4
    assert collection["features"][0]["geometry"]["coordinates"][0][0] == pytest.approx(-105.147, abs=1e-2)
    lines = [e for e in xml.etree.ElementTree.parse(names["kml"]).iter() if e.tag.endswith("LineString")]
    assert len(lines) == len(marks)
    page = names["html"].read_text()
    assert page.count("<svg") == 3
    assert "without fixes" in page
    assert "http://" not in page.replace("http://www.w3.org", "").replace("http://purl.org", "").replace(
        "http://creativecommons.org", ""
    ), "a report is offline"
    assert not list(tmp_path.glob("*.part"))
    again = tmp_path / "again.csv"
    assert ins("replay", WALK / "walk.toml", "--smooth", "--csv", again).returncode == 0
    assert again.read_bytes() == names["csv"].read_bytes(), "the same every time"


def test_events_that_are_not_in_order_are_refused():
    config = replay_config.load(WALK / "walk.toml", {})
    drive = replay.read(config, WALK)
    given = replay.increments(drive.imu)
    start = alignment.align(given, drive.gnss, False, np.zeros(3))
    filter_ = _post.GpsIns(
        {}, start.t, start.q_nb.tolist(), start.v_n.tolist(), start.position.tolist(), start.gyro_bias.tolist(),
        start.sigma.tolist(),
    )  # fmt: skip
    rows = np.ascontiguousarray(np.column_stack([given.t, given.period, given.theta, given.v]))[::-1].copy()
    none = np.zeros((0, len(_post.FIX_COLUMNS)))
    with pytest.raises(ValueError, match="not in order"):
        _post.Replay(filter_, rows, np.zeros((0, 4)), none, 0.1)
    with pytest.raises(ValueError, match="18 columns"):
        _post.Replay(filter_, rows, np.zeros((0, 4)), np.zeros((0, 3)), 0.1)
    with pytest.raises(ValueError, match="there are no nodes"):
        filter_.smooth()
