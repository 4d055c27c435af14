"""The reader of SDCC's linked listings, against what the .cdb of the same image says, and on images without one."""

import os

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from libins.cdb_types import CdbError
from sdcc_kit import FIRMWARE, build

from libins import cdb, coverage, listing, observe, run, scenario

EXAMPLES = 500 if os.environ.get("INS_BENCH") == "1" else 50
PROGRAMS = ("kinds", "observed")


@pytest.fixture(scope="module", params=PROGRAMS)
def both(request, tmp_path_factory):
    """An image's .cdb and its listing."""
    folder = tmp_path_factory.mktemp(request.param)
    image = build(FIRMWARE / f"{request.param}.c", folder, "--debug")
    return cdb.load(image.with_suffix(".cdb")), listing.load(listing.beside(image))


def test_functions_are_those_of_the_cdb(both):
    said, read = both
    places = [[(f.name, f.begin, f.end, f.interrupt, f.module) for f in table.functions] for table in both]
    assert len(said.functions) > 3
    assert places[0] == places[1]


def test_lines_are_those_of_the_cdb(both):
    """Of two marks of a line in the same block the .cdb has the last, and the listing's comment is at the first."""
    said, read = both
    assert read.asm_lines == said.asm_lines
    assert {(line.file, line.number) for line in read.c_lines} == {(line.file, line.number) for line in said.c_lines}
    marked = set(said.c_lines)
    for address in (line.address for line in said.asm_lines):
        ours, theirs = read.line_at(address), said.line_at(address)
        same = ours and theirs and (ours.file, ours.number) == (theirs.file, theirs.number)
        assert same or ours == theirs or ours not in marked
    assert len(set(read.c_lines) - marked) <= 2


def test_the_image_as_it_is_shipped(tmp_path):
    """Without --debug: cycles add up, and the sources are found without being told where."""
    loaded = scenario.load(scenario.find("default"), settings={"stop_s": 1.0})
    assert not loaded.firmware.with_suffix(".cdb").exists()
    watch = observe.Observation(loaded, observe.Wanted(profile=True, lcov=tmp_path / "s.info"))
    summary = run.execute(loaded, run.Options(watch=watch)).summary
    observed = summary["observed"]
    functions = sum(row["cycles"] for row in observed["functions"].values())
    assert functions + observed["elsewhere"] + observed["asleep"] == summary["cpu"]["cycles"]
    assert observed["interrupts"].keys() == {"tick", "serial"}
    assert {"main", "offer", "ins_hs_board_tx"} <= observed["functions"].keys()
    assert observed["coverage"]["functions"] == 14
    text = (tmp_path / "s.info").read_text(encoding="utf-8")
    for name in ("acq.c", "handshake_board.c"):
        assert f"/{name}\n" in text


def test_what_is_no_listing(tmp_path):
    empty = tmp_path / "empty.rst"
    empty.write_text("nothing\n", encoding="ascii")
    with pytest.raises(CdbError, match=r"empty\.rst: no instruction in it; give SDCC's linked listing"):
        listing.load([empty])
    with pytest.raises(CdbError, match=r"absent\.rst: cannot be read: No such file .*; link the firmware again"):
        listing.load([tmp_path / "absent.rst"])
    binary = tmp_path / "binary.rst"
    binary.write_bytes(b"\xff")
    with pytest.raises(CdbError, match="octet 0 is no text"):
        listing.load([binary])


def test_a_source_that_the_listing_does_not_place_is_looked_for(both, tmp_path):
    said, read = both
    assert coverage.sources(read, [tmp_path]) == {f"{said.modules[0]}.c": FIRMWARE / f"{said.modules[0]}.c"}
    assert coverage.sources(said, [FIRMWARE]) == coverage.sources(read, [])


@settings(max_examples=EXAMPLES, deadline=None, derandomize=True)
@given(data=st.data())
def test_damage_is_an_error_or_another_table(both, tmp_path_factory, data):
    """Lines dropped, doubled, cut and octets changed."""
    said, _ = both
    lines = said.path.with_suffix(".rst").read_text(encoding="ascii").splitlines()
    for _ in range(data.draw(st.integers(1, 5))):
        i = data.draw(st.integers(0, len(lines) - 1))
        at = data.draw(st.integers(0, len(lines[i])))
        change = data.draw(st.sampled_from(["", lines[i] * 2, lines[i][:at], lines[i][:at] + "[F ;\t" + lines[i][at:]]))
        lines[i] = change
    path = tmp_path_factory.getbasetemp() / "fuzz.rst"
    path.write_text("\n".join(lines), encoding="ascii")
    try:
        table = listing.load([path])
    except CdbError as error:
        assert str(path) in str(error)
        return
    for address in (0, 0x80, 0xFFFF):
        table.function_at(address)
        table.line_at(address)
