"""What the packaging tests share: places, number types, commands that must succeed, tools that must be there."""

import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CORE = ROOT / "libins" / "core"
EXAMPLES = ROOT / "examples"
WALL_LIMIT_S = 600  # a hang, not a figure

STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wdouble-promotion", "-Wshadow", "-Werror"]
REALS = {"double": [], "float": ["-DINS_REAL_FLOAT"]}
LIBRARY = {"double": "libins", "float": "libinsf"}

Prefix = Callable[[str], Path]


def run(*command: object, code: int = 0, stdin: str = "", cwd: Path | None = None, **env: str) -> str:
    """The output of a command; its exit code must be the one expected."""
    words = [str(word) for word in command]
    assert shutil.which(words[0]), f"{words[0]} is missing: ./dev test installs it (list of packages at the top of dev)"
    done = subprocess.run(
        words, input=stdin, capture_output=True, text=True, timeout=WALL_LIMIT_S, cwd=cwd, env={**os.environ, **env}
    )
    assert done.returncode == code, f"{' '.join(words)}\nexit code {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def configure(source: Path, build: Path, *options: str, code: int = 0) -> str:
    cache = ["-DCMAKE_C_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    # As on a user's machine: a C compiler, and none for C++.
    return run(
        *(
            "cmake",
            "-G",
            "Ninja",
            "-S",
            source,
            "-B",
            build,
            "-DCMAKE_BUILD_TYPE=Release",
            "-DCMAKE_C_FLAGS_RELEASE=-O1",
            *cache,
            *options,
        ),
        code=code,
        CXX="/nonexistent",
    )
