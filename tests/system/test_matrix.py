"""One scenario, many runs: matrices, firmware variants, --set, and what a CI reads of them."""

import json
import xml.etree.ElementTree as ET

import pytest
from test_bad_input import refused

FAILS = '\n[[expect]]\nvalue = "attitude.max_rad.yaw"\nat_most = 1e-9\n'


def matrix(*lines: str) -> str:
    return "\n[matrix]\n" + "\n".join(lines) + "\n"


def test_each_combination_runs_once_in_order(summary, scenario, tmp_path):
    path = scenario("default", tail=matrix("seed = [7, 8]", "link.bit_error = [0.0, 1e-4]"))
    runs = summary(path, "--stop-s", 2, "--states", tmp_path / "s.csv", code=0)
    assert [run["matrix"] for run in runs] == [
        {"seed": seed, "link.bit_error": rate} for seed in (7, 8) for rate in (0.0, 1e-4)
    ]
    assert [run["seed"] for run in runs] == [7, 7, 8, 8]
    flips = [run["link"]["bits_inverted"] for run in runs]
    assert flips[0] == flips[2] == 0 and flips[1] > 0 and flips[3] > 0
    sizes = [(tmp_path / f"s.{n}.csv").read_text().count("\n") for n in (1, 2, 3, 4)]
    assert sizes == [1 + run["link"]["ok"] for run in runs]
    assert runs[0]["trace_sha256"] == runs[2]["trace_sha256"] != runs[1]["trace_sha256"]


def test_a_combination_is_the_run_with_that_value(summary, scenario):
    varied = scenario("default", tail=matrix('"link.baud" = [9600, 4800]', "[matrix.nav]", 'form = ["one"]'))
    runs = summary(varied, "--stop-s", 1, code=1)
    alone = summary("default", "--stop-s", 1, "--set", "link.baud=4800", "--set", "nav.form=one", code=1)
    assert len(runs) == 2
    assert runs[1]["trace_sha256"] == alone["trace_sha256"]
    assert runs[0]["attitude"] != summary("default", "--stop-s", 1)["attitude"]


def test_the_exit_code_is_the_largest_and_junit_says_which(ins, scenario, tmp_path):
    path = scenario("default", tail=FAILS + matrix("expect.4.at_most = [1.0, 1e-9]"))
    out = tmp_path / "junit.xml"
    done = ins("run", path, "--stop-s", 1, "--junit", out)
    assert done.returncode == 1, done.stdout + done.stderr
    assert done.stdout.endswith("1 of 2 runs passed\n")
    suites = ET.parse(out).getroot().findall("testsuite")
    assert [suite.get("name") for suite in suites] == [
        f"default_variant[expect.4.at_most={value}]" for value in (1.0, 1e-9)
    ]
    failures = [[case.get("name") for case in suite if case.find("failure") is not None] for suite in suites]
    assert failures == [[], ["attitude.max_rad.yaw at most 1e-09"]]
    assert [suite.get("failures") for suite in suites] == ["0", "1"]
    assert "expected at most 1e-09" in suites[1].find("testcase/failure").get("message")
    assert all(len(suite.findall("testcase")) == 5 + 2 for suite in suites)


def test_reports_are_failures_of_a_strict_run_only(ins, tmp_path):
    image = tmp_path / "a5.ihx"
    image.write_text(":02000000A50059\n:00000001FF\n", encoding="ascii")
    for strict in ([], ["--strict"]):
        done = ins("run", "default", "--firmware", image, "--stop-s", 0.1, "--junit", tmp_path / "j.xml", *strict)
        assert done.returncode == (3 if strict else 1)
        (case,) = [
            case
            for case in ET.parse(tmp_path / "j.xml").iter("testcase")
            if case.get("name") == "the firmware does nothing wrong"
        ]
        text = case.find("failure").get("message") if strict else case.find("system-out").text
        assert "times, first at 0.0000" in text


def test_with_the_host_outside_the_navigators_expectations_are_skipped(ins, tmp_path):
    out = tmp_path / "j.xml"
    ins("run", "default", "--serial", f"uart=file:{tmp_path / 'u'}", "--speed", "max", "--stop-s", 0.2, "--junit", out)
    root = ET.parse(out).getroot()
    assert root.get("skipped") == "4"
    assert root.find("testsuite/testcase/skipped").get("message") == "the host is outside the run"


def test_images_are_a_dimension(summary, ins, tmp_path):
    from libins import scenario

    images = [scenario.PACKAGE / "firmware" / f"{name}.ihx" for name in ("acq_default", "acq_80ms_seq")]
    options = [word for image in images for word in ("--firmware", image)]
    runs = summary("default", "--stop-s", 2, *options, code=1)
    assert [run["firmware"] for run in runs] == ["acq_default.ihx", "acq_80ms_seq.ihx"]
    assert runs[0]["samples"] > 3 * runs[1]["samples"]


def test_what_the_command_line_gives_is_not_varied(summary, scenario):
    path = scenario("default", tail=matrix("seed = [1, 2]", "stop_s = [0.5, 1.0]"))
    one = summary(path, "--seed", 5, "--stop-s", 0.25)
    assert one["seed"] == 5 and one["sim_s"] == 0.25 and "matrix" not in one
    two = summary(path, "--set", "seed=9")
    assert [run["sim_s"] for run in two] == [0.5, 1.0] and {run["seed"] for run in two} == {9}


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        (["link.baud = 9600"], ("_variant.toml:46:", "matrix.link.baud", "9600", "a list")),
        (["link.baud = []"], ("matrix.link.baud", "[]", "one value or more")),
        (["link.baud = [9600, 9]"], ("_variant.toml:46: matrix: link.baud", "found 9.0", "50")),
        (['"link.bawd" = [9600]'], ("_variant.toml:46: matrix: link.bawd", "unknown key", "'baud'")),
        (["seed = [1, 'two']"], ("matrix: seed", "'two'", "an integer")),
        (["expect.9.at_most = [1.0]"], ("matrix: expect.9.at_most", "array of 4")),
        (["seed.low = [1]"], ("matrix: seed.low", "is 1, so there is no 'low'")),
        ([f"seed = {list(range(101))}", f"link.baud = {list(range(100))}"], ("matrix", "10100 runs", "10000")),
        (['firmware = ["nowhere.ihx"]'], ("matrix: firmware", "nowhere.ihx")),
    ],
)
def test_a_bad_matrix_is_refused_before_anything_runs(ins, scenario, tmp_path, lines, words):
    out = tmp_path / "s.json"
    refused(ins("run", scenario("default", tail=matrix(*lines)), "--stop-s", 0.1, "--json", out), *words)
    assert not out.exists()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--set", "link.baud"), ("--set link.baud", "KEY=VALUE")),
        (("--set", "link.baud=fast"), ("--set: link.baud", "'fast'", "a number")),
        (("--set", "lnk.baud=9600"), ("--set: lnk", "'link'")),
    ],
)
def test_a_bad_set_is_refused(ins, options, words):
    refused(ins("run", "default", *options), *words)


def test_one_serial_line_has_one_board(ins, scenario):
    path = scenario("default", tail=matrix("seed = [1, 2]"))
    refused(ins("run", path, "--serial", "uart=pty"), "--serial", "2 runs", "--set")


def test_a_published_list_is_what_json_reads(ins, scenario):
    path = scenario("default", tail=matrix("seed = [1, 2]"))
    done = ins("run", path, "--stop-s", 0.1, "--json", "-")
    assert [run["seed"] for run in json.loads(done.stdout)] == [1, 2]
