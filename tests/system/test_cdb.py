"""The reader of SDCC's .cdb files, on files that SDCC makes here, and on damaged ones."""

import os
import re
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from intelhex import IntelHex
from libins.cdb import CdbError, Space
from libins.cdb_types import Kind, parse_type, scalar
from sdcc_kit import FIRMWARE, build

from libins import cdb, scenario

EXAMPLES = 2000 if os.environ.get("INS_BENCH") == "1" else 100
SOURCE = FIRMWARE / "kinds.c"
RET = "22"
RETI = "32"
JNZ = 0x70


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("kinds")
    build(SOURCE, path, "--debug")
    return path


@pytest.fixture(scope="module")
def table(folder) -> cdb.Cdb:
    return cdb.load(folder / "kinds.cdb")


@pytest.fixture(scope="module")
def listing(folder) -> list[tuple[int, str, str]]:
    """(address, first octet, instruction) of each instruction, from SDCC's linked listing."""
    pattern = re.compile(r" {6}([0-9A-F]{6}) ([0-9A-F]{2})[0-9A-F ]* \[\d\d\] +\d+ +(.*)")
    text = (folder / "kinds.rst").read_text(encoding="ascii")
    return sorted((int(m[1], 16), m[2], m[3].expandtabs().strip()) for m in map(pattern.match, text.splitlines()) if m)


def line_of(text: str) -> int:
    """Number of the one line of the source that holds the text."""
    numbers = [n for n, line in enumerate(SOURCE.read_text(encoding="ascii").splitlines(), 1) if text in line]
    assert len(numbers) == 1, f"{text!r} is in lines {numbers}"
    return numbers[0]


@pytest.mark.parametrize(
    ("name", "declared", "size", "space"),
    [
        ("nodes", "struct node [3]", 21, Space.XDATA),
        ("table", "int [3][4]", 24, Space.IDATA),
        ("total", "unsigned long", 4, Space.DATA),
        ("text", "unsigned char [4]", 4, Space.CONSTANT),
        ("ratio", "float", 4, Space.DATA),
        ("valid", "_Bool", 1, Space.DATA),
        ("wide", "long long", 8, Space.DATA),
        ("fields", "struct fields", 1, Space.DATA),
        ("callback", "int ()*", 2, Space.XDATA),
        ("latch", "unsigned char", 1, Space.XDATA),
        ("AUXR", "unsigned char", 1, Space.SFR),
        ("P1_4", "_Bool", 1, Space.SBIT),
    ],
)
def test_a_global_has_its_type_and_place(table, folder, name, declared, size, space):
    symbol = table.find(name)
    assert (str(symbol.type), symbol.type.size, symbol.space) == (declared, size, space)
    fixed = {"latch": 0x4000, "AUXR": 0x8E, "P1_4": 0x94}
    if name in fixed:
        assert symbol.address == fixed[name]
    else:
        linked = re.search(rf"([0-9A-F]{{8}})  _{name} ", (folder / "kinds.map").read_text(encoding="ascii"))
        assert linked, f"the linker's map has _{name}"
        assert symbol.address == int(linked[1], 16)


def test_the_address_of_a_bit_is_in_the_listing(table, folder, tmp_path):
    """The instruction that sets it has it as its operand."""
    flag = table.find("flag")
    assert (flag.type.bits, flag.space) == ((0, 1), Space.BIT)
    operand = re.search(r"D2 ([0-9A-F]{2}) .*setb\t_flag", (folder / "kinds.rst").read_text(encoding="ascii"))
    assert operand
    assert flag.address == int(operand[1], 16)
    alone = tmp_path / "kinds.cdb"
    alone.write_bytes((folder / "kinds.cdb").read_bytes())
    assert cdb.load(alone).find("flag").address is None


def test_bits_of_several_modules_follow_each_other():
    """Four of acq.c, which the linker puts first."""
    table = cdb.load(scenario.PACKAGE / "firmware/acq_default_debug.cdb")
    assert [table.find(name).address for name in ("rx_full", "tx_full", "tx_idle", "event")] == [0, 1, 2, 3]


def test_a_local_hides_the_global_of_its_name(table):
    inside = table.function("main").begin
    assert table.find("total", inside).function == "main"
    assert table.find("total", inside).registers == ("r6", "r7")
    assert table.find("total", table.function("tick").begin) is table.find("total")
    with pytest.raises(CdbError, match=r"no variable squares in main\(\)"):
        table.find("squares", inside)


def test_locals_on_the_stack_and_static_ones(table, folder):
    squares = table.find("squares", table.function("helper").begin)
    said = re.search(r";squares +Allocated to stack - _bp \+(\d+)", (folder / "kinds.rst").read_text(encoding="ascii"))
    assert said, "the listing says where squares is"
    assert (squares.space, squares.stack, squares.type.length) == (Space.STACK, int(said[1]), 3)
    assert {s.name for s in table.locals(table.function("helper"))} == {"n", "squares", "i"}
    count = table.find("count", table.function("tick").begin)
    assert (count.space, str(count.type)) == (Space.DATA, "unsigned char")
    assert count.address is not None


def test_members_with_their_offsets(table):
    nodes = table.find("nodes")
    following, content = table.members("kinds", nodes.type.target)
    assert (following.name, following.offset, str(following.type)) == ("next", 0, "struct node *")
    assert (content.name, content.offset, content.type.length) == ("content", 3, 2)
    inner = table.members("kinds", content.type.target)
    assert [(m.name, m.offset, str(m.type)) for m in inner] == [
        ("word", 0, "unsigned int"),
        ("octets", 0, "unsigned char [2]"),
    ]
    low, high = table.members("kinds", table.find("fields").type)
    assert (low.type.bits, high.type.bits) == ((0, 3), (3, 5))
    with pytest.raises(CdbError, match="declares no struct or union absent"):
        table.members("kinds", parse_type("{2}STabsent:S"))


def test_functions_lie_where_the_listing_says(table, listing):
    octets = {address: octet for address, octet, _ in listing}
    assert {f.name for f in table.functions} == {"helper", "tick", "pause", "main"}
    for function in table.functions:
        inside = sorted(a for a in octets if function.begin <= a < function.end)
        assert inside[0] == function.begin
        assert octets[inside[-1]] == (RETI if function.name == "tick" else RET)
        assert table.function_at(function.begin) is table.function_at(function.end - 1) is function
    assert (table.function("tick").interrupt, table.function("tick").bank) == (1, 1)
    assert table.function("main").interrupt is None
    assert table.function("helper").static
    assert not table.function("main").static
    with pytest.raises(CdbError, match="has no function absent; it has helper, tick, pause, main"):
        table.function("absent")


def test_every_instruction_has_its_assembler_line(table, listing):
    assert [line.address for line in table.asm_lines] == [address for address, _, _ in listing]
    assert table.asm_line_at(table.function("main").begin + 1) is None


@pytest.mark.parametrize(
    ("source", "instruction"),
    [
        ("count++;", r"inc +"),
        ("flag = 1;", r"setb +_flag"),
        ("PCON |= 1;", r"orl +_PCON,#0x01"),
        ("return squares[2];", r"mov +dpl,"),
        ("total = 123456;", r"mov +_total,#0x40"),
    ],
)
def test_a_line_is_where_its_instruction_is(table, listing, source, instruction):
    number = line_of(source)
    begins = table.addresses("kinds.c", number)
    assert begins
    mine = [text for address, _, text in listing if table.line_at(address) and table.line_at(address).number == number]
    assert any(re.match(instruction, text) for text in mine), mine
    assert table.line_at(begins[0]).number == number


def test_no_line_where_no_c_is(table, listing):
    first_line = min(line.address for line in table.c_lines)
    assert [table.line_at(address) for address, _, _ in listing if address < first_line] == [None] * sum(
        address < first_line for address, _, _ in listing
    )
    assert table.line_at(table.functions[-1].end) is None
    assert table.lines_at(0xFFFF) == []


@pytest.mark.parametrize(
    ("chain", "octets", "value"),
    [
        ("{2}SI:S", b"\xfe\xff", -2),
        ("{2}SI:U", b"\xfe\xff", 65534),
        ("{8}SI:S", b"\xff" * 8, -1),
        ("{4}SF:S", b"\x00\x00\xc0\x3f", 1.5),
        ("{1}:S", b"\x01", 1),
        ("{3}DG,SI:S", b"\x34\x12\x40", 0x401234),
        ("{1}SB3$5:U", b"\xa8", 21),
        ("{1}SB0$3:S", b"\x05", -3),
    ],
)
def test_values_of_octets(chain, octets, value):
    assert scalar(parse_type(chain), octets) == value


def test_a_value_needs_its_octets():
    with pytest.raises(CdbError, match="int has 2 octets, not 1"):
        scalar(parse_type("{2}SI:S"), b"\x01")
    with pytest.raises(CdbError, match=r"int \[2\] has no value of its own; name a member or an element"):
        scalar(parse_type("{4}DA2d,SI:S"), b"\x01\x00\x02\x00")


def test_the_projects_own_debug_image(listing):
    table = cdb.load(scenario.PACKAGE / "firmware/acq_default_debug.cdb")
    assert table.modules == ["acq", "handshake_board"]
    assert table.function("tick").interrupt == 1
    assert table.find("sampled").type.kind is Kind.INTEGER
    assert [m.name for m in table.members("acq", table.find("link").type)][-3:] == ["sent", "resent", "given_up"]
    assert table.addresses("handshake_board.c", table.line_at(table.function("board_retry").begin).number)


@pytest.mark.parametrize(
    ("before", "after", "message"),
    [
        ("M:kinds\n", "nonsense\n", r":1: 'nonsense' is no record of a \.cdb file .*; build the firmware again"),
        ("{4}SL:U", "{4}SQ:U", r":\d+: .*type 'SQ' is none of SDCC's"),
        ("{24}DA3d,DA4d,SI:S", "{24}DA3d,DA4d", r"\.cdb:\d+: not a whole symbol|not a whole type"),
        ("({3}S:S$content", "({3}S:S$con(tent", r":\d+: not a whole member"),
        ("L:G$latch$0_0$0:4000", "L:G$latch$0_0$0:40000000", r":\d+: address 0x40000000 lies beyond 64 KB"),
        ("L:XG$main$0$0:", "L:XG$main$0$0:0 ", r":\d+: not a whole linker record"),
    ],
)
def test_a_damaged_file_is_refused_with_its_line(folder, tmp_path, before, after, message):
    text = (folder / "kinds.cdb").read_text(encoding="ascii")
    assert before in text
    damaged = tmp_path / "damaged.cdb"
    damaged.write_text(text.replace(before, after), encoding="ascii")
    with pytest.raises(CdbError, match=message) as caught:
        cdb.load(damaged)
    assert str(damaged) in str(caught.value)


def test_a_file_that_is_none(tmp_path):
    with pytest.raises(CdbError, match=r"absent\.cdb: cannot be read: No such file .*; build the firmware with sdcc"):
        cdb.load(tmp_path / "absent.cdb")
    binary = tmp_path / "binary.cdb"
    binary.write_bytes(b"M:a\n\xff\x00")
    with pytest.raises(CdbError, match="octet 4 is not ASCII"):
        cdb.load(binary)
    unlinked = tmp_path / "unlinked.cdb"
    unlinked.write_text("M:a\nF:G$main$0_0$0({2}DF,SV:S),C,0,0,0,0,0\n", encoding="ascii")
    with pytest.raises(CdbError, match="no function has an address; link the image with"):
        cdb.load(unlinked)


@settings(max_examples=EXAMPLES, deadline=None, derandomize=True)
@given(data=st.data())
def test_damage_is_an_error_or_another_table(folder, tmp_path_factory, data):
    """Lines cut, joined, swapped and octets changed: CdbError or a table that can be asked everything."""
    lines = [
        line
        for line in (folder / "kinds.cdb").read_text(encoding="ascii").splitlines()
        if not re.match(r"[SL]:G\$[A-Z]", line)
    ]
    for _ in range(data.draw(st.integers(1, 4))):
        i = data.draw(st.integers(0, len(lines) - 1))
        at = data.draw(st.integers(0, len(lines[i])))
        change = data.draw(st.sampled_from(["cut", "octet", "join", "drop", "swap"]))
        j = data.draw(st.integers(0, len(lines) - 1))
        if change == "cut":
            lines[i] = lines[i][:at]
        elif change == "octet":
            lines[i] = lines[i][:at] + data.draw(st.sampled_from("$:,(){}[]0F9ZXSLDA-\x00 ")) + lines[i][at + 1 :]
        elif change == "join":
            lines[i] += lines[j]
        elif change == "swap":
            lines[i], lines[j] = lines[j], lines[i]
        elif len(lines) > 1:
            del lines[i]
    path = tmp_path_factory.getbasetemp() / "fuzz.cdb"
    path.write_text("\n".join(lines), encoding="ascii")
    ask_everything(path)


@settings(max_examples=EXAMPLES, deadline=None, derandomize=True)
@given(octets=st.binary(max_size=300) | st.text("MFSTLX:$,(){}[]0123456789ABCDG\n", max_size=300).map(str.encode))
def test_octets_of_any_kind(tmp_path_factory, octets):
    path = tmp_path_factory.getbasetemp() / "octets.cdb"
    path.write_bytes(octets)
    ask_everything(path)


def ask_everything(path: Path) -> None:
    try:
        table = cdb.load(path)
    except CdbError as error:
        assert str(path) in str(error)
        return
    for address in (0, table.functions[0].begin, 0xFFFF):
        table.function_at(address)
        table.line_at(address)
        table.asm_line_at(address)
    for symbol in table.symbols:
        assert str(symbol.type)


def test_a_line_begins_behind_a_jump_on_what_the_one_before_has_left(tmp_path):
    """SDCC marks `return 0;` before the JNZ that skips it; a stop there would happen each time."""
    source = FIRMWARE / "observed.c"
    image = IntelHex(str(build(source, tmp_path, "--debug")))
    table = cdb.load(tmp_path / "observed.cdb")
    lines = source.read_text(encoding="ascii").splitlines()
    asked, skipped = lines.index("    if (n == 0)") + 1, lines.index("        return 0;") + 1
    (marked,) = table.addresses("observed.c", skipped)
    assert image[marked] == JNZ
    table.correct_lines(image.__getitem__)
    assert table.addresses("observed.c", skipped) == [marked + 2]
    assert table.line_at(marked).number == asked
    assert table.line_at(marked + 2).number == skipped
