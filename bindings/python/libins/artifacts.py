"""What a failed test leaves behind, so that anybody can look at the failure again.

In a folder: before.snapshot, a board some milliseconds before the failure; inputs.json, what the outside did since;
failure.snapshot, the board at the failure; trace.vcd and instructions.txt, what happened between the two; board.txt,
where it ended. Of an F2812 there are no snapshots: inputs.json begins at power-on, and accesses.jsonl has the accesses.

    board = artifacts.replay(Path("board-artifacts/test_meter.py__test_lamp"))   # at the failure again
"""

import json
import re
from pathlib import Path
from typing import Any

from libins import net_scenario, snapshot
from libins.bench import Bench, Input
from libins.board import Board
from libins.errors import UsageError
from libins.f2812_board import F2812Board
from libins.machine import PS_PER_S
from libins.schema import Document

BEFORE, INPUTS, FAILURE = "before.snapshot", "inputs.json", "failure.snapshot"
TRACE, INSTRUCTIONS, ACCESSES, TEXT = "trace.vcd", "instructions.txt", "accesses.jsonl", "board.txt"


def folder_of(node: str) -> str:
    """A folder's name from a test's."""
    return re.sub(r"[^\w.=-]+", "_", node.replace("::", "__")).strip("_")


def write(board: Bench, folder: Path, keep_s: float) -> list[Path]:
    """Everything about a board, and in detail its last seconds. Raises UsageError."""
    if isinstance(board, F2812Board):
        return _write_f2812(board, folder, keep_s)
    assert isinstance(board, Board)
    return _write_8051(board, folder)


def _write_f2812(board: F2812Board, folder: Path, keep_s: float) -> list[Path]:
    """Repeated from power-on, and recorded towards the end."""
    folder.mkdir(parents=True, exist_ok=True)
    loaded, end_ps = board.scenario, board.now_ps
    table = {**loaded.table, **({"firmware": str(loaded.firmware.absolute())} if loaded.flat else {})}
    document = {
        "scenario": str(loaded.path.absolute()),
        "table": table,
        "end_ps": end_ps,
        "inputs": _inputs(board.inputs),
    }
    (folder / INPUTS).write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    with F2812Board(loaded) as again:
        begin_ps = max(0, end_ps - round(2 * keep_s * PS_PER_S))
        early = [each for each in board.inputs if each.at_ps <= begin_ps]
        again.repeat(early, begin_ps)
        with again.record(vcd=folder / TRACE, access_log=folder / ACCESSES):
            again.repeat(board.inputs[len(early) :], end_ps)
    (folder / TEXT).write_text(board.describe() + "\n", encoding="utf-8")
    return [folder / name for name in (INPUTS, TRACE, ACCESSES, TEXT)]


def _write_8051(board: Board, folder: Path) -> list[Path]:
    """Of a board that was told to keep() its past."""
    before, inputs = board.past()
    folder.mkdir(parents=True, exist_ok=True)
    before.write(folder / BEFORE)
    at = board.snapshot()
    at.write(folder / FAILURE)
    document = {"end_ps": board.now_ps, "inputs": _inputs(inputs)}
    (folder / INPUTS).write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    again = Board.from_snapshot(before, trace=True)
    with again.record(vcd=folder / TRACE, itrace=folder / INSTRUCTIONS):
        again.repeat(inputs, board.now_ps)
    (folder / TEXT).write_text(board.describe() + "\n", encoding="utf-8")
    return [folder / name for name in (BEFORE, INPUTS, FAILURE, TRACE, INSTRUCTIONS, TEXT)]


def replay(folder: Path) -> Board | F2812Board:
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
    board: Board | F2812Board
    if "table" in document:
        scenario = net_scenario.read(Document(Path(document["scenario"]), document["table"]))
        board = F2812Board(scenario)
    else:
        board = Board.from_snapshot(snapshot.read(folder / BEFORE))
    board.repeat(inputs, end_ps)
    return board


def _inputs(inputs: list[Input]) -> list[dict[str, Any]]:
    return [_to_json(each) for each in inputs]


def _to_json(each: Input) -> dict[str, Any]:
    arguments = [{"hex": a.hex()} if isinstance(a, bytes) else a for a in each.arguments]
    return {"at_ps": each.at_ps, "what": each.what, "arguments": arguments}


def _from_json(each: dict[str, Any]) -> Input:
    arguments = [bytes.fromhex(a["hex"]) if isinstance(a, dict) and set(a) == {"hex"} else a for a in each["arguments"]]
    return Input(int(each["at_ps"]), str(each["what"]), tuple(arguments))
