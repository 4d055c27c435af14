"""The report of a replay: one self-contained HTML page with a map and plots. The same bytes for the same replay."""

from typing import Any

import matplotlib
import numpy as np
from jinja2 import Environment, PackageLoader, select_autoescape
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from libins import core, pictures
from libins.recording import Array
from libins.replay import CHECK, STATE, Drive, Solution, within
from libins.replay_score import BOUND_95, NIS_NAMES, columns, horizontal

PLOT_POINTS = 4000
NIS_TOP = 20.0


def _metres(place: Array, origin: Array) -> Array:
    radii = np.asarray(core.earth_radii(float(np.sin(origin[0])))) + origin[2]
    return np.asarray((place[:, :2] - origin[:2]) * np.array([radii[0], radii[1] * np.cos(origin[0])]))


def path_plot(drive: Drive, solution: Solution) -> str:
    """North over east: fixes, the path, and where it had none."""
    run, spans = solution.runs[0], solution.spans[0]
    states = run.states[:: max(1, len(run.states) // PLOT_POINTS)]
    origin = drive.gnss.position[0]
    path, fixes = _metres(states[:, 1:4], origin), _metres(drive.gnss.position, origin)
    hidden = within(states[:, 0], spans)
    with matplotlib.rc_context({"font.size": 9}):
        figure = Figure(figsize=(9, 7), layout="constrained")
        axes = figure.subplots()
        axes.plot(fixes[:, 1], fixes[:, 0], ".", color="0.6", markersize=2.5, label="fixes")
        axes.plot(path[:, 1], path[:, 0], linewidth=0.9, color="tab:blue", label="navigated")
        alone = np.where(hidden[:, None], path, np.nan)
        axes.plot(alone[:, 1], alone[:, 0], linewidth=1.6, color="tab:red", label="without fixes")
        if run.smoothed is not None:
            smooth = _metres(run.smoothed[:: max(1, len(run.smoothed) // PLOT_POINTS), 1:4], origin)
            axes.plot(smooth[:, 1], smooth[:, 0], linewidth=0.7, color="tab:green", label="smoothed")
        axes.set_xlabel(f"east [m] of longitude {np.rad2deg(origin[1]):.7f} deg")
        axes.set_ylabel(f"north [m] of latitude {np.rad2deg(origin[0]):.7f} deg")
        axes.set_aspect("equal", adjustable="datalim")
        axes.grid(alpha=0.3)
        axes.legend(frameon=False)
        return pictures.svg(figure)


def _shade(axes: Axes, solution: Solution) -> None:
    for begin, end in solution.spans[0]:
        axes.axvspan(begin, end, color="tab:red", alpha=0.08, linewidth=0)
    axes.grid(alpha=0.3)


def error_plot(solution: Solution) -> str:
    """Errors before each fix and the filter's own standard deviation; velocities; NIS."""
    run = solution.runs[0]
    t, ts = run.checks[:, CHECK["t_s"]], run.states[:, STATE["t_s"]]
    with matplotlib.rc_context({"font.size": 9}):
        figure = Figure(figsize=(9, 8), layout="constrained")
        place, speed, nis = figure.subplots(3, 1, sharex=True)
        sigma = np.hypot(*columns(run.states, STATE, "sigma_n_m", "sigma_e_m").T)
        step = max(1, len(ts) // PLOT_POINTS)
        place.semilogy(t, np.maximum(horizontal(run.checks, "before"), 1e-3), linewidth=0.8, label="horizontal error")
        place.semilogy(ts[::step], sigma[::step], linewidth=0.9, color="0.3", label="filter's sigma")
        place.set_ylabel("filter - fix [m]")
        place.legend(frameon=False)
        for name, colour in zip("ned", ("tab:green", "tab:orange", "tab:blue"), strict=True):
            speed.plot(t, run.checks[:, CHECK[f"dv_{name}_before"]], linewidth=0.8, color=colour, label=f"v_{name}")
        speed.set_ylabel("filter - fix [m/s]")
        speed.legend(frameon=False, ncols=3)
        for name in NIS_NAMES:
            nis.plot(
                t, np.minimum(run.checks[:, CHECK[name]], NIS_TOP), ".", markersize=2, label=name.removeprefix("nis_")
            )
        nis.axhline(BOUND_95, color="0.3", linewidth=0.8)
        nis.set_ylabel(f"NIS (cut at {NIS_TOP:g}; line: 95 %)")
        nis.set_xlabel("time [s]; red: fixes withheld")
        nis.legend(frameon=False, ncols=6, markerscale=4)
        for axes in (place, speed, nis):
            _shade(axes, solution)
        return pictures.svg(figure)


def state_plot(solution: Solution) -> str:
    """Attitude, speed and biases."""
    states = solution.runs[0].states
    states = states[:: max(1, len(states) // PLOT_POINTS)]
    t = states[:, 0]
    euler = np.rad2deg(core.quat_to_euler(np.ascontiguousarray(columns(states, STATE, "q_w", "q_x", "q_y", "q_z"))))
    with matplotlib.rc_context({"font.size": 9}):
        figure = Figure(figsize=(9, 8), layout="constrained")
        angles, heading, gyro, accel = figure.subplots(4, 1, sharex=True)
        angles.plot(t, euler[:, 0], linewidth=0.8, label="roll")
        angles.plot(t, euler[:, 1], linewidth=0.8, label="pitch")
        angles.set_ylabel("angle [deg]")
        heading.plot(t, euler[:, 2], ".", markersize=1.5, label="heading")
        heading.set_ylabel("heading [deg]")
        for axis in "xyz":
            gyro.plot(t, np.rad2deg(states[:, STATE[f"bg_{axis}_rad_s"]]), linewidth=0.8, label=axis)
            accel.plot(t, states[:, STATE[f"ba_{axis}_m_s2"]], linewidth=0.8, label=axis)
        gyro.set_ylabel("gyro bias [deg/s]")
        accel.set_ylabel("accelerometer\nbias [m/s^2]")
        accel.set_xlabel("time [s]; red: fixes withheld")
        for axes in (angles, heading, gyro, accel):
            _shade(axes, solution)
            axes.legend(frameon=False, ncols=3)
        return pictures.svg(figure)


def html(name: str, text: str, result: dict[str, Any], drive: Drive, solution: Solution) -> str:
    """One self-contained page. Holds no wall-clock figure."""
    environment = Environment(
        loader=PackageLoader("libins", "."), autoescape=select_autoescape(), trim_blocks=True, lstrip_blocks=True
    )
    plots = [path_plot(drive, solution), error_plot(solution), state_plot(solution)]
    return environment.get_template("replay.html").render(
        name=name, result=result, configuration=text, plots=[Markup(plot) for plot in plots]
    )
