"""The IDL files of libins_dds as ROS message definitions, which is how readers of recordings know the types.

`definition("sensor_msgs::msg::dds_::Imu_")` gives the name sensor_msgs/msg/Imu and the text that rosbag2 puts into a
file (schema encoding ros2msg): the fields of the message, and those of every message in it. Comments go along, since
they have the units. What these files do not use is not read here.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

from libins.tables import PACKAGE

FOLDER = PACKAGE / "idl"
RULE = "=" * 80
PRIMITIVES = {
    "double": "float64",
    "float": "float32",
    "octet": "uint8",
    "int8": "int8",
    "boolean": "bool",
    "short": "int16",
    "unsigned short": "uint16",
    "long": "int32",
    "unsigned long": "uint32",
    "long long": "int64",
    "unsigned long long": "uint64",
}
BYTES = {("diagnostic_msgs/msg/DiagnosticStatus", "level")}
"""An octet of IDL is uint8 or byte in ROS."""
STRUCT = re.compile(r"@final\s+struct\s+(\w+)\s*\{(.*?)\n?\s*\};", re.DOTALL)
FIELD = re.compile(
    r"(?:@key\s+)?(?P<type>(?:unsigned\s+)?[\w:]+(?:\s+long)?(?:<[^>]*>)?)\s+(?P<name>\w+)(?:\[(?P<size>\d+)\])?\s*;"
    r"(?:[^\S\n]*//[^\S\n]*(?P<comment>[^\n]*))?"
)


@dataclass(frozen=True)
class Field:
    """Of a message."""

    type: str
    """A primitive of ROS, or package/msg/Name, with its brackets."""
    name: str
    comment: str

    @property
    def message(self) -> str | None:
        """The message that it is or holds."""
        return self.type.partition("[")[0] if "/" in self.type else None


def ros_name(dds: str) -> str:
    """sensor_msgs::msg::dds_::Imu_ is sensor_msgs/msg/Imu; libins::NavState is libins/msg/NavState."""
    scopes = dds.split("::")
    return f"{scopes[0]}/msg/{scopes[-1].removesuffix('_') if 'dds_' in scopes else scopes[-1]}"


def dds_name(ros: str) -> str:
    """The other way round."""
    package, _, name = ros.partition("/msg/")
    return f"{package}::{name}" if package == "libins" else f"{package}::msg::dds_::{name}_"


def _modules(text: str) -> Iterator[tuple[str, str]]:
    """Name in DDS of each struct, and what is between its braces."""
    for part in re.split(r"^module ", text, flags=re.MULTILINE)[1:]:
        scopes = [part.split()[0], *re.findall(r"module (\w+)", part)]
        for struct in STRUCT.finditer(part):
            yield "::".join([*scopes, struct[1]]), struct[2] + "\n"


def _field(owner: str, found: re.Match[str]) -> Field:
    kind, _, bound = re.sub(r"\s+", " ", found["type"]).partition("<")
    size = f"[{found['size']}]" if found["size"] else ""
    bound = bound.removesuffix(">")
    if kind == "string":
        kind, size = f"string<={bound}" if bound else "string", size
    elif kind == "sequence":
        kind, size = bound, "[]"
    if kind in PRIMITIVES:
        kind = "byte" if (ros_name(owner), found["name"]) in BYTES else PRIMITIVES[kind]
    elif not kind.startswith("string"):
        inside = owner.rpartition("::")[0]
        kind = ros_name(kind if "::" in kind else f"{inside}::{kind}")
    return Field(kind + size, found["name"].lower(), (found["comment"] or "").strip())


@cache
def messages() -> dict[str, list[Field]]:
    """Every message of the files, by its name in ROS; field names are lower case there."""
    found: dict[str, list[Field]] = {}
    for path in sorted(FOLDER.glob("*.idl")):
        for name, body in _modules(path.read_text(encoding="utf-8")):
            found[ros_name(name)] = [_field(name, field) for field in FIELD.finditer(body)]
    return found


def _lines(name: str) -> Iterator[str]:
    for field in messages()[name]:
        kind = field.type.replace("/msg/", "/")
        yield f"{kind} {field.name}" + (f"  # {field.comment}" if field.comment else "")


def definition(dds: str) -> tuple[str, str]:
    """Name and text of a message by its type in DDS. Raises KeyError for one that the files do not have."""
    name = ros_name(dds)
    needed = [name]
    for each in needed:
        inside = (field.message for field in messages()[each])
        needed += [message for message in dict.fromkeys(inside) if message and message not in needed]
    parts = ["\n".join(_lines(name))]
    parts += [f"{RULE}\nMSG: {each.replace('/msg/', '/')}\n" + "\n".join(_lines(each)) for each in needed[1:]]
    return name, "\n".join(parts) + "\n"
