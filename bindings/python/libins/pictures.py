"""Pictures of a window of a run, as SVG: nets as a logic analyser shows them, inputs as an oscilloscope does.

The logic analyser shows one scan with the channel and code of each transfer, and the exchange on the line with its
octets; the oscilloscope the volts at the inputs over a second, and on them what each sample's code stands for.
"""

import io

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from libins.uart import PS_PER_S
from libins.views import CHANNELS, LINES, Edges, View

TRANSFERS = 4
"""Of a scan."""
CONVERTER = ("/CS", "I/O CLOCK", "DATA IN", "DATA OUT", "EOC")
COLOURS = ("tab:green", "tab:orange", "tab:blue")
REF_V = 5.0
CODES = 4096
MARGIN = 0.03
HIGH = 0.7
"""Height of a trace; traces are 1 apart."""


INK = {"#000000": "currentColor", "#4d4d4d": "#808080"}
"""On a page that may be light or dark: black is what its text has, and a dark grey a middle one."""


def svg(figure: Figure) -> str:
    """A figure as an SVG element without a ground of its own; the same bytes for the same figure."""
    out = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": "libins", "svg.fonttype": "none"}):
        figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None}, transparent=True)
    text = out.getvalue()[out.getvalue().index("<svg") :]
    for colour, other in INK.items():
        text = text.replace(colour, other)
    return text


def _falls(edges: Edges, since: int) -> list[int]:
    return [at for at, level in edges[1:] if not level and at >= since]


def _traces(axes: Axes, view: View, nets: tuple[str, ...], begin: float, end: float, unit: float) -> None:
    """Nets below each other, time in `unit` picoseconds from the begin."""
    for row, net in enumerate(reversed(nets)):
        edges = view.nets[net]
        before = [level for at, level in edges if at <= begin]
        inside = [(at, level) for at, level in edges if begin < at < end]
        times = [begin, *(at for at, _ in inside), end]
        levels = [before[-1] if before else edges[0][1], *(level for _, level in inside)]
        heights = [row + HIGH * level for level in (*levels, levels[-1])]
        axes.step([(t - begin) / unit for t in times], heights, where="post", linewidth=0.9, color="tab:blue")
    axes.set_yticks([row + HIGH / 2 for row in range(len(nets))], reversed(nets))
    axes.set_xlim(0, (end - begin) / unit)
    axes.set_ylim(-0.2, len(nets) + 0.5)
    axes.tick_params(axis="y", length=0)
    axes.grid(axis="x", alpha=0.3)


def logic(view: View) -> str | None:
    """The first scan after the view's instant and the exchange that follows; None when there is none."""
    if "/CS" not in view.nets:
        return None
    falls = _falls(view.nets["/CS"], view.at_ps)[:TRANSFERS]
    rises = [at for at, level in view.nets["/CS"] if level and falls and at > falls[0]][:TRANSFERS]
    if len(rises) < TRANSFERS:
        return None
    with matplotlib.rc_context({"font.size": 9}):
        figure = Figure(figsize=(9, 5.2), layout="constrained")
        scan, exchange = figure.subplots(2, 1, height_ratios=[3, 2])
        margin = MARGIN * (rises[-1] - falls[0])
        begin, end = falls[0] - margin, rises[-1] + 2 * margin
        _traces(scan, view, CONVERTER, begin, end, 1e6)
        for at, channel, code, _ in view.samples:
            if begin < at < end:
                scan.plot([(at - begin) / 1e6] * 2, [0, len(CONVERTER)], color="tab:red", linewidth=0.7)
                text = f"AIN{channel} {code:03X}h"
                scan.text((at - begin) / 1e6, len(CONVERTER) + 0.05, text, ha="right", color="tab:red", fontsize=8)
        scan.set_xlabel(f"microseconds from {begin / PS_PER_S:.6f} s; red: the sample, its input and its code")
        frames = [f for net in LINES for f in view.frames[net] if f.begin_ps >= falls[0]]
        later = _falls(view.nets["/CS"], rises[-1] + 1)
        last = max((f.end_ps for f in frames if not later or f.begin_ps < later[0]), default=rises[-1])
        end = last + MARGIN * (last - begin)
        _traces(exchange, view, LINES, begin, end, 1e9)
        _octets(exchange, view, LINES, begin, end)
        exchange.set_xlabel("milliseconds; red: octets")
        return svg(figure)


def lines(view: View, span_s: float) -> str | None:
    """All nets around the view's instant, and the octets on them; None when nothing happens."""
    begin, end = view.at_ps - span_s * PS_PER_S, view.at_ps + span_s * PS_PER_S
    nets = tuple(view.nets)
    if not any(begin < at < end for net in nets for at, _ in view.nets[net][1:]):
        return None
    with matplotlib.rc_context({"font.size": 9}):
        figure = Figure(figsize=(9, 0.8 + 0.6 * len(nets)), layout="constrained")
        axes = figure.subplots()
        _traces(axes, view, nets, begin, end, 1e9)
        _octets(axes, view, nets, begin, end)
        axes.axvline((view.at_ps - begin) / 1e9, color="tab:red", linewidth=0.7, linestyle=":")
        axes.set_xlabel(
            f"milliseconds from {begin / PS_PER_S:.6f} s; dotted: {view.at_ps / PS_PER_S:.6f} s; red: octets"
        )
        return svg(figure)


def _octets(axes: Axes, view: View, nets: tuple[str, ...], begin: float, end: float) -> None:
    """On traces with time in milliseconds from the begin."""
    for row, net in enumerate(reversed(nets)):
        for frame in (f for f in view.frames[net] if begin < f.begin_ps and f.end_ps < end):
            middle = ((frame.begin_ps + frame.end_ps) / 2 - begin) / 1e9
            axes.text(middle, row + HIGH + 0.05, str(frame), ha="center", color="tab:red", fontsize=8)


def scope(view: View) -> str | None:
    """The volts at the inputs, and on them the samples as the volts their codes stand for."""
    if not len(view.volts):
        return None
    with matplotlib.rc_context({"font.size": 9}):
        figure = Figure(figsize=(9, 3.2), layout="constrained")
        axes = figure.subplots()
        for channel, (name, colour) in enumerate(zip(CHANNELS, COLOURS, strict=True)):
            axes.plot(
                view.volts[:, 0], view.volts[:, 1 + channel], color=colour, linewidth=0.8, label=f"AIN{channel} {name}"
            )
            mine = [(at / PS_PER_S, code * REF_V / CODES) for at, c, code, _ in view.samples if c == channel]
            if mine:
                axes.plot(*zip(*mine, strict=True), color=colour, linestyle="none", marker=".", markersize=4)
        axes.set_xlabel("time [s]; dots: samples, at their instants")
        axes.set_ylabel("input [V]")
        axes.grid(alpha=0.3)
        figure.legend(*axes.get_legend_handles_labels(), ncols=3, loc="outside upper center", frameon=False)
        return svg(figure)
