# SPDX-License-Identifier: MIT
"""Boards on threads share nothing that is written: no object of the library has writable static data.

    shares_nothing.py OBJDUMP OBJECT [...]

Exit 1: one has.
"""

import re
import subprocess
import sys

WRITABLE = re.compile(r"^\s*\d+ \.(t?data|t?bss)(?!\.rel\.ro)\S*\s+([0-9a-f]+)", re.M)


def main() -> int:
    objdump, *objects = sys.argv[1:]
    bad = []
    for path in objects:
        headers = subprocess.run([objdump, "-h", path], capture_output=True, text=True, check=True).stdout
        assert ".text" in headers, f"no sections read from {path}"
        bad += [f"{path}: .{name}: {int(size, 16)} octets" for name, size in WRITABLE.findall(headers) if int(size, 16)]
    print("\n".join(bad) or f"{len(objects)} objects without writable static data")
    return 1 if bad or not objects else 0


if __name__ == "__main__":
    sys.exit(main())
