"""What is done by hand: the same deeds live, taken back and repeated, and from a saved scenario give the same bits."""

import os
import random
from pathlib import Path

import numpy as np
import pytest
from libins.debugger import Debugger, open_scenario
from libins.errors import UsageError
from libins.view_board import BoardEngine
from libins.view_session import Asked

from libins import _run, run, scenario

SEED = int(os.environ.get("VIEW_SEED", "20261122"))
ROUNDS = 20 if os.environ.get("INS_BENCH") else 2
DEEDS = 25
TRACED = len(_run.WIRES)


def opened(name: str = "default", **settings: object) -> BoardEngine:
    return BoardEngine(open_scenario(name, None, settings, seen=True))


def do(engine: BoardEngine, command: str, **arguments: object) -> dict:
    return engine.commands[command](Asked({"do": command, **arguments}))


def on(debugger: Debugger, ps: int) -> None:
    debugger.resume(debugger.run.now_ps + ps)


def deeds(engine: BoardEngine, rng: random.Random) -> None:
    """Knobs, faults and octets at random instants."""
    for _ in range(DEEDS):
        kind = rng.choice(["knob", "knob", "fault", "remove", "send", "input", "reset"])
        if kind == "knob":
            knob = rng.choice([k for k in engine.hand.knobs() if not k["name"].startswith("volts")])
            do(engine, "knob", name=knob["name"], value=rng.uniform(knob["min"], knob["max"]))
        elif kind == "input":
            do(engine, "knob", name=f"volts.{rng.randrange(11)}", value=rng.choice([None, rng.uniform(0, 5)]))
        elif kind == "fault":
            made = {"kind": "adc_noise", "lsb": 5.0}, {"kind": "volts_noise", "volts": 0.01}
            late = {"kind": "eoc_late", "delay_s": 1e-5, "probability": 0.5}, {"kind": "iram_flip", "rate_per_s": 5.0}
            wires = {"kind": "wire_cut", "net": "P1.3"}, {"kind": "crystal", "ppm": 200.0, "drift_ppm_s": 9.0}
            do(engine, "fault_add", **rng.choice([*made, *late, *wires]))
        elif kind == "remove" and engine.d.run.fault_hits():
            do(engine, "fault_remove", index=rng.randrange(len(engine.d.run.fault_hits())))
        elif kind == "send":
            do(engine, "uart_send", hex=rng.randbytes(3).hex())
        elif kind == "reset" and rng.random() < 0.3:
            do(engine, "reset", power=rng.random() < 0.5)
        if rng.random() < 0.7:  # or two at one instant
            on(engine.d, rng.randrange(1, 10**11))


@pytest.mark.parametrize("number", range(ROUNDS))
def test_a_saved_scenario_gives_the_same_edges_samples_and_faults(number: int, tmp_path: Path) -> None:
    print(f"seed {SEED} {number}")
    rng = random.Random(f"{SEED} {number}")
    engine = opened(seed=rng.randrange(1000), **{"gyro.preset": rng.choice(["ideal", "cg_l53"])})
    deeds(engine, rng)
    on(engine.d, 10**11)
    path = tmp_path / "done.toml"
    path.write_text(do(engine, "save")["toml"], encoding="utf-8")
    loaded = scenario.load_board(path)
    again = run.build(loaded, loaded.tables.seed, False, trace=True, seen=True)
    end = engine.now_ps
    while again.now_ps < end:
        again.until(min(end, again.now_ps + rng.randrange(1, 10**12)))
    edges = engine.history.edges.part(0, 10**9)
    assert again.take_edges().tolist() == edges[edges[:, 1] < TRACED].tolist()
    assert [list(map(float, row)) for row in _run.take_samples(again)] == engine.history.samples.part(0, 10**9).tolist()
    assert again.fault_hits() == engine.d.run.fault_hits()
    assert again.hand() == engine.d.run.hand()


def test_the_way_back_repeats_what_was_done(tmp_path: Path) -> None:
    rng = random.Random(SEED)
    engine = opened()
    deeds(engine, rng)
    on(engine.d, 10**11)
    d = engine.d
    end, state, shown = d.timeline.position, d.run.save(), engine.frame(True)
    for _ in range(5):
        d.timeline.go_near(rng.randrange(end.at_ps))
        assert engine.frame(False)["rewound"] <= engine.now_ps
        d.timeline.go(end)
        assert d.run.save() == state
        assert engine.frame(True)["edges"] == shown["edges"] and engine.frame(True)["uart"] == shown["uart"]


def test_another_deed_in_the_past_makes_another_future() -> None:
    engine = opened()
    on(engine.d, 5 * 10**11)
    do(engine, "knob", name="rate.z", value=0.5)
    on(engine.d, 5 * 10**11)
    engine.d.timeline.go_near(2 * 10**11)
    do(engine, "knob", name="rate.z", value=-0.5)
    on(engine.d, 8 * 10**11)
    assert engine.d.run.hand()["rate"] == [0.0, 0.0, -0.5]
    assert do(engine, "save")["toml"].count("[[knob]]") == 1
    edges = engine.history.edges.part(0, 10**9)
    assert (np.diff(edges[:, 0]) >= 0).all()


def test_turns_and_tilts_move_truth_and_estimate() -> None:
    engine = opened(**{"motion.kind": "still"})
    on(engine.d, 5 * 10**11)
    do(engine, "knob", name="rate.z", value=1.0)
    on(engine.d, 5 * 10**11)
    frame = engine.frame(False)
    assert frame["truth"]["w"] == [0.0, 0.0, 1.0] and frame["truth"]["euler"][2] == pytest.approx(0.5, abs=1e-5)
    assert abs(frame["error"][2]) < 2e-2
    for name, value in (("roll", 0.3), ("pitch", -0.4)):
        do(engine, "knob", name=f"tilt.{name}", value=value)
    on(engine.d, 10**12)
    frame = engine.frame(False)
    assert frame["truth"]["euler"][:2] == pytest.approx([0.3, -0.4], abs=1e-12) and frame["truth"]["w"] == [0.0] * 3
    assert frame["knobs"]["rate.z"] == 0.0
    assert {verdict["value"] for verdict in frame["verdicts"]} >= {"link.lost", "attitude.max_rad.yaw"}
    assert all(verdict["ok"] is not None for verdict in frame["verdicts"])


def test_six_accelerometers_have_inputs_by_hand_alone() -> None:
    engine = opened("sixacc")
    assert {knob["group"] for knob in engine.hello()["knobs"]} == {"Inputs by hand"}
    do(engine, "knob", name="volts.5", value=1.5)
    on(engine.d, 10**11)
    assert engine.frame(False)["volts"]["5"] == 1.5
    assert [part["name"] for part in engine.hello()["parts"] if part["kind"] == "tlc2543"] == ["U2", "U3"]


BAD = [
    ({"at_s": 1.0}, "found none, but exactly one of rate_rad_s"),
    ({"at_s": 1.0, "volts": 1.0, "channel": 0, "rate_rad_s": [0, 0, 1]}, "found rate_rad_s and volts"),
    ({"at_s": 1.0, "rate_rad_s": [0.0, 1.0]}, "3 numbers are needed"),
    ({"at_s": 1.0, "rate_rad_s": [0.0, 0.0, 1e9]}, "must lie in -100.0 .. 100.0"),
    ({"at_s": 1.0, "volts": 1.0}, "channel: is missing"),
    ({"at_s": 1.0, "bias_rad_s": [0, 0, 0], "channel": 1}, "means nothing to bias_rad_s"),
    ({"rate_rad_s": [0, 0, 1]}, "at_s: is missing"),
    ({"at_s": -1.0, "rate_rad_s": [0, 0, 1]}, "at_s: found -1.0"),
    ({"at_s": 1.0, "euler_rad": [0, 0, 1], "turn_s": 0.0}, "turn_s: found 0.0"),
]
BAD_SEND = [({"at_s": 0.0}, "exactly one of hex and text"), ({"at_s": 0.0, "hex": "5"}, "two digits an octet")]


@pytest.mark.parametrize(
    ("table", "name", "said"), [(t, "knob", s) for t, s in BAD] + [(t, "send", s) for t, s in BAD_SEND]
)
def test_bad_tables_are_refused_with_their_place(table: dict, name: str, said: str) -> None:
    with pytest.raises(UsageError) as refused:
        scenario.load_board(scenario.find("default"), None, {name: [table]})
    assert said in str(refused.value) and f"{name}.0" in str(refused.value)


def test_knobs_that_turn_are_refused_on_a_board_without_gyros() -> None:
    with pytest.raises(UsageError, match="knob.0.rate_rad_s: this board has no gyros"):
        scenario.load_board(scenario.find("sixacc"), None, {"knob": [{"at_s": 1.0, "rate_rad_s": [0.0, 0.0, 1.0]}]})
