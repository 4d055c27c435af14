"""Each bad input ends in one clear message with place and remedy, and the right exit code; nothing is half-written."""

import os
import subprocess
import sys

import pytest

IMAGE = "firmware/acq_default.ihx"


def refused(done, *words: str) -> str:
    assert done.returncode == 2, done.stdout + done.stderr
    assert "Traceback" not in done.stderr
    lines = [line for line in done.stderr.splitlines() if line.strip()]
    assert len(lines) == 1, done.stderr
    for word in words:
        assert word in lines[0], lines[0]
    return lines[0]


@pytest.fixture
def image():
    from libins import scenario

    return (scenario.PACKAGE / IMAGE).read_text(encoding="ascii")


def test_truncated_hex(ins, tmp_path, image):
    path = tmp_path / "cut.ihx"
    path.write_text(image[: len(image) // 2], encoding="ascii")
    refused(ins("run", "default", "--firmware", path), str(path), "build it again")
    whole_records = "".join(image.splitlines(keepends=True)[:-1])
    path.write_text(whole_records, encoding="ascii")
    refused(ins("run", "default", "--firmware", path), "truncated")


def test_bad_checksum_hex(ins, tmp_path, image):
    lines = image.splitlines()
    lines[0] = lines[0][:-1] + ("0" if lines[0][-1] != "0" else "1")
    path = tmp_path / "sum.ihx"
    path.write_text("\n".join(lines) + "\n", encoding="ascii")
    refused(ins("run", "default", "--firmware", path), str(path), "checksum", "line 1")


def test_image_larger_than_flash(ins, tmp_path):
    path = tmp_path / "large.ihx"
    path.write_text(":011000000AE5\n:00000001FF\n", encoding="ascii")
    refused(ins("run", "default", "--firmware", path), "0x1000", "4096")


def test_missing_files(ins, tmp_path, scenario):
    refused(ins("run", "no/such.toml"), "no/such.toml", "No such file")
    refused(ins("run", "default", "--firmware", tmp_path / "none.ihx"), "none.ihx", "No such file")
    refused(ins("run", scenario("default", ("acq_default.ihx", "nowhere.ihx"))), ":4: firmware", "nowhere.ihx")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("baud = 9600", "bawd = 9600", ("link.bawd", "unknown key", "'baud'", "_variant.toml:20")),
        ("baud = 9600", 'baud = "9600"', ("link.baud", "'9600'", "a number")),
        ("baud = 9600", "baud = 9", ("link.baud", "50")),
        ("amplitude_rad = 1.0", "amplitude_deg = 57.3", ("motion.yaw.amplitude_deg", "amplitude_rad")),
        ("amplitude_rad = 1.0", "amplitude_rad = nan", ("motion.yaw.amplitude_rad", "nan", "finite")),
        ("schema = 1", "schema = 2", ("schema", "2")),
        ("period_s = 0.02", "", ("nav.period_s", "missing")),
        ("sequence = true", "sequence = 1", ("nav.sequence", "true or false")),
        ('kind = "sinusoids"', 'kind = "wobble"', ("motion.kind", "'wobble'", "'coning'")),
        ("stop_s = 24.0", "stop_s = 0", ("stop_s", "above 0")),
        ("baud = 9600", "baud = 9600\ncuts_s = [[2.0, 1.0]]", ("link.cuts_s.0", "from < to")),
        ("[motion]", "[motion", ("not TOML", "line")),
        ("frequency_hz = 0.2", "frequency_hz = -0.2", ("motion.yaw.frequency_hz", "-0.2")),
    ],
)
def test_wrong_keys_types_and_units(ins, scenario, old, new, words):
    refused(ins("run", scenario("default", (old, new))), *words)


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        (["t_s,yaw_rad,pitch_rad,roll_rad", "0,0,0,0", "1,nan,0,0", "2,0,0,0", "3,0,0,0"], (":3:", "finite")),
        (
            ["t_s,yaw_rad,pitch_rad,roll_rad", "0,0,0,0", "0,0,0,0", "2,0,0,0", "3,0,0,0"],
            (":3:", "does not come after"),
        ),
        (["t_s,yaw_deg,pitch_rad,roll_rad", "0,0,0,0"], (":1:", "header")),
        (["t_s,yaw_rad,pitch_rad,roll_rad", "0,0,0,0", "1,0,x,0"], (":3:", "'x'")),
        (["t_s,yaw_rad,pitch_rad,roll_rad", "0,0,0,0", "1,0,0,0"], ("at least 4",)),
        (["t_s,yaw_rad,pitch_rad,roll_rad"] + [f"{t},0,0,0" for t in range(5)], ("ends at 4", "stop_s")),
    ],
)
def test_bad_csv(ins, tmp_path, scenario, rows, words):
    (tmp_path / "m.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    path = scenario("default", ('kind = "sinusoids"', 'kind = "csv"\ncsv = "m.csv"'))
    out = tmp_path / "s.json"
    refused(ins("run", path, "--json", out), *words)
    assert not out.exists()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--serial", "uart=/dev/ttyS0"), ("--serial", "pty")),
        (("--serial", "scib=pty"), ("scib", "uart")),
        (("--serial", "uart=file:/no/such/folder/f"), ("/no/such/folder/f", "No such file")),
        (("--speed", "fast"), ("--speed", "max")),
        (("--stop-s", "-1"), ("--stop-s",)),
        (("--seed", "-1"), ("--seed",)),
        (("--dds", "--domain", "300"), ("--domain", "230")),
        (("--dds", "--dds-config", "/no/such.xml"), ("/no/such.xml",)),
        (("--stop-s", "0.1", "--json", "/no/such/folder/s.json"), ("/no/such/folder",)),
    ],
)
def test_bad_options(ins, options, words):
    refused(ins("run", "default", *options), *words)


def test_unknown_option_is_usage(ins):
    done = ins("run", "default", "--waves", "x.vcd")
    assert done.returncode == 2
    assert "--waves" in done.stderr


def test_port_in_use(ins):
    import socket

    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        refused(ins("run", "default", "--serial", f"uart=tcp:{port}"), str(port), "another port")


def test_bad_dds_configuration(ins, tmp_path):
    path = tmp_path / "dds.xml"
    path.write_text("<CycloneDDS><Domain><Nonsense/></Domain></CycloneDDS>", encoding="utf-8")
    done = ins("run", "default", "--stop-s", 0.1, "--dds", "--domain", 77, "--dds-config", path)
    refused(done, "DDS")


def test_dds_without_any_network_interface():
    """In a network namespace of its own where even lo is down."""
    command = ["unshare", "-rn", sys.executable, "-m", "libins", "run", "default", "--stop-s", "0.1", "--dds"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, env=dict(os.environ))
    refused(done, "DDS", "interface")


def test_a_domain_already_taken_in_this_process():
    from libins import _dds

    first = _dds.Handle(78, _dds.TOPICS["state"], None, True)
    with pytest.raises(RuntimeError, match="domain 78"):
        _dds.Handle(78, _dds.TOPICS["state"], None, False)
    first.close()
    _dds.Handle(78, _dds.TOPICS["state"], None, False).close()


def test_nav_missing_device(ins):
    done = ins("nav", "--device", "/dev/no-such-tty", "--timeout-s", 1)
    assert done.returncode == 2
    assert "/dev/no-such-tty" in done.stderr


def test_a_corrupt_scenario_never_crashes(ins, tmp_path):
    path = tmp_path / "binary.toml"
    path.write_bytes(bytes(range(256)))
    refused(ins("run", path), "binary.toml")
