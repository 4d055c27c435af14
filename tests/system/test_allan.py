"""`ins allan`: deviation against AllanTools, terms against their closed forms, intervals against repeated runs."""

import json
import math
import os
import tomllib
from pathlib import Path

import allantools
import numpy as np
import pytest
from libins.allan_model import TERMS, Clusters, Term

from libins import _truth, allan, allan_data, allan_model, cli, replay_config, sim

ROOT = Path(__file__).resolve().parents[2]
BENCH = os.environ.get("INS_BENCH") == "1"
DT = 0.01
FITS = 60 if BENCH else 2
"""IMUs of three axes each, of which every interval is looked up."""
SAMPLES = 200_000 if BENCH else 60_000
REPEATS = 2000 if BENCH else 400
"""Records from which the variance of an estimate is taken."""
FINER = 10
CLOSED = {  # IEEE Std 952-1997, annex C
    "quantisation": lambda tau: 3 / tau**2,
    "random_walk": lambda tau: 1 / tau,
    "bias_instability": lambda tau: 2 * math.log(2) / math.pi + 0 * tau,
    "rate_random_walk": lambda tau: tau / 3,
    "rate_ramp": lambda tau: tau**2 / 2,
}


def white(rng: np.random.Generator, n: int, coefficient: float) -> np.ndarray:
    return coefficient / math.sqrt(DT) * rng.standard_normal(n)


def walk(rng: np.random.Generator, n: int, coefficient: float) -> np.ndarray:
    """Means over the samples of a walk in steps that are FINER."""
    fine = coefficient * math.sqrt(DT / FINER) * np.cumsum(rng.standard_normal(n * FINER))
    return fine.reshape(n, FINER).mean(axis=1)


def test_the_deviation_is_that_of_allantools():
    x = white(np.random.default_rng(1), 5000, 1e-3) + walk(np.random.default_rng(2), 5000, 1e-3)
    curve = allan.deviation([x], DT)
    tau, adev, _, _ = allantools.oadev(x, rate=1 / DT, data_type="freq", taus=curve.tau)
    assert np.allclose(tau, curve.tau) and len(tau) > 30
    assert np.allclose(adev, curve.adev, rtol=1e-10)


def test_stretches_are_not_joined():
    rng = np.random.default_rng(3)
    parts = [white(rng, n, 1e-3) for n in (4000, 2500, 900)]
    curve = allan.deviation([part + 5.0 * i for i, part in enumerate(parts)], DT)
    at = int(np.argmin(np.abs(curve.tau - 0.2)))
    sums, counts = 0.0, 0
    for part in parts:
        _, adev, _, n = allantools.oadev(part, rate=1 / DT, data_type="freq", taus=[curve.tau[at]])
        sums, counts = sums + adev[0] ** 2 * n[0], counts + n[0]
    assert curve.avar[at] == pytest.approx(sums / counts, rel=1e-10)


@pytest.mark.parametrize("term", TERMS, ids=lambda term: term.name)
def test_a_term_adds_what_ieee_952_says(term: Term):
    tau = np.logspace(-2, 3, 26)
    assert np.allclose(term.avar(tau), CLOSED[term.name](tau), rtol=1e-9)


def test_a_markov_process_peaks_as_ieee_952_says():
    tau = np.logspace(-2, 3, 2001)
    adev = np.sqrt(allan_model.markov(10.0).avar(tau))
    peak = int(np.argmax(adev))
    # 0.437 q_c sqrt(T_c) at 1.89 T_c, q_c^2 = 2 sigma^2 / T_c.
    assert tau[peak] == pytest.approx(18.9, rel=0.01)
    assert adev[peak] == pytest.approx(0.437 * math.sqrt(2.0), rel=2e-3)
    assert np.allclose(allan_model.filtered(1e-6).avar(tau), allan_model.RANDOM_WALK.avar(tau), rtol=1e-3)


@pytest.mark.parametrize("kind", ["random_walk", "rate_random_walk", "quantisation"])
def test_estimates_scatter_as_the_covariance_says(kind: str):
    """Variances, and what neighbours have in common, over REPEATS records in two stretches."""
    rng = np.random.default_rng(4)
    lengths = (700, 300)
    m = allan.deviation([rng.standard_normal(n) for n in lengths], DT).clusters.m
    places = np.searchsorted(m, [1, 2, 5, 16, 30])
    m = tuple(np.array(m)[places].tolist())
    clusters = Clusters(DT, m, lengths)
    term = next(term for term in TERMS if term.name == kind)
    want = allan_model.covariance(allan_model.products([term], clusters), np.ones(1))
    seen = []
    for _ in range(REPEATS):
        parts = []
        for n in lengths:
            angle = rng.standard_normal(n + 1)
            parts.append(
                {"random_walk": white, "rate_random_walk": walk}[kind](rng, n, 1.0)
                if kind != "quantisation"
                else np.diff(angle) / DT
            )
        curve = allan.deviation(parts, DT)
        seen.append(curve.avar[places])
    got = np.cov(np.array(seen).T)
    # 4.5 standard deviations of the variance of a sample of chi-squares with ten degrees of freedom.
    bound = 4.5 * math.sqrt(3.2 / REPEATS)
    assert np.abs(np.diag(got) / np.diag(want) - 1).max() < bound
    scale = np.sqrt(np.outer(np.diag(want), np.diag(want)))
    assert np.abs((got - want) / scale).max() < bound


def rates(config: _truth.ImuConfig) -> np.ndarray:
    still = np.zeros((SAMPLES, 3))
    return _truth.ImuErrors(config).apply(still, still, DT)["theta"] / DT


def test_intervals_hold_the_coefficients_of_the_error_model():
    """Records of ins_truth/imu.h: of all 95 % intervals 95 % hold, within 3 standard deviations of a binomial."""
    true = {
        "quantisation": 2e-5 / math.sqrt(12),
        "random_walk": 1e-4,
        "bias_instability": 1e-4,
        "rate_random_walk": 2e-5,
    }
    held = dict.fromkeys(true, 0)
    for seed in range(1, FITS + 1):
        config = _truth.ImuConfig()
        config.seed = seed
        config.gyro.quantum = 2e-5
        for name in ("random_walk", "bias_instability", "rate_random_walk"):
            setattr(config.gyro, name, [true[name]] * 3)
        for column in rates(config).T:
            fit = allan.coefficients(allan.deviation([column], DT))
            assert fit.lag_s == 0
            for name, value in true.items():
                c = fit[name]
                assert c.low <= c.value <= c.high
                held[name] += c.low <= value <= c.high
    count = 3 * FITS
    least = 0.95 * count - 3 * math.sqrt(count * 0.95 * 0.05)
    assert min(held.values()) >= least, f"{held} of {count}, seeds 1 .. {FITS}"


def test_filtered_samples_are_seen_and_do_not_move_the_random_walk():
    rng = np.random.default_rng(5)
    lag_s, keep = 0.04, math.exp(-DT / 0.04)
    noise = white(rng, 100_000, 1e-3)
    x = np.empty_like(noise)
    last = 0.0
    for i, value in enumerate(noise.tolist()):
        last = keep * last + (1 - keep) * value
        x[i] = last
    fit = allan.coefficients(allan.deviation([x], DT))
    assert fit.lag_s == pytest.approx(lag_s, rel=0.2)
    assert fit["random_walk"].value == pytest.approx(1e-3, rel=0.03)


def test_a_gauss_markov_bias_is_found():
    config = _truth.ImuConfig()
    config.gyro.random_walk = [1e-4] * 3
    config.gyro.markov = [3e-4] * 3
    config.gyro.markov_tau_s = 5.0
    curves = [allan.deviation([column], DT) for column in rates(config).T]
    found = allan.gauss_markov(curves, [allan.coefficients(curve) for curve in curves])
    assert found.tau_s == pytest.approx(5.0, rel=0.35) and not found.at_limit
    assert found.sigma == pytest.approx([3e-4] * 3, rel=0.25)
    assert found.random_walk == pytest.approx([1e-4] * 3, rel=0.05)


def record(path, moving: bool) -> np.ndarray:
    """120 s at 100 Hz in deg/s and g; with motion from 40 to 50 s, and a gap of 5 s at 80 s."""
    rng = np.random.default_rng(6)
    n = 12_000
    t = np.arange(n) * DT + np.where(np.arange(n) >= 8000, 5.0, 0.0)
    rate, force = 0.05 * rng.standard_normal((n, 3)), [0, 0, 1] + 1e-3 * rng.standard_normal((n, 3))
    if moving:
        rate[4000:5000] += 20 * np.sin(np.arange(1000) * DT)[:, None]
    rows = np.column_stack([t, force, rate])
    np.savetxt(path, rows, delimiter=",", header="t,ax,ay,az,gx,gy,gz", comments="")
    return rows


OPTIONS = ["--force-unit", "g", "--rate-unit", "deg/s"]


def test_the_command_writes_what_the_others_read(tmp_path, capsys):
    path = tmp_path / "still.csv"
    record(path, moving=False)
    files = {name: tmp_path / f"out.{name}" for name in ("json", "toml", "html")}
    command = ["allan", str(path), *OPTIONS, "--json", str(files["json"]), "--toml", str(files["toml"])]
    assert cli.main([*command, "--report", str(files["html"])]) == 0
    printed = capsys.readouterr().out
    assert printed.startswith("120.0 s at rest in 2 stretches, 100.00 Hz")
    result = json.loads(files["json"].read_text())
    arw, vrw = math.radians(0.05) * math.sqrt(DT), 1e-3 * 9.80665 * math.sqrt(DT)
    for axis in "xyz":
        assert result["columns"][f"w{axis}"]["random_walk"]["value"] == pytest.approx(arw, rel=0.05)
        assert result["columns"][f"f{axis}"]["random_walk"]["value"] == pytest.approx(vrw, rel=0.05)
    table = tomllib.loads(files["toml"].read_text())
    config = _truth.ImuConfig()
    for name, value in table["imu"]["gyro"].items():
        setattr(config.gyro, name, value)
    assert config.gyro.random_walk == pytest.approx([arw] * 3, rel=0.05)
    assert sim.Triad(**table["imu"]["accel"]).random_walk == pytest.approx([vrw] * 3, rel=0.05)
    noise = replay_config.Noise(**table["noise"])
    assert noise.arw_rad_rts == pytest.approx(arw, rel=0.05)
    assert noise.vrw_m_s_rts == pytest.approx(vrw, rel=0.05)
    page = files["html"].read_text()
    assert page.count("<svg") == 2 and "bias instability" in page


def test_motion_is_refused_or_left_out(tmp_path, capsys):
    path = tmp_path / "moving.csv"
    rows = record(path, moving=True)
    assert cli.main(["allan", str(path), *OPTIONS]) == 2
    assert "the sensor moves, first about 40.0 s after the start" in capsys.readouterr().err
    declared = allan_data.Declared(["time", "fx", "fy", "fz", "wx", "wy", "wz"], "g", "deg/s", 1.0, None, False)
    found = allan_data.load(path, declared, (0.0, math.inf), True)
    # One window beside the motion goes with it; a gap ends a stretch.
    assert found.starts_s == pytest.approx([0.0, 51.0, 85.0])
    assert [len(x) for x in found.stretches["wx"]] == [3900, 2900, 4000]
    assert np.allclose(found.stretches["wx"][1], np.radians(rows[5100:8000, 4]))


BAD = [
    (["--rate-unit", "rpm"], "--rate-unit 'rpm': one of rad/s, deg/s is needed"),
    (["--force-unit", "x g"], "--force-unit 'x g': one of m/s^2, g, mg is needed"),
    (["--columns", "time,gx"], "columns: 'gx' is not known here"),
    (["--columns", "time,-"], "none of fx, fy, fz, wx, wy, wz is among them"),
    (["--columns=-,fx"], "no column is `time`"),
    (["--columns", "fx,time"], "times must increase"),
    (["--tau-s", "5"], "--tau-s 5: two times in seconds are needed"),
    (["--tau-s", "1e3:1e4"], "widen --tau-s"),
    (["--from-s", "900"], "no sample lies in --from-s 900"),
    (["--rate-hz=-1", "--columns=-,fx"], "--rate-hz -1.0: samples a second are needed"),
]


@pytest.mark.parametrize(("more", "message"), BAD, ids=lambda value: " ".join(value) if isinstance(value, list) else "")
def test_bad_input_is_refused(more: list[str], message: str, tmp_path, capsys):
    path = tmp_path / "still.csv"
    record(path, moving=False)
    assert cli.main(["allan", str(path), *OPTIONS, *more, "--json", str(tmp_path / "out.json")]) == 2
    assert message in capsys.readouterr().err
    assert not (tmp_path / "out.json").exists()


def test_halves_of_a_real_recording_agree():
    """The multi-position recording of an Xsens MTi, codes of its gyros: what lies between the turns."""
    path = ROOT / "tests/data/imu_tk_xsens/xsens_gyro.mat.gz"
    declared = allan_data.Declared(["time", "wx", "wy", "wz"], "g", "rad/s", 1.0, None, False)
    halves = [allan_data.load(path, declared, span, True) for span in ((0.0, 256.0), (256.0, math.inf))]
    assert min(half.seconds for half in halves) > 80 and min(len(half.starts_s) for half in halves) > 8
    for axis in ("wx", "wy", "wz") if BENCH else ("wx",):
        first, second = (
            allan.coefficients(allan.deviation(half.stretches[axis], half.dt))["random_walk"] for half in halves
        )
        assert first.value == pytest.approx(2.8, rel=0.15)  # codes sqrt(s): 28 codes at 100 Hz, seen in each window
        assert abs(first.value - second.value) < (first.high - first.low) / 2 + (second.high - second.low) / 2


def test_a_constant_column_is_refused(tmp_path, capsys):
    path = tmp_path / "constant.csv"
    np.savetxt(path, np.column_stack([np.arange(1000) * DT, np.ones(1000)]), delimiter=",")
    assert cli.main(["allan", str(path), "--columns", "time,fx"]) == 2
    assert "column fx: the samples are constant" in capsys.readouterr().err
