"""The arrows between rooms (docs/design/rooms.md): no #include and no link line may cross a wall that has no door."""

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

# room -> folder, include prefix of its public headers, CMake targets, and the rooms it may know
ROOMS: dict[str, tuple[str, str, set[str], set[str]]] = {
    "core": ("libins/core", "ins/", {"ins_core", "ins_coref"}, set()),
    "truth": ("libins/host/truth", "ins_truth/", {"ins_truth", "ins_truth_cvode"}, {"core"}),
    "post": ("libins/host/post", "ins_post/", {"ins_post"}, {"core"}),
    "navd": ("libins/host/navd", "ins_nav/", {"ins_nav", "ins-navd"}, {"core", "dds"}),
    "dds": ("libins/host/dds", "ins_dds/", {"ins_dds", "ins_dds_idl"}, {"core", "navd"}),
    "calib": ("libins/host/calib", "ins_calib/", {"ins_calib"}, {"core"}),
    "emu_common": ("emu/common", "emu/", {"emu_common"}, set()),
    "emu_8051": ("emu/8051_tlc2543", "emu_8051/", {"emu_8051"}, {"emu_common"}),
    "emu_f2812": ("emu/f2812_sci", "emu_f2812/", {"emu_f2812", "emu_f2812_parts"}, {"emu_common"}),
    "python": (
        "bindings/python",
        "libins_py/",
        {"_run", "_dds", "_calib", "_post", "ins_python_core", "ins_python_coref"},
        {"core", "truth", "post", "navd", "dds", "calib", "emu_common", "emu_8051", "emu_f2812"},
    ),
    "cpp": ("bindings/cpp", "ins/ins.hpp", {"ins_cpp", "ins_cppf"}, {"core"}),
}
# A firmware folder holds programs for a board, not parts of the emulator: it may include core.
FIRMWARE = "firmware"


def crossings(root: Path) -> list[str]:
    """Every forbidden arrow below root, as 'file:line: room -> room (text)'."""
    found: list[str] = []
    for room, (folder, _, _, allowed) in ROOMS.items():
        for path in sorted((root / folder).rglob("*")):
            if not path.is_file():
                continue
            may = allowed | {room} | ({"core"} if FIRMWARE in path.relative_to(root / folder).parts else set())
            if path.suffix in {".c", ".h", ".cpp", ".hpp", ".idl"}:
                found += [
                    f"{path.relative_to(root)}:{n}: {room} -> {other} ({text})"
                    for n, other, text in includes(root, path)
                    if other not in may
                ]
            elif path.name == "CMakeLists.txt" or path.suffix == ".cmake":
                found += [
                    f"{path.relative_to(root)}:{n}: {room} -> {other} ({text})"
                    for n, other, text in links(path)
                    if other not in may
                ]
    return found


def includes(root: Path, path: Path) -> list[tuple[int, str, str]]:
    result = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
        match = re.match(r'\s*#\s*include\s*["<]([^">]+)[">]', line)
        if not match:
            continue
        for other, (folder, prefix, _, _) in ROOMS.items():
            target = (path.parent / match[1]).resolve()
            if match[1].startswith(prefix) or (target.exists() and target.is_relative_to(root / folder)):
                result.append((number, other, match[1]))
    return result


def links(path: Path) -> list[tuple[int, str, str]]:
    result = []
    text = path.read_text(encoding="utf-8")
    for match in re.finditer(r"target_(?:link_libraries|include_directories)\s*\(([^)]*)\)", text):
        number = text.count("\n", 0, match.start()) + 1
        for word in match[1].split()[1:]:
            for other, (folder, _, targets, _) in ROOMS.items():
                if word in targets or (folder + "/") in word:
                    result.append((number, other, word))
    return result


def test_no_forbidden_arrow() -> None:
    assert crossings(ROOT) == []


@pytest.mark.parametrize(
    ("path", "text", "arrow"),
    [
        ("libins/core/src/bad.c", '#include "emu/time.h"\n', "core -> emu_common"),
        ("emu/8051_tlc2543/cpu/bad.c", "#include <ins/quat.h>\n", "emu_8051 -> core"),
        ("emu/common/src/bad.c", '#include "../../8051_tlc2543/include/emu_8051/mcs51.h"\n', "emu_common -> emu_8051"),
        (
            "libins/host/truth/CMakeLists.txt",
            "target_link_libraries(ins_truth PUBLIC emu_common)\n",
            "truth -> emu_common",
        ),
    ],
)
def test_a_forbidden_arrow_is_found(tmp_path: Path, path: str, text: str, arrow: str) -> None:
    header = tmp_path / "emu/8051_tlc2543/include/emu_8051/mcs51.h"
    header.parent.mkdir(parents=True)
    header.write_text("")
    bad = tmp_path / path
    bad.parent.mkdir(parents=True, exist_ok=True)
    bad.write_text(text)
    assert len(crossings(tmp_path)) == 1
    assert arrow in crossings(tmp_path)[0]


def test_firmware_may_include_core_but_not_the_host(tmp_path: Path) -> None:
    bad = tmp_path / "emu/8051_tlc2543/firmware/acq.c"
    bad.parent.mkdir(parents=True)
    bad.write_text('#include "ins/handshake.h"\n#include "ins_nav/nav.h"\n')
    assert [c.split(": ")[1].split(" (")[0] for c in crossings(tmp_path)] == ["emu_8051 -> navd"]


def test_every_tracked_source_is_in_a_room() -> None:
    tracked = subprocess.run(
        ["git", "ls-files", "*.c", "*.h", "*.cpp"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.split()
    free = ("tests/", "bench/", "examples/", "tools/")
    folders = tuple(folder + "/" for folder, *_ in ROOMS.values())
    assert [path for path in tracked if not path.startswith(free + folders)] == []
