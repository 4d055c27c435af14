"""The report of a run: one self-contained HTML page with plots. The same bytes for the same run."""

from collections.abc import Mapping
from typing import Any

import matplotlib
import numpy as np
from jinja2 import Environment, PackageLoader, select_autoescape
from markupsafe import Markup
from matplotlib.figure import Figure

from libins import _run, coverage, moments, pictures, profile, report, views
from libins.net_scenario import NetScenario
from libins.run import AXES, COLUMNS, Array, Result
from libins.tables import Loaded

PLOT_POINTS = 1500
"""More states than this are thinned for the plot (the figures above it count them all)."""


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


def _spread(name: str, values: Array, digits: int = 3) -> tuple[str, ...]:
    """A row: least, median, 99 %, most."""
    found = (values.min(), *np.percentile(values, [50, 99]), values.max())
    return (name, *(f"{value:.{digits}f}" for value in found))


def timing(result: Result) -> list[tuple[str, ...]]:
    """Rows: what follows what, and how late."""
    rows = []
    if len(result.scans) > 1:
        channels = result.scans.shape[1] // 2
        at_us = result.scans[:, :channels] * 1e6
        rows.append(_spread("from one scan to the next [us]", np.diff(at_us[:, 0])))
        for name, column in zip(result.scan_columns[1:channels], at_us[:, 1:].T, strict=True):
            rows.append(
                _spread(f"sample {name.removesuffix('_s')} after the first of its scan [us]", column - at_us[:, 0])
            )
    if len(result.states) > 1:
        columns = list(result.columns)
        if "age_s" in columns:
            rows.append(
                _spread("age of the attitude when it was ready [ms]", result.states[:, columns.index("age_s")] * 1e3)
            )
        at = columns.index("at_s" if "at_s" in columns else "t_s")
        rows.append(_spread("from one state to the next [ms]", np.diff(result.states[:, at]) * 1e3))
    return rows


def carried(result: Result) -> list[tuple[str, ...]]:
    """Rows: what each line carried."""
    sim_s = result.summary["sim_s"]
    return [
        (
            name, f"{line.baud:g}", str(line.octets), str(line.bad), f"{line.octet_s * 1e6:.1f}",
            f"{line.shortest_ps * 1e-6:.1f}" if line.octets > 1 else "-",
            f"{100 * line.octets * line.octet_s / sim_s:.2f}",
        )
        for name, line in result.lines.items()
    ]  # fmt: skip


def _coverage(observed: dict[str, Any]) -> list[tuple[str, ...]]:
    covered = observed.get("coverage", {})
    rows: list[tuple[str, ...]] = [
        (what, str(covered[what]), str(covered[f"{what}_covered"]))
        for what in ("functions", "lines", "branches")
        if what in covered
    ]
    if "instructions_covered" in covered:
        rows.insert(
            0, ("instructions (no debug information beside the image)", "-", str(covered["instructions_covered"]))
        )
    return rows


def _files(files: Mapping[str, coverage.File]) -> list[tuple[str, ...]]:
    return [
        (
            name, str(len(file.lines)), str(sum(file.lines.values())),
            coverage.ranges(number for number, ran in file.lines.items() if not ran),
        )
        for name, file in files.items()
    ]  # fmt: skip


def _link(summary: dict[str, Any]) -> list[tuple[str, str]]:
    """Of the navigator, else of every host."""
    if summary["link"] is not None:
        counts = [("", summary["link"])]
    else:
        counts = [(f"{name}: ", host) for name, host in summary.get("hosts", {}).items()]
    return [
        (prefix + name.replace("_", " "), "not seen from here" if count is None else str(count))
        for prefix, host in counts
        for name, count in host.items()
        if not isinstance(count, dict)
    ]


def html(
    scenario: Loaded,
    result: Result,
    view: views.View | None = None,
    files: Mapping[str, coverage.File] | None = None,
) -> str:
    """One self-contained page. Holds no wall-clock figure."""
    environment = Environment(
        loader=PackageLoader("libins", "."), autoescape=select_autoescape(), trim_blocks=True, lstrip_blocks=True
    )
    summary = result.summary
    observed = summary.get("observed", {})
    span_s = moments.SPAN_S
    return environment.get_template("report.html").render(
        summary=summary,
        checks=result.checks,
        moments=[(each.title, _markup(pictures.lines(each.view, span_s))) for each in result.moments],
        plot=_markup(_plot(result)),
        logic=_markup(pictures.logic(view)) if view else None,
        lines=_markup(pictures.lines(view, span_s)) if view and isinstance(scenario, NetScenario) else None,
        cpu=report.cpu_text(summary),
        scope=_markup(pictures.scope(view)) if view else None,
        link=_link(summary),
        carried=carried(result),
        faults=[
            (place, kind, str(count)) for place, hit in summary.get("faults", {}).items() for kind, count in hit.items()
        ],
        timing=timing(result),
        profile=profile.text(observed) if observed.get("functions") else None,
        coverage=_coverage(observed),
        files=_files(files or {}),
        compiled=isinstance(scenario, NetScenario) and bool(scenario.programs),
        axes=AXES,
        scenario_text=scenario.text,
    )
