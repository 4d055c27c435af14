"""The dump of a run, read by others: the converter's timing table (TI SLAS079F) and the line, from the VCD alone."""

import re
import subprocess
from bisect import bisect_right
from pathlib import Path

import pytest
from conftest import timeless
from vcdvcd import VCDVCD

NS = 1_000
US = 1_000_000
CS_TO_CLOCK_PS = 1_425 * NS
DATA_SETUP_PS = 100 * NS
CLOCK_PERIOD_PS = 10**12 // 4_100_000
DATA_OUT_PS = 150 * NS
EOC_DELAY_PS = 2_200 * NS
CONVERSION_PS = 10 * US
ABORT_PS = 5 * US
BITS = 12
CODES = 4096
SPAN_V = 5.0
STOP_S = 1.0
SCANS = 49
CHANNELS = [0, 1, 2, 0]
"""Of the four transfers of a scan: each gives the result of the one before."""


class Signal:
    """One variable: (instant, value) of its changes."""

    def __init__(self, changes):
        self.changes = changes
        self.at = [at for at, _ in changes]

    def value(self, t):
        """At instant t, after the changes of that instant."""
        return self.changes[bisect_right(self.at, t) - 1][1]

    def before(self, t):
        return self.value(t - 1)

    def edges(self, to, begin=1, end=10**15):
        return [at for at, value in self.changes if value == to and begin <= at < end]


@pytest.fixture(scope="module")
def dump(tmp_path_factory, ins) -> Path:
    path = tmp_path_factory.mktemp("vcd") / "default.vcd"
    options = ["--set", "firmware=acq_default_debug.ihx", "--stop-s", STOP_S, "--vcd", path, "--vcd-sfr", "TCON"]
    done = ins("run", "default", *options)
    assert done.returncode == 0, done.stdout + done.stderr
    return path


@pytest.fixture(scope="module")
def wires(dump):
    values = VCDVCD(str(dump))
    return {name: Signal(values[name].tv) for name in values.signals}


@pytest.fixture(scope="module")
def net(wires):
    return {name.rsplit(".", 1)[1]: signal for name, signal in wires.items()}


@pytest.fixture(scope="module")
def texts(dump):
    """The variables of type string, which the reader above leaves out."""
    text = dump.read_text(encoding="ascii")
    names = dict(re.findall(r"\$var string 1 (\S+) (\w+) \$end", text))
    signals = {name: [] for name in names.values()}
    now = 0
    for line in text.partition("$enddefinitions")[2].splitlines():
        if line.startswith("#"):
            now = int(line[1:])
        elif line.startswith("s"):
            value, _, key = line[1:].rpartition(" ")
            signals[names[key]].append((now, value))
    return {name: Signal(changes) for name, changes in signals.items()}


@pytest.fixture(scope="module")
def transfers(net):
    """(fall of /CS, its rise) of each transfer of the converter."""
    falls, rises = net["CS_n"].edges("0"), net["CS_n"].edges("1")
    assert len(falls) == len(rises) == SCANS * len(CHANNELS)
    return list(zip(falls, rises, strict=True))


def test_twelve_clocks_within_cs_and_the_set_up_times(net, transfers):
    for fall, rise in transfers:
        ups, downs = net["IO_CLOCK"].edges("1", fall, rise), net["IO_CLOCK"].edges("0", fall, rise)
        assert len(ups) == len(downs) == BITS
        assert all(up < down for up, down in zip(ups, downs, strict=True))
        assert ups[0] - fall >= CS_TO_CLOCK_PS
        assert min(b - a for a, b in zip(ups, ups[1:], strict=False)) >= CLOCK_PERIOD_PS
        for up in ups:
            data = net["DATA_IN"].at
            assert up - data[bisect_right(data, up) - 1] >= DATA_SETUP_PS


def test_nothing_but_the_converters_own_signals_outside_cs(net, transfers):
    """No clock where /CS is high, after the start."""
    inside = [at for fall, rise in transfers for at in net["IO_CLOCK"].edges("1", fall, rise)]
    assert net["IO_CLOCK"].edges("1", transfers[0][0]) == inside


def test_eoc_falls_after_the_last_clock_and_the_conversion_ends_before_the_next_transfer(net, transfers):
    following = [fall for fall, _ in transfers[1:]] + [10**15]
    for (fall, rise), after in zip(transfers, following, strict=True):
        last = net["IO_CLOCK"].edges("0", fall, rise)[-1]
        down = net["EOC"].edges("0", fall, after)
        up = net["EOC"].edges("1", fall, after)
        assert len(down) == len(up) == 1
        assert 0 < down[0] - last <= EOC_DELAY_PS
        assert 0 < up[0] - down[0] <= CONVERSION_PS
        assert after - last > ABORT_PS
        assert after >= up[0]


def address_of(net, fall, rise):
    """What the converter is told by DATA IN at the first four rising edges."""
    ups = net["IO_CLOCK"].edges("1", fall, rise)
    return int("".join(net["DATA_IN"].value(up) for up in ups[:4]), 2)


def test_channels_in_order_sampled_at_the_last_falling_edge(net, transfers):
    assert [address_of(net, *t) for t in transfers] == CHANNELS * SCANS
    lasts = [net["IO_CLOCK"].edges("0", *t)[-1] for t in transfers]
    assert net["sampled"].at == lasts
    assert [int(net["channel"].value(at), 2) for at in lasts] == CHANNELS * SCANS


def test_data_out_is_the_result_before_msb_first(net, transfers):
    for (begin, end), (fall, rise) in zip(transfers, transfers[1:], strict=False):
        ups = net["IO_CLOCK"].edges("1", fall, rise)
        read = int("".join(net["DATA_OUT"].before(up) for up in ups), 2)
        sampled = net["IO_CLOCK"].edges("0", begin, end)[-1]
        assert read == int(net["code"].value(sampled), 2)


def test_data_out_is_valid_soon_after_a_falling_edge(net, transfers):
    for fall, rise in transfers:
        downs = net["IO_CLOCK"].edges("0", fall, rise)
        ups = net["IO_CLOCK"].edges("1", fall, rise)
        for at in (at for at in net["DATA_OUT"].at if ups[0] < at < rise):
            assert 0 <= at - max(down for down in downs if down <= at) <= DATA_OUT_PS


def test_codes_are_the_volts_at_the_instant_of_the_sample(net):
    for at in net["sampled"].at:
        channel = int(net["channel"].value(at), 2)
        volts = float(net[f"AIN{channel}"].value(at))
        assert int(net["code"].value(at), 2) == pytest.approx(volts / SPAN_V * CODES, abs=0.5)


def test_the_grid_of_the_volts(wires):
    assert set(range(10**9, 10**12, 10**9)) <= set(wires["board.analog.AIN1"].at)


def test_octets_on_the_line_carry_the_codes(net, texts, transfers):
    sent = [value for _, value in texts["TXD_octet"].changes if value]
    octets = bytes.fromhex("".join(sent))
    pairs = [
        (high & 0x0F) << 8 | low for high, low in zip(octets, octets[1:], strict=False)
    ]  # a number is above the codes
    blocks = [pairs[i : i + 6 : 2] for i in range(len(pairs))]
    instants = [net["IO_CLOCK"].edges("0", *t)[-1] for t in transfers]
    for i in range(0, len(instants) - 8, len(CHANNELS)):
        codes = [int(net["code"].value(at), 2) for at in instants[i : i + 3]]
        assert codes in blocks
    begins = [at for at, value in texts["TXD_octet"].changes if value]
    assert begins == [at for at in net["TXD"].edges("0") if at in set(begins)], "an octet begins with its start bit"
    assert len([value for _, value in texts["RXD_octet"].changes if value]) >= SCANS


def test_the_scan_happens_in_its_interrupt(texts, transfers):
    assert {value for _, value in texts["interrupt"].changes} == {"", "tick", "serial"}
    for fall, rise in transfers:
        assert texts["interrupt"].value(fall) == texts["interrupt"].value(rise) == "tick"


def test_ports_are_their_nets(net, wires):
    bits = {"EOC": 0, "IO_CLOCK": 1, "DATA_IN": 2, "DATA_OUT": 3, "CS_n": 4}
    for at, value in dict(wires["board.cpu.P1"].changes).items():  # the last of an instant
        shown = {name: value[-1 - bit] for name, bit in bits.items()}
        assert shown == {name: net[name].value(at) for name in bits}
    assert {at for at, _ in wires["board.cpu.P1"].changes} >= set(net["DATA_OUT"].at) | set(net["CS_n"].at)


def test_sfrs_asked_for(wires):
    """TF0 comes up for each tick and is cleared by the hardware's call."""
    tcon = [int(value, 2) for at, value in wires["board.cpu.TCON"].changes if at]
    assert {value >> 4 & 1 for value in tcon} == {0, 1}, "TR0 stops while the interrupt reloads"


def test_gtkwave_reads_all_of_it(dump, tmp_path):
    """Through GTKWave's own format and back: the same changes of every wire."""
    fst, back = tmp_path / "d.fst", tmp_path / "d.vcd"
    subprocess.run(["vcd2fst", dump, fst], check=True, capture_output=True, timeout=60)
    with back.open("wb") as file:
        subprocess.run(["fst2vcd", fst], check=True, stdout=file, timeout=60)
    ours, theirs = VCDVCD(str(dump)), VCDVCD(str(back))
    compared = [name for name in ours.signals if not name.startswith("board.analog")]
    assert len(compared) > 15
    for name in compared:
        other = next(theirs[n] for n in theirs.signals if n.split("[")[0].split()[0] == name)
        if ours[name].var_type in ("wire", "reg"):
            assert [(t, v.lstrip("0x")) for t, v in ours[name].tv] == [(t, v.lstrip("0x")) for t, v in other.tv], name


def test_a_dump_changes_nothing(summary, tmp_path):
    plain = summary("default", "--stop-s", STOP_S)
    looked_at = summary("default", "--stop-s", STOP_S, "--vcd", tmp_path / "a.vcd", "--vcd-sfr", "TL0")
    assert looked_at.pop("observed")["cycles"] == plain["cpu"]["cycles"]
    assert timeless(looked_at) == timeless(plain)


def test_the_file_grows_while_the_run_goes_on(tmp_path):
    """An hour's edges need not fit into memory."""
    from libins import observe, run, scenario

    path = tmp_path / "long.vcd"
    loaded = scenario.load(scenario.find("default"), settings={"stop_s": 2.0})
    sizes = []
    watch = observe.Observation(loaded, observe.Wanted(vcd=path))
    part = path.with_name("long.vcd.part")
    run.execute(loaded, run.Options(watch=watch, progress=lambda t, _: sizes.append(part.stat().st_size)))
    assert sizes[len(sizes) // 2] > 0.3 * path.stat().st_size
    assert not part.exists()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--vcd", "{tmp}/absent/a.vcd"], "absent/a.vcd: cannot be written: No such file or directory"),
        (["--vcd", "{tmp}/a.vcd", "--vcd-sfr", "PINSEL"], "--vcd-sfr PINSEL: is none of ACC, AUXR"),
        (["--vcd", "{tmp}/a.vcd", "--vcd-analog-us", "0"], "--vcd-analog-us 0: must lie in 1 .. 1e9"),
    ],
)
def test_what_cannot_be_dumped(ins, tmp_path, options, message):
    done = ins("run", "default", *[str(option).format(tmp=tmp_path) for option in options])
    assert done.returncode == 2
    assert message in done.stderr
    assert not list(tmp_path.glob("*.part"))
