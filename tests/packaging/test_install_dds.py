"""libins_dds installed: find_package(libins COMPONENTS dds), pkg-config, headers, symbols, IDL, a subscriber on it."""

import os
import re
import subprocess
from pathlib import Path

import pytest
from packaging_kit import EXAMPLES, ROOT, STRICT, run

OFF = [f"-DINS_BUILD_{part}=OFF" for part in ("TESTS", "EMU", "PYTHON", "FIRMWARE")]
HEADERS = [
    header
    for folder in ("libins/host/dds/include/ins_dds", "libins/host/navd/include/ins_nav")
    for header in sorted((ROOT / folder).glob("*.h"))
]
DOMAIN = 100 + os.getpid() % 100
STATES = 20


@pytest.fixture(scope="module")
def prefix(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Moved after the installation."""
    folder = tmp_path_factory.mktemp("dds")
    run("cmake", "-G", "Ninja", "-S", ROOT, "-B", folder / "build", *OFF, "-DCMAKE_BUILD_TYPE=Release")
    run("cmake", "--build", folder / "build", "-j2", "--target", "ins_core", "ins_coref", "ins_dds")
    run("cmake", "--install", folder / "build", "--prefix", folder / "as_installed")
    return (folder / "as_installed").rename(folder / "as_used")


def subscribed(command: list[object], **environment: str) -> list[str]:
    """What a subscriber prints of STATES states of the source 'unit'."""
    publisher = ROOT / "build/release/tests/dds/dds_publisher"
    subscriber = subprocess.Popen(
        [str(part) for part in (*command, DOMAIN, STATES)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | environment,
    )
    sender = subprocess.Popen([str(publisher), str(DOMAIN), "unit", str(STATES)], stdin=subprocess.PIPE)
    try:
        out, err = subscriber.communicate(timeout=60)
    finally:
        subscriber.kill()
        assert sender.stdin is not None
        sender.stdin.close()
        assert sender.wait(timeout=20) == 0
    assert subscriber.returncode == 0, err
    return out.splitlines()


def expect_states(lines: list[str]) -> None:
    assert [line.split(":")[0] for line in lines] == [f"unit {k}" for k in range(STATES)]
    assert all(line.endswith("28.6478898 -14.3239449 deg +- 1.50 m") for line in lines)


def test_the_c_subscriber_is_built_by_pkg_config(prefix: Path, tmp_path: Path) -> None:
    where = {"PKG_CONFIG_PATH": str(prefix / "lib/pkgconfig")}
    flags = run("pkg-config", "--cflags", "--libs", "libins_dds", **where).split()
    run("gcc", *STRICT, EXAMPLES / "dds_subscribe_c/main.c", *flags, "-lm", "-o", tmp_path / "subscribe")
    expect_states(subscribed([tmp_path / "subscribe"], LD_LIBRARY_PATH=str(prefix / "lib")))


def fields(text: str, begin: str, end: str, pattern: str) -> list[str]:
    """Names of a struct's fields, in order; case is the language's."""
    return [name.lower() for name in re.findall(pattern, text.split(begin)[1].split(end)[0], re.MULTILINE)]


def test_the_installed_idl_is_what_the_subscribers_declare(prefix: Path) -> None:
    where = {"PKG_CONFIG_PATH": str(prefix / "lib/pkgconfig")}
    folder = Path(run("pkg-config", "--variable=idldir", "libins_dds", **where).strip())
    assert sorted(path.name for path in folder.iterdir()) == ["libins.idl", "ros2.idl"]
    idl = re.sub(r"//.*", "", (folder / "libins.idl").read_text(encoding="utf-8"))
    python = (EXAMPLES / "dds_subscribe_python/subscribe.py").read_text(encoding="utf-8")
    rust = (EXAMPLES / "dds_subscribe_rust/src/main.rs").read_text(encoding="utf-8")
    for name in ("NavCounts", "NavState"):
        want = fields(idl, f"struct {name}\n", "};", r"(\w+)(?:\[\d+\])?;")
        assert len(want) > 5
        assert fields(python, f"class {name}(", "\n\n", r"^    (\w+): ") == want
        assert fields(rust, f"struct {name} {{", "\n}", r"^    (\w+): ") == want


def test_every_header_is_installed_and_compiles_alone(prefix: Path, tmp_path: Path) -> None:
    for header in HEADERS:
        (tmp_path / "alone.c").write_text(f'#include "{"/".join(header.parts[-2:])}"\n', encoding="utf-8")
        for standard in ("c11", "c++17"):
            language = "c++" if standard == "c++17" else "c"
            command = ["gcc", "-x", language, f"-std={standard}", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]
            run(*command, f"-I{prefix / 'include'}", "-fsyntax-only", tmp_path / "alone.c")
    assert len(HEADERS) >= 6


def test_the_library_exports_the_api_and_nothing_else(prefix: Path) -> None:
    listed = (ROOT / "tests/packaging/symbols_dds.txt").read_text(encoding="utf-8").split()
    declared = {
        name
        for header in HEADERS
        for name in re.findall(r"^INS_API [^;{]*?(\w+)\(", header.read_text(encoding="utf-8"), re.MULTILINE)
    }
    assert sorted(declared) == listed, (
        f"new: {sorted(declared - set(listed))}, gone: {sorted(set(listed) - declared)}. "
        "If that is meant, bring tests/packaging/symbols_dds.txt up to date; what is gone needs a new minor version"
    )
    library = prefix / "lib/libins_dds.so"
    exported = [line.split()[2] for line in run("nm", "-D", "--defined-only", library).splitlines()]
    assert sorted(exported) == listed
    assert re.search(r"\[libins_dds\.so\.\d+\.\d+\]", run("readelf", "-d", library))
