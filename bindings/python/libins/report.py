"""What a run has to show as text: a few lines for a terminal, and CSV. The same bytes for the same run."""

import io
from collections.abc import Iterable, Sequence
from typing import Any

from libins.run import AXES, Array


def trace_lines(wires: Sequence[str], edges: Array) -> Iterable[str]:
    """CSV lines of a block of edges."""
    return (f"{at},{wires[wire]},{level}\n" for at, wire, level in edges.tolist())


def rows_csv(columns: Sequence[str], states: Array) -> str:
    """All states or scans, one line each, columns named with their unit."""
    out = io.StringIO()
    out.write(",".join(columns) + "\n")
    for row in states.tolist():
        out.write(",".join(repr(value) for value in row) + "\n")
    return out.getvalue()


def report_line(report: dict[str, Any]) -> str:
    """What the board had to say about the firmware, how often and since when."""
    board = f"{report['board']}: " if "board" in report else ""
    times = f"{report['count']} times, first at {report['first_s']:.6f} s"
    return f"{board}{report['text']} ({report['detail']:#x}), {times}"


def cpu_text(summary: dict[str, Any]) -> str:
    """What the processors did."""
    if "boards" in summary:
        return "; ".join(f"{name} {cpu_text(board)}" for name, board in summary["boards"].items())
    cpu = summary["cpu"]
    if "instructions" in cpu:
        return f"{cpu['instructions']} instructions, {cpu['cycles']} machine cycles"
    return f"{cpu['accesses']} register accesses, {cpu['interrupts']} interrupts"


def calibration_lines(calibration: dict[str, Any] | None) -> list[str]:
    """What came out of a fixture, a line an accelerometer."""
    if calibration is None:
        return []
    lines = [f"rests     {calibration['scans']} scans or more in each, LSB {calibration['lsb_m_s2']:.4g} m/s^2"]
    paper = calibration.get("paper")
    for j, residual in calibration["residual_rms_m_s2"].items():
        printed = f"SF {paper['sf'][j]:.4f}, bias {paper['bias_g'][j]:.5f} g; " if paper else ""
        lines.append(
            f"#{j}        {printed}map off by {calibration['axis_error'][j]:.1e} of its length and "
            f"{calibration['bias_error_m_s2'][j]:.1e} m/s^2, residual {residual:.1e} m/s^2"
        )
    if paper:
        lines.append(
            "angles    " + ", ".join(f"{name} {value:.4f}" for name, value in paper["angle_deg"].items()) + " deg"
        )
    return lines


def text(summary: dict[str, Any]) -> str:
    """The summary for a terminal."""
    speed = summary["speed"]
    lines = [
        f"{summary['scenario']}: {summary['firmware']}, seed {summary['seed']}, {summary['sim_s']:g} s simulated "
        f"in {summary['wall_s']:.2f} s ({speed:.0f} times real time)",
        f"cpu       {cpu_text(summary)}",
    ]
    if (program := summary.get("program")) is not None:
        lines.append(f"program   {program['ended'] or 'did not end'}, exit code {program['exit_code']}")
    for name, host in summary.get("hosts", {}).items():
        counted = f"{host['octets_sent']} octets sent, {host['octets_received']} received"
        lines.append(f"{name:9} {counted}, {host['framing_errors']} framing errors")
    if (link := summary["link"]) is not None:
        sampled = f"{link['sent']} sampled, " if "sent" in link else ""
        corrupt = link.get("corrupt_accepted")
        lines.append(
            f"link      {sampled}{link['ok']} accepted, {link['retried']} retried, {link['lost']} lost"
            + (f", {corrupt} corrupt accepted" if corrupt is not None else "")
        )
    if (attitude := summary["attitude"]) is not None:
        for kind in ("rms", "max"):
            values = ", ".join(f"{axis} {attitude[f'{kind}_rad'][axis]:.2e}" for axis in AXES)
            lines.append(f"error     {kind} [rad]: {values}")
    if (position := summary.get("position")) is not None:
        lines.append(f"position  rms {position['rms_m']:.2f} m, max {position['max_m']:.2f} m")
    lines += calibration_lines(summary.get("calibration"))
    if (age := summary["age_s"]) is not None:
        lines.append(f"age       {age['min'] * 1e3:.2f} to {age['max'] * 1e3:.2f} ms from the sample to the attitude")
    if summary["dds"] is not None:
        received = summary["dds"]["received"]
        lines.append(
            f"dds       {summary['dds']['published']} published"
            + (f", {received} received" if received is not None else "")
        )
    lines += [f"{r['kind']}: {report_line(r)}" for r in summary["reports"]]
    lines += [f"expected  {failure}" for failure in summary["failed"]]
    if summary["not_judged"]:
        lines.append(f"not judged, the host is outside: {', '.join(summary['not_judged'])}")
    lines.append(f"verdict   {summary['verdict']}")
    return "\n".join(lines)
