# SPDX-License-Identifier: MIT
"""The handlers of the fast engine end in jumps: a call would take stack for each emulated instruction.

    handlers_jump.py OBJDUMP OBJECT

Only mcs51_fast calls a handler. Exit 1: another function does.
"""

import re
import subprocess
import sys

HANDLER = r"(plain|acc|port|effect)_[0-9A-Fa]{2}\b|mcs51_(one|leave|poll|count|decode_here)\b"
CALL = re.compile(r"\t(?:callq?|blr?|jalr?|bctrl)\s+(.*)")


def main() -> int:
    objdump, path = sys.argv[1:]
    command = [objdump, "-dr", "--no-show-raw-insn", path]
    lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    function, handlers, bad = "", set(), []
    for line, after in zip(lines, [*lines[1:], ""], strict=True):
        if head := re.match(r"[0-9a-f]+ <(\S+)>:", line):
            function = head[1]
            if re.match(HANDLER, function):
                handlers.add(function)
        elif (call := CALL.search(line)) and function != "mcs51_fast":
            callee = after.split()[-1] if "R_" in after else call[1]
            if "<" not in callee and "R_" not in after or re.search(HANDLER, callee):
                bad.append(f"{function}: {line.strip()}")
    print("\n".join(bad) or f"{len(handlers)} handlers, each ends in a jump")
    if len(handlers) < 256:
        print(f"only {len(handlers)} handlers found in {path}", file=sys.stderr)
        return 1
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
