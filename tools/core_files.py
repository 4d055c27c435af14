"""The core's version and files, from where they are written down once.  SPDX-License-Identifier: MIT.

version.h has the version, libins/core/CMakeLists.txt the sources, include/ins the headers.
"""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CORE = ROOT / "libins" / "core"


def version() -> str:
    """MAJOR.MINOR.PATCH."""
    text = (CORE / "include/ins/version.h").read_text(encoding="utf-8")
    return ".".join(re.findall(r"^#define INS_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", text, re.MULTILINE))


def sources() -> list[Path]:
    """The .c files of the library, sorted."""
    listed = re.search(r"set\(INS_CORE_SOURCES\s+([^)]*)\)", (CORE / "CMakeLists.txt").read_text(encoding="utf-8"))
    if not listed:
        raise SystemExit(f"{CORE / 'CMakeLists.txt'} has no set(INS_CORE_SOURCES ...)")
    return [CORE / name for name in sorted(listed[1].split())]


def internal_headers() -> list[Path]:
    """Headers of the sources, not installed."""
    return sorted((CORE / "src").glob("*.h"))


def headers() -> list[Path]:
    """The installed headers."""
    return sorted((CORE / "include/ins").glob("*.h"))


def licence() -> str:
    """Text of the licence."""
    return (ROOT / "LICENSE").read_text(encoding="utf-8")
