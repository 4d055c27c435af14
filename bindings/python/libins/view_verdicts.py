"""Expectations of a scenario while it runs: what they look at so far, and whether that is as it should be."""

from typing import Any

import numpy as np

from libins import run
from libins.machine import AXES, COLUMNS, link_of
from libins.scenario import Scenario
from libins.view_history import Totals

Json = dict[str, Any]


def verdicts(scenario: Scenario, engine: Any, totals: Totals) -> list[Json]:
    """Value, bounds, what was found, and whether it holds; null: nothing to judge yet, or only `ins run` can."""
    if not scenario.tables.expect:
        return []
    summary = _summary(engine, totals)

    def told(expect: Any) -> Json:
        found: Any = summary
        for name in expect.value.split("."):
            found = found.get(name) if isinstance(found, dict) else None
        known = isinstance(found, (int, float))
        bounds = {name: getattr(expect, name) for name in run.BOUNDS if getattr(expect, name) is not None}
        ok = run.failure(expect, summary) is None if known else None
        return {"value": expect.value, **bounds, "found": found if known else None, "ok": ok}

    return [told(expect) for expect in scenario.tables.expect]


def _summary(engine: Any, totals: Totals) -> Json:
    """The summary's part that states make, without the states."""
    c = engine.counters()
    ends = np.zeros((0 if totals.last is None else 2, len(COLUMNS)))
    summary: Json = {"samples": c["sampled"], "attitude": None, "age_s": None}
    if totals.last is not None:
        ends[0, COLUMNS["scan"]], ends[1, COLUMNS["scan"]] = totals.first_scan, totals.last[COLUMNS["scan"]]
        rms, largest = np.sqrt(totals.squares / totals.count).tolist(), totals.largest.tolist()
        summary["attitude"] = {
            "rms_rad": dict(zip(AXES, rms, strict=True)),
            "max_rad": dict(zip(AXES, largest, strict=True)),
        }
        least, added, most = map(float, totals.ages)
        summary["age_s"] = {"min": least, "mean": added / totals.count, "max": most}
    return {**summary, "link": link_of(c, ends)}
