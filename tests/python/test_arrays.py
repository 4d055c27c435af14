"""How arguments are taken and refused: dtypes, shapes, rows, copies, exceptions, the interpreter's lock."""

import copy
import os
import re
import shutil
import subprocess
import sys
import threading
import time
import tracemalloc

import numpy as np
import pytest
from reference import ROOT, both, real

from libins import core, coref

LEVEL = (1.0, 0.0, 0.0, 0.0)
ROWS = 200_000
"""Enough work for another thread to be seen meanwhile: some 10 ms."""
TRIES = 200


def seeded(ins, *shape, scale=0.01):
    return real(ins, scale * np.random.default_rng(20261122).standard_normal(shape))


@both
def test_one_call_is_the_calls_row_by_row(ins):
    theta, v = seeded(ins, 50, 3), seeded(ins, 50, 3, scale=0.1)
    q = ins.quat_from_rotvec(theta)
    assert np.array_equal(q, [ins.quat_from_rotvec(row) for row in theta])
    assert np.array_equal(ins.quat_mul(q, q[::-1]), [ins.quat_mul(a, b) for a, b in zip(q, q[::-1], strict=True)])
    start = ins.Position((0.4, 2.1, 100.0))
    at_once, stepped = (ins.Strapdown(ins.CONING_HIST2_OPT, 0.01, LEVEL, (10, 0, 0), start) for _ in range(2))
    together = at_once.step(theta, v)
    singly = [stepped.step(a, b) for a, b in zip(theta, v, strict=True)]
    for i, shape in enumerate(((50, 4), (50, 3), (50, 3))):
        assert together[i].shape == shape
        assert np.array_equal(together[i], [s[i] for s in singly])
    assert np.array_equal(at_once.position.llh, together[2][-1])


@both
def test_batch_has_the_bits_of_the_single_step(ins):
    steps, n = 20, 7
    theta = seeded(ins, steps, 3, n)
    start = np.ascontiguousarray(ins.quat_from_rotvec(seeded(ins, n, 3)).T)
    batch = ins.Batch(start)
    track = batch.step(theta)
    assert track.shape == (steps, 4, n)
    for i in range(n):
        single = ins.Attitude(ins.CONING_HIST2_OPT, start[:, i].copy())
        assert np.array_equal(track[:, :, i], single.step(theta[:, :, i]))
    assert np.array_equal(batch.q_nb, track[-1])


@both
def test_the_small_step_has_the_bits_of_the_general_one(ins):
    theta = seeded(ins, 500, 3)
    lean = ins.Hist2(LEVEL)
    track = lean.step(theta)
    assert np.array_equal(track, ins.Attitude(ins.CONING_HIST2_OPT, LEVEL).step(theta))
    assert np.array_equal(lean.q_nb, track[-1]) and lean.count == 2
    with pytest.raises(ins.RangeError, match="Hist2.step: row 1: .*0.5 rad"):
        lean.step(np.array([[0, 0, 0], [0, 0.6, 0]], dtype=ins.real))
    with pytest.raises(ins.RangeError, match="Hist2: .*unit norm"):
        ins.Hist2([1.01, 0, 0, 0])


@both
def test_fixed_point_follows_the_real_one(ins):
    theta = seeded(ins, 500, 3)
    wanted = ins.Attitude(ins.CONING_HIST2_OPT, LEVEL).step(theta)[-1]
    units = np.round(theta.astype(np.float64) * 2**31).astype(np.int32)
    start = np.array([ins.Q31_ONE, 0, 0, 0], dtype=np.int32)
    for kind in (ins.Q31, ins.Q31w):
        fixed = kind(start)
        track = fixed.step(units)
        assert track.dtype == np.int32 and track.shape == (500, 4)
        assert np.array_equal(fixed.q_nb, track[-1])
        assert np.abs(track[-1] / 2**30 - wanted).max() < 5e-6
        with pytest.raises(ins.RangeError, match="Q31w?.step: row 1: .*0.5 rad"):
            fixed.step(np.array([[0, 0, 0], [2**31 - 1] * 3], dtype=np.int32))


@both
def test_a_row_for_all_rows(ins):
    q = ins.quat_from_rotvec(seeded(ins, 5, 3))
    assert np.array_equal(ins.quat_mul(LEVEL, q), q)
    assert ins.quat_rotate(LEVEL, np.ones((5, 3), dtype=ins.real)).shape == (5, 3)
    assert ins.earth_gravity(0.5, real(ins, [0, 10, 20])).shape == (3,)
    assert ins.earth_gravity(0.5, 0).shape == ()
    assert ins.quat_conj(np.empty((0, 4), dtype=ins.real)).shape == (0, 4)


@both
def test_dtypes_are_taken_or_refused_never_guessed(ins):
    other = np.float32 if ins is core else np.float64
    want = np.dtype(ins.real).name
    for wrong in (other, np.int64, np.float16, np.complex128, np.bool_):
        with pytest.raises(TypeError, match=rf"quat_conj: q: found an array of dtype {np.dtype(wrong)}, wanted {want}"):
            ins.quat_conj(np.ones(4, dtype=wrong))
    with pytest.raises(TypeError, match="quat_conj: q"):
        ins.quat_conj(np.ones(4, dtype=np.dtype(ins.real).newbyteorder()))
    for right in ([1, 0, 0, 0], (1.0, 0, 0, 0), [np.float32(1), np.float64(0), 0, np.int8(0)]):
        assert ins.quat_conj(right).dtype == ins.real
    for wrong in ("1000", ["1", "0", "0", "0"], [True, False, False, False], [1, 2, 3, 1j], [[1, 2], [3]], object()):
        with pytest.raises(TypeError, match=f"quat_conj: q: found .*, wanted an array of dtype {want}"):
            ins.quat_conj(wrong)
    with pytest.raises(TypeError):
        ins.quat_conj(None)
    for wrong in ([0.5, 0, 0, 0], [2**31, 0, 0, 0], np.array([1, 0, 0, 0], dtype=np.int64)):
        with pytest.raises(TypeError, match="Q31: q_nb: found .* int32"):
            ins.Q31(wrong)
    with pytest.raises(TypeError, match=r"hs_block_put: codes: found .* uint16"):
        ins.hs_block_put([1, 2, 70000])
    with pytest.raises(TypeError, match="Switch.epoch: valid"):
        ins.Switch().epoch([1, 0], [4, 4], [1, 1])


@both
def test_shapes_are_named(ins):
    with pytest.raises(ValueError, match=r"quat_mul: p: found shape \(3,\), wanted \(4,\) or \(N, 4\)"):
        ins.quat_mul([1, 0, 0], LEVEL)
    with pytest.raises(ValueError, match=r"quat_mul: q: found 2 rows, wanted 3 as in p"):
        ins.quat_mul(np.ones((3, 4), dtype=ins.real), np.ones((2, 4), dtype=ins.real))
    with pytest.raises(ValueError, match=r"quat_from_dcm: C_nb: found shape \(9,\), wanted \(3, 3\) or \(N, 3, 3\)"):
        ins.quat_from_dcm(np.ones(9, dtype=ins.real))
    with pytest.raises(ValueError, match=r"earth_radii: sin_lat: found shape \(1, 1\), wanted \(\) or \(N,\)"):
        ins.earth_radii([[0.5]])
    with pytest.raises(ValueError, match=r"Kalman: P: found shape \(3, 2\), wanted \(2, 2\)"):
        ins.Kalman([0, 0], np.ones((3, 2), dtype=ins.real))
    with pytest.raises(ValueError, match=r"Batch: q_nb: found shape \(4,\), wanted \(4, any\)"):
        ins.Batch(LEVEL)
    attitude = ins.Attitude(ins.CONING_HIST1, LEVEL)
    with pytest.raises(ValueError, match=r"q_nb: found shape \(3,\), wanted \(4,\)"):
        attitude.q_nb = [1, 0, 0]


@both
def test_the_cores_refusals_are_exceptions_that_say_where(ins):
    assert issubclass(ins.RangeError, ins.Error) and issubclass(ins.RangeError, ValueError)
    assert issubclass(ins.StateError, ins.Error) and issubclass(ins.StateError, RuntimeError)
    assert issubclass(ins.ABIError, ins.Error) and issubclass(ins.ABIError, ImportError)
    attitude = ins.Attitude(ins.CONING_HIST2_OPT, LEVEL)
    rows = np.full((5, 3), 0.1, dtype=ins.real)
    rows[3, 1] = np.nan
    with pytest.raises(ins.RangeError, match=r"Attitude\.step: row 3: .*wanted: dtheta_b finite, each .* <= pi rad"):
        attitude.step(rows)
    three = ins.Attitude(ins.CONING_HIST2_OPT, LEVEL).step(rows[:3])
    assert np.array_equal(attitude.q_nb, three[-1]), "the rows before are done, the row itself changed nothing"
    with pytest.raises(ins.RangeError, match="Attitude: .*form"):
        ins.Attitude(ins.CONING_BLOCK2, LEVEL)
    with pytest.raises(ins.RangeError, match="coning_phi: .*CONING_"):
        ins.coning_phi(99, [[0, 0, 0]])
    with pytest.raises(ins.StateError, match="Linfit.solve: .*four unknowns"):
        ins.Linfit(3).solve()
    with pytest.raises(ins.StateError, match="Mean.get: .*two samples"):
        ins.Mean().get()
    with pytest.raises(ins.RangeError, match=r"fusion: estimate 1: .*positive definite"):
        ins.fusion([[1], [2]], [[[1]], [[-1]]])
    kalman = ins.Kalman([0], [[1]])
    with pytest.raises(ins.GateError, match=r"Kalman\.update: nis 50\.0*, gate 6\.6"):
        kalman.update([1], 10.0, 1.0, ins.KALMAN_GATE_99)
    assert kalman.x == 0 and kalman.P == 1
    board = ins.HsBoard(block_len=6, retries=1, reply_timeout=40, octet_timeout=10)
    with pytest.raises(ins.RangeError, match="HsBoard.offer: block"):
        board.offer(b"12345", 0, 0)
    board.offer(b"123456", 0, 0)
    with pytest.raises(ins.StateError, match="HsBoard.offer"):
        board.offer(b"123456", 0, 0)


@both
def test_every_status_has_its_exception(ins):
    header = (ROOT / "libins/core/include/ins/config.h").read_text(encoding="utf-8")
    codes = re.findall(r"X\(INS_E_(\w+), (-\d+), \"(.*?)\"\)", header)
    assert len(codes) >= 4
    for name, code, text in codes:
        exception = getattr(ins, ("ABI" if name == "ABI" else name.capitalize()) + "Error")
        assert issubclass(exception, ins.Error)
        assert exception.__doc__ == text == ins.status_text(int(code))


@both
def test_gates_in_a_run_are_answers(ins):
    kalman = ins.Kalman([0], [[1]])
    z = real(ins, [[0.1], [100], [np.nan], [0.2]])
    x, _, nis = kalman.run([[1]], [[0]], [[1]], [1], z, ins.KALMAN_GATE_99)
    assert x[1] == x[0] == x[2] != x[3]
    assert nis[1] > ins.KALMAN_GATE_99 > nis[0] > nis[2] == 0
    unicycle = ins.Unicycle(
        [0, 0, 0, 8, 0, 1],
        [5, 5, 1, 1, 0, 0],
        q_speed=4,
        q_bias=0,
        q_scale=0,
        r_rate=1e-4,
        r_distance=0.0025,
        gate=6.6,
        gate_gps=9.2,
    )
    _, nis = unicycle.run(0.1, [0.0, 0.0], [0.8, 100.0], [[np.nan, np.nan], [900.0, 0.0]], 4.0)
    assert nis[0, 0] < 6.6 < nis[1, 0] and nis[0, 1] == 0 and nis[1, 1] > 9.2
    with pytest.raises(ins.GateError, match=r"Unicycle\.gps: nis \d+"):
        unicycle.gps(900, 0, 4)


@both
def test_contiguous_input_is_not_copied(ins):
    """As NumPy counts its memory; a strided array is copied, and is right too."""
    big = np.zeros((ROWS, 3), dtype=ins.real)
    rates = ins.Rates(2, 0.01)
    mean = ins.Mean()
    mean.add(big[:2])
    tracemalloc.start()
    mean.add(big)
    _, without = tracemalloc.get_traced_memory()
    mean.add(np.zeros((3, ROWS), dtype=ins.real).T)
    _, with_copy = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert without < big.nbytes / 100, "NumPy allocated nothing of the array's size"
    assert with_copy > big.nbytes
    strided = seeded(ins, 40, 6)[::2, ::2]
    assert np.array_equal(rates.add(strided), ins.Rates(2, 0.01).add(np.ascontiguousarray(strided)))
    frozen = seeded(ins, 4, 3)
    frozen.flags.writeable = False
    assert ins.quat_from_rotvec(frozen).shape == (4, 4)


@both
def test_results_are_the_callers(ins):
    attitude = ins.Attitude(ins.CONING_HIST2_OPT, LEVEL)
    q = attitude.q_nb
    q[0] = 5
    assert attitude.q_nb[0] == 1
    out = attitude.step([0.1, 0, 0])
    before = out.copy()
    attitude.step([0.2, 0, 0])
    assert np.array_equal(out, before)


@both
def test_a_copy_is_a_snapshot(ins):
    theta = seeded(ins, 10, 3)
    for original in (
        ins.Attitude(ins.CONING_HIST3_OPT, LEVEL),
        ins.Hist2(LEVEL),
        ins.Thesis(LEVEL),
        ins.Fiter(ins.FITER_HIST3, 1.0, LEVEL),
        ins.Rates(4, 0.01),
    ):
        step = "add" if isinstance(original, ins.Rates) else "step"
        getattr(original, step)(theta[:5])
        for twin in (copy.copy(original), copy.deepcopy(original)):
            assert np.array_equal(getattr(twin, step)(theta[5:]), getattr(copy.copy(original), step)(theta[5:]))
    kalman = ins.Ud([0, 1], [[2, 0], [0, 3]])
    twin = copy.deepcopy(kalman)
    kalman.update([1, 0], 1.0, 1.0)
    assert twin.x[0] == 0 and np.array_equal(twin.P, [[2, 0], [0, 3]])


@both
def test_the_interpreter_runs_on_meanwhile(ins):
    """Within one step() call of one thread another one comes to work. The lock is never taken away, only given."""
    rows = seeded(ins, ROWS, 3)
    attitude = ins.Attitude(ins.CONING_HIST2_OPT, LEVEL)
    turns = 0
    seen = []

    def work():
        for _ in range(TRIES):
            before = turns
            attitude.step(rows)
            if turns > before:
                seen.append(turns - before)
                return

    interval = sys.getswitchinterval()
    sys.setswitchinterval(3600)
    try:
        thread = threading.Thread(target=work)
        thread.start()
        while thread.is_alive():
            turns += 1
            time.sleep(0)
        thread.join()
    finally:
        sys.setswitchinterval(interval)
    assert seen, f"none of {TRIES} calls let the other thread run"


def test_the_two_modules_are_apart():
    assert core.real == np.float64 and coref.real == np.float32
    assert core.Attitude is not coref.Attitude
    assert core.RangeError is not coref.RangeError
    with pytest.raises(TypeError):
        core.geodesy_to_ecef(coref.WGS84, (0, 0, 0))
    exact, rounded = (float(m.earth_gravity(0.5, 0)) for m in (core, coref))
    assert exact != rounded and exact == pytest.approx(rounded, rel=1e-6)


@both
def test_version_abi_and_selftest(ins):
    header = (ROOT / "libins/core/include/ins/version.h").read_text(encoding="utf-8")
    numbers = tuple(int(re.search(rf"INS_VERSION_{part} (\d+)", header)[1]) for part in ("MAJOR", "MINOR", "PATCH"))
    assert ins.version() == numbers
    version = numbers[0] * 10000 + numbers[1] * 100 + numbers[2]
    size = np.dtype(ins.real).itemsize
    ins.abi_check(version, size)
    for other in ((version + 100, size), (version, 12 - size)):
        with pytest.raises(ins.ABIError, match="abi_check: .*version"):
            ins.abi_check(*other)
    assert ins.selftest() == 0


def test_vectors_come_from_the_directory_that_is_named(tmp_path):
    folder = tmp_path / "vectors"
    shutil.copytree(ROOT / "tests/data/vectors", folder)
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-p",
        "no:cacheprovider",
        ROOT / "tests/python/test_vectors_octets.py",
    ]

    def run():
        return subprocess.run(
            command, env={**os.environ, "INS_VECTOR_DIR": str(folder)}, capture_output=True, text=True
        )

    good = run()
    assert good.returncode == 0, good.stdout
    file = folder / "gimu.json"
    text = file.read_text(encoding="utf-8")
    assert "4660" in text
    file.write_text(text.replace("4660", "4661"), encoding="utf-8")
    assert "test_gimu_streams" in run().stdout
