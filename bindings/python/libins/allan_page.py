"""The report of `ins allan`: one self-contained HTML page with the curves."""

from typing import Any

import matplotlib
from jinja2 import Environment, PackageLoader, select_autoescape
from markupsafe import Markup
from matplotlib.figure import Figure

from libins import pictures
from libins.allan_cli import CUSTOMARY, SYMBOLS, kind_of

COLOURS = ("tab:green", "tab:orange", "tab:blue")
LABELS = {"rate": "Allan deviation [rad/s]", "force": "Allan deviation [m/s²]"}


def curves(result: dict[str, Any], kind: str) -> str:
    """Deviation with its 68 % bars and the model, of one kind of sensor, as SVG."""
    with matplotlib.rc_context({"font.size": 9}):
        figure = Figure(figsize=(9, 4.5), layout="constrained")
        axes = figure.subplots()
        columns = {name: column for name, column in result["columns"].items() if kind_of(name) == kind}
        for (name, c), colour in zip(columns.items(), COLOURS, strict=False):
            axes.fill_between(c["tau_s"], c["low"], c["high"], color=colour, alpha=0.2, linewidth=0)
            axes.plot(c["tau_s"], c["adev"], color=colour, marker=".", markersize=4, linewidth=0, label=name)
            axes.plot(c["tau_s"], c["model"], color=colour, linewidth=0.9, label=f"{name}, model")
        axes.set_xscale("log")
        axes.set_yscale("log")
        axes.set_xlabel("cluster time [s]")
        axes.set_ylabel(LABELS[kind])
        axes.grid(alpha=0.3, which="both")
        axes.legend(frameon=False)
        return pictures.svg(figure)


def html(name: str, result: dict[str, Any]) -> str:
    """One self-contained page."""
    environment = Environment(
        loader=PackageLoader("libins", "."), autoescape=select_autoescape(), trim_blocks=True, lstrip_blocks=True
    )
    kinds = [kind for kind in LABELS if any(kind_of(column) == kind for column in result["columns"])]
    return environment.get_template("allan.html").render(
        name=name,
        result=result,
        symbols=SYMBOLS,
        customary={column: CUSTOMARY[kind_of(column)] for column in result["columns"]},
        plots=[Markup(curves(result, kind)) for kind in kinds],
    )
