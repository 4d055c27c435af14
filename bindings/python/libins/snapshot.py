"""A board at one instant: an object between tests, and a file that another machine of the same version restores.

The file is a ZIP archive: board.json (configuration, image, what the host received) and state.bin (emu/state.h).
"""

import json
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from libins.board_uart import Octet
from libins.errors import UsageError
from libins.scenario import Scenario, Tables
from libins.schema import Document

FORMAT = 2


@dataclass(frozen=True)
class Snapshot:
    """Everything that a board of the same configuration needs to go on from here."""

    scenario: Scenario
    navigator: bool
    now_ps: int
    state: bytes
    received: tuple[Octet, ...]
    read: int
    volts: Mapping[int, float]

    def write(self, path: Path) -> None:
        """As a file. Raises UsageError."""
        s = self.scenario
        document = {
            "format": FORMAT,
            "name": str(s.path),
            "table": s.table,
            "firmware": str(s.firmware),
            "image": [[address, octets.hex()] for address, octets in s.image],
            "csv": None if s.csv is None else s.csv.tolist(),
            "path_csv": None if s.path_csv is None else s.path_csv.tolist(),
            "analog": [[place, volts.tolist()] for place, volts in s.volts.items()],
            "navigator": self.navigator,
            "now_ps": self.now_ps,
            "received": self.received,
            "read": self.read,
            "volts": list(self.volts.items()),
        }
        try:
            with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
                for name, octets in (("board.json", json.dumps(document).encode()), ("state.bin", self.state)):
                    archive.writestr(zipfile.ZipInfo(name), octets, zipfile.ZIP_DEFLATED)  # the same bytes at any hour
        except OSError as error:
            raise UsageError(f"{path}: cannot be written: {error.strerror}; choose another place") from error


def read(path: Path) -> Snapshot:
    """From a file. Raises UsageError when it is none, or another version's."""
    try:
        with zipfile.ZipFile(path) as archive:
            d: dict[str, Any] = json.loads(archive.read("board.json"))
            state = archive.read("state.bin")
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {error.strerror}") from error
    except (zipfile.BadZipFile, KeyError, ValueError) as error:
        raise UsageError(f"{path}: no snapshot of a board: {error}; take it again") from error
    if d.get("format") != FORMAT:
        raise UsageError(
            f"{path}: of format {d.get('format')}, but this version reads {FORMAT}; take the snapshot again"
        )
    document = Document(Path(d["name"]), d["table"])
    scenario = Scenario(
        path=document.path,
        tables=document.parse(Tables, document.table),
        firmware=Path(d["firmware"]),
        csv=None if d["csv"] is None else np.array(d["csv"]),
        combination={},
        table=d["table"],
        image=[(address, bytes.fromhex(octets)) for address, octets in d["image"]],
        volts={place: np.array(volts) for place, volts in d["analog"]},
        path_csv=None if d["path_csv"] is None else np.array(d["path_csv"]),
    )
    received = tuple(Octet(*octet) for octet in d["received"])
    return Snapshot(scenario, d["navigator"], d["now_ps"], state, received, d["read"], dict(d["volts"]))
