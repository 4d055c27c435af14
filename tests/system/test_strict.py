"""--strict fails on both kinds of report: the firmware did something wrong, and the emulator does not model this."""

import json

import pytest

RESERVED = "A580FE"  # opcode A5h; SJMP $
NO_RAM = "E080FE"  # MOVX A,@DPTR; SJMP $


def image(code: str) -> str:
    octets = bytes([len(code) // 2, 0, 0, 0]) + bytes.fromhex(code)
    return f":{octets.hex().upper()}{-sum(octets) & 255:02X}\n:00000001FF\n"


@pytest.mark.parametrize(
    ("code", "kind", "text"),
    [(RESERVED, "guest_error", "opcode A5h is reserved"), (NO_RAM, "not_modelled", "there is no external RAM")],
)
def test_each_kind_of_report_fails_a_strict_run_and_is_named(ins, tmp_path, code, kind, text):
    path, out = tmp_path / "a.ihx", tmp_path / "out.json"
    path.write_text(image(code), encoding="ascii")
    for strict in ([], ["--strict"]):
        done = ins("run", "default", "--firmware", path, "--stop-s", 0.01, "--json", out, *strict)
        assert done.returncode == (3 if strict else 1), done.stdout + done.stderr
        reports = json.loads(out.read_text(encoding="utf-8"))["reports"]
        assert [(report["kind"], text in report["text"]) for report in reports] == [(kind, True)]
        assert text in done.stdout + done.stderr
