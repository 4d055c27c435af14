"""Recordings for tests: messages of every type with random contents, their octets made by another library (rosbags)."""

import random
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from libins.recorder import Recorder
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from libins import _dds, idl

NAMES = {
    "libins::NavState": "libins/nav_state",
    "libins::NavSolution": "libins/nav_solution",
    "sensor_msgs::msg::dds_::Imu_": "rt/imu/data",
    "sensor_msgs::msg::dds_::NavSatFix_": "rt/gnss/fix",
    "tf2_msgs::msg::dds_::TFMessage_": "rt/tf",
}
BEGIN_NS = 1_700_000_000_123_456_789
NUMBERS: dict[str, Callable[[random.Random], Any]] = {
    "float64": lambda r: r.gauss(0, 1e3),
    "uint8": lambda r: r.randrange(2**8),
    "byte": lambda r: r.randrange(2**7),  # rosbags has it signed
    "octet": lambda r: r.randrange(2**7),
    "int8": lambda r: r.randrange(-(2**7), 2**7),
    "uint16": lambda r: r.randrange(2**16),
    "int32": lambda r: r.randrange(-(2**31), 2**31),
    "uint32": lambda r: r.randrange(2**32),
    "int64": lambda r: r.randrange(-(2**63), 2**63),
    "uint64": lambda r: r.randrange(2**64),
}
STORE = get_typestore(Stores.EMPTY)
for dds_type in _dds.raw_types():
    message_name, text = idl.definition(dds_type)
    STORE.register({k: v for k, v in get_types_from_msg(text, message_name).items() if k not in STORE.fielddefs})


def message(name: str, rng: random.Random) -> Any:
    """A random one; texts and sequences of any length, also none."""
    kinds, made = STORE.fielddefs[name][1], {}
    for field, kind in kinds:
        made[field] = _value(kind, rng)
    return STORE.types[name](**made)


def _value(kind: Any, rng: random.Random) -> Any:
    node = kind[0].name
    if node == "BASE":
        base = kind[1][0]
        if base == "string":
            return "".join(rng.choices("aé1 \"',\n", k=rng.randrange(12)))[:60]
        return NUMBERS[base](rng)
    if node == "NAME":
        return message(kind[1], rng)
    inside, count = kind[1]
    count = count if node == "ARRAY" else rng.randrange(4)
    values = [_value(inside, rng) for _ in range(count)]
    return np.array(values, inside[1][0]) if inside[0].name == "BASE" and inside[1][0] != "string" else values


def leaves(value: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Path and value of each number and text of a message of rosbags, or of mcap-ros2-support."""
    if isinstance(value, (list, np.ndarray)):
        for i, each in enumerate(value):
            yield from leaves(each, f"{path}.{i}")
    elif isinstance(value, (int, float, str, np.generic)):
        yield path.lstrip("."), value
    else:
        names = getattr(type(value), "__slots__", None) or vars(value)
        for name in names:
            if not name.startswith("__"):
                yield from leaves(getattr(value, name), f"{path}.{name}")


def octets_of(name: str, value: Any, little: bool = True) -> bytes:
    """As DDS sends them: a multiple of four, the number of octets added in the header."""
    raw = bytes(STORE.serialize_cdr(value, name, little_endian=little))
    padding = -len(raw) % 4
    return raw[:3] + bytes([padding]) + raw[4:] + b"\0" * padding


def write(path: Path, count: int, seed: int, spacing_ns: int = 1_000_000, compression: str = "zstd") -> list[tuple]:
    """A recording of NAMES in turn; returns topic, log instant, message, octets of each message."""
    rng = random.Random(seed)
    recorder = Recorder(path, compression)
    topics = [
        _dds.raw_topic(name, kind, user="typehash=RIHS01_00;", latched=name == "rt/tf", deadline_s=1.5)
        for kind, name in NAMES.items()
    ]
    numbers = [recorder.topic(topic) for topic in topics]
    said = []
    for k in range(count):
        topic = topics[k % len(topics)]
        name = idl.ros_name(topic.type)
        value = message(name, rng)
        octets = octets_of(name, value)
        at = BEGIN_NS + k * spacing_ns
        recorder.add(numbers[k % len(topics)], at, at - 1000, octets)
        said.append((topic.name.removeprefix("rt"), at, value, octets))
    recorder.close()
    return said
