"""The table [security] of a TOML file: the six files of DDS Security, as ins_dds_security_t has them.

    [security]
    folder = "keys/nav"                 # as `ins keys` makes it
    key = "/run/secrets/nav_key.pem"    # a file elsewhere; without a folder all six are named

Paths are relative to the TOML file.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from libins.schema import Document, field

FILES = {
    "identity_ca": "identity_ca.pem",
    "certificate": "certificate.pem",
    "key": "key.pem",
    "permissions_ca": "permissions_ca.pem",
    "governance": "governance.p7s",
    "permissions": "permissions.p7s",
}
"""Key, and the name in a folder; in the order of ins_dds_security_t."""


@dataclass(frozen=True, kw_only=True)
class Security:
    """One participant."""

    folder: str | None = field(None)
    identity_ca: str | None = field(None)
    certificate: str | None = field(None)
    key: str | None = field(None)
    permissions_ca: str | None = field(None)
    governance: str | None = field(None)
    permissions: str | None = field(None)


@dataclass(frozen=True, kw_only=True)
class File:
    """What the file holds."""

    security: Security


def places(given: str) -> str:
    """What ins_dds_security_folder() takes, of a folder or of such a file. Raises UsageError."""
    path = Path(given)
    if path.suffix != ".toml":
        return given
    document = Document(path)
    table = document.parse(File, document.table).security
    files = []
    for key, name in FILES.items():
        named = getattr(table, key)
        if named is None and table.folder is None:
            raise document.refuse(("security", key), "is missing; name it, or a folder that `ins keys` made")
        file = str(path.parent / (named if named is not None else Path(table.folder or "") / name))
        if "," in file:
            raise document.refuse(("security", key), f"{file!r} has a comma, which no path here may have")
        files.append(file)
    return ",".join(files)


def for_daemon(arguments: Sequence[str]) -> list[str]:
    """The arguments with what --security names in the daemons' form. Raises UsageError."""
    out = list(arguments)
    for i, word in enumerate(out):
        if word == "--security" and i + 1 < len(out):
            out[i + 1] = places(out[i + 1])
        elif word.startswith("--security="):
            out[i] = "--security=" + places(word.removeprefix("--security="))
    return out
