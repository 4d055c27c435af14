"""DDS Security: the right certificate hears, nobody else does; ins keys and its refusals; open and close many times."""

import os
import stat
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from conftest import ROOT
from cryptography import x509

pytestmark = pytest.mark.wall_clock
DOMAIN = 100 + os.getpid() % 100
LISTEN_S = 3
WARM_UP = 50  # cycles in which OpenSSL and the plugins fill their caches
CYCLES = 100 if "INS_BENCH" in os.environ else 50
ROUND = f"""
import sys
from libins import _dds
def pages():
    return int(open("/proc/self/statm").read().split()[1])
seen = [pages()]
for i in range({WARM_UP} + {CYCLES}):
    _dds.Handle({DOMAIN} + 1, _dds.TOPICS["state"], None, True, False, sys.argv[1]).close()
    seen.append(pages())
print(seen[{WARM_UP}], seen[-1])
"""


def ins(*arguments: object, timeout: float = 60) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "libins", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=timeout)


@pytest.fixture(scope="module")
def keys(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("keys")
    for authority, name, option, topic in (
        ("own", "nav", "--publish", "libins/*"),
        ("own", "dash", "--subscribe", "libins/*"),
        ("own", "other", "--subscribe", "rt/*"),
        ("foreign", "dash", "--subscribe", "libins/*"),
    ):
        done = ins("keys", folder / authority, name, option, topic)
        assert done.returncode == 0, done.stderr
    return folder


@pytest.fixture(scope="module")
def unit(keys: Path) -> Iterator[None]:
    command = [ROOT / "build/release/tests/dds/dds_unit", str(DOMAIN), "0", "1", keys / "own/nav"]
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    try:
        time.sleep(0.5)
        assert process.poll() is None, "the publisher could not open"
        yield
    finally:
        process.kill()
        process.wait()


def listen(*more: object) -> subprocess.CompletedProcess[str]:
    return ins("sub", "--domain", DOMAIN, "--limit", 20, "--timeout-s", LISTEN_S, *more)


def test_the_right_certificate_hears(keys, unit):
    done = listen("--security", keys / "own/dash")
    assert done.returncode == 0 and len(done.stdout.splitlines()) == 20, done.stderr


@pytest.mark.parametrize("who", [None, "foreign/dash"])
def test_no_certificate_and_that_of_another_authority_hear_nothing(keys, unit, who):
    done = listen(*(["--security", keys / who] if who else []))
    assert done.returncode == 1 and done.stdout == "", "a stranger heard something"


def test_without_permission_the_topic_is_refused(keys, unit):
    done = listen("--security", keys / "own/other")
    assert done.returncode == 2 and done.stdout == ""
    assert "DDS security does not allow" in done.stderr and "--subscribe" in done.stderr


def table(folder: Path, *lines: str) -> Path:
    path = folder / "security.toml"
    path.write_text("\n".join(["[security]", *lines, ""]), encoding="utf-8")
    return path


def test_the_files_may_come_from_a_table(keys, unit, tmp_path):
    """A folder beside the file, and a key elsewhere; ins-navd takes what `ins nav` makes of it."""
    (tmp_path / "elsewhere.pem").write_bytes((keys / "own/dash/key.pem").read_bytes())
    (tmp_path / "dash").symlink_to(keys / "own/dash")
    done = listen("--security", table(tmp_path, 'folder = "dash"', 'key = "elsewhere.pem"'))
    assert done.returncode == 0 and len(done.stdout.splitlines()) == 20, done.stderr
    (tmp_path / "elsewhere.pem").write_bytes((keys / "own/nav/key.pem").read_bytes())
    done = listen("--security", tmp_path / "security.toml")
    assert done.returncode == 1 and done.stdout == "", "heard with the key of another certificate"
    (tmp_path / "elsewhere.pem").unlink()
    nav = ins("nav", "--device", os.ttyname(os.openpty()[1]), "--dds", "--security", tmp_path / "security.toml")
    assert nav.returncode == 2 and f"the private key cannot be read: {tmp_path}/elsewhere.pem" in nav.stderr


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        (['foldr = "nav"'], ["security.toml:2", "foldr", "did you mean 'folder'"]),
        (['key = "k.pem"'], ["security.identity_ca", "is missing"]),
        (["folder = 3"], ["security.toml:2", "a string is needed"]),
        (['folder = "a,b"'], ["a,b", "comma"]),
    ],
)
def test_a_wrong_table_is_refused(tmp_path, lines, words):
    for command in (["sub", "--timeout-s", "1"], ["nav", "--device", "/dev/null", "--dds"]):
        done = ins(*command, "--security", table(tmp_path, *lines))
        assert done.returncode == 2 and all(word in done.stderr for word in words), done.stderr


def test_a_missing_file_is_named(keys, tmp_path):
    done = listen("--security", tmp_path)
    assert done.returncode == 2
    assert f"the identity CA cannot be read: {tmp_path}/identity_ca.pem" in done.stderr


def test_open_and_close_many_times_leave_nothing(keys):
    """With one arena, so that a page more is memory kept and not another thread's."""
    done = subprocess.run(
        [sys.executable, "-c", ROUND, keys / "own/nav"],
        env=os.environ | {"MALLOC_ARENA_MAX": "1"},
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    first, last = map(int, done.stdout.split())
    assert last - first < CYCLES, f"{last - first} pages more after {CYCLES} cycles"


def test_a_key_is_for_its_owner_alone(keys):
    for key in (keys / "own/ca/ca_key.pem", keys / "own/nav/key.pem"):
        assert stat.S_IMODE(key.stat().st_mode) == 0o600


def test_one_authority_signs_all_its_participants(keys):
    ca = x509.load_pem_x509_certificate((keys / "own/ca/ca.pem").read_bytes())
    for name in ("nav", "dash", "other"):
        certificate = x509.load_pem_x509_certificate((keys / "own" / name / "certificate.pem").read_bytes())
        certificate.verify_directly_issued_by(ca)
    done = subprocess.run(
        [
            "openssl",
            "smime",
            "-verify",
            "-text",
            "-in",
            keys / "own/nav/permissions.p7s",
            "-CAfile",
            keys / "own/ca/ca.pem",
        ],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0 and "<topic>libins/*</topic>" in done.stdout, done.stderr


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("ca", "--publish", "x"), "not 'ca'"),
        (("a/b", "--publish", "x"), "participant 'a/b'"),
        (("nav",), "neither publish nor subscribe"),
        (("nav", "--publish", "x", "--days", "0"), "--days 0"),
    ],
)
def test_bad_options_are_refused(tmp_path, arguments, words):
    done = ins("keys", tmp_path / "k", *arguments)
    assert done.returncode == 2 and words in done.stderr
    assert not list(tmp_path.glob("k/*/certificate.pem"))


def test_half_a_ca_is_refused(keys, tmp_path):
    (tmp_path / "ca").mkdir()
    (tmp_path / "ca/ca.pem").write_bytes((keys / "own/ca/ca.pem").read_bytes())
    done = ins("keys", tmp_path, "nav", "--publish", "x")
    assert done.returncode == 2 and "belong together" in done.stderr
