# SPDX-License-Identifier: MIT
"""The core on its targets: the same bits, libm within 4 ulp, the reference vectors; and what would spoil them."""

import os
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import pytest
from machines import MACHINES, MachineError, tell
from programs import BUILD, NUMBER, OPTIMISATION, Report, build, core_objects, read, run, table

REFERENCE = "x86_64"
ULP = {"f64": 2.0**-52, "f32": 2.0**-23}
LIBM_ULP = 4
SETS = [(name, number) for name, machine in MACHINES.items() for number in machine.numbers]
IDS = [f"{name}-{number}" for name, number in SETS]
Sets = dict[tuple[str, str], "Future[Report]"]


@pytest.fixture(scope="module")
def reports(request: pytest.FixtureRequest) -> Iterator[Sets]:
    """Every set that a chosen test asks for, built and run beside each other."""
    parameters = (getattr(item, "callspec", None) for item in request.session.items)
    wanted = {each.params["wanted"] for each in parameters if each is not None and "wanted" in each.params}
    wanted |= {(REFERENCE, number) for number in NUMBER}
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        yield {each: pool.submit(run, *each) for each in SETS if each in wanted}


def ulps(got: list[float], want: list[float], epsilon: float) -> float:
    """Largest difference, in units of the last place of the largest component."""
    return max(abs(g - w) for g, w in zip(got, want, strict=True)) / (epsilon * max(map(abs, want)))


@pytest.mark.parametrize("wanted", SETS, ids=IDS)
def test_same_bits_as_on_x86_64(reports: Sets, wanted: tuple[str, str]) -> None:
    got = reports[wanted].result()
    want = reports[REFERENCE, wanted[1]].result()
    assert got.exits["bits_attitude"] == 0, f"ins_selftest() gave {got.exits['bits_attitude']}"
    assert len(want.same) >= 32
    assert got.same == want.same


@pytest.mark.parametrize("wanted", SETS, ids=IDS)
def test_libm_within_4_ulp_of_x86_64(reports: Sets, wanted: tuple[str, str]) -> None:
    got = reports[wanted].result().near
    want = reports[REFERENCE, wanted[1]].result().near
    assert got.keys() == want.keys() and len(want) >= 10
    worst = {}
    for name, results in want.items():
        assert len(got[name]) == len(results) > 10, name
        worst[name] = max(ulps(g, w, ULP[wanted[1]]) for g, w in zip(got[name], results, strict=True))
    print(*(f"{name} {value:.2f}" for name, value in worst.items()), sep="\n")
    assert max(worst.values()) <= LIBM_ULP, worst


@pytest.mark.parametrize("wanted", SETS, ids=IDS)
def test_reference_vectors_on_the_target(reports: Sets, wanted: tuple[str, str]) -> None:
    report = reports[wanted].result()
    print(
        *(f"{name}: {n} values, {worst:.2e} of {limit:.0e}" for name, (n, worst, limit) in report.vectors.items()),
        sep="\n",
    )
    assert len(report.vectors) == 21
    assert report.exits["vectors"] == 0, report.vectors


def test_integers_are_the_same_in_both_types(reports: Sets) -> None:
    double, single = (reports[REFERENCE, number].result().same for number in ("f64", "f32"))
    whole = {"q31", "handshake", "link", "gimu", "nmea", "switch", "libm_input"}
    assert {name for name in double if double[name].split()[:2] == single[name].split()[:2]} == whole


def test_contraction_is_noticed(reports: Sets) -> None:
    """A compiler that may contract a b + c to one rounding: other bits, and the comparison says so."""
    machine = MACHINES["m7"]
    report = Report()
    program = build(machine, "f64", "bits_attitude", ("-ffp-contract=fast", "-std=gnu11"))
    read("bits_attitude", machine.start(program)[1], report)
    want = reports[REFERENCE, "f64"].result().same
    different = {name for name, digest in report.same.items() if digest != want[name]}
    assert "attitude" in different and "strapdown" not in different
    assert "q31" not in different


@pytest.mark.parametrize("shift", [50, 3000, 9000, 10000])
def test_a_wrong_vector_is_noticed(shift: int) -> None:
    machine = MACHINES[REFERENCE]
    program = build(machine, "f64", "vectors", tape=table(shift))
    code, printed = machine.start(program)
    report = Report()
    read("vectors", printed, report)
    assert code != 0 and report.exits["vectors"] >= 1


def test_five_ulp_are_too_many() -> None:
    assert ulps([1.0, 2.0 + 5 * 2**-51], [1.0, 2.0], ULP["f64"]) > LIBM_ULP
    assert ulps([1.0, 2.0 + 4 * 2**-51], [1.0, 2.0], ULP["f64"]) <= LIBM_ULP


def test_a_program_that_hangs_fails_and_says_so(tmp_path: Path) -> None:
    machine = MACHINES["m3"]
    source = tmp_path / "hang.c"
    source.write_text("int main(void) { for (volatile int i = 0;;) { i = 1; } }\n")
    machine.compile(source, tmp_path / "hang.o", OPTIMISATION)
    machine.connect([tmp_path / "hang.o"], tmp_path / "hang.elf")
    with pytest.raises(MachineError, match="m3: no end after 1 s"):
        machine.start(tmp_path / "hang.elf", limit_s=1)


def test_a_missing_emulator_fails_and_says_what_to_install() -> None:
    machine = replace(MACHINES["armel"], run=("qemu-none",))
    with pytest.raises(MachineError, match="apt-get install --no-install-recommends .*qemu-user"):
        machine.start(Path("any"))


@pytest.mark.parametrize("number", NUMBER)
def test_every_object_for_the_arm920t_is_v4t_code(number: str) -> None:
    machine = MACHINES["arm920t"]
    objects = core_objects(machine, [*OPTIMISATION, *NUMBER[number]])
    assert len(objects) > 40
    for path in objects:
        attributes = tell(machine.tool("readelf"), "-A", path)
        assert "Tag_CPU_arch: v4T" in attributes, path.relative_to(BUILD)
