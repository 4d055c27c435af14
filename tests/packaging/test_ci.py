"""The CI action and the job examples: valid by their makers' schemas, and their own lines run a project of a user's."""

import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import pytest
import yaml
from packaging_kit import EXAMPLES, ROOT, WALL_LIMIT_S, run

ACTION = ROOT / "packaging/ci/action.yml"
GITHUB, GITLAB = EXAMPLES / "ci/github.yml", EXAMPLES / "ci/gitlab-ci.yml"
SCHEMAS = {ACTION: "vendor.github-actions", GITHUB: "vendor.github-workflows", GITLAB: "vendor.gitlab-ci"}


def load(path: Path) -> Any:
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def check(path: Path, schema: str, code: int = 0) -> str:
    return run(sys.executable, "-m", "check_jsonschema", "--builtin-schema", schema, path, code=code)


@pytest.mark.parametrize("path", SCHEMAS, ids=lambda path: path.name)
def test_valid_by_the_schema(path: Path, tmp_path: Path) -> None:
    check(path, SCHEMAS[path])
    wrong = tmp_path / path.name
    text = path.read_text(encoding="utf-8")
    wrong.write_text(
        text.replace("composite", "bundle").replace("runs-on:", "run-on:").replace("script:", "scripts:", 2)
    )
    assert wrong.read_text(encoding="utf-8") != text
    check(wrong, SCHEMAS[path], code=1)


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """As the examples say, with ins, python3 and pytest of this environment first in its PATH."""
    shutil.copytree(EXAMPLES / "board_pytest", tmp_path / "project/firmware")
    (tmp_path / "bin").mkdir()
    for name, words in {"python3": "", "ins": "-m libins", "pytest": "-m pytest"}.items():
        script = tmp_path / "bin" / name
        script.write_text(f'#!/bin/sh\nexec "{sys.executable}" {words} "$@"\n', encoding="utf-8")
        script.chmod(0o755)
    return tmp_path / "project"


def shell(project: Path, text: str, **env: str) -> int:
    """Exit code of a step, as the runner's bash runs it."""
    path = f"{project.parent / 'bin'}:{os.environ['PATH']}"
    # Installed, the plugin is found by its entry point; in the build tree it is named.
    env = {**os.environ, "PATH": path, "PYTEST_PLUGINS": "libins.pytest_plugin", "PYTEST_ADDOPTS": "", **env}
    done = subprocess.run(
        ["bash", "-eo", "pipefail", "-c", text],
        cwd=project,
        env=env,
        capture_output=True,
        text=True,
        timeout=WALL_LIMIT_S,
    )
    print(done.stdout, done.stderr)
    return done.returncode


def act(project: Path, inputs: dict[str, str]) -> list[int]:
    """Exit codes of the action's own steps; an input that is empty leaves its step out, as `if` says."""
    action = load(ACTION)
    values = {name: str(inputs.get(name, given["default"])) for name, given in action["inputs"].items()}
    codes = []
    for step in action["runs"]["steps"]:
        asked = re.search(r"inputs\.(\w+) != ''", str(step.get("if", "")))
        if "run" in step and asked and values[asked[1]]:
            env = {k: re.sub(r"\$\{\{ inputs\.(\w+) \}\}", lambda m: values[m[1]], v) for k, v in step["env"].items()}
            codes.append(shell(project, step["run"], **env))
    return codes


def cases(folder: Path) -> dict[str, int]:
    """Test cases in each JUnit file."""
    return {path.name: len(list(ET.parse(path).iter("testcase"))) for path in sorted(folder.glob("*.xml"))}


def test_the_github_job_runs(project: Path) -> None:
    *steps, last = load(GITHUB)["jobs"]["board"]["steps"]
    (build,) = [step["run"] for step in steps if step.get("run", "").startswith("make")]
    assert shell(project, build) == 0
    assert last["uses"].endswith("/packaging/ci") and set(last["with"]) <= set(load(ACTION)["inputs"])
    assert act(project, {**last["with"], "package": ""}) == [0, 0]
    assert cases(project / "libins-results") == {"pytest.xml": 8, "scenario1.xml": 6, "scenario2.xml": 2}


def test_the_gitlab_job_runs(project: Path) -> None:
    job = load(GITLAB)["board"]
    assert [shell(project, line) for line in job["script"]] == [0] * len(job["script"])
    assert cases(project / job["artifacts"]["paths"][0]) == {"default.xml": 6, "meter.xml": 2, "pytest.xml": 8}


def test_a_failure_fails_the_job_and_leaves_its_artifacts(project: Path) -> None:
    assert shell(project, "make -C firmware meter.ihx") == 0
    source = project / "firmware/test_meter.py"
    source.write_text(source.read_text(encoding="utf-8").replace("(2.9, True)", "(2.9, False)"), encoding="utf-8")
    scenarios = "default --stop-s 1 --set expect.1.at_most=1e-9\n\n  default --stop-s 1 --set stop_samples=1000"
    assert act(project, {"package": "", "scenarios": scenarios, "pytest": "firmware"}) == [42, 1]
    results = project / "libins-results"
    assert set(cases(results)) == {"pytest.xml", "scenario1.xml", "scenario2.xml"}
    (folder,) = (results / "boards").iterdir()
    assert "test_lamp" in folder.name and (folder / "trace.vcd").exists()
