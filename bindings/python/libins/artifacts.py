"""What a failed test leaves behind, so that anybody can look at the failure again.

In a folder: before.snapshot, a board some milliseconds before the failure; inputs.json, what the outside did since;
failure.snapshot, the board at the failure; trace.vcd and instructions.txt, what happened between the two; board.txt,
where it ended.

    board = artifacts.replay(Path("board-artifacts/test_meter.py__test_lamp"))   # at the failure again
"""

import json
import re
from pathlib import Path
from typing import Any

from libins import snapshot
from libins.board import Board, Input
from libins.errors import UsageError

BEFORE, INPUTS, FAILURE = "before.snapshot", "inputs.json", "failure.snapshot"
TRACE, INSTRUCTIONS, TEXT = "trace.vcd", "instructions.txt", "board.txt"


def folder_of(node: str) -> str:
    """A folder's name from a test's."""
    return re.sub(r"[^\w.=-]+", "_", node.replace("::", "__")).strip("_")


def write(board: Board, folder: Path) -> list[Path]:
    """Everything about a board that was told to keep() its past. Raises UsageError."""
    before, inputs = board.past()
    folder.mkdir(parents=True, exist_ok=True)
    before.write(folder / BEFORE)
    at = board.snapshot()
    at.write(folder / FAILURE)
    document = {"end_ps": board.now_ps, "inputs": [_to_json(each) for each in inputs]}
    (folder / INPUTS).write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    again = Board.from_snapshot(before, trace=True)
    with again.record(vcd=folder / TRACE, itrace=folder / INSTRUCTIONS):
        again.repeat(inputs, board.now_ps)
    (folder / TEXT).write_text(board.describe() + "\n", encoding="utf-8")
    return [folder / name for name in (BEFORE, INPUTS, FAILURE, TRACE, INSTRUCTIONS, TEXT)]


def replay(folder: Path) -> Board:
    """The board at the failure, brought there from before it. Raises UsageError."""
    path = folder / INPUTS
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        inputs = [_from_json(each) for each in document["inputs"]]
        end_ps = int(document["end_ps"])
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {error.strerror}; give the folder of a failed test") from error
    except (ValueError, KeyError, TypeError) as error:
        raise UsageError(f"{path}: not what a failed test wrote: {error}") from error
    board = Board.from_snapshot(snapshot.read(folder / BEFORE))
    board.repeat(inputs, end_ps)
    return board


def _to_json(each: Input) -> dict[str, Any]:
    arguments = [{"hex": a.hex()} if isinstance(a, bytes) else a for a in each.arguments]
    return {"at_ps": each.at_ps, "what": each.what, "arguments": arguments}


def _from_json(each: dict[str, Any]) -> Input:
    arguments = [bytes.fromhex(a["hex"]) if isinstance(a, dict) and set(a) == {"hex"} else a for a in each["arguments"]]
    return Input(int(each["at_ps"]), str(each["what"]), tuple(arguments))
