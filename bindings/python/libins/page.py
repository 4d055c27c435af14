"""The report of a run: one self-contained HTML page with plots. The same bytes for the same run."""

import matplotlib
import numpy as np
from jinja2 import Environment, PackageLoader, select_autoescape
from markupsafe import Markup
from matplotlib.figure import Figure

from libins import _run, pictures, profile, report, views
from libins.net_scenario import NetScenario
from libins.run import AXES, COLUMNS, Array, Result
from libins.tables import Loaded

PLOT_POINTS = 1500
"""More states than this are thinned for the plot (the figures above it count them all)."""
LINES_SPAN_S = 0.02
"""Of the picture of lines, before and after its instant."""


def attitude_plot(states: Array) -> str:
    """Truth against estimate, and the error, as SVG."""
    thinned = states[:: max(1, len(states) // PLOT_POINTS)]
    t = thinned[:, COLUMNS["t_s"]]
    with matplotlib.rc_context({"font.size": 9}):
        figure = Figure(figsize=(9, 6), layout="constrained")
        angles, errors = figure.subplots(2, 1, sharex=True, height_ratios=[3, 2])
        for axis, colour in zip(AXES, ("tab:green", "tab:orange", "tab:blue"), strict=True):
            truth = thinned[:, COLUMNS[f"true_{axis}_rad"]]
            angles.plot(t, truth, color=colour, linewidth=3, alpha=0.3, label=f"{axis}, truth")
            angles.plot(t, thinned[:, COLUMNS[f"{axis}_rad"]], color=colour, linewidth=0.9, label=f"{axis}, estimate")
            errors.plot(t, thinned[:, COLUMNS[f"error_{axis}_rad"]] * 1e3, color=colour, linewidth=0.9, label=axis)
        angles.set_ylabel("angle [rad]")
        figure.legend(*angles.get_legend_handles_labels(), ncols=6, loc="outside upper center", frameon=False)
        errors.set_ylabel("estimate - truth [mrad]")
        errors.set_xlabel("time [s]")
        for axes in (angles, errors):
            axes.grid(alpha=0.3)
        return pictures.svg(figure)


def solution_plot(states: Array) -> str:
    """The path and the angles that a navigating board has sent, as SVG."""
    place = {name: n for n, name in enumerate(_run.SOLUTION_COLUMNS)}
    thinned = states[:: max(1, len(states) // PLOT_POINTS)]
    with matplotlib.rc_context({"font.size": 9}):
        figure = Figure(figsize=(9, 4), layout="constrained")
        path, angles = figure.subplots(1, 2)
        known = thinned[thinned[:, place["zone"]] != 0]
        path.plot(known[:, place["easting_m"]], known[:, place["northing_m"]], linewidth=0.9)
        path.set_xlabel("easting [m]")
        path.set_ylabel("northing [m]")
        path.ticklabel_format(useOffset=False, style="plain")
        path.tick_params(axis="x", rotation=30)
        path.axis("equal")
        for name in ("roll", "pitch", "heading"):
            angles.plot(thinned[:, place["t_s"]], thinned[:, place[f"{name}_rad"]], linewidth=0.9, label=name)
        angles.legend(frameon=False)
        angles.set_xlabel("time [s]")
        angles.set_ylabel("angle [rad]")
        for axes in (path, angles):
            axes.grid(alpha=0.3)
        return pictures.svg(figure)


def _plot(result: Result) -> str | None:
    if len(result.states) == 0:
        return None
    if tuple(result.columns) == tuple(_run.SOLUTION_COLUMNS):
        return solution_plot(result.states)
    return attitude_plot(result.states)


def _markup(picture: str | None) -> Markup | None:
    return None if picture is None else Markup(picture)


def html(scenario: Loaded, result: Result, view: views.View | None = None) -> str:
    """One self-contained page. Holds no wall-clock figure."""
    environment = Environment(
        loader=PackageLoader("libins", "."), autoescape=select_autoescape(), trim_blocks=True, lstrip_blocks=True
    )
    scored = len(result.states) > 0 and list(result.columns[: len(COLUMNS)]) == list(COLUMNS)
    return environment.get_template("report.html").render(
        summary=result.summary,
        plot=_markup(_plot(result)),
        logic=_markup(pictures.logic(view)) if view else None,
        lines=_markup(pictures.lines(view, LINES_SPAN_S)) if view and isinstance(scenario, NetScenario) else None,
        cpu=report.cpu_text(result.summary),
        scope=_markup(pictures.scope(view)) if view else None,
        profile=profile.text(result.summary["observed"]) if "coverage" in result.summary.get("observed", {}) else None,
        axes=AXES,
        scenario_text=scenario.text,
        ages=np.round(result.states[:, COLUMNS["age_s"]] * 1e3, 3) if scored else None,
    )
