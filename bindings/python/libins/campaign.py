"""`ins campaign`: a scenario run many times, each with a seed and variations that follow from the seed alone.

Rows are appended to OUT/rows.jsonl as they come, so a campaign goes on where it was interrupted; table.csv,
table.parquet and index.html are made of them, in the order of the seeds. docs/campaign.md
"""

import argparse
import fcntl
import hashlib
import json
import math
import os
import re
import statistics
from collections import Counter
from collections.abc import Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Future, wait
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TextIO

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from libins import campaign_worker, scenario, schema
from libins.errors import UsageError
from libins.tables import Loaded

CLUSTER = r"local:[1-9]\d{0,2}|\w+://.+|(?!local:)[\w.-]+:\d+"
RUNS_LIMIT = 1_000_000
OUTCOMES = ("pass", "fail", "time limit", "firmware error", "not modelled", "refused", "crash")
NEEDED = {
    "uniform": "two numbers, low and high",
    "normal": "two numbers, mean and sigma",
    "choice": "a list of one value or more",
    "list": "a list of one value or more",
    "chance": "a probability, 0 .. 1",
}

Row = dict[str, Any]
"""seed, outcome, error, set (what was varied), measured (dotted names of the summary), wall_s."""


@dataclass(frozen=True)
class Vary:
    """How one key of the scenario is drawn."""

    key: str
    how: str
    given: Any
    integer: bool
    """The key takes integers: draws are rounded."""

    def draw(self, seed: int) -> Any:
        """The key's value in the run of that seed: of nothing but the seed, the key and the distribution."""
        digest = hashlib.sha256(f"{seed} {self.key}".encode()).digest()
        u = ((int.from_bytes(digest[:8], "little") >> 12) + 0.5) * 2.0**-52  # 0 < u < 1
        if self.how == "list":
            return self.given[seed % len(self.given)]
        if self.how == "choice":
            return self.given[int(u * len(self.given))]
        if self.how == "chance":
            return u < self.given
        a, b = self.given
        if self.how == "normal":
            value = a + b * statistics.NormalDist().inv_cdf(u)
            return round(value) if self.integer else value
        return a + math.floor(u * (b - a + 1)) if self.integer else a + u * (b - a)

    def extremes(self) -> list[Any]:
        """Values to be checked before anything runs."""
        if self.how == "chance":
            return [False, True]
        if self.how == "normal":
            return [round(self.given[0]) if self.integer else self.given[0]]
        return list(self.given)


def _varies(document: schema.Document, key: tuple[str, ...], table: Any) -> Iterator[Vary]:
    """The distributions of a [campaign] table, written link.baud, "link.baud" or as a table."""
    if not isinstance(table, dict):
        raise document.refuse(("campaign", *key), f"found {table!r}, but one of {{ {', '.join(NEEDED)} }} is needed")
    if not NEEDED.keys() & table.keys():
        for name, value in table.items():
            yield from _varies(document, (*key, *name.split(".")), value)
        return
    ((how, given), *rest) = table.items()
    if rest or how not in NEEDED:
        raise document.refuse(("campaign", *key), f"found {table!r}, but one of {', '.join(NEEDED)} alone is needed")
    numbers = isinstance(given, list) and len(given) == 2 and all(map(_is_number, given))
    good = {
        "uniform": numbers and given[0] <= given[1],
        "normal": numbers and given[1] >= 0,
        "chance": _is_number(given) and 0 <= given <= 1,
    }.get(how, isinstance(given, list) and len(given) > 0)
    if not good:
        raise document.refuse(("campaign", *key), f"{how}: found {given!r}, but {NEEDED[how]} is needed")
    if key == ("seed",):
        raise document.refuse(("campaign", "seed"), "is numbered by the campaign itself; choose the first by --seed")
    integer = schema.kind(scenario.schema_of(document), key) is int
    if integer and how == "uniform" and not all(isinstance(bound, int) for bound in given):
        raise document.refuse(("campaign", *key), f"uniform: found {given!r}, but the key takes integers")
    yield Vary(".".join(key), how, given, integer)


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


class Campaign:
    """What is run: a scenario, settings, and the distributions of a plan."""

    def __init__(self, name: str, plan: Path | None, settings: Mapping[str, Any]) -> None:
        """Read and check everything, each distribution at its extremes. Raises UsageError."""
        self.name = name
        self.path = scenario.find(name)
        self.settings = dict(settings)
        document = schema.Document(plan or self.path)
        self.origin = "campaign" if plan is None else f"{plan}: campaign"
        if "campaign" not in document.table:
            raise document.refuse(("campaign",), "the table is missing: it says what is varied (docs/campaign.md)")
        if "matrix" in schema.Document(self.path).table:
            raise UsageError(f"{self.path}: has a [matrix]; a campaign varies by [campaign], key = {{ list = [...] }}")
        varies = list(_varies(document, (), document.table["campaign"]))
        self.varies = [vary for vary in varies if vary.key not in self.settings]
        digest = hashlib.sha256()
        alone = [{vary.key: value} for vary in self.varies for value in vary.extremes()]
        for variation in ({}, *alone):
            digest.update(repr(self._load(0, variation).contents()).encode())
        self.identity: dict[str, Any] = {
            "build": campaign_worker.build(),
            "scenario": hashlib.sha256(self.path.read_bytes()).hexdigest(),
            "campaign": hashlib.sha256(repr(self.varies).encode()).hexdigest(),
            "settings": self.settings,
            "files": digest.hexdigest(),
        }

    def load_base(self) -> Loaded:
        """The scenario with nothing varied. Raises UsageError."""
        return self._load(0, {})

    def variation(self, seed: int) -> dict[str, Any]:
        """Values of the varied keys in the run of that seed, by dotted name."""
        return {vary.key: vary.draw(seed) for vary in self.varies}

    def load(self, seed: int) -> Loaded:
        """The scenario of the run of that seed. Raises UsageError."""
        return self._load(seed, self.variation(seed))

    def _load(self, seed: int, variation: Mapping[str, Any]) -> Loaded:
        return scenario.load(self.path, None, {**self.settings, "seed": seed}, variation, self.origin)

    def command(self, row: Row) -> list[str]:
        """What runs the row's run alone."""
        sets = {**self.settings, **row["set"]}.items()
        words = [word for key, value in sets for word in ("--set", f"{key}={toml(value)}")]
        return ["ins", "run", self.name, "--seed", str(row["seed"]), *words]


def toml(value: Any) -> str:
    """A value as TOML writes it, on one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)} = {toml(v)}" for key, v in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value, ensure_ascii=False)


class Rows:
    """The finished runs of a folder: a line of identity, then one of JSON each, in the order they came."""

    def __init__(self, folder: Path, identity: dict[str, Any]) -> None:
        """Open, or go on with, the campaign in the folder. Raises UsageError."""
        self.path = folder / "rows.jsonl"
        self.by_seed: dict[int, Row] = {}
        try:
            folder.mkdir(parents=True, exist_ok=True)
            self._file: TextIO = self.path.open("a+", encoding="utf-8")
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise UsageError(f"{self.path}: another campaign is writing there; choose another --out") from error
        except OSError as error:
            raise UsageError(f"{self.path}: cannot be written: {error.strerror}; choose another --out") from error
        self._file.seek(0)
        text = self._file.read()
        whole = text[: text.rfind("\n") + 1]  # a line that was being written when the campaign was killed is no row
        os.ftruncate(self._file.fileno(), len(whole.encode()))
        head, *rows = whole.splitlines() or [""]
        if not head:
            self._write(identity)
        elif (before := _object(head)) != json.loads(json.dumps(identity)):
            other = ", ".join(key for key in identity if before.get(key) != identity[key])
            raise UsageError(f"{self.path}: holds another campaign ({other} differ); choose another --out")
        for number, line in enumerate(rows, start=2):
            row = _object(line)
            if "seed" not in row:
                raise UsageError(f"{self.path}:{number}: not a row of a campaign; choose another --out")
            self.by_seed[row["seed"]] = row

    def append(self, row: Row) -> None:
        """Keep a finished run: the whole line, in one write."""
        self._write(row)
        self.by_seed[row["seed"]] = row

    def _write(self, value: Any) -> None:
        os.write(self._file.fileno(), (json.dumps(value) + "\n").encode())

    def close(self) -> None:
        """Let another campaign go on here."""
        self._file.close()


def _object(line: str) -> dict[str, Any]:
    try:
        value = json.loads(line)
    except ValueError:
        value = None
    return value if isinstance(value, dict) else {}


def run_all(campaign: Campaign, seeds: range, rows: Rows, pool: campaign_worker.Pool, progress: Any) -> None:
    """Every seed that has no row yet. Raises UsageError when the pool is gone."""
    pending = (seed for seed in seeds if seed not in rows.by_seed)
    running: dict[Future[Row], int] = {}
    while True:
        while len(running) < pool.width() and (seed := next(pending, None)) is not None:
            try:
                running[pool.submit(campaign.load(seed), campaign.identity["build"])] = seed
            except UsageError as error:
                refused = campaign_worker.lost("refused", str(error))
                rows.append({"seed": seed, "set": campaign.variation(seed), **refused})
                progress()
        if not running:
            return
        for future in wait(running, return_when=FIRST_COMPLETED).done:
            seed = running.pop(future)
            rows.append({"seed": seed, "set": campaign.variation(seed), **pool.result(future, seed)})
            progress()


def add_options(grammar: argparse.ArgumentParser) -> None:
    """The command line of `ins campaign`."""
    grammar.add_argument("scenario", help="a TOML file with a [campaign] table, or a name with --plan")
    grammar.add_argument("--plan", type=Path, metavar="F.toml", help="take the [campaign] table from there")
    grammar.add_argument("--runs", type=int, required=True, metavar="N", help="how many there shall be in the table")
    grammar.add_argument("--seed", type=int, default=1, metavar="S", help="of the first run; the others follow (1)")
    grammar.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="as in ins run; not varied")
    grammar.add_argument("--jobs", type=int, default=os.cpu_count() or 1, metavar="N", help="runs at a time (cores)")
    grammar.add_argument("--dask", metavar="ADDRESS|local:N", help="on a Dask cluster, or a local one of N workers")
    grammar.add_argument("--out", type=Path, required=True, metavar="DIR", help="of the rows, tables and page")


def command(options: argparse.Namespace) -> int:
    """Run it. 0 when every run passed, else 1. Raises UsageError."""
    from libins import campaign_page  # needs the packages of libins[campaign]

    if not 1 <= options.runs <= RUNS_LIMIT:
        raise UsageError(f"--runs {options.runs}: must lie in 1 .. {RUNS_LIMIT}")
    if not 0 <= options.seed <= 2**63 - 1 - options.runs:
        raise UsageError(f"--seed {options.seed}: must lie in 0 .. 2^63 - 1 - runs")
    if not 1 <= options.jobs <= 1024:
        raise UsageError(f"--jobs {options.jobs}: must lie in 1 .. 1024")
    if options.dask is not None and not re.fullmatch(CLUSTER, options.dask):
        raise UsageError(f"--dask {options.dask}: local:N or a scheduler's address is needed, such as tcp://host:8786")
    campaign = Campaign(options.scenario, options.plan, dict(map(scenario.setting, options.set)))
    seeds = range(options.seed, options.seed + options.runs)
    rows = Rows(options.out, campaign.identity)
    console = Console(stderr=True)
    try:
        done = [seed for seed in seeds if seed in rows.by_seed]
        counts = Counter(rows.by_seed[seed]["outcome"] for seed in done)
        with Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeRemainingColumn(),
            console=console,
            disable=not console.is_terminal,
            transient=True,
        ) as bar:
            task = bar.add_task(_counted(counts), total=len(seeds), completed=len(done))

            def progress() -> None:
                counts[next(reversed(rows.by_seed.values()))["outcome"]] += 1
                bar.update(task, advance=1, description=_counted(counts))

            if len(done) < len(seeds):
                with campaign_worker.pool(options.dask, options.jobs) as pool:
                    run_all(campaign, seeds, rows, pool, progress)
        campaign_page.write(options.out, campaign, [rows.by_seed[seed] for seed in seeds])
    finally:
        rows.close()
    already = f" ({len(done)} were there)" if done else ""
    print(f"{len(seeds)} runs{already}: {_counted(counts)}; {options.out / 'index.html'}")
    return 0 if counts["pass"] == len(seeds) else 1


def _counted(counts: Counter[str]) -> str:
    return ", ".join(f"{counts[outcome]} {outcome}" for outcome in OUTCOMES if counts[outcome])
