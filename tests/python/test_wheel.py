"""A wheel built from the repository, installed in a bare environment, runs there without a compiler."""

import importlib.metadata
import importlib.util
import json
import subprocess
import sys
import venv
import zipfile
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from reference import ROOT

IMAGES = ("acq_default", "acq_s3_paper", "acq_80ms_seq", "acq_57600", "acq_six")

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


@pytest.fixture(scope="module")
def bare(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel, what it says it requires, and pytest, as those are here; nothing else of this environment, no pip."""
    folder = tmp_path_factory.mktemp("bare")
    venv.create(folder / "bare", with_pip=False)
    python = folder / "bare/bin/python"
    site = Path(run(python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))").strip())
    run(sys.executable, "-m", "pip", "--python", python, "install", "--no-deps", "--no-index", "--quiet", wheel)
    metadata = importlib.metadata.PathDistribution(next(site.glob("libins-*.dist-info")))
    pytest_itself = importlib.metadata.distribution("pytest")
    for name in {"pytest"} | required(metadata) | required(pytest_itself):
        for part in {str(file).split("/")[0] for file in importlib.metadata.distribution(name).files or []}:
            source = Path(str(importlib.metadata.distribution(name).locate_file(part)))
            if part != ".." and not (site / part).exists():
                (site / part).symlink_to(source)
    return python.parent


def required(distribution: importlib.metadata.Distribution, found: frozenset[str] = frozenset()) -> frozenset[str]:
    """Names of what a distribution requires without extras, and what those require."""
    for text in distribution.requires or []:
        requirement = Requirement(text)
        wanted = requirement.marker is None or requirement.marker.evaluate({"extra": ""})
        if wanted and requirement.name not in found:
            other = importlib.metadata.distribution(requirement.name)
            assert requirement.specifier.contains(other.version), f"{text}, but {other.version} is here"
            found = required(other, found | {requirement.name})
    return found


def test_what_the_wheel_holds(wheel: Path):
    names = {n.removeprefix("libins/") for n in zipfile.ZipFile(wheel).namelist() if n.startswith("libins/")}
    sources = {p.name for p in (ROOT / "bindings/python/libins").iterdir() if p.suffix in {".py", ".html", ".typed"}}
    built = {f"{module}.pyi" for module in ("core", "coref", "_post", "_run", "_truth")}
    images = {f"firmware/{n}{kind}" for n in IMAGES for kind in (".ihx", "_debug.ihx", "_debug.cdb")}
    scenarios = {f"scenarios/{p.name}" for p in (ROOT / "emu/8051_tlc2543/scenarios").iterdir()}
    images |= {f"firmware/{p.name}.f2812" for p in (ROOT / "emu/f2812_sci/firmware").iterdir() if p.is_dir()}
    images.add("firmware/thesis_raw.f2812")
    scenarios |= {f"scenarios_f2812/{p.name}" for p in (ROOT / "emu/f2812_sci/scenarios").iterdir()}
    page = {f"view/{p.name}" for p in (ROOT / "bindings/python/libins/view").iterdir()}
    libraries = {n for n in names if n.endswith(".so")}
    assert {n.split(".")[0] for n in libraries} == {"core", "coref", "_post", "_run", "_truth"}
    assert names - libraries == sources | built | images | scenarios | page | {"bin/ins-navd", "bin/ins-gpsdr"}
    version = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8").split("project(libins VERSION ")[1].split()[0]
    assert wheel.name.startswith(f"libins-{version}-")


def test_the_core_runs_in_a_bare_environment(bare: Path, tmp_path: Path):
    shown = run(bare / "python", "-I", "-c", PROGRAM, cwd=tmp_path, env={"PATH": ""})
    assert shown.startswith("(100, 4)") and str(bare.parent) in shown


def test_a_board_runs_in_a_bare_environment(bare: Path, tmp_path: Path):
    """The same bytes as from the build tree: every edge of every wire."""
    out = tmp_path / "s.json"
    shown = run(bare / "ins", "run", "default", "--stop-s", 3, "--json", out, cwd=tmp_path, env={"PATH": ""})
    assert "verdict   pass" in shown
    here = tmp_path / "here.json"
    run(sys.executable, "-m", "libins", "run", "default", "--stop-s", 3, "--json", here)
    kept, built = (json.loads(path.read_text(encoding="utf-8")) for path in (out, here))
    assert kept["trace_sha256"] == built["trace_sha256"] and kept["attitude"] == built["attitude"]
    assert "usage: ins-navd" in run(bare / "ins", "nav", "--help", env={"PATH": ""}).replace("Usage", "usage")


def test_a_program_of_the_f2812_runs_in_a_bare_environment(bare: Path, tmp_path: Path):
    assert "verdict   pass" in run(bare / "ins", "run", "echo", cwd=tmp_path, env={"PATH": ""})


def test_pytest_finds_the_plugin_by_itself(bare: Path, tmp_path: Path):
    text = """
import pytest
@pytest.mark.board("default", boot=b"\\xaa")
def test_it_asks(board):
    board.send(bytes([0xBB]))
    board.run_for(0.02)
    assert len(board.unread) > 6
"""
    (tmp_path / "test_it.py").write_text(text, encoding="utf-8")
    assert "1 passed" in run(bare / "python", "-m", "pytest", "-q", tmp_path, cwd=tmp_path, env={"PATH": ""})


def test_an_extra_that_is_missing_is_named(bare: Path, tmp_path: Path):
    command = [bare / "ins", "run", "default", "--stop-s", "0.1", "--report", tmp_path / "r.html"]
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, env={"PATH": ""})
    assert done.returncode == 2, done.stdout + done.stderr
    assert "pip install 'libins[report]'" in done.stderr and "Traceback" not in done.stderr
    assert not (tmp_path / "r.html").exists()
