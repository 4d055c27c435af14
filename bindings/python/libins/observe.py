"""Looking at firmware while it runs: --vcd, --itrace, --profile, --lcov and --report of `ins run`, put together."""

import contextlib
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TextIO

import numpy as np

from libins import _run, coverage, itrace, listing, profile, vcd, views
from libins.cdb import ADDRESS_END, Cdb
from libins.cdb import load as load_cdb
from libins.disasm import SFR
from libins.errors import UsageError
from libins.growing_file import GrowingFile
from libins.scenario import Scenario


@dataclass
class Wanted:
    """What to look at, and where to write it. None: not asked for."""

    vcd: Path | None = None
    sfrs: list[str] = field(default_factory=list)
    analog_us: float = 1000.0
    itrace: Path | None = None
    lcov: Path | None = None
    profile: bool = False
    cdb: Path | None = None
    """The .cdb; without it, the one beside the image."""
    source: list[Path] = field(default_factory=list)
    """Folders with the firmware's C files."""
    view_s: float | None = None
    """Of a report, which has the profile and coverage too: the instant around which its pictures are."""


def _code(run: Any) -> Callable[[int], int]:
    """Code memory by address, as it is now."""
    return bytes(run.read("code", 0, ADDRESS_END)).__getitem__


class Observation:
    """Of one run: begin() at its begin, slice() after each piece of it, end() at its end, close() in any case."""

    def __init__(self, scenario: Scenario, wanted: Wanted) -> None:
        """Raises UsageError for what cannot be looked at."""
        self._scenario = scenario
        self._wanted = wanted
        self._table = self._debug_information()
        for name in wanted.sfrs:
            if name not in SFR:
                raise UsageError(f"--vcd-sfr {name}: is none of {', '.join(sorted(SFR))}")
        if not 1.0 <= wanted.analog_us <= 1e9:
            raise UsageError(f"--vcd-analog-us {wanted.analog_us:g}: must lie in 1 .. 1e9")
        self._paths: dict[str, Path] = {}
        if wanted.lcov and self._table:
            beside = [scenario.firmware.resolve().parent, self._table.path.resolve().parent]
            self._paths = coverage.sources(self._table, wanted.source or beside)
        self._files: list[GrowingFile] = []
        self._dump: vcd.Dump | None = None
        self._trace: itrace.Writer | None = None
        self._observer: Any = None
        self._recorder: views.Recorder | None = None
        self.files: dict[str, coverage.File] = {}
        """What ran of each C file, at the end."""

    def _debug_information(self) -> Cdb | None:
        beside = self._scenario.firmware.with_suffix(".cdb")
        path = self._wanted.cdb or (beside if beside.exists() else None)
        if path is not None:
            return listing.load([path]) if path.suffix == ".rst" else load_cdb(path)
        if listings := listing.beside(self._scenario.firmware):
            return listing.load(listings)
        if self._wanted.lcov or self._wanted.profile:
            raise UsageError(
                f"{self._scenario.firmware}: neither {beside.name} nor {beside.stem}.rst beside it; "
                "build the image with sdcc --debug, or give its .cdb or .rst with --cdb"
            )
        return None

    def begin(self, run: Any) -> None:
        """At the run's begin."""
        w = self._wanted
        code = _code(run)
        if self._table:
            self._table.correct_lines(code)
        watch: list[int] = []
        if w.view_s is not None:
            self._recorder = views.Recorder(run, w.view_s, self._scenario.tables.link.baud)
        if w.vcd:
            settings = vcd.Settings(
                self._scenario.tables.link.baud,
                sfrs=w.sfrs,
                analog_us=w.analog_us,
                interrupt_name=lambda irq: profile.interrupt_name(self._table, irq),
            )
            watch = [SFR[name] for name in w.sfrs]
            self._dump = vcd.Dump(self._open(w.vcd), run, settings)
        if w.itrace:
            self._trace = itrace.Writer(self._open(w.itrace), code)
        report = w.view_s is not None
        if w.lcov or w.profile or report:
            _run.cover(run)
        if w.vcd or w.itrace or w.profile or report:
            entries = [f.begin for f in self._table.functions] if self._table else []
            self._observer = _run.Observer(run, entries, watch, trace=w.itrace is not None)

    def _open(self, path: Path) -> TextIO:
        self._files.append(GrowingFile(path))
        return self._files[-1].text

    def slice(self, run: Any, edges: Any) -> None:
        """The edges of the traced wires since the last call."""
        pins, samples = _run.take_pin_edges(run), _run.take_samples(run)
        changes = self._observer.take_changes() if self._observer else np.empty((0, 3), np.int64)
        if self._recorder:
            self._recorder.slice(run, edges, samples)
        if self._dump:
            self._dump.slice(edges, pins, changes, samples)
        if self._trace:
            self._trace.slice(self._observer.take_trace())

    def end(self, run: Any) -> dict[str, Any]:
        """What the summary gets, `observed` if something was measured; files get their names."""
        for writer in (self._dump, self._trace):
            if writer is not None:
                writer.close()
        for file in self._files:
            file.done()
        if self._recorder:
            self._recorder.end(run)
        observed: dict[str, Any] = {}
        if self._observer is not None:
            observed |= self._profile(run)
        if self._table and (self._wanted.lcov or self._wanted.profile or self._wanted.view_s is not None):
            self.files = coverage.measure(self._table, _run.coverage(run), _code(run))
            observed["coverage"] = coverage.totals(self.files)
            if self._wanted.lcov:
                lcov = GrowingFile(self._wanted.lcov)
                lcov.text.write(coverage.lcov(self.files, self._paths))
                lcov.done()
        elif self._wanted.view_s is not None:
            observed["coverage"] = coverage.instructions(_run.coverage(run), _code(run))
        return {"observed": observed} if observed else {}

    def _profile(self, run: Any) -> dict[str, Any]:
        observer = self._observer
        observer.settle()
        named = profile.functions(self._table, observer) if self._table else {}
        executing = int(observer.cycles().sum())
        return {
            "cycles": executing + observer.asleep,
            "asleep": observer.asleep,
            "elsewhere": executing - sum(row["cycles"] for row in named.values()),
            "functions": named,
            "lines": profile.lines(self._table, observer) if self._table else [],
            "interrupts": profile.interrupts(self._table, observer),
            "stack": profile.stack(self._table, observer),
            "sfrs": profile.sfrs(observer),
            "sampling": profile.sampling(run.scans(), self._scenario.tables.clock_hz),
        }

    @property
    def view(self) -> "views.View | None":
        """What the report's pictures show."""
        return self._recorder.view if self._recorder else None

    def close(self) -> None:
        """Take away what an interrupted run has left."""
        for file in self._files:
            with contextlib.suppress(OSError):
                file.drop()
