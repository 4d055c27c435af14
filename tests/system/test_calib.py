"""`ins calib`: a real IMU, the reference accelerometers, the paper's tables; what is refused, and in which words."""

import json
import math
import os
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest

from libins import calibration, core

ROOT = Path(__file__).resolve().parents[2]
XSENS = ROOT / "tests/data/imu_tk_xsens/xsens.toml"
VECTORS = Path(os.environ.get("INS_VECTOR_DIR", ROOT / "tests/data/vectors"))
CHI2_9_95 = 16.919
ACCEL_RMS_MAX = 1.1e-3
"""[m/s^2]; the quietest of its sensors has 0.3 m/s^2 of noise a sample, poses of some 500."""
GYRO_RMS_MAX_DEG = 0.14
UP = [f"up_{axis}" for axis in "xyz"]
RATE = [f"w_{axis}" for axis in "xyz"]

FULL = """
method = "full"
g_m_s2 = {g}
rho_m = 0.1
[poses]
file = "poses.csv"
up = ["up_x", "up_y", "up_z"]
rate = ["w_x", "w_y", "w_z"]
rate_unit = "{unit}"
readings = ["a1", "a2", "a3", "a4", "a5", "a6"]
[full]
noise_m_s2 = 1e-3
"""


def vector(name: str) -> dict:
    return json.loads((VECTORS / name).read_text(encoding="utf-8"))


def poses_csv(folder: Path, rows: int | None = None, rate_unit: str = "rad/s") -> Path:
    """The reference file's noisy readings as a user has them."""
    unit = math.degrees(1.0) if rate_unit == "deg/s" else 1.0
    file = vector("calib_full.json")
    lines = [",".join([*UP, *RATE, *(f"a{a['acc']}" for a in file["acc"])])]
    for k, m in enumerate(file["meas"][:rows]):
        lines.append(
            ",".join(repr(v) for v in [*m[:3], *(unit * w for w in m[3:6]), *(a["y_noisy"][k] for a in file["acc"])])
        )
    (folder / "poses.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    declaration = folder / "full.toml"
    declaration.write_text(FULL.format(g=file["g"], unit=rate_unit), encoding="utf-8")
    return declaration


def refused(done: subprocess.CompletedProcess[str], *words: str) -> None:
    assert done.returncode == 2, done.stdout + done.stderr
    assert "Traceback" not in done.stderr
    for word in words:
        assert word in done.stderr, done.stderr


def test_a_real_imu(ins, tmp_path):
    out, header, page, figures = (tmp_path / name for name in ("imu.toml", "imu.h", "r.html", "f.json"))
    done = ins("calib", XSENS, "--out", out, "--header", header, "--report", page, "--json", figures)
    assert done.returncode == 0, done.stderr
    found = json.loads(figures.read_text(encoding="utf-8"))["figures"]
    for name, value in found.items():
        print(f"{name}: {value}")
    assert found["still poses"] == 38
    assert found["|f| - g rms [m/s^2]"] < ACCEL_RMS_MAX < found["|f| - g rms with one scale factor [m/s^2]"] / 30
    assert found["gravity turned by gyros, rms [deg]"] < GYRO_RMS_MAX_DEG
    assert found["the same with one scale factor [deg]"] > 20 * GYRO_RMS_MAX_DEG
    halves = {name: value for name, value in found.items() if name.startswith("halves differ")}
    assert len(halves) == 2 and all(value < CHI2_9_95 for value in halves.values()), halves
    written = tomllib.loads(out.read_text(encoding="utf-8"))
    matrix, bias = np.array(written["accel"]["matrix"]), np.array(written["accel"]["bias"])
    assert matrix[1, 0] == matrix[2, 0] == matrix[2, 1] == 0
    assert abs(np.linalg.norm(matrix @ (np.array([33104.0, 33333.0, 36429.0]) - bias)) - written["g_m_s2"]) < 0.05
    assert "<svg" in page.read_text(encoding="utf-8") and "http-equiv" not in page.read_text(encoding="utf-8")
    program = tmp_path / "imu.c"
    program.write_text(
        '#include "imu.h"\nint main(void) { return imu_gyro_matrix[0] < imu_accel_matrix[0] ? 0 : 1; }\n'
    )
    include = ROOT / "libins/core/include"
    for real in ([], ["-DINS_REAL_FLOAT"]):
        flags = ["-std=c11", "-Wall", "-Werror", "-Wno-unused-const-variable", f"-I{include}", *real]
        subprocess.run(["gcc", *flags, program, "-o", tmp_path / "imu"], check=True)
        subprocess.run([tmp_path / "imu"], check=True)


@pytest.mark.parametrize("rate_unit", ["rad/s", "deg/s"])
def test_six_accelerometers_in_full(ins, tmp_path, rate_unit):
    """What is written is what core takes: bias, SF u and place of the reference file's own minimum."""
    out = tmp_path / "six.toml"
    done = ins("calib", poses_csv(tmp_path, rate_unit=rate_unit), "--out", out, "--header", tmp_path / "six.h")
    assert done.returncode == 0, done.stderr
    bias, axis, place = calibration.accelerometers(out)
    for j, a in enumerate(vector("calib_full.json")["acc"]):
        b, sf, m1, m2, _, *r = a["p_est_noisy"]
        u = np.array(a["u0"]) + m1 * np.array(a["e1"]) + m2 * np.array(a["e2"])
        assert bias[j] == pytest.approx(sf * b, abs=1e-8)
        assert axis[j] == pytest.approx(sf * u / np.linalg.norm(u), abs=1e-8)
        assert place[j] == pytest.approx(r, abs=1e-9)
    assert core.Sixacc(bias, axis, place, 0.01) is not None
    text = (tmp_path / "six.h").read_text(encoding="utf-8")
    assert "static const ins_accel_t six[6]" in text
    k2 = calibration.quadratic(out)
    assert k2 == pytest.approx([a["p_est_noisy"][4] for a in vector("calib_full.json")["acc"]], abs=1e-9)
    assert np.abs(k2).max() > 1e-6
    assert f"six_k2[6] = {{INS_C({float(k2[0])!r})" in text
    x = np.linspace(-20.0, 20.0, 6)
    scale = np.linalg.norm(axis, axis=1)
    assert core.accel_linear(bias, axis, k2, bias + scale * (x + k2 * x**2)) == pytest.approx(
        bias + scale * x, abs=1e-12
    )


def test_poses_that_are_not_enough(ins, tmp_path):
    declaration = poses_csv(tmp_path, rows=24)
    out = tmp_path / "six.toml"
    done = ins("calib", declaration, "--out", out)
    refused(done, "full.toml", "accelerometer 1 has rank 7 of 8, not fixed: r_z", "Add: spin about (1, 1, 0) and spin")
    assert not out.exists()
    with declaration.open("a", encoding="utf-8") as file:
        file.write('fixed = ["r"]\n')
    assert ins("calib", declaration, "--out", out).returncode == 0
    assert calibration.accelerometers(out)[2] == pytest.approx(np.array(core.sixacc_paper(0.1)[2]))


def test_table_7(ins, tmp_path):
    case = next(c for c in vector("calib_linear.json")["cases"] if c.get("paper_table6") and c["model"] == "exact")
    (tmp_path / "p.csv").write_text("\n".join(" ".join(map(repr, row)) for row in np.array(case["P"]).T.tolist()))
    text = f'method = "paper"\ng_m_s2 = {case["g"]}\n[poses]\nfile = "p.csv"\nreadings = ["1", "2", "3"]\n'
    (tmp_path / "paper.toml").write_text(text + f"[paper]\nnumbers = {case['group']}\nT_s = {case['T']}\n")
    done = ins("calib", tmp_path / "paper.toml", "--json", "-")
    assert done.returncode == 0, done.stderr
    figures = json.loads(done.stdout)["figures"]
    printed = {"xy": 0.5930, "xz": 0.5042, "yx": 0.8074, "yz": 0.7001, "zx": 0.4000, "zy": 0.8001}
    for name, value in printed.items():
        assert round(figures[f"angle {name} [deg]"], 4) == value


def test_the_linear_map(ins, tmp_path):
    case = vector("calib_linear.json")["cases"][0]
    attitudes = vector("calib_linear.json")["attitudes"][case["group"]]
    rows = [[*up, *(p[k] / case["T"] for p in case["P"])] for k, up in enumerate(attitudes)]
    (tmp_path / "p.csv").write_text("x;y;z;a;b;c\n" + "\n".join(";".join(map(repr, row)) for row in rows))
    text = f'method = "linear"\ng_m_s2 = {case["g"]}\n[poses]\nfile = "p.csv"\n'
    (tmp_path / "l.toml").write_text(text + 'up = ["x", "y", "z"]\nreadings = ["a", "b", "c"]\n')
    assert ins("calib", tmp_path / "l.toml", "--out", tmp_path / "o.toml").returncode == 0
    _, axis, _ = calibration.accelerometers(tmp_path / "o.toml")
    assert np.max(np.abs(axis - np.array(case["true_map"]))) < 1e-12


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("rho_m = 0.1", "rho = 0.1", ("full.toml:4", "did you mean 'rho_m'")),
        ('method = "full"', 'method = "ful"', ("full.toml:2", "'linear'")),
        ("g_m_s2 = 9.79", "g_m_s2 = -9.79", ("full.toml:3", "g_m_s2")),
        ('"a6"]', '"a7"]', ("poses.csv", "no column 'a7'", "up_x")),
        (', "a6"]', "]", ("full.toml", "5 columns, but 6 nominal accelerometers")),
        ('"poses.csv"', '"none.csv"', ("none.csv", "No such file")),
    ],
)
def test_bad_declarations(ins, tmp_path, old, new, words):
    declaration = poses_csv(tmp_path)
    text = declaration.read_text(encoding="utf-8")
    assert old in text
    declaration.write_text(text.replace(old, new), encoding="utf-8")
    refused(ins("calib", declaration), *words)


@pytest.mark.parametrize(
    ("line", "text", "words"),
    [
        (5, None, ("poses.csv:5", "11 columns, but the first row has 12")),
        (7, "nan", ("poses.csv:7", "column a6", "'nan'")),
        (7, "1.O", ("poses.csv:7", "column a6", "'1.O'")),
    ],
)
def test_bad_data(ins, tmp_path, line, text, words):
    declaration = poses_csv(tmp_path)
    lines = (tmp_path / "poses.csv").read_text(encoding="utf-8").splitlines()
    cut = lines[line - 1].rsplit(",", 1)[0]
    lines[line - 1] = cut if text is None else f"{cut},{text}"
    (tmp_path / "poses.csv").write_text("\n".join(lines), encoding="utf-8")
    refused(ins("calib", declaration), *words)


def test_without_ceres(tmp_path):
    """The rest configures, and the command says what to install."""
    hidden = "import sys; sys.modules['libins._calib'] = None; from libins.cli import main; sys.exit(main())"
    done = subprocess.run([sys.executable, "-c", hidden, "calib", poses_csv(tmp_path)], capture_output=True, text=True)
    refused(done, "install libceres-dev")
    off = [f"-DINS_BUILD_{part}=OFF" for part in ("TESTS", "EMU", "DDS")]
    command = ["cmake", "-S", ROOT, "-B", tmp_path / "build", "-G", "Ninja", f"-DPython_EXECUTABLE={sys.executable}"]
    command += [*off, "-DCMAKE_DISABLE_FIND_PACKAGE_Ceres=ON"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0 and "no ins calib (Debian: libceres-dev)" in done.stdout, done.stdout + done.stderr
