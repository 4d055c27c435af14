"""Profile, coverage, interrupt times, stack and instruction trace, on firmware whose cycles are counted by hand."""

import json
import re
import subprocess
from pathlib import Path

import pytest
from conftest import timeless
from intelhex import IntelHex
from libins.disasm import OPCODES, decode
from sdcc_kit import FIRMWARE, build

from libins import cdb, observe, run, scenario

SCENARIO = """
schema = 1
board = "8051_tlc2543"
firmware = "{firmware}"
stop_s = 0.05
[motion]
kind = "still"
"""
SPINS = 50
VECTOR = 4
"""The hardware's call and the LJMP at the vector."""
SLOW = VECTOR + 2 + 2 + 2 * SPINS + 2 + 2
QUICK = VECTOR + 1 + 1 + 2
PUSH_RETURN = 2
SOURCE = FIRMWARE / "observed.c"


def line_of(text: str) -> int:
    numbers = [n for n, line in enumerate(SOURCE.read_text(encoding="ascii").splitlines(), 1) if text in line]
    assert len(numbers) == 1, f"{text!r} is in lines {numbers}"
    return numbers[0]


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("observed")
    image = build(SOURCE, path, "--debug")
    (path / "observed.toml").write_text(SCENARIO.format(firmware=image.name), encoding="ascii")
    return path


@pytest.fixture(scope="module")
def result(folder):
    """The summary, and where files are."""
    wanted = observe.Wanted(
        profile=True, lcov=folder / "o.info", itrace=folder / "o.itrace", source=[FIRMWARE], vcd=folder / "o.vcd"
    )
    loaded = scenario.load(folder / "observed.toml")
    return run.execute(loaded, run.Options(watch=observe.Observation(loaded, wanted))).summary


@pytest.fixture(scope="module")
def observed(result):
    return result["observed"]


@pytest.fixture(scope="module")
def table(folder):
    return cdb.load(folder / "observed.cdb")


def test_every_cycle_is_accounted_for(result, observed):
    assert observed["cycles"] == result["cpu"]["cycles"]
    functions = sum(row["cycles"] for row in observed["functions"].values())
    assert functions + observed["elsewhere"] + observed["asleep"] == observed["cycles"]
    assert sum(row["cycles"] for row in observed["lines"]) <= functions + observed["elsewhere"]
    assert observed["asleep"] > 0.2 * observed["cycles"]


def test_interrupts_counted_by_hand(observed):
    slow, quick = observed["interrupts"]["slow"], observed["interrupts"]["quick"]
    assert slow["worst_alone"] == SLOW
    assert slow["worst"] == SLOW + QUICK, "timer 1 comes every 250 cycles, once at most within one of slow()"
    assert slow["cycles"] == slow["count"] * SLOW
    assert quick == {"count": quick["count"], "cycles": quick["count"] * QUICK, "worst": QUICK, "worst_alone": QUICK}
    assert slow["count"] >= 170
    assert abs(slow["count"] * 256 - quick["count"] * 250) < 2 * 256


def test_calls_and_inclusive_cycles(observed):
    functions = observed["functions"]
    assert {name: row["calls"] for name, row in functions.items()} == {
        "main": 1,
        "down": 5,
        "first": 1,
        "second": 1,
        "choose": 3,
        "slow": observed["interrupts"]["slow"]["count"] + 1,
        "quick": observed["interrupts"]["quick"]["count"],
    }
    assert (functions["second"]["cycles"], functions["second"]["inclusive"]) == (4 + 2, 4 + 2)
    assert (functions["first"]["cycles"], functions["first"]["inclusive"]) == (1 + 2, 1 + 2 + 4 + 2)
    assert functions["down"]["inclusive"] == functions["down"]["cycles"], "recursion is counted once"
    parts = ("main", "down", "first", "second", "choose")
    assert functions["main"]["inclusive"] == sum(functions[name]["cycles"] for name in parts)
    whole, last = divmod(functions["slow"]["cycles"], SLOW - VECTOR)
    assert (whole, last > 0) == (functions["slow"]["calls"] - 1, True), "the run ends within the last one"


def test_lines(observed, table):
    rows = {row["line"]: row for row in observed["lines"]}
    assert rows[line_of("done = 1;")]["executions"] == 3
    assert rows[line_of("return n + down(n - 1);")]["executions"] >= 4
    assert line_of("never = 1;") not in rows
    assert [row["cycles"] for row in observed["lines"]] == sorted(
        (r["cycles"] for r in observed["lines"]), reverse=True
    )


def test_stack_from_the_linkers_begin_to_the_deepest_push(observed, folder):
    """main calls down(4), four times deeper: a return address each time, and what SDCC pushes around the call."""
    begin = re.search(r"([0-9A-F]{8})  __start__stack", (folder / "observed.map").read_text(encoding="ascii"))
    assert begin
    pushes = (folder / "observed.rst").read_text(encoding="ascii").partition("_down:")[2].partition("_second:")[0]
    kept = len(re.findall(r"\]\s+\d+\s+push", pushes.partition("lcall")[0]))
    assert observed["stack"] == {
        "begin": int(begin[1], 16) - 1,
        "top": int(begin[1], 16) - 1 + 5 * PUSH_RETURN + 4 * kept,
        "octets": 5 * PUSH_RETURN + 4 * kept,
        "in": "down",
    }


def test_sfrs_that_the_program_names(observed):
    touched = observed["sfrs"]
    assert {"SP", "TMOD", "TH0", "TL0", "TH1", "TL1", "IP", "IE", "TCON", "PCON"} <= touched.keys()
    assert not {"SCON", "SBUF", "P0", "P1", "P2", "P3"} & touched.keys()
    assert touched["TMOD"] == {"reads": 0, "writes": 1}
    assert touched["PCON"]["reads"] == touched["PCON"]["writes"] > 100, "ORL is both"


def test_coverage_of_a_branch_that_is_never_taken(observed, folder):
    text = (folder / "o.info").read_text(encoding="ascii")
    assert f"SF:{SOURCE}\n" in text
    assert f"DA:{line_of('never = 1;')},0\n" in text
    assert f"DA:{line_of('never = 2;')},0\n" in text
    assert f"DA:{line_of('done = 1;')},1\n" in text
    choice = re.findall(rf"BRDA:{line_of('if (x > 3)')},0,([01]),([-01])\n", text)
    assert sorted(taken for _, taken in choice) == ["0", "1"], "one way only"
    ends = re.findall(rf"BRDA:{line_of('if (n == 0)')},\d,([01]),([-01])\n", text)
    assert {taken for _, taken in ends} == {"1"}, "both ways"
    assert "FNDA:0,untouched\n" in text
    assert "FNDA:1,choose\n" in text
    totals = observed["coverage"]
    assert (totals["functions"], totals["functions_covered"]) == (8, 7)
    assert totals["lines"] == len(re.findall(r"^DA:", text, re.MULTILINE))
    assert totals["lines_covered"] == len(re.findall(r"^DA:\d+,1$", text, re.MULTILINE))
    assert totals["branches"] == len(re.findall(r"^BRDA:", text, re.MULTILINE))


def test_coverage_is_what_the_trace_executed(folder, table):
    """Every line and branch, from where the program went after each instruction."""
    image = IntelHex(str(folder / "observed.ihx"))
    table.correct_lines(image.__getitem__)
    steps = [int(line[12:16], 16) for line in (folder / "o.itrace").read_text(encoding="ascii").splitlines()]
    executed, went = set(steps), set(zip(steps, steps[1:], strict=False))
    expected = set()
    jumps: dict[int, int] = {}
    for address in (line.address for line in table.asm_lines):
        for line in table.lines_at(address):
            ran = any(table.line_at(a) and line in table.lines_at(a) for a in executed)
            expected.add(f"DA:{line.number},{int(ran)}")
        if not (line := table.line_at(address)) or not OPCODES[image[address]].branches:
            continue
        following = address + OPCODES[image[address]].length
        target = int(decode(image.__getitem__, address).text[-4:], 16)
        block = jumps[line.number] = jumps.get(line.number, -1) + 1
        for way, to in enumerate((following, target)):
            taken = int((address, to) in went) if address in executed else "-"
            expected.add(f"BRDA:{line.number},{block},{way},{taken}")
    text = (folder / "o.info").read_text(encoding="ascii")
    assert set(re.findall(r"^(?:DA|BRDA):.*$", text, re.MULTILINE)) == expected


def test_lcov_and_genhtml_read_it(observed, folder):
    command = ["lcov", "--rc", "lcov_branch_coverage=1", "--summary", folder / "o.info"]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=60)
    total = observed["coverage"]
    for what in ("lines", "functions", "branches"):
        assert re.search(rf"{what}\.+: .*\({total[f'{what}_covered']} of {total[what]} ", done.stdout), done.stdout
    html = folder / "html"
    command = ["genhtml", "--branch-coverage", "-q", "-o", html, folder / "o.info"]
    subprocess.run(command, check=True, capture_output=True, timeout=60)
    assert "never = 1;" in next(html.rglob("observed.c.gcov.html")).read_text(encoding="utf-8")


def test_instruction_trace_is_the_listing_executed(folder, result):
    """Every line stands in SDCC's listing with its octets, and takes the cycles the listing says."""
    listing = (folder / "observed.rst").read_text(encoding="ascii")
    rows = re.findall(r"^ {6}([0-9A-F]{6}) ((?:[0-9A-F]{2} )+) *\[(\d\d)\]", listing, re.MULTILINE)
    known = {int(address, 16): (octets.strip().lower(), int(clocks) // 12) for address, octets, clocks in rows}
    lines = (folder / "o.itrace").read_text(encoding="ascii").splitlines()
    assert len(lines) - result["cpu"]["instructions"] in (0, 1), "the last one may have begun"
    at = [(int(line[:10]), int(line[12:16], 16), line[18:28].strip()) for line in lines]
    seen = 0
    for (cycle, address, octets), (after, following, _) in zip(at, at[1:], strict=False):
        if address in known:
            assert octets == known[address][0]
            seen += 1
            if after - cycle != known[address][1]:
                assert following in (0x0B, 0x1B), "an interrupt, or sleep until one"
    assert seen > 0.9 * len(lines)


def test_instruction_trace_says_what_changed(folder, table):
    lines = (folder / "o.itrace").read_text(encoding="ascii").splitlines()
    entry = f"  {table.function('first').begin:04x}  "
    at = next(i for i, line in enumerate(lines) if entry in line)
    assert [re.sub(r" +", " ", line[18:]) for line in lines[at : at + 2]] == [
        "00 nop",
        f"02 {table.function('second').begin:04x} ljmp 0x{table.function('second').begin:04x}".replace(
            f"{table.function('second').begin:04x} l",
            f"{table.function('second').begin >> 8:02x} {table.function('second').begin & 255:02x} l",
        ),
    ]
    assert any(re.search(r"75 89 22  mov TMOD,#0x22$", line) for line in lines)
    assert any(re.search(r"75 f0 32  mov B,#0x32 +B=32$", line) for line in lines)
    assert any(re.search(r"c0 f0 +push B +SP=", line) for line in lines)


def test_looking_changes_nothing(folder, result):
    loaded = scenario.load(folder / "observed.toml")
    plain = run.execute(loaded, run.Options()).summary
    assert timeless(plain) == timeless({key: value for key, value in result.items() if key != "observed"})


def test_profile_as_text(ins, folder, tmp_path):
    done = ins("run", folder / "observed.toml", "--profile", "-", "--json", tmp_path / "s.json")
    assert done.returncode == 0, done.stderr
    observed = json.loads((tmp_path / "s.json").read_text(encoding="utf-8"))["observed"]
    main = observed["functions"]["main"]
    assert re.search(rf"^ +{main['cycles']} +[\d.]+ +{main['inclusive']} +1  main$", done.stdout, re.MULTILINE)
    assert re.search(rf"^ +{observed['asleep']} +[\d.]+ +asleep$", done.stdout, re.MULTILINE)
    assert re.search(rf"^ +\d+ +\d+ +{SLOW + QUICK} +{SLOW}  slow$", done.stdout, re.MULTILINE)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            ["--profile", "-"],
            "neither observed.cdb nor observed.rst beside it; build .* --debug, or give its .cdb or .rst with --cdb",
        ),
        (
            ["--lcov", "o.info", "--cdb", "{folder}/observed.cdb"],
            "observed.c: not found in .*; give its folder with --source",
        ),
        (["--itrace", "/absent/o"], "/absent/o: cannot be written: No such file or directory; choose another place"),
    ],
)
def test_what_cannot_be_looked_at(ins, folder, tmp_path, options, message):
    """Beside this image lies no .cdb."""
    (tmp_path / "observed.ihx").write_bytes((folder / "observed.ihx").read_bytes())
    (tmp_path / "o.toml").write_text(SCENARIO.format(firmware="observed.ihx"), encoding="ascii")
    done = ins("run", tmp_path / "o.toml", *[option.format(folder=folder) for option in options])
    assert done.returncode == 2
    assert re.search(message, done.stderr)


def test_an_expectation_on_what_was_observed(ins, folder, tmp_path):
    """Its value is there with --profile, and is judged."""
    path = tmp_path / "expect.toml"
    limits = "".join(
        f'[[expect]]\nvalue = "observed.{value}"\nat_most = {limit}\n'
        for value, limit in (("interrupts.slow.worst", SLOW), ("stack.octets", 100))
    )
    path.write_text(SCENARIO.format(firmware=folder / "observed.ihx") + limits, encoding="ascii")
    done = ins("run", path, "--profile", tmp_path / "p.txt")
    assert done.returncode == 1
    assert f"observed.interrupts.slow.worst = {SLOW + QUICK}, expected at most {SLOW}" in done.stdout
    assert "observed.stack.octets" not in done.stdout
