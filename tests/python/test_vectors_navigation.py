"""sculling, sixacc, calib_linear, calib_full and geodesy, through Python."""

import numpy as np
import pytest
from reference import both, expect, load, real, tolerance, wrapped

from libins import core

TOL_DV_REL = (1e-12, 3e-7)
TOL_MEAN_MPS2 = (1e-12, 2e-7)
MEAN_REL = 1e-6
"""Of a mean error in double: the files hold it to that many digits."""
TOL_SIXACC_REL = (1e-12, 1e-6)
TOL_MAP = (1e-12, 2e-6)
TOL_READING = (1e-13, 1e-5)
TOL_PASS = (1e-12, 1e-5)
"""Largest component of the step that ends the passes."""
PASSES_MAX = 8
TOL_CLEAN = (1e-10, 2e-5)
"""Float: readings of 14 m/s^2 are good to 1e-6."""
TOL_NOISY = (1e-7, 2e-5)
TOL_COST_REL = (1e-9, 2e-2)
TOL_SD_REL = (1e-5, 1e-3)
NOISE_MPS2 = 1e-3
"""The file's noise, before the scale factor."""
TOL_BIAS_AND_AXIS = (1e-11, 5e-6)
"""Of calib_full's static rows: readings of 10 m/s^2, fitted over 24 attitudes."""
TOL_RESOLVED_REL = (1e-11, 5e-5)
"""Of calib_full's turning rows: 100 m/s^2 and an arm of 0.1 m; the products of the rate are taken away again."""
# Float: steps of the type, 0.5 m in 6e6 m (2 m in 2.5e7 m), 1.2e-7 in 2 rad.
TOL_ECEF_M = (1e-8, 6.0)
TOL_ECEF_RAD = (1e-13, 5e-7)
TOL_TM_M = (1e-6, 2.0)
TOL_TM_RAD = (1e-13, 5e-7)
TOL_CONVERGENCE_RAD = (5e-8, 3e-7)
"""The file's convergence is a difference quotient."""
TOL_THESIS_INVERSE_RAD = (1e-4 / 6.4e6, 5e-7)
SCULLING = {"rot": core.CONING_ONE, "hist1": core.CONING_HIST1, "hist2_opt": core.CONING_HIST2_OPT}


@both
def test_sculling(ins):
    for case in load("sculling.json")["cases"]:
        theta = np.array([p[0] for p in case["pre"]] + [row["theta"] for row in case["rows"]])
        v = np.array([p[1] for p in case["pre"]] + [row["v"] for row in case["rows"]])
        first = len(case["pre"])
        true_x = np.array([row["true"][0] for row in case["rows"]])
        for name, form in SCULLING.items():
            n = ins.coning_samples(form)
            read = [slice(k - n + 1, k + 1) for k in range(first, len(theta))]
            dv = ins.sculling_dv(form, real(ins, [theta[r] for r in read]), real(ins, [v[r] for r in read]))
            want = np.array([row[name] for row in case["rows"]])
            scale = np.linalg.norm(want, axis=1, keepdims=True)
            expect(dv, want, tolerance(ins, *TOL_DV_REL), name, scale=np.maximum(scale, 1e-300))
            mean = np.mean(dv[:, 0].astype(np.float64) - true_x) / case["h"]
            goal = case["mean_x_error_mps2"][name]
            extra = MEAN_REL * abs(goal) if ins is core else 0.0
            expect(mean, goal, tolerance(ins, *TOL_MEAN_MPS2) + extra, name + ", mean")


@both
def test_sixacc(ins):
    file = load("sixacc.json")
    limit = tolerance(ins, *TOL_SIXACC_REL)
    for case in file["cases"]:
        bias, axis, r = ins.sixacc_paper(case["rho"])
        expect(axis, file["axis"], 1e-7, "axis")
        expect(r, case["rho"] * np.array(file["pos_unit"]), 1e-7, "place")
        sixacc = ins.Sixacc(bias, axis, r, 0.02)
        rows = {key: np.array([row[key] for row in case["rows"]]) for key in ("f", "w", "wd", "f_centre", "q", "a")}
        wd, f = sixacc.resolve(real(ins, rows["f"]), real(ins, rows["w"]))
        largest = np.max(np.abs(rows["f"]), axis=1, keepdims=True)
        expect(wd, rows["wd"], limit, "angular acceleration", scale=largest / case["rho"])
        expect(f, rows["f_centre"], limit, "specific force", scale=largest)
        a = ins.quat_rotate(real(ins, rows["q"]), f) + real(ins, case["G_nav"])
        expect(a, rows["a"], limit, "acceleration in n", scale=largest)


@both
def test_calib_linear(ins):
    file = load("calib_linear.json")
    for case in file["cases"]:
        up = np.array(file["attitudes"][case["group"]])
        readings = np.array(case["P"]).T / case["T"]
        fit = ins.Linfit(3)
        fit.add(real(ins, case["g"] * up), real(ins, readings))
        got = fit.solve()
        true = case["true"]
        expect(got[:, 1:], case["true_map"], tolerance(ins, *TOL_MAP), "axis")
        expect(got[:, 0], np.array(true["bias"]) * true["SF"], tolerance(ins, *TOL_MAP), "bias")
        assert fit.residual2.max() < tolerance(ins, 1e-24, 1e-9), "the map is exact"


@both
def test_calib_full(ins):
    file = load("calib_full.json")
    up, w, wd = np.split(np.array(file["meas"]), 3, axis=1)
    motion = [real(ins, m) for m in (file["g"] * up, w, wd)]

    def fitted(acc, readings):
        fit = ins.Accelfit(*(real(ins, acc[key]) for key in ("u0", "e1", "e2", "p0")))
        for _ in range(PASSES_MAX):
            fit.add(*motion, readings)
            if fit.step() < tolerance(ins, *TOL_PASS):
                return fit
        raise AssertionError(f"no convergence in {PASSES_MAX} passes")

    for acc in file["acc"]:
        clean, noisy = real(ins, acc["y_clean"]), real(ins, acc["y_noisy"])
        true = ins.Accelfit(*(real(ins, acc[key]) for key in ("u0", "e1", "e2", "p_true")))
        reading, jacobian = true.predict(*motion)
        expect(reading, acc["y_clean"], tolerance(ins, *TOL_READING), "reading")
        assert jacobian.shape == (len(clean), 8)
        expect(fitted(acc, clean).p, acc["p_true"], tolerance(ins, *TOL_CLEAN), "p, no noise")
        fit = fitted(acc, noisy)
        expect(fit.p, acc["p_est_noisy"], tolerance(ins, *TOL_NOISY), "p, noise")
        fit.add(*motion, noisy)
        assert fit.rows == len(noisy)
        expect(fit.residual2, acc["cost_noisy"], tolerance(ins, *TOL_COST_REL), "cost", scale=acc["cost_noisy"])
        deviation = fit.deviation(NOISE_MPS2 * acc["p_true"][1])
        expect(deviation, acc["sd"], tolerance(ins, *TOL_SD_REL), "deviations", scale=acc["sd"])
        with pytest.raises(ins.StateError, match=r"Accelfit\.step: .*all eight"):
            still = ins.Accelfit(*(real(ins, acc[key]) for key in ("u0", "e1", "e2", "p0")))
            still.add(*(m[:18] for m in motion), clean[:18])
            still.step()


@both
def test_calib_full_as_a_system(ins):
    """Six accelerometers of calib_full as linear maps and places: rest gives the maps, the turning rows come back.

    The quadratic term is taken off the readings first: Linfit and Sixacc have none.
    """
    file = load("calib_full.json")
    meas = np.array(file["meas"])
    up, w, wd = meas[:, :3], meas[:, 3:6], meas[:, 6:]
    rest = ~w.any(axis=1)
    f = file["g"] * up
    bias, axis, places, linear = [], [], [], []
    for acc in file["acc"]:
        b, sf, m1, m2, k2, *place = acc["p_true"]
        u = np.array(acc["u0"]) + m1 * np.array(acc["e1"]) + m2 * np.array(acc["e2"])
        u /= np.linalg.norm(u)
        at_arm = f + np.cross(w, np.cross(w, place)) + np.cross(wd, place)
        linear.append(np.array(acc["y_clean"]) - sf * k2 * (at_arm @ u) ** 2)
        bias.append(sf * b)
        axis.append(sf * u)
        places.append(place)
    readings = np.array(linear).T
    fit = ins.Linfit(len(bias))
    fit.add(real(ins, f[rest]), real(ins, readings[rest]))
    got = fit.solve()
    expect(got[:, 0], bias, tolerance(ins, *TOL_BIAS_AND_AXIS), "bias")
    expect(got[:, 1:], axis, tolerance(ins, *TOL_BIAS_AND_AXIS), "axis")
    sixacc = ins.Sixacc(got[:, 0], got[:, 1:], real(ins, places), 0.02)
    got_wd, got_f = sixacc.resolve(real(ins, readings[~rest]), real(ins, w[~rest]))
    largest = np.max(np.abs(readings))
    arm = np.min(np.linalg.norm(places, axis=1))
    expect(got_f, f[~rest], tolerance(ins, *TOL_RESOLVED_REL), "specific force", scale=largest)
    expect(got_wd, wd[~rest], tolerance(ins, *TOL_RESOLVED_REL), "angular acceleration", scale=largest / arm)


@both
def test_geodesy_ecef(ins):
    file = load("geodesy.json")
    points = file["points"] + file["ecef_global"]
    llh = np.array([[np.radians(p["lat_deg"]), np.radians(p["lon_deg"]), p["h"]] for p in points])
    xyz = np.array([[p["X"], p["Y"], p["Z"]] for p in points])
    expect(ins.geodesy_to_ecef(ins.GRS80, real(ins, llh)), xyz, tolerance(ins, *TOL_ECEF_M), "to ECEF")
    back = ins.geodesy_from_ecef(ins.GRS80, real(ins, xyz)).astype(np.float64)
    expect(back[:, 0], llh[:, 0], tolerance(ins, *TOL_ECEF_RAD), "latitude")
    east = wrapped(back[:, 1] - llh[:, 1]) * np.cos(llh[:, 0])
    expect(east, np.zeros_like(east), tolerance(ins, *TOL_ECEF_RAD), "longitude on the ground")
    expect(back[:, 2], llh[:, 2], tolerance(ins, *TOL_ECEF_M), "height")


@both
def test_geodesy_tm2(ins):
    points = load("geodesy.json")["points"]
    for zone, epsg in ((121, 3826), (119, 3825)):
        of_zone = [p for p in points if p["epsg"] == epsg]
        lat, lon = (np.radians([p[key] for p in of_zone]) for key in ("lat_deg", "lon_deg"))
        en = np.array([[p["E"], p["N"]] for p in of_zone])
        lat_lon = np.stack([lat, lon], axis=1)
        tm = ins.Tm.twd97(zone)
        got, convergence = tm.forward(real(ins, lat), real(ins, lon))
        expect(got, en, tolerance(ins, *TOL_TM_M), "Krueger forward")
        goal = np.radians([p["convergence_deg"] for p in of_zone])
        expect(convergence, goal, tolerance(ins, *TOL_CONVERGENCE_RAD), "convergence")
        expect(tm.inverse(real(ins, en)), lat_lon, tolerance(ins, *TOL_TM_RAD), "Krueger inverse")
        expect(tm.thesis_forward(real(ins, lat), real(ins, lon)), en, tolerance(ins, *TOL_TM_M), "thesis forward")
        inverse = tm.thesis_inverse(real(ins, en))
        expect(inverse, lat_lon, tolerance(ins, *TOL_THESIS_INVERSE_RAD), "thesis inverse")
