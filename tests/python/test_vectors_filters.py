"""kalman_pva and gps_dr, through Python."""

import numpy as np
import pytest
from reference import both, expect, load, real, tolerance, wrapped

from libins import core

# Double: rounding over the run. Float: measured in C, times about 2.
TOL_PVA = (1e-12, 3e-5)
"""Of an element over the largest of its kind in that step."""
TOL_STEADY = (1e-9, 1e-5)
TOL_STEADY_POS_VEL = 1e-5
"""That run still converges at its end: 2.4e-6."""
TOL_RMS_M = (1e-9, 2e-4)
TOL_MODEL = (1e-10, 2e-6)
"""The file's Phi and Q come from Van Loan's method, good to 1e-11."""
TOL_RUN = (1e-11, 2e-3)
"""Of an element over 1 or its own size."""
TOL_FUSION = (1e-12, 2e-5)
TOL_GPS_STEADY = (1e-7, 1e-3)
TOL_DEAD_RECKONING = (1e-15, 1e-6)
"""Of 100 m and of 1 rad."""
OUTAGE = slice(400, 500)
SMALLEST_SCALE = 1e-3
SIGMAS = 4


def expect_largest(got, want, limit, what):
    expect(got, want, limit, what, scale=max(SMALLEST_SCALE, np.max(np.abs(want))))


def expect_own_size(got, want, limit, what):
    expect(got, want, limit, what, scale=np.maximum(1, np.abs(want)))


@both
@pytest.mark.parametrize("form", ["Kalman", "Ud"])
@pytest.mark.parametrize("steps", ["steps", "steps_outage_400_499"])
def test_pva_as_the_generic_filter(ins, form, steps):
    file = load("kalman_pva.json")
    limit = tolerance(ins, *TOL_PVA)
    for run in file["runs"]:
        h, z = np.array(run["H"]), np.array(run["z"], dtype=np.float64)
        if steps != "steps":
            z[OUTAGE] = np.nan
        filter_ = getattr(ins, form)(real(ins, run["x0"]), real(ins, run["P0"]))
        noise = real(ins, np.diag(run["R"]))
        x, covariance, nis = filter_.run(real(ins, file["A"]), real(ins, file["Q"]), real(ins, h), noise, real(ins, z))
        assert len(run[steps]) > 0
        for step in run[steps]:
            k = step["k"]
            expect_largest(x[k], np.ravel(step["x"]), limit, f"x {k}")
            expect_largest(np.diag(covariance[k]), step["P_diag"], limit, f"P {k}")
            if step["P"] is not None:
                expect_largest(covariance[k], step["P"], limit, f"P {k}")
        if steps == "steps":
            error = x[:, 0].astype(np.float64) - np.array(file["truth"])[:, 0]
            expect(np.sqrt(np.mean(error**2)), run["rms_pos_err"], tolerance(ins, *TOL_RMS_M), "rms")
            steady = tolerance(ins, *TOL_STEADY) if len(h) == 1 else TOL_STEADY_POS_VEL
            expect_largest(filter_.P, run["steady"]["P_plus"], steady, "steady P")
            assert (nis > 0).all()
        else:
            assert not nis[OUTAGE].any()


@both
@pytest.mark.parametrize("form", ["Kalman", "Ud"])
def test_gains_of_single_updates(ins, form):
    file = load("kalman_pva.json")
    run = next(r for r in file["runs"] if len(r["H"]) == 1)
    filter_ = getattr(ins, form)(real(ins, run["x0"]), real(ins, run["P0"]))
    phi, noise, h = (real(ins, m) for m in (file["A"], file["Q"], run["H"][0]))
    gains = {}
    for k, z in enumerate(run["z"]):
        filter_.predict(phi, noise)
        gains[k], _ = filter_.update(h, z[0] - float(filter_.x[0]), run["R"][0][0])
    for step in run["steps"]:
        if step["K"] is not None:
            expect_largest(gains[step["k"]], np.ravel(step["K"]), tolerance(ins, *TOL_PVA), f"K {step['k']}")
    expect_largest(gains[len(run["z"]) - 1], np.ravel(run["steady"]["K"]), tolerance(ins, *TOL_STEADY), "steady K")


@both
def test_pva_module(ins):
    file = load("kalman_pva.json")
    limit = tolerance(ins, *TOL_PVA)
    for run in file["runs"]:
        pva = ins.Pva(real(ins, np.diag(run["P0"])))
        steps = {step["k"]: step for step in run["steps"]}
        for k, z in enumerate(run["z"]):
            pva.predict(file["T"], file["q"])
            for what in range(len(run["H"])):
                pva.update(what, z[what], run["R"][what][what])
            if k in steps:
                expect_largest(pva.x, np.ravel(steps[k]["x"]), limit, f"x {k}")
                expect_largest(np.diag(pva.P), steps[k]["P_diag"], limit, f"P {k}")
        if len(run["H"]) == 1:
            expect_largest(pva.K, np.ravel(run["steady"]["K"]), tolerance(ins, *TOL_STEADY), "steady K")


@both
def test_gps_axis(ins):
    g = load("gps_dr.json")["gps"]
    figures = {
        "dt": g["T"],
        "tau_acceleration": g["tau_a"],
        "tau_fix": g["tau_eps"],
        "sigma_acceleration": np.sqrt(g["sigma_a2"]),
        "sigma_fix": np.sqrt(g["sigma_eps2"]),
        "r": g["R"],
    }
    axis = ins.GpsAxis(real(ins, np.diag(g["P0"])), **figures)
    model = tolerance(ins, *TOL_MODEL)
    expect_own_size(axis.Phi, g["Phi"], model, "Phi")
    expect_own_size(axis.Q, g["Q"], model, "Q")
    expect_own_size(axis.u, g["U_current_stat"][:3], model, "U")
    twin = ins.GpsAxis(real(ins, np.diag(g["P0"])), **figures)
    x, nis = twin.step(real(ins, np.ravel(g["z"])))
    assert (nis > 0).all()
    limit = tolerance(ins, *TOL_RUN)
    steps = {step["k"]: step for step in g["steps"]}
    for k, z in enumerate(g["z"]):
        axis.step(real(ins, z[0]))
        assert np.array_equal(axis.x, x[k]), "one by one as in one call"
        if k in steps:
            expect_own_size(axis.x, steps[k]["x"], limit, f"x {k}")
            expect_own_size(np.diag(axis.P), steps[k]["P_diag"], limit, f"P {k}")
            expect_own_size(axis.K, np.ravel(steps[k]["K"]), limit, f"K {k}")
    axis.step(np.zeros(2000, dtype=ins.real))
    expect_own_size(axis.K, np.ravel(g["steady"]["K"]), tolerance(ins, *TOL_GPS_STEADY), "steady K")
    expect_own_size(axis.P, g["steady"]["P_plus"], tolerance(ins, *TOL_GPS_STEADY), "steady P")


@both
def test_dead_reckoning(ins):
    limit = tolerance(ins, *TOL_DEAD_RECKONING)
    for c in load("gps_dr.json")["dead_reckoning"]:
        out = ins.dead_reckoning(real(ins, [c["e"], c["n"], c["heading"]]), c["s"], c["dheading"])
        expect(out[:2], c["out"][:2], limit, "place", scale=100)
        expect(wrapped(float(out[2]) - c["out"][2]), 0.0, limit, "heading")


@both
def test_dr_ekf(ins):
    d = load("gps_dr.json")["dr"]
    ekf = ins.DrEkf(
        real(ins, d["x0"]),
        real(ins, np.diag(d["P0"])),
        dt=d["T"],
        tau=real(ins, [d["tau_e"], d["tau_n"]]),
        sigma=real(ins, np.sqrt(d["sigma2"])),
        r_rate=d["R"][0][0],
        r_distance=d["R"][1][1],
        v_min=d["vmin"],
        v_zero=d["vzero"],
    )
    expect_own_size(ekf.Phi, d["Phi"], tolerance(ins, *TOL_MODEL), "Phi")
    expect_own_size(ekf.Q, d["Q"], tolerance(ins, *TOL_MODEL), "Q")
    z = real(ins, d["z"])
    limit = tolerance(ins, *TOL_RUN)
    steps = {step["k"]: step for step in d["steps"]}
    done = 0
    for k in sorted(steps):
        x, _ = ekf.step(z[done:k, 0], z[done:k, 1])
        done = k
        expect_own_size(x[-1], steps[k]["x"], limit, f"x {k}")
        expect_own_size(np.diag(ekf.P), steps[k]["P_diag"], limit, f"P {k}")


@both
def test_unicycle(ins):
    u = load("gps_dr.json")["dr_unicycle"]
    noise = {"q_speed": u["qv"], "q_bias": u["qb"], "q_scale": u["qk"], "r_rate": u["rw"], "r_distance": u["rs"]}
    unicycle = ins.Unicycle(real(ins, u["x0"]), real(ins, np.diag(u["P0"])), **noise)
    rate, distance = (real(ins, [z[i] for z in u["z"]]) for i in (0, 1))
    fix = real(ins, [z[2] or (np.nan, np.nan) for z in u["z"]])
    limit = tolerance(ins, *TOL_RUN)
    done = 0
    for step in u["steps"]:
        part = slice(done, step["k"])
        x, nis = unicycle.run(u["T"], rate[part], distance[part], fix[part], u["Rgps"])
        assert np.array_equal(nis[:, 1] > 0, ~np.isnan(fix[part, 0]))
        done = step["k"]
        got = x[-1].astype(np.float64)
        got[2] = step["x"][2] + wrapped(got[2] - step["x"][2])
        expect_own_size(got, step["x"], limit, f"x {done}")
        expect_own_size(np.diag(unicycle.P), step["P_diag"], limit, f"P {done}")
    unicycle.run(u["T"], rate[done:], distance[done:], fix[done:], u["Rgps"])
    sigma = np.sqrt(float(unicycle.P[4, 4]))
    assert abs(float(unicycle.x[4]) - u["truth_bias"]) < SIGMAS * sigma


@both
def test_fusion(ins):
    limit = tolerance(ins, *TOL_FUSION)
    for c in load("gps_dr.json")["fusion"]:
        x, covariance = ins.fusion(real(ins, c["x"]), real(ins, c["P"]))
        expect_own_size(x, c["x_fused"], limit, "x")
        expect_own_size(covariance, c["P_fused"], limit, "P")
        for beta, want in zip(c["beta"], c["P_local_reset"], strict=True):
            expect_own_size(ins.fusion_share(covariance, beta), want, limit, "P shared")


@both
def test_switch(ins):
    s = load("gps_dr.json")["switch"]
    p, epochs, expected = s["params"], s["epochs"], s["expected"]
    switch = ins.Switch(hdop_max=p["hmax"], gate=p["gate"], sats=p["smin"], back=p["n_back"])
    modes = switch.epoch(
        [e["valid"] for e in epochs],
        [e["sats"] for e in epochs],
        real(ins, [e["hdop"] for e in epochs]),
        real(ins, [e["nis"] or 0.0 for e in epochs]),
    )
    assert ["GPS" if m == core.SWITCH_GPS else "DR" for m in modes] == [e["mode"] for e in expected]
    assert switch.good == expected[-1]["good"]
    at_once = ins.Switch(hdop_max=p["hmax"], gate=p["gate"], sats=p["smin"], back=ins.SWITCH_BACK_PAPER)
    for e, want in zip(epochs, expected, strict=True):
        at_once.epoch(e["valid"], e["sats"], e["hdop"], e["nis"] or 0.0)
        assert at_once.good == want["good"]
