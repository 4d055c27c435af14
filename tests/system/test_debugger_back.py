"""The debugger backwards: every state before is found again, octet by octet, and what the outside did is repeated."""

import os
import random

import pytest
import steps
from libins.timeline import FINER, SPACING, Timeline
from steps import line_of, mark_of

from libins import debugger

PLACES = 1000 if os.environ.get("INS_BENCH") == "1" else 40
SEED = int(os.environ.get("INS_SEED", "1"))
SECOND = 10**12
STEPS = 200


@pytest.fixture(scope="module")
def image(tmp_path_factory):
    return steps.image(tmp_path_factory.mktemp("steps"))


def opened(name, image):
    return debugger.open_scenario("default") if name == "default" else steps.opened(image)


def state(d) -> tuple[int, int, bytes]:
    return d.pc, d.run.cycle, d.run.save()


@pytest.mark.parametrize("name", ["default", "steps"])
def test_a_step_back_is_the_state_before_at_random_places(name, image):
    print("INS_SEED", SEED)
    d, rng = opened(name, image), random.Random(SEED)
    for _ in range(PLACES):
        d.resume(d.run.now_ps + rng.randrange(SECOND // 10**6, SECOND // 50))
        d.step_instruction()
        before = state(d)
        assert d.step_instruction().reason == "step"
        after = state(d)
        d.reverse_step_instruction()
        assert state(d) == before
        d.step_instruction()
        assert state(d) == after


@pytest.mark.parametrize("name", ["default", "steps"])
def test_snapshot_restore_run_is_run_at_random_places(name, image):
    print("INS_SEED", SEED)
    d, rng = opened(name, image), random.Random(SEED)
    for _ in range(PLACES):
        d.resume(d.run.now_ps + rng.randrange(1, SECOND // 50))
        snap, here = d.run.save(), d.run.now_ps
        further = here + rng.randrange(1, SECOND // 100)
        d.run.until(further)
        d.run.watcher.settle()
        reached = state(d)
        d.run.restore(snap)
        assert d.run.now_ps == here
        d.run.until(further)
        d.run.watcher.settle()
        assert state(d) == reached
        d.run.restore(snap)


def test_steps_back_retrace_every_step(image):
    d = steps.opened(image)
    d.add_code("main")
    d.resume()
    d.breakpoints.clear()
    seen = []
    for _ in range(STEPS):
        seen.append(state(d))
        d.step_instruction()
    for expected in reversed(seen):
        d.reverse_step_instruction()
        assert state(d) == expected


@pytest.mark.parametrize("over", [False, True])
def test_lines_back_retrace_lines_forward(image, over):
    d = steps.opened(image)
    d.add_code(str(line_of("loop 1"))).ignore = 5
    d.resume()
    d.breakpoints.clear()
    seen = []
    for _ in range(30):
        seen.append((d.run.cycle, mark_of(d.line().number)))
        d.step(over)
    back = []
    for _ in range(30):
        d.reverse_step(over)
        back.insert(0, (d.run.cycle, mark_of(d.line().number)))
    assert back == seen


def test_next_back_does_not_enter_a_function_that_has_returned_but_leaves_the_one_that_runs(image):
    d = steps.opened(image)
    d.add_code(str(line_of("count 3")))
    d.resume()
    d.breakpoints.clear()
    marks = []
    for _ in range(3):
        d.reverse_step(over=True)
        marks.append(mark_of(d.line().number))
    assert marks == ["by pointer", "count 1", "loop 1"]


def test_run_back_is_the_last_stop_of_any_breakpoint(image):
    d = steps.opened(image)
    d.add_code(str(line_of("count 3")))
    d.add_watch("far[0]")
    d.add_edge("P1.0", falling=False, condition="values[1] % 4 == 0")
    stops = []
    for _ in range(60):
        stop = d.resume()
        stops.append((stop.numbers, state(d)))
    assert {tuple(numbers) for numbers, _ in stops} == {(1,), (2,), (3,)}
    assert stops[-1][1][1] > 3 * d.run.cycle // 4, "the stops spread over several snapshots"
    for numbers, expected in reversed(stops[:-1]):
        stop = d.reverse_resume()
        assert (stop.numbers, state(d)) == (numbers, expected)
        if numbers == [1]:
            d.resume()
            assert state(d) != expected, "from a breakpoint that was found backwards the run goes on"
            d.reverse_resume()
            assert state(d) == expected
    assert d.reverse_resume().reason == "start"
    assert d.run.now_ps == 0
    assert (d.resume().numbers, state(d)) == stops[0]


def test_a_step_back_from_the_very_instruction_of_a_snapshot_is_one_instruction():
    d = debugger.open_scenario("default")
    d.resume(SECOND // 5)
    marks = d.timeline.marks()[1:]
    assert marks
    for mark in marks:
        d.timeline.go(mark)
        here = state(d)
        assert d.reverse_step_instruction().reason == "step"
        assert d.run.now_ps < mark.at_ps
        d.step_instruction()
        assert state(d) == here or d.run.now_ps > mark.at_ps, "asleep there: on to where it wakes"


def test_a_breakpoint_at_the_very_instruction_of_a_snapshot_is_met_backwards(image):
    d = steps.opened(image)
    d.resume(SECOND // 20)
    mark = d.timeline.marks()[-3]
    d.timeline.go(mark)
    d.add_code(f"*{d.pc:#x}")
    expected = state(d)
    d.breakpoints[1].enabled = False
    d.step_instruction()
    d.breakpoints[1].enabled = True
    assert d.reverse_resume().numbers == [1]
    assert state(d) == expected


def test_what_the_outside_did_is_repeated_and_what_it_does_anew_drops_the_future(image):
    d = steps.opened(image)
    stop = SECOND // 20
    d.resume(stop // 5)
    changes = [
        lambda r: r.send(b"Hi"),
        lambda r: r.set_volts(0, 1.5),
        lambda r: r.drive_pin(1, 4, False),
        lambda r: r.write("iram", 0x40, b"\x5a"),
        lambda r: r.reset(False),
    ]
    states = []
    for change in changes:
        d.do(change)
        d.do(lambda r: r.write("xdata", 0x80, b"\x01"))
        states.append((d.timeline.position, state(d)))
        d.resume(d.run.now_ps + stop // 10)
    end, received = state(d), list(d.timeline.received)
    assert [octet for _, octet, _ in received] == [ord("I"), ord("j")]
    for position, expected in random.Random(SEED).sample(states, len(states)):
        d.timeline.go(position)
        assert state(d) == expected
    d.timeline.go(d.timeline.start)
    d.resume(end_ps := states[-1][0].at_ps + stop // 10)
    assert state(d) == end
    assert d.timeline.received == received
    d.timeline.go(states[1][0])
    d.do(lambda r: r.write("iram", 0x40, b"\xa5"))
    d.resume((states[1][0].at_ps + end_ps) // 2)
    middle = d.timeline.position, state(d)
    d.resume(end_ps)
    assert state(d) != end
    assert d.run.read("iram", 0x40, 1) == b"\xa5", "the later poke is gone"
    d.timeline.go(middle[0])
    assert state(d) == middle[1], "so are the snapshots of the future that was"


def test_history_stays_within_its_budget_and_reaches_to_the_start(image):
    d = steps.opened(image)
    size = len(d.run.save())
    d.timeline = timeline = Timeline(d.run, d.scenario.tables.clock_hz, SPACING // 100, 100 * size)
    d.resume(SECOND // 2)
    marks = timeline.marks()
    assert 2 * FINER < len(marks) <= 100
    assert marks[0] == timeline.start
    gaps = [b.at_ps - a.at_ps for a, b in zip(marks, marks[1:], strict=False)]
    assert min(gaps[-FINER // 2 :]) < timeline.ps(SPACING // 100) // 8, "close together behind the newest"
    now = state(d)
    timeline.go(marks[len(marks) // 2])
    timeline.advance(SECOND // 2)
    assert state(d) == now


def test_a_snapshot_of_a_file_goes_on_and_another_boards_is_refused(image, tmp_path):
    from libins.errors import UsageError
    from libins.terminal import Terminal

    from libins import snapshot

    d = steps.opened(image)
    d.resume(SECOND // 100)
    Terminal(d).do_snapshot(str(tmp_path / "here.snap"))
    d.resume(SECOND // 50)
    expected = state(d)
    other = debugger.open_scenario(str(tmp_path / "here.snap"))
    other.resume(SECOND // 50)
    assert state(other) == expected
    assert other.print_value("total") == d.print_value("total")
    with pytest.raises(UsageError, match="another configuration or image"):
        debugger.open_scenario("default").restore(snapshot.read(tmp_path / "here.snap"))
