"""A file that is written while a run goes on."""

from pathlib import Path
from typing import TextIO

from libins.errors import UsageError


class GrowingFile:
    """A text file that grows while the run goes on and gets its name when it is whole."""

    def __init__(self, path: Path) -> None:
        """Open it under another name. Raises UsageError."""
        self._path = path
        self._part = path.with_name(path.name + ".part")
        try:
            self.text: TextIO = self._part.open("w", encoding="utf-8")
        except OSError as error:
            raise UsageError(f"{path}: cannot be written: {error.strerror}; choose another place") from error

    def done(self) -> None:
        """It is whole."""
        self.text.close()
        self._part.replace(self._path)

    def drop(self) -> None:
        """Leave nothing of one that did not become whole."""
        if not self.text.closed:
            self.text.close()
            self._part.unlink()
