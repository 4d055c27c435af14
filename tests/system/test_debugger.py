"""The debugger forwards: places, steps, breakpoints of every kind, the stack."""

import numpy as np
import pytest
import steps
from libins.errors import UsageError
from steps import line_of, mark_of

from libins import _run, debugger, run, scenario

SECOND = 10**12


@pytest.fixture(scope="module")
def image(tmp_path_factory):
    return steps.image(tmp_path_factory.mktemp("steps"))


@pytest.fixture
def d(image):
    return steps.opened(image)


def at(d) -> str:
    line = d.line()
    return mark_of(line.number) if line else ""


def to(d, mark: str) -> None:
    """Run to a line."""
    d.breakpoints.clear()
    d.add_code(str(line_of(mark)), temporary=True)
    assert d.resume().reason == "breakpoint"
    assert at(d) == mark


def test_a_debugged_run_is_the_run_without_a_debugger(d):
    stop_ps = SECOND // 5
    d.add_code("twice", condition="total == 0xFFFE")
    d.add_watch("total", condition="total == 0xFFFF")
    assert d.resume(stop_ps).reason == "limit"
    plain = run.build(d.scenario, d.scenario.tables.seed, True, trace=False, listen=True)
    plain.until(stop_ps)
    for each in (plain, d.run):
        each.watcher.settle()
        each.take_received()
    assert (d.run.cycle, d.run.pc) == (plain.cycle, plain.pc)
    assert d.run.save() == plain.save()


def test_step_goes_into_functions_and_passes_interrupts_over(d):
    d.add_code(str(line_of("loop 1"))).ignore = 20
    d.resume()
    d.breakpoints.clear()
    seen = []
    while not seen or seen[-1] != "count 3":
        assert d.step().reason == "step"
        seen.append(at(d))
    body = ["twice 1", "twice 2", "}"]  # SDCC makes no code of its own for the return
    assert seen == ["count 1", *body, "by pointer", *body, "count 3"]
    assert d.run.counters()["interrupts"] > 0


def test_next_passes_calls_over_also_by_pointer_and_recursive_ones(d):
    to(d, "count 1")
    seen = []
    for _ in range(6):
        assert d.step(over=True).reason == "step"
        seen.append(at(d))
    assert seen == ["by pointer", "count 3", "}", "loop 2", "loop 3", "loop 4"]


def test_finish_leaves_a_function_and_an_interrupt(d):
    to(d, "twice 2")
    d.finish()
    assert at(d) == "count 1"
    d.add_code("tick")
    assert d.resume().reason == "breakpoint"
    outside = d.frames()[1].pc
    d.breakpoints.clear()
    d.finish()
    assert d.pc == outside


def test_the_stack_of_recursive_calls_and_of_an_interrupt(d):
    d.add_code(str(line_of("bottom")), condition="$r7 == 0")
    d.resume()
    assert [f.function.name for f in d.frames()] == ["depth"] * 4 + ["main"]
    d.add_code("tick")
    d.resume()
    names = [f.function.name for f in d.frames()]
    assert names[0] == "tick"
    assert names[-1] == "main"
    d.breakpoints.clear()
    d.finish()
    assert [f.function.name for f in d.frames()] == names[1:]


def test_an_interrupt_knows_where_it_came_from_at_each_of_its_instructions(d):
    tick = d.table.function("tick")
    for instruction in [line.address for line in d.table.asm_lines if tick.begin <= line.address < tick.end]:
        d.breakpoints.clear()
        d.add_code(f"*{instruction:#x}")
        d.resume()
        frames = d.frames()
        assert frames[-1].function.name == "main"
        d.breakpoints.clear()
        d.finish()
        assert d.pc == frames[1].pc, hex(instruction)


def test_a_change_is_told_with_both_values_and_only_where_they_differ(d):
    d.add_watch("values[1]")
    stop = d.resume()
    assert stop.notes == ["values[1]\n\nOld value = 0\nNew value = 20"], "the start-up code fills it"
    stop = d.resume()
    assert stop.notes == ["values[1]\n\nOld value = 20\nNew value = 21"]
    assert at(d) in ("count 3", "}")


def test_an_expression_is_watched_through_all_that_it_reads(d):
    to(d, "first")
    d.add_watch("total + ticks * 1000 > 1010 && ticks")
    stop = d.resume()
    assert stop.reason == "breakpoint"
    assert d.print_value("ticks") == "1" and int(d.print_value("total")) > 10


def test_a_place_that_is_read_often_is_noted_once(d):
    r0 = d.expression("$r0")
    r0.number(d.memory)
    noted = len(d.memory.touched)
    for _ in range(100):
        r0.number(d.memory)
    assert len(d.memory.touched) == noted > 0, "a page of ins view reads the registers 30 times a second for hours"


@pytest.mark.parametrize("mark", ["loop 2"])
def test_reads_and_writes_of_external_ram_and_of_registers(d, mark):
    to(d, "first")
    d.add_watch("far[0]", "read")
    stop = d.resume()
    d.breakpoints.clear()
    assert (stop.reason, at(d)) == ("breakpoint", mark)
    assert stop.notes == ["far[0] was read: 0x00 at 0x0001"]
    d.add_watch("far[0]", "write")
    assert d.resume().notes == ["far[0] was written: 0x03 at 0x0001"]
    d.breakpoints.clear()
    d.add_watch("P1", "access")
    d.resume()
    assert at(d) in ("loop 3", "loop 4")


def test_edges_of_a_pin_octets_of_the_line_and_instants(d):
    d.add_edge("P1.0", rising=False)
    assert d.resume().notes == ["P1.0 fell"]
    assert not d.run.pin(1, 0)
    d.breakpoints.clear()
    d.resume(5 * SECOND // 1000)  # timer 1 has passed its first 256 counts
    assert d.do(lambda r: r.send(b"AB")) == 2
    d.add_octet(ord("C"))
    assert d.resume(SECOND).notes == ["the host received 0x43"]
    assert [octet for _, octet, _ in d.timeline.received] == [ord("B"), ord("C")]
    d.breakpoints.clear()
    when = d.add_time(0.0123)
    assert d.resume().numbers == [when.number]
    assert 0 <= d.run.now_ps - 12_300_000_000 < d.timeline.ps(4)


def test_conditions_ignore_counts_and_disabled_breakpoints(d):
    each = d.add_code(str(line_of("count 1")), condition="values[1] >= 25")
    d.resume()
    assert d.print_value("values[1]") == "25"
    assert each.hits == 1
    each.condition, each.ignore = None, 3
    d.resume()
    assert d.print_value("values[1]") == "29"
    each.enabled = False
    assert d.resume(d.run.now_ps + SECOND // 100).reason == "limit"


def test_a_program_that_ends_and_one_that_sleeps(tmp_path, image):
    (tmp_path / "ends.c").write_text("void main(void)\n{\n    while (1)\n    {\n    }\n}\n", encoding="ascii")
    ends = debugger.open_scenario(str(steps.build(tmp_path / "ends.c", tmp_path, "--debug")))
    assert ends.resume().reason == "halted"
    (tmp_path / "sleeps.c").write_text("#include <8051.h>\nvoid main(void)\n{\n    PCON = 1;\n}\n", encoding="ascii")
    sleeps = debugger.open_scenario(str(steps.build(tmp_path / "sleeps.c", tmp_path, "--debug")))
    sleeps.add_code("main")
    sleeps.resume()
    assert [sleeps.step_instruction().reason for _ in range(3)][-1] == "asleep"


def test_pokes_change_variables_bits_pointers_and_the_program_counter(d):
    to(d, "loop 4")
    for target, value in (("point.x", "-77"), ("P1.4", "0"), ("$r3", "0x5A"), ("pointer->y", "1234"), ("far[2]", "7")):
        d.assign(target, value)
        assert int(d.print_value(target)) == int(value, 0), target
    d.assign("$pc", "count")
    assert d.pc == d.table.function("count").begin


@pytest.mark.parametrize(
    ("do", "said"),
    [
        (lambda d: d.add_code("nowhere"), "has no function nowhere"),
        (lambda d: d.add_code("other.c:3"), "no code is from this file"),
        (lambda d: d.add_code("steps.c:9999"), "no code from here to the end"),
        (lambda d: d.add_code("main", condition="nothing == 1"), "has no variable nothing"),
        (lambda d: d.add_watch("1 + 1"), "a constant never changes"),
        (lambda d: d.add_watch("total + 1", "read"), "only a place in memory"),
        (lambda d: d.add_edge("P4.0"), "no wire of this board"),
        (lambda d: d.assign("total + 1", "3"), "only a number in memory"),
        (lambda d: d.delete(17), "no such breakpoint"),
    ],
)
def test_what_cannot_be_is_refused_with_its_reason(d, do, said):
    with pytest.raises(UsageError, match=said):
        do(d)
    assert not d.breakpoints


def test_the_default_scenario_debugged_gives_its_navigation_states():
    loaded = scenario.load(scenario.find("default"), scenario.PACKAGE / "firmware/acq_default_debug.ihx")
    plain = run.build(loaded, loaded.tables.seed, False, trace=False)
    plain.until(SECOND)
    d = debugger.open_scenario("default")
    d.add_code("tick", condition="lost != 0")
    d.add_edge("/CS", condition="sampled == 0xFFFF")
    states = []
    take = d.run.take_states

    class Kept:
        """The run, but for the states it hands out, which are kept."""

        def __getattr__(self, name):
            return getattr(d.run, name)

        def take_states(self):
            states.append(take()[0])
            return states[-1], []

    d.timeline.run = Kept()
    assert d.resume(SECOND).reason == "limit"
    expected = plain.take_states()[0]
    assert len(expected) > 10
    assert np.array_equal(np.concatenate(states), expected)
    assert list(_run.STATE_COLUMNS)[:2] == ["index", "scan"]
