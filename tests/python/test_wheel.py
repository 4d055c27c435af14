"""A wheel built from the repository, installed in a bare environment, runs there without a compiler."""

import importlib.util
import subprocess
import sys
import venv
import zipfile
from pathlib import Path

import pytest
from reference import ROOT

PROGRAM = """
import numpy as np
from libins import core, coref
assert core.selftest() == coref.selftest() == 0
attitude = core.Attitude(core.CONING_HIST2_OPT, [1, 0, 0, 0])
print(attitude.step(np.full((100, 3), 0.001)).shape, core.__file__)
"""


def run(*command: object, **options) -> str:
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built with the tools of this environment; what was compiled stays in build/wheel for the next time."""
    assert importlib.util.find_spec("scikit_build_core"), "pip install -r bindings/python/requirements-test.txt"
    out = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--quiet"]
    run(*command, "-Cbuild-dir=build/wheel", "--wheel-dir", out, ROOT)
    (made,) = out.glob("libins-*.whl")
    return made


def test_what_the_wheel_holds(wheel: Path):
    names = zipfile.ZipFile(wheel).namelist()
    package = sorted(
        n.removeprefix("libins/").split(".")[0] + "." + n.rsplit(".", 1)[1] for n in names if n.startswith("libins/")
    )
    assert package == ["__init__.py", "core.pyi", "core.so", "coref.pyi", "coref.so", "py.typed"]
    version = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8").split("project(libins VERSION ")[1].split()[0]
    assert wheel.name.startswith(f"libins-{version}-")
    metadata = next(n for n in names if n.endswith("METADATA"))
    assert "Requires-Dist: numpy" in zipfile.ZipFile(wheel).read(metadata).decode()


def test_it_runs_in_a_bare_environment(wheel: Path, tmp_path: Path):
    venv.create(tmp_path / "bare", with_pip=False)
    python = tmp_path / "bare/bin/python"
    site = Path(run(python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))").strip())
    run(sys.executable, "-m", "pip", "--python", python, "install", "--no-deps", "--no-index", "--quiet", wheel)
    # NumPy as it is here, and nothing else of this environment.
    numpy = Path(importlib.util.find_spec("numpy").origin).parent
    for folder in (numpy, numpy.with_name("numpy.libs")):
        (site / folder.name).symlink_to(folder)
    shown = run(python, "-I", "-c", PROGRAM, cwd=tmp_path, env={"PATH": ""})
    assert shown.startswith("(100, 4)") and str(site) in shown
