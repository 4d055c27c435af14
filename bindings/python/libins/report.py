"""What a run has to show: a few lines of text, CSV, and an HTML page with plots. The same bytes for the same run."""

import io
from collections.abc import Iterable
from typing import Any

import matplotlib
import numpy as np
from jinja2 import Environment, PackageLoader, select_autoescape
from markupsafe import Markup

from libins import _run
from libins.run import AXES, COLUMNS, Array, Result
from libins.scenario import Scenario

matplotlib.use("svg")

from matplotlib.figure import Figure  # noqa: E402

PLOT_POINTS = 1500
"""More states than this are thinned for the plot (the figures above it count them all)."""


def trace_lines(edges: Array) -> Iterable[str]:
    """CSV lines of a block of edges."""
    return (f"{at},{_run.WIRES[wire]},{level}\n" for at, wire, level in edges.tolist())


def states_csv(states: Array) -> str:
    """All states, one line each, columns named with their unit."""
    out = io.StringIO()
    out.write(",".join(_run.STATE_COLUMNS) + "\n")
    for row in states.tolist():
        out.write(",".join(repr(value) for value in row) + "\n")
    return out.getvalue()


def text(summary: dict[str, Any]) -> str:
    """The summary for a terminal."""
    speed = summary["speed"]
    lines = [
        f"{summary['scenario']}: {summary['firmware']}, seed {summary['seed']}, {summary['sim_s']:g} s simulated "
        f"in {summary['wall_s']:.2f} s ({speed:.0f} times real time)",
        f"cpu       {summary['cpu']['instructions']} instructions, {summary['cpu']['cycles']} machine cycles",
    ]
    if (link := summary["link"]) is not None:
        lines.append(
            f"link      {link['sent']} sampled, {link['ok']} accepted, {link['retried']} retried, {link['lost']} lost, "
            f"{link['corrupt_accepted']} corrupt accepted"
        )
    if (attitude := summary["attitude"]) is not None:
        for kind in ("rms", "max"):
            values = ", ".join(f"{axis} {attitude[f'{kind}_rad'][axis]:.2e}" for axis in AXES)
            lines.append(f"error     {kind} [rad]: {values}")
    if (age := summary["age_s"]) is not None:
        lines.append(f"age       {age['min'] * 1e3:.2f} to {age['max'] * 1e3:.2f} ms from the sample to the attitude")
    if summary["dds"] is not None:
        lines.append(f"dds       {summary['dds']['published']} published")
    lines += [
        f"{r['kind']}: {r['text']} ({r['detail']:#x}), {r['count']} times, first at {r['first_s']:.6f} s"
        for r in summary["reports"]
    ]
    lines += [f"expected  {failure}" for failure in summary["failed"]]
    if summary["not_judged"]:
        lines.append(f"not judged, the host is outside: {', '.join(summary['not_judged'])}")
    lines.append(f"verdict   {summary['verdict']}")
    return "\n".join(lines)


def attitude_plot(states: Array) -> str:
    """Truth against estimate, and the error, as SVG."""
    thinned = states[:: max(1, len(states) // PLOT_POINTS)]
    t = thinned[:, COLUMNS["t_s"]]
    with matplotlib.rc_context({"svg.hashsalt": "libins", "svg.fonttype": "none", "font.size": 9}):
        figure = Figure(figsize=(9, 6), layout="constrained")
        angles, errors = figure.subplots(2, 1, sharex=True, height_ratios=[3, 2])
        for axis, colour in zip(AXES, ("tab:green", "tab:orange", "tab:blue"), strict=True):
            truth = thinned[:, COLUMNS[f"true_{axis}_rad"]]
            angles.plot(t, truth, color=colour, linewidth=3, alpha=0.3, label=f"{axis}, truth")
            angles.plot(t, thinned[:, COLUMNS[f"{axis}_rad"]], color=colour, linewidth=0.9, label=f"{axis}, estimate")
            errors.plot(t, thinned[:, COLUMNS[f"error_{axis}_rad"]] * 1e3, color=colour, linewidth=0.9, label=axis)
        angles.set_ylabel("angle [rad]")
        angles.legend(ncols=3, loc="upper right", frameon=False)
        errors.set_ylabel("estimate - truth [mrad]")
        errors.set_xlabel("time [s]")
        for axes in (angles, errors):
            axes.grid(alpha=0.3)
        out = io.StringIO()
        figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None})
    return out.getvalue()[out.getvalue().index("<svg") :]


def html(scenario: Scenario, result: Result) -> str:
    """One self-contained page. Holds no wall-clock figure."""
    environment = Environment(
        loader=PackageLoader("libins", "."), autoescape=select_autoescape(), trim_blocks=True, lstrip_blocks=True
    )
    plot = Markup(attitude_plot(result.states)) if len(result.states) else None
    return environment.get_template("report.html").render(
        summary=result.summary,
        plot=plot,
        axes=AXES,
        scenario_text=scenario.path.read_text(encoding="utf-8"),
        ages=np.round(result.states[:, COLUMNS["age_s"]] * 1e3, 3) if len(result.states) else None,
    )
