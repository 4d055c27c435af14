"""The `ins calib` command: readings in poses to what core, firmware and navigator apply."""

import argparse
import json
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn

from libins import calib_tables, calib_text, calibration
from libins.errors import UsageError
from libins.whole_file import write

STEPS = 4


def options(command: argparse.ArgumentParser) -> None:
    """Adds the grammar of `ins calib`."""
    command.add_argument("declaration", type=Path, metavar="F.toml", help="method, files and columns: docs/calib.md")
    command.add_argument("--out", type=Path, metavar="F.toml", help="what was found, to be applied")
    command.add_argument("--header", type=Path, metavar="F.h", help="the same as C tables for firmware")
    command.add_argument("--report", type=Path, metavar="F.html", help="one page with residuals; holds its pictures")
    command.add_argument("--json", type=Path, metavar="F", help="all figures; - is standard output")


def run(parsed: argparse.Namespace) -> int:
    """Returns the exit code. Raises UsageError."""
    page = _page() if parsed.report is not None else None  # missing before the fit rather than after it
    document, declared = calib_tables.read(parsed.declaration)
    console = Console(stderr=True)
    with Progress(
        TextColumn("{task.description}"), BarColumn(), console=console, disable=not console.is_terminal, transient=True
    ) as progress:
        task = progress.add_task("", total=STEPS)
        result = calibration.run(
            document.path, declared, lambda step: progress.update(task, description=step, advance=1)
        )
    if str(parsed.json) != "-":
        print(calib_text.summary(result))
    if parsed.out is not None:
        write(parsed.out, calib_text.toml(result, declared.g_m_s2, document.path.name))
    if parsed.header is not None:
        write(parsed.header, calib_text.header(result, parsed.header))
    if parsed.json is not None:
        everything = {"method": result.method, "figures": result.figures, **result.tables}
        write(parsed.json, json.dumps(everything, indent=2, default=_plain) + "\n")
    if page is not None:
        write(parsed.report, page.html(result, document.text))
    return 0


def _plain(value: Any) -> Any:
    return value.tolist() if isinstance(value, (np.ndarray, np.generic)) else str(value)


def _page() -> Any:
    try:
        from libins import calib_page
    except ImportError as error:
        raise UsageError(f"--report: {error.name} is missing; pip install 'libins[report]'") from error
    return calib_page
