"""A [[fault]] table that cannot be is refused before anything runs: file, line, key, value, what would be right."""

import pytest
from libins.board import Board
from libins.errors import UsageError
from test_bad_input import refused

LINE = 44  # of [[fault]], behind the default scenario


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        (["kind = 'adc_stuk'"], (f":{LINE + 1}: fault.0.kind", "'adc_stuk'", "'adc_stuck'")),
        (["lsb = 3.0"], ("fault.0.kind", "missing")),
        (["kind = 'adc_offset'"], (f":{LINE}: fault.0.lsb", "missing", "adc_offset")),
        (["kind = 'adc_offset'", "lsb = 1", "volts = 2.0"], (f":{LINE + 3}: fault.0.volts", "adc_offset", "lsb")),
        (["kind = 'adc_flip'", "probability = 1.5"], (f":{LINE + 2}: fault.0.probability", "1.5", "0.0 .. 1.0")),
        (["kind = 'adc_stuck'", "bit = 12", "value = 1"], ("fault.0.bit", "12", "0 .. 11")),
        (["kind = 'iram_flip'"], ("fault.0", "at_s or rate_per_s")),
        (["kind = 'iram_flip'", "at_s = 1", "rate_per_s = 1"], ("fault.0", "either at_s or rate_per_s")),
        (["kind = 'reset'", "at_s = 1", "to_s = 2"], (f":{LINE + 2}: fault.0.at_s", "one instant")),
        (["kind = 'iram_flip'", "at_s = 1", "bit = 9"], ("fault.0.bit", "9", "0 .. 7")),
        (["kind = 'iram_flip'", "at_s = 1", "address = 0x80"], ("fault.0.address", "0x80", "0x7f")),
        (["kind = 'sfr_flip'", "at_s = 1", "address = 0x30"], ("fault.0.address", "0x30", "0x80 .. 0xff")),
        (["kind = 'xdata_flip'", "at_s = 1"], ("fault.0.kind", "xdata_flip", "xdata_octets")),
        (["kind = 'wire_cut'", "net = 'P4.0'"], (f":{LINE + 2}: fault.0.net", "'P4.0'", "P1.4")),
        (["kind = 'wire_cut'", "net = 'EOC 2'"], ("fault.0.net", "'EOC 2'")),
        (["kind = 'wire_cut'", "net = 'HOST RXD'"], ("fault.0.net", "'HOST RXD'", "pin of the CPU")),
        (["kind = 'wire_short'", "net = 'EOC'", "to = 'ground'"], (f":{LINE + 3}: fault.0.to", "'ground'", "gnd")),
        (["kind = 'wire_short'", "net = 'EOC'", "to = 'P1.0'"], ("fault.0.to", "'P1.0'", "another net")),
        (["kind = 'break'", "line = 'both'"], ("fault.0.line", "'both'", "'to_board', 'to_host'")),
        (["kind = 'crystal'", "ppm = 2e5"], ("fault.0.ppm", "200000.0", "100000.0")),
        (["kind = 'baud'", "ppm = 2.0", "from_s = 3.0", "to_s = 3.0"], ("fault.0.to_s", "3.0", "after")),
        (
            ["kind = 'baud'", "ppm = 1", "[[fault]]", "kind = 'baud'", "ppm = true"],
            (f":{LINE + 5}: fault.1.ppm", "True", "a number"),
        ),
        (
            ["kind = 'wire_short'", "net = 'EOC'", "to = 'gnd'", "[[fault]]", "kind = 'wire_short'", "net = 'TXD'"]
            + ["to = 'EOC'", "from_s = 1.0"],
            (f":{LINE + 4}: fault.1", "EOC", "two faults at a time"),
        ),
    ],
)
def test_a_bad_table_is_refused(ins, scenario, tmp_path, lines, words):
    path = scenario("default", tail="\n".join(["[[fault]]", *lines, ""]))
    refused(ins("run", path, "--json", tmp_path / "s.json"), *words)
    assert not (tmp_path / "s.json").exists()


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"kind": "adc_offset"}, "fault.0.lsb.*missing"),
        ({"kind": "adc_offset", "lsbs": 1}, "fault.lsbs: unknown key"),
        ({"kind": "wire_cut", "net": "EOC 2"}, "net: found 'EOC 2'"),
    ],
)
def test_a_bad_fault_of_a_board_is_refused_and_nothing_is_broken(keys, words):
    board = Board("default")
    with pytest.raises(UsageError, match=words):
        board.faults.add(**keys)
    assert board.faults.hits() == []
