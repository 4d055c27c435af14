"""What a campaign leaves: table.csv, table.parquet and index.html; and times.csv, which no two campaigns share."""

import io
import json
import shlex
from collections import Counter
from pathlib import Path
from typing import Any

from libins import pictures
from libins.campaign import OUTCOMES, Campaign, Row
from libins.errors import UsageError

try:
    import polars
except ImportError as missing:
    raise UsageError("a campaign's table needs polars: pip install 'libins[campaign]'") from missing

from jinja2 import Environment, PackageLoader, select_autoescape
from markupsafe import Markup
from matplotlib.figure import Figure

HUES = ("#2a7d3f", "#b3261e", "#e08a00", "#7b3fa0", "#5b6b7a", "#9aa5b1", "#111111")
COLOURS = dict(zip(OUTCOMES, HUES, strict=True))
BINS = 30
PLOTS = 12
"""Keys and values that are plotted at most."""


def column(name: str, values: list[Any]) -> polars.Series:
    """A column of one type: booleans, integers, numbers, or else text, what is no text as JSON."""
    kinds = {type(value) for value in values if value is not None}
    if kinds <= {bool}:
        return polars.Series(name, values, polars.Boolean)
    if kinds <= {int}:
        return polars.Series(name, values, polars.Int64)
    if kinds <= {int, float}:
        return polars.Series(name, [None if value is None else float(value) for value in values], polars.Float64)
    texts = [value if value is None or isinstance(value, str) else json.dumps(value) for value in values]
    return polars.Series(name, texts, polars.String)


def table(rows: list[Row]) -> polars.DataFrame:
    """One line a run, in the order of the rows; a column for every key varied and value measured in any of them."""
    columns = [column(name, [row[name] for row in rows]) for name in ("seed", "outcome", "error")]
    for group, prefix in (("set", "set."), ("measured", "")):
        names = dict.fromkeys(name for row in rows for name in row[group])
        columns += [column(prefix + name, [row[group].get(name) for row in rows]) for name in names]
    return polars.DataFrame(columns)


def write(folder: Path, campaign: Campaign, rows: list[Row]) -> None:
    """All files, each whole or not at all. Raises UsageError."""
    frame = table(rows)
    parquet = io.BytesIO()
    frame.write_parquet(parquet)
    times = "seed,wall_s\n" + "".join(f"{row['seed']},{row['wall_s']!r}\n" for row in rows)
    contents = {
        "table.csv": frame.write_csv().encode(),
        "table.parquet": parquet.getvalue(),
        "times.csv": times.encode(),
        "index.html": html(campaign, rows, frame).encode(),
    }
    for name, octets in contents.items():
        temporary = folder / (name + ".part")
        try:
            temporary.write_bytes(octets)
            temporary.replace(folder / name)
        except OSError as error:
            raise UsageError(f"{folder / name}: cannot be written: {error.strerror}; choose another --out") from error


def html(campaign: Campaign, rows: list[Row], frame: polars.DataFrame) -> str:
    """One self-contained page. Holds no wall-clock figure."""
    loaded = campaign.load_base()
    judged = list(dict.fromkeys(e.value for e in loaded.tables.expect if e.value in frame.columns))
    varied = [f"set.{vary.key}" for vary in campaign.varies]
    counts = Counter(row["outcome"] for row in rows)
    plots = [outcome_plot(counts)]
    plots += [spread_plot(frame, name) for name in (varied + judged)[:PLOTS] if frame[name].dtype != polars.String]
    environment = Environment(
        loader=PackageLoader("libins", "."), autoescape=select_autoescape(), trim_blocks=True, lstrip_blocks=True
    )
    shown = ["seed", "outcome", *varied, *judged]
    return environment.get_template("campaign.html").render(
        name=campaign.name,
        total=len(rows),
        counts=[(outcome, counts[outcome], COLOURS[outcome]) for outcome in OUTCOMES if counts[outcome]],
        plots=[Markup(plot) for plot in plots],
        failing=[(row, shlex.join(campaign.command(row))) for row in rows if row["outcome"] != "pass"],
        shown=shown,
        lines=frame.select(shown).rows(),
        varies=[(vary.key, vary.how, vary.given) for vary in campaign.varies],
        colours=COLOURS,
    )


def outcome_plot(counts: Counter[str]) -> str:
    """How many runs came out how."""
    figure = Figure(figsize=(9, 0.6 + 0.3 * len(OUTCOMES)), layout="constrained")
    axes = figure.subplots()
    names = OUTCOMES[::-1]
    bars = axes.barh(names, [counts[name] for name in names], color=[COLOURS[name] for name in names])
    axes.bar_label(bars, padding=3)
    axes.set_xlabel("runs")
    return pictures.svg(figure)


def spread_plot(frame: polars.DataFrame, name: str) -> str:
    """How the values of a column spread, by outcome."""
    present = frame.filter(polars.col(name).is_not_null())
    groups = {outcome: present.filter(polars.col("outcome") == outcome)[name] for outcome in OUTCOMES}
    values = {outcome: group.cast(polars.Float64).to_list() for outcome, group in groups.items() if len(group)}
    figure = Figure(figsize=(9, 2.4), layout="constrained")
    axes = figure.subplots()
    colours = [COLOURS[outcome] for outcome in values]
    axes.hist(list(values.values()), bins=BINS, stacked=True, color=colours, label=list(values))
    axes.set_xlabel(name)
    axes.set_ylabel("runs")
    axes.legend(frameon=False)
    return pictures.svg(figure)
