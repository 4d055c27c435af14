"""Firmware of other makers by options of `ins run` alone: its memory, its console, its end and its exit code."""

import json
from pathlib import Path

import pytest
from sdcc_kit import FIRMWARE, build
from test_bad_input import refused

MEMORY = ("--part", "at89s52", "--code-octets", 65536, "--xdata-octets", 65536)
PROGRAM = (*MEMORY, "--console", "sbuf0", "--stop-on-xdata-read", "0xFFF0", "--exit-from", "iram:0x00")
SAID = "5133 primes below 50000: good\nsine: good\nhigh code: good\nupper RAM: good\n"
FLAGS = ("--xram-size", "65536", "--iram-size", "256")


@pytest.fixture(scope="module")
def images(tmp_path_factory) -> dict[int, Path]:
    """By what each adds to its exit code."""
    folders = {extra: tmp_path_factory.mktemp(f"extra{extra}") for extra in (0, 3)}
    source = FIRMWARE / "program.c"
    return {
        extra: build(source, folder, *FLAGS, f"-DEXTRA_FAILURES={extra}", model="large")
        for extra, folder in folders.items()
    }


@pytest.mark.parametrize("extra", [0, 3])
def test_console_end_and_exit_code(ins, images, tmp_path, extra):
    out = tmp_path / "s.json"
    done = ins("run", images[extra], *PROGRAM, "--strict", "--json", out)
    assert done.returncode == extra, done.stdout + done.stderr
    assert done.stdout == SAID
    summary = json.loads(out.read_text())
    assert summary["program"] == {"ended": "read of xdata 0xfff0", "exit_code": extra}
    assert summary["verdict"] == ("fail" if extra else "pass")
    assert summary["reports"] == []


def test_a_smaller_part_is_refused_or_reported(ins, images):
    refused(ins("run", images[0]), "lies beyond the code memory (4096 octets)", "at89s52", "code_octets")
    refused(ins("run", images[0], "--part", "at89s52"), "lies beyond the code memory (8192 octets)")
    code = ("--code-octets", 65536, "--stop-s", 0.1, "--strict")
    assert "no RAM at this address" in ins("run", images[0], *code).stdout
    done = ins("run", images[0], "--part", "at89s52", *code)
    assert done.returncode == 3
    assert "MOVX" in done.stdout


def test_a_program_that_does_not_end_is_exit_42(ins, images):
    done = ins("run", images[0], *PROGRAM, "--stop-s", 1)
    assert done.returncode == 42
    assert "did not end" in done.stderr


@pytest.fixture
def image(tmp_path):
    """Intel HEX of some octets at 0000h."""

    def make(code: bytes) -> Path:
        record = bytes([len(code), 0, 0, 0]) + code
        path = tmp_path / "small.ihx"
        path.write_text(f":{record.hex().upper()}{-sum(record) & 0xFF:02X}\n:00000001FF\n", encoding="ascii")
        return path

    return make


@pytest.mark.parametrize(
    ("place", "code"),
    [
        ("ACC", bytes.fromhex("7407 80FE")),  # MOV A,#7; SJMP $
        ("B", bytes.fromhex("75F007 80FE")),  # MOV B,#7; SJMP $
        ("xdata:0x12", bytes.fromhex("900012 7407 F0 80FE")),  # MOV DPTR,#12h; MOV A,#7; MOVX @DPTR,A; SJMP $
        ("iram:48", bytes.fromhex("753007 80FE")),  # MOV 30h,#7; SJMP $
    ],
)
def test_a_jump_to_itself_is_an_end(ins, image, place, code):
    done = ins("run", image(code), "--xdata-octets", 256, "--exit-from", place)
    assert done.returncode == 7, done.stdout + done.stderr
    assert "program   halted, exit code 7" in done.stdout


def test_the_line_as_console(ins, image):
    # TMOD 20h, TH1 FDh, TR1, SCON 50h, 'H', wait for TI, 'i', wait for TI, SJMP $
    code = bytes.fromhex("758920 758DFD D28E 759850 759948 3099FD C299 759969 3099FD 80FE")
    done = ins("run", image(code), "--console", "uart", "--stop-s", 0.5)
    assert (done.stdout, done.returncode) == ("Hi", 0), done.stderr


def test_in_mode_0_alone_sbuf_is_the_console(ins, image):
    code = bytes.fromhex("759850 759941 759800 759942 80FE")  # 'A' in mode 1, 'B' in mode 0
    assert ins("run", image(code), "--console", "sbuf0").stdout == "B"


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--exit-from", "rom:1"), ("--exit-from rom:1", "xdata:0xNNNN")),
        (("--exit-from", "iram:0x100"), ("iram", "0x100", "0xff")),
        (("--exit-from", "ACK"), ("ACK", "did you mean ACC")),
        (("--stop-on-xdata-read", "here"), ("--stop-on-xdata-read here",)),
        (("--part", "8052"), ("--set: part", "'8052'", "'at89s52'")),
        (("--xdata-octets", "65537"), ("--set: xdata_octets", "65537")),
        (("--code-octets", "64"), ("--set: code_octets", "less than the flash")),
    ],
)
def test_bad_options(ins, image, options, words):
    refused(ins("run", image(bytes.fromhex("80FE")), *options), *words)


def test_a_bare_image_without_options(ins, image, tmp_path):
    page = tmp_path / "r.html"
    done = ins("run", image(bytes.fromhex("80FE")), "--stop-s", 0.1, "--report", page)
    assert done.returncode == 0, done.stderr
    assert "small.ihx: small.ihx" in done.stdout
    assert "<h2>Scenario</h2>" not in page.read_text(encoding="utf-8")
    upper = image(bytes.fromhex("80FE")).rename(tmp_path / "SMALL.HEX")
    assert ins("run", upper, "--stop-s", 0.1).returncode == 0
    refused(ins("run", "no/such.ihx"), "no/such.ihx", "No such file")
