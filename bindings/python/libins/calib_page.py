"""The report of a calibration: one self-contained HTML page with its residuals. The same bytes for the same data."""

from typing import Any

import matplotlib
import numpy as np
from jinja2 import Environment, PackageLoader, select_autoescape
from markupsafe import Markup
from matplotlib.figure import Figure

from libins import calib_text, pictures
from libins.calibration import Result


def residual_plot(result: Result) -> str:
    """Each sensor's residuals over the poses, as SVG."""
    count = len(result.labels)
    with matplotlib.rc_context({"font.size": 9}):
        figure = Figure(figsize=(9, 1.1 + 1.1 * count), layout="constrained")
        rows = np.atleast_1d(figure.subplots(count, 1, sharex=True))
        poses = np.arange(1, len(result.residuals) + 1)
        for axes, label, values in zip(rows, result.labels, result.residuals.T, strict=True):
            axes.axhline(0, color="black", linewidth=0.6)
            axes.stem(poses, values, markerfmt=".", basefmt=" ")
            axes.set_ylabel(label if not result.unit else f"{label}\n[{result.unit}]")
            axes.grid(alpha=0.3)
        rows[-1].set_xlabel("pose")
        return pictures.svg(figure)


def _rows(result: Result) -> list[tuple[str, str, str, str]]:
    """Sensor, parameter, value, standard deviation."""
    found = []
    for name, table in result.tables.items():
        for i, row in enumerate(table if isinstance(table, list) else [table], start=1):
            which = f"{name} {row.get('number', i)}" if isinstance(table, list) else name
            values = row.get("parameters") or {key: value for key, value in row.items() if key != "deviation"}
            deviations: Any = row.get("deviation") if "parameters" in row else {}
            found += [
                (which, key, calib_text.short(value), calib_text.short(deviations[key]) if key in deviations else "")
                for key, value in values.items()
                if key != "number"
            ]
    return found


def html(result: Result, declaration: str) -> str:
    """One self-contained page."""
    environment = Environment(
        loader=PackageLoader("libins", "."), autoescape=select_autoescape(), trim_blocks=True, lstrip_blocks=True
    )
    return environment.get_template("calib.html").render(
        method=result.method,
        figures={name: calib_text.short(value) for name, value in result.figures.items()},
        rows=_rows(result),
        plot=Markup(residual_plot(result)),
        declaration=declaration,
    )
