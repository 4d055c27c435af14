"""Every entry of coning, attitude_motion and quaternion whose formula the core has, through Python.

The readings of the paper's sample reuse that rotate three times too far (reuse_naive*) and the rectangle rule
(rates_left*) are in the files as warnings and are not built.
"""

import numpy as np
import pytest
from reference import angles_between, both, expect, load, real, rotation_between, same_sign, tolerance, wrapped

from libins import core

FORMS = {
    "one": core.CONING_ONE,
    "two": core.CONING_BLOCK2,
    "three_poly": core.CONING_BLOCK3_FIT,
    "three_opt": core.CONING_BLOCK3_OPT,
    "four_poly": core.CONING_BLOCK4_FIT,
    "four_opt": core.CONING_BLOCK4_OPT,
    "hist1": core.CONING_HIST1,
    "hist2_poly": core.CONING_HIST2_FIT,
    "hist2_opt": core.CONING_HIST2_OPT,
    "hist3_poly": core.CONING_HIST3_FIT,
    "hist3_opt": core.CONING_HIST3_OPT,
}
REUSE = {"reuse_interleaved_poly": core.CONING_BLOCK3_FIT, "reuse_interleaved_opt": core.CONING_BLOCK3_OPT}
FITER = {"fhist2": core.FITER_HIST2, "fhist3": core.FITER_HIST3}
RATEFIT = {"ratefit3": core.FITER_RATE3, "ratefit4": core.FITER_RATE4, "ratefit5": core.FITER_RATE5}
RATES = {"rates_trap+hist2_opt": 2, "rates_am3+hist2_opt": 3, "rates_am4+hist2_opt": 4}
WARNINGS = {"reuse_naive", "reuse_naive_avg", "reuse_naive_cross", "rates_left+hist2_opt"}
LONGEST_HISTORY = 3

# Double: rounding of 1e-12 relative to 1 rad or to a unit quaternion, Float: of one step, of 36 and of 300 steps.
TOL_ONE_STEP = (1e-12, 5e-7)
TOL_CONING = (1e-12, 4e-7)
TOL_MOTION_QUAT = (1e-12, 4e-6)
TOL_MOTION_RAD = (1e-12, 8e-6)
TOL_COEFFICIENT = (1e-15, 1e-7)
TOL_EULER_RAD = (1e-12, 5e-7)
NEAR_POLE = 1e-3
"""Cosine of the pitch below which roll and yaw are known to less than the rounding of q over it."""


def chained(ins, start, turns):
    """q(k+1) = q(k) turn(k), renormalised."""
    track = [real(ins, start)]
    for turn in turns:
        track.append(ins.quat_normalise_approx(ins.quat_mul(track[-1], turn)))
    return np.array(track[1:])


def with_history(method, state, start, pre, samples):
    """Samples before the start only fill the history."""
    method(pre)
    state.q_nb = start
    return method(samples)


def run_form(ins, form, start, pre, incs):
    """(index of the last increment, attitudes) at the end of each interval, the start first."""
    start, incs = real(ins, start), real(ins, incs)
    if not ins.coning_is_block(form):
        attitude = ins.Attitude(form, start)
        track = with_history(attitude.step, attitude, start, real(ins, pre), incs)
        return np.arange(len(incs) + 1), np.vstack([start, track])
    n = ins.coning_samples(form)
    count = len(incs) // n
    phi = ins.coning_phi(form, incs[: n * count].reshape(count, n, 3))
    track = chained(ins, start, ins.quat_from_rotvec(phi))
    return n * np.arange(count + 1), np.vstack([start, track])


def run_named(ins, name, case):
    """Attitudes of a named formula over a case of coning or attitude_motion; None if it has another kind of input."""
    truth, incs, pre = case["q_true"], case["incs"], case["pre"]
    every = np.arange(len(incs) + 1)
    if name in FORMS:
        return run_form(ins, FORMS[name], truth[0], pre[-LONGEST_HISTORY:], incs)
    if name in REUSE:
        track = ins.Reuse(REUSE[name], real(ins, truth[:3])).step(real(ins, incs))
        return every, np.vstack([real(ins, truth[0]), track])
    if name == "thesis2":
        thesis = ins.Thesis(real(ins, truth[0]))
        track = with_history(thesis.step, thesis, real(ins, truth[0]), real(ins, pre[-1:]), real(ins, incs))
        return every, np.vstack([real(ins, truth[0]), track])
    if name in FITER:
        fiter = ins.Fiter(FITER[name], 1.0, real(ins, truth[0]))
        track = with_history(fiter.step, fiter, real(ins, truth[0]), real(ins, pre), real(ins, incs))
        return every, np.vstack([real(ins, truth[0]), track])
    if name == "fiter3":
        blocks = real(ins, incs).reshape(-1, 3, 3)
        track = chained(ins, truth[0], ins.fiter_turn(ins.FITER_BLOCK3, blocks))
        return 3 * np.arange(len(blocks) + 1), np.vstack([real(ins, truth[0]), track])
    return None


def run_rates(ins, name, case):
    """As run_named, from the rates of attitude_motion."""
    start, rates, lead = real(ins, case["q_true"][0]), real(ins, case["rates"]), -case["rates_first_k"]
    every = np.arange(case["n"] + 1)
    if name in RATES:
        order = RATES[name]
        integral = ins.Rates(order, case["T"]).add(rates)
        k, track = run_form(ins, ins.CONING_HIST2_OPT, start, integral[order - 1 : lead + 1], integral[lead + 1 :])
        return k, track
    if name in RATEFIT:
        fiter = ins.Fiter(RATEFIT[name], case["T"], start)
        track = with_history(fiter.step, fiter, start, rates[: lead + 1], rates[lead + 1 : lead + 1 + case["n"]])
        return every, np.vstack([start, track])
    if name == "rk4_2T":
        rk4 = ins.ThesisRk4(0.0, 2 * case["T"], start, rates[lead])
        track = [start]
        for k in range(lead + 2, len(rates), 2):
            rk4.step(rates[k - 1], rates[k])
            rk4.q_nb = ins.quat_normalise(rk4.q_nb)
            track.append(rk4.q_nb)
        return 2 * np.arange(len(track)), np.array(track)
    return None


@both
def test_coning_coefficients(ins):
    for name, rows in load("coning.json")["coefficients"].items():
        form = FORMS[name]
        n = ins.coning_samples(form)
        pairs = [(i, j) for i in range(n) for j in range(i + 1, n)]
        want = [next((r[2] / r[3] for r in rows if (r[0], r[1]) == (i + 1, j + 1)), 0.0) for i, j in pairs]
        theta = np.zeros((len(pairs), n, 3), dtype=ins.real)
        for row, (i, j) in enumerate(pairs):  # theta_i along x, theta_j along y: the z of phi is the coefficient
            theta[row, i, 0] = theta[row, j, 1] = 1
        if pairs:
            expect(ins.coning_phi(form, theta)[:, 2], want, tolerance(ins, *TOL_COEFFICIENT), name)


@both
def test_coning_first_interval(ins):
    for case in load("coning.json")["cases"]:
        for name, want in case["phi_first"].items():
            if name == "thesis_P_unnormalised":
                got = ins.thesis_p(real(ins, case["incs"][0]), real(ins, case["pre"][-1]))
                expect(got, want, tolerance(ins, *TOL_ONE_STEP), name)
                continue
            n = ins.coning_samples(FORMS[name])
            before = 0 if ins.coning_is_block(FORMS[name]) else n - 1
            read = (case["pre"] + case["incs"])[len(case["pre"]) - before :][:n]
            got = ins.coning_phi(FORMS[name], real(ins, read))
            expect(got, want, tolerance(ins, *TOL_ONE_STEP), name, scale=np.linalg.norm(want))


@both
def test_coning_attitude_after_the_increments(ins):
    limit = tolerance(ins, *TOL_CONING)
    for case in load("coning.json")["cases"]:
        assert set(case["q_final"]) - {"reuse_naive"} <= {*FORMS, *REUSE, "thesis2"}
        for name, want in case["q_final"].items():
            if name == "reuse_naive":
                continue
            _, track = run_named(ins, name, case)
            expect(same_sign(track[-1], want), want, limit, name)
            error = rotation_between(track[-1], case["q_true"][-1])
            expect(error, case["att_err_final"][name], limit, name + " att_err_final")
        rates = real(ins, case["rates_half_step"])
        rk4 = ins.ThesisRk4(0.0, case["h"], real(ins, case["q_true"][0]), rates[0])
        track = rk4.step(rates[1::2], rates[2::2])
        want = case["rk4_q_after_12_unnormalised"]
        expect(same_sign(track[-1], want), want, limit, "rk4")


def test_coning_drift_over_whole_cycles():
    """In double alone: float's rounding hides drifts of 1e-9 rad/s and less."""
    cycles, noise_rad_s, transient = 12, 2e-15, 2e-5
    for case in load("coning.json")["cases"]:
        a, h, omega = np.radians(case["half_angle_deg"]), case["h"], case["omega"]
        k = np.arange(-LONGEST_HISTORY, cycles * case["increments_per_cycle"])
        middle = omega * (case["t0"] + (k + 0.5) * h)
        chord = 2 * np.sin(a) * np.sin(omega * h / 2)
        along = np.full(len(k), -2 * omega * h * np.sin(a / 2) ** 2)
        incs = np.stack([along, -chord * np.sin(middle), chord * np.cos(middle)], axis=1)
        start = case["q_true"][0]
        for name, want in case["drift_x"].items():
            if name not in FORMS:
                continue  # thesis2, and the chains, whose drift is that of their block form
            _, track = run_form(core, FORMS[name], start, incs[:LONGEST_HISTORY], incs[LONGEST_HISTORY:])
            drift = rotation_between(track[-1], start)[0] / ((len(k) - LONGEST_HISTORY) * h)
            measured = want["measured"]
            assert drift == pytest.approx(measured, abs=noise_rad_s + transient * abs(measured)), name


@both
def test_attitude_motion(ins):
    quat, rad = tolerance(ins, *TOL_MOTION_QUAT), tolerance(ins, *TOL_MOTION_RAD)
    for case in load("attitude_motion.json")["cases"]:
        truth = np.array(case["q_true"])
        for name, want in case["results"].items():
            if name in WARNINGS:
                continue
            run = run_named(ins, name, case) or run_rates(ins, name, case)
            assert run is not None, f"{name}: no formula of that name is known here"
            k, track = run
            assert k[-1] == want["k_final"], name
            expect(same_sign(track[-1], want["q_final"]), want["q_final"], quat, name)
            errors = angles_between(track, truth[k])
            expect(errors.max(), want["max_err"], rad, name + " max_err")
            if "rms_err" in want and name in {*FORMS, *REUSE}:
                expect(np.sqrt(np.mean(errors**2)), want["rms_err"], rad, name + " rms_err")
                got = core.quat_to_euler(track.astype(np.float64)) - core.quat_to_euler(truth[k])
                for axis, angle in ((2, "yaw"), (1, "pitch")):
                    e = wrapped(got[:, axis])
                    expect(
                        [min(e.min(), 0.0), max(e.max(), 0.0)],
                        [want[f"{angle}_err_min"], want[f"{angle}_err_max"]],
                        rad,
                        name,
                    )


@both
def test_quaternion_euler_and_direction_cosines(ins):
    cases = load("quaternion.json")["euler"]
    limit = tolerance(ins, *TOL_ONE_STEP)
    euler = np.array([[c["roll"], c["pitch"], c["yaw"]] for c in cases])
    q = np.array([c["q"] for c in cases])
    dcm = np.array([c["C_bn"] for c in cases])
    expect(same_sign(ins.quat_from_euler(real(ins, euler)), q), q, limit, "from_euler")
    expect(ins.quat_to_dcm(real(ins, q)), dcm, limit, "to_dcm")
    expect(same_sign(ins.quat_from_dcm(real(ins, dcm)), q), q, limit, "from_dcm")
    back = ins.quat_to_euler(real(ins, q))
    again = core.quat_from_euler(back.astype(np.float64))
    expect(same_sign(again, q), q, limit, "to_euler and back")
    away = np.cos(euler[:, 1]) > NEAR_POLE
    error = wrapped(back[away] - np.array([c["euler_back"] for c in cases])[away])
    error[:, [0, 2]] *= np.cos(euler[away, 1:2])
    expect(error, np.zeros_like(error), tolerance(ins, *TOL_EULER_RAD), "to_euler")


@both
def test_quaternion_products(ins):
    cases = load("quaternion.json")["products"]
    limit = tolerance(ins, *TOL_ONE_STEP)
    a, b, v, rv, prev = (np.array([c[key] for c in cases]) for key in ("a", "b", "v", "rv", "thesis_P_prev"))
    ab, rot, q_rv, p, approx = (
        np.array([c[key] for c in cases]) for key in ("ab", "rot", "q_rv", "thesis_P", "norm_approx")
    )
    expect(same_sign(ins.quat_mul(real(ins, a), real(ins, b)), ab), ab, limit, "product")
    length = np.maximum(1, np.linalg.norm(v, axis=1, keepdims=True))
    expect(ins.quat_rotate(real(ins, a), real(ins, v)), rot, limit, "rotate", scale=length)
    expect(ins.quat_rotate(ins.quat_conj(real(ins, a)), real(ins, rot)), v, limit, "rotate back", scale=length)
    expect(same_sign(ins.quat_from_rotvec(real(ins, rv)), q_rv), q_rv, limit, "from_rotvec")
    expect(ins.quat_normalise_approx(real(ins, 1.001 * a)), approx, limit, "normalise_approx")
    size = np.maximum(1, np.abs(p[:, :1]))  # of vectors out of the update's range P is large
    expect(ins.thesis_p(real(ins, rv), real(ins, prev)), p, limit, "thesis_p", scale=size)


@both
def test_quaternion_zxz(ins):
    cases = load("quaternion.json")["zxz"]
    got = ins.thesis_zxz(real(ins, [[c["alpha"], c["beta"], c["gamma"]] for c in cases]))
    expect(got, [c["R"] for c in cases], tolerance(ins, *TOL_ONE_STEP), "zxz")
    expect(got[:, 0], [c["S"] for c in cases], tolerance(ins, *TOL_ONE_STEP), "zxz, first row")
