"""Writes the core as two files, ins_all.h and ins_all.c.  SPDX-License-Identifier: MIT.

    python3 tools/amalgamate.py FOLDER [--float]

Every file is taken whole, once, where it is first included; a source's macros end with it. --float fixes ins_real in
the header, for builds that cannot pass -DINS_REAL_FLOAT. The same sources give the same octets.
"""

import argparse
import re
from pathlib import Path

import core_files

INCLUDE = re.compile(r'^#include "([^"]+)"\n', re.MULTILINE)
MACRO = re.compile(r"^#define (\w+)", re.MULTILINE)
FLOAT = "#ifndef INS_REAL_FLOAT\n#define INS_REAL_FLOAT // this copy of libins computes in float\n#endif\n\n"


def licence_comment() -> str:
    """The licence as a comment: it goes where the file goes."""
    return "".join(f"// {line}".rstrip() + "\n" for line in core_files.licence().splitlines())


def inline(path: Path, done: set[Path]) -> str:
    """The text of a file, its quoted includes replaced by what they name (nothing, the second time)."""
    done.add(path)

    def replace(match: re.Match[str]) -> str:
        folder = core_files.CORE / "include" if match[1].startswith("ins/") else path.parent
        included = folder / match[1]
        return "" if included in done else inline(included, done)

    return f"{INCLUDE.sub(replace, path.read_text(encoding='utf-8')).strip()}\n\n"


def header(single: bool) -> str:
    """ins_all.h."""
    done: set[Path] = set()
    # config.h first: it explains itself when the number type does not fit the compiler.
    order = sorted(core_files.headers(), key=lambda path: (path.name != "config.h", path.name))
    body = "".join(inline(path, done) for path in order if path.name != "ins.h" and path not in done)
    about = (
        f"/// \\file   ins_all.h\n/// \\brief  libins {core_files.version()}: all headers of the core in one.\n///\n"
    )
    guard = "#ifndef INS_ALL_H_INCLUDED\n#define INS_ALL_H_INCLUDED\n\n"
    return about + licence_comment() + guard + (FLOAT if single else "") + body + "#endif // INS_ALL_H_INCLUDED\n"


def source() -> str:
    """ins_all.c."""
    internal = {name: path for path in core_files.internal_headers() for name in MACRO.findall(path.read_text("utf-8"))}
    done = set(core_files.headers())
    parts = []
    for path in core_files.sources():
        macros = sorted(set(MACRO.findall(path.read_text(encoding="utf-8"))))
        for name in set(macros) & set(internal):
            raise SystemExit(f"{path}: macro {name} is also in {internal[name].name}: give one of them another name")
        parts.append(inline(path, done) + "".join(f"#undef {name}\n" for name in macros) + "\n")
    about = (
        f"/// \\file   ins_all.c\n/// \\brief  libins {core_files.version()}: all sources of the core in one.\n///\n"
    )
    return about + licence_comment() + '#include "ins_all.h"\n\n' + "".join(parts).rstrip() + "\n"


def write(folder: Path, single: bool = False) -> None:
    """Both files into folder."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "ins_all.h").write_text(header(single), encoding="utf-8")
    (folder / "ins_all.c").write_text(source(), encoding="utf-8")


def main() -> None:
    """The command."""
    arguments = argparse.ArgumentParser(description="writes ins_all.h and ins_all.c")
    arguments.add_argument("folder", type=Path)
    arguments.add_argument("--float", action="store_true", help="fix ins_real to float in the header")
    given = arguments.parse_args()
    write(given.folder, given.float)


if __name__ == "__main__":
    main()
