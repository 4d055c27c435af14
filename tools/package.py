"""Assembles a package of the core for a package manager of firmware.  SPDX-License-Identifier: MIT.

    python3 tools/package.py {platformio,arduino,esp_idf,zephyr} FOLDER [--url URL]

packaging/KIND is copied, with the version filled in, beside the core's own files. --url is the home page of the copy
you publish (registries want one); without it the line is left out. Arduino has no place for a flag that both a sketch
and a library see, so its package is the amalgamation, fixed to float.
"""

import argparse
import shutil
from pathlib import Path

import amalgamate
import core_files

KINDS = ("platformio", "arduino", "esp_idf", "zephyr")


def fill(template: str, url: str | None) -> str:
    """The template's text with its placeholders replaced."""
    lines = [line for line in template.splitlines(keepends=True) if url or "@URL@" not in line]
    return "".join(lines).replace("@VERSION@", core_files.version()).replace("@URL@", url or "")


def assemble(kind: str, folder: Path, url: str | None = None) -> None:
    """The package of this kind into folder, which must not be there or be empty."""
    if folder.exists() and any(folder.iterdir()):
        raise SystemExit(f"{folder} is not empty: name another folder, or remove it")
    template = core_files.ROOT / "packaging" / kind
    for path in sorted(p for p in template.rglob("*") if p.is_file()):
        out = folder / path.relative_to(template)
        out.parent.mkdir(parents=True, exist_ok=True)
        out.write_text(fill(path.read_text(encoding="utf-8"), url), encoding="utf-8")
    (folder / "LICENSE").write_text(core_files.licence(), encoding="utf-8")
    if kind == "arduino":
        amalgamate.write(folder / "src", single=True)
        return
    (folder / "src").mkdir()
    (folder / "include/ins").mkdir(parents=True)
    for path in [*core_files.sources(), *core_files.internal_headers()]:
        shutil.copy(path, folder / "src")
    for path in core_files.headers():
        shutil.copy(path, folder / "include/ins")


def main() -> None:
    """The command."""
    arguments = argparse.ArgumentParser(description="assembles a package of the core")
    arguments.add_argument("kind", choices=KINDS)
    arguments.add_argument("folder", type=Path)
    arguments.add_argument("--url", help="home page")
    given = arguments.parse_args()
    assemble(given.kind, given.folder, given.url)


if __name__ == "__main__":
    main()
