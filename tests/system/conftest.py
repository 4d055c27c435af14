"""What the system tests share: the built `ins` command, run as a user runs it."""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
SCENARIOS = ROOT / "emu/8051_tlc2543/scenarios"
WALL_LIMIT_S = 120

Ins = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture(scope="session")
def ins() -> Ins:
    """Run `ins ARGUMENTS...`; env adds to the environment."""

    def call(*arguments: object, env: dict[str, str] | None = None) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "libins", *map(str, arguments)]
        return subprocess.run(
            command, capture_output=True, text=True, timeout=WALL_LIMIT_S, env={**os.environ, **(env or {})}
        )

    return call


@pytest.fixture
def scenario(tmp_path: Path) -> Callable[..., Path]:
    """A variant of a scenario that comes with the package: text replacements, then lines at the end."""

    def make(name: str, *replacements: tuple[str, str], tail: str = "") -> Path:
        text = (SCENARIOS / f"{name}.toml").read_text(encoding="utf-8")
        for old, new in replacements:
            assert old in text, f"{old!r} is not in {name}.toml"
            text = text.replace(old, new)
        path = tmp_path / f"{name}_variant.toml"
        path.write_text(text + tail, encoding="utf-8")
        return path

    return make


@pytest.fixture
def summary(ins: Ins, tmp_path: Path) -> Callable[..., dict[str, Any]]:
    """Run a scenario and give its JSON summary; the exit code must be the one expected."""

    def run(path: object, *options: object, code: int = 0, env: dict[str, str] | None = None) -> dict[str, Any]:
        out = tmp_path / "summary.json"
        done = ins("run", path, "--json", out, *options, env=env)
        assert done.returncode == code, done.stdout + done.stderr
        result: dict[str, Any] = json.loads(out.read_text(encoding="utf-8"))
        return result

    return run


def timeless(summary: dict[str, Any]) -> dict[str, Any]:
    """A summary without its wall-clock fields."""
    return {key: value for key, value in summary.items() if key not in ("wall_s", "speed")}
