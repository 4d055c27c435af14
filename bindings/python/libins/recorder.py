"""A recording as an MCAP file in the manner of rosbag2: CDR as it was taken, definitions of the messages beside it.

Profile ros2, schema encoding ros2msg, chunked and indexed, so that viewers seek. What a topic was offered with is kept
as rosbag2 does (offered_qos_profiles, topic_type_hash) and, of partition and ownership, as libins_partition and
libins_strength. While it grows the file is named F.mcap.part; a second after a message has come it is in it.
"""

import time
from pathlib import Path
from typing import Any

from mcap.writer import CompressionType, Writer

from libins import idl
from libins.errors import UsageError

COMPRESSIONS = {"zstd": CompressionType.ZSTD, "none": CompressionType.NONE}
CHUNK_OCTETS = 1 << 20
FLUSH_S = 1.0
"""A message waits for so long at most until it is in the file."""
FOREVER = {"sec": 9223372036, "nsec": 854775807}
"""As rosbag2 writes what has no limit."""


def ros_topic(name: str, kind: str) -> str:
    """As viewers know it: /imu/data for rt/imu/data."""
    return name.removeprefix("rt") if "::dds_::" in kind and name.startswith("rt/") else name


def dds_topic(name: str, kind: str) -> str:
    """The other way round, with the type as DDS has it."""
    return f"rt{name}" if "::dds_::" in kind and name.startswith("/") else name


def _profile(topic: Any) -> str:
    """YAML of rosbag2: what the writer offered."""

    def span(seconds: float) -> dict[str, int]:
        return {"sec": int(seconds), "nsec": round(seconds % 1 * 1e9)} if seconds else FOREVER

    lines = [
        "- history: keep_last",
        "  depth: 1" if topic.latched else "  depth: 10",
        f"  reliability: {'best_effort' if topic.best_effort else 'reliable'}",
    ]
    lines.append(f"  durability: {'transient_local' if topic.latched else 'volatile'}")
    for name, seconds in (("deadline", topic.deadline_s), ("lifespan", 0.0)):
        lines += [f"  {name}:", *(f"    {key}: {value}" for key, value in span(seconds).items())]
    lines += ["  liveliness: automatic", "  liveliness_lease_duration:"]
    lines += [*(f"    {key}: {value}" for key, value in FOREVER.items()), "  avoid_ros_namespace_conventions: false"]
    return "\n".join(lines) + "\n"


class Recorder:
    """Writes one file. close() gives it its name; without that, what is whole of it stays in F.mcap.part."""

    def __init__(self, path: Path, compression: str = "zstd") -> None:
        """Raises UsageError."""
        self.path = path
        self.part = path.with_name(path.name + ".part")
        self.counts: list[int] = []
        """Messages of each topic."""
        self._flushed = time.monotonic()
        self._waiting = False
        try:
            self._file = self.part.open("xb")
        except FileExistsError as error:
            raise UsageError(
                f"{self.part}: is there, of a recording that goes on or was killed; "
                f"wait for it, or see what it holds (ins play, ins export) and remove it"
            ) from error
        except OSError as error:
            raise UsageError(f"{path}: cannot be written: {error.strerror}; choose another place") from error
        self._writer = Writer(self._file, chunk_size=CHUNK_OCTETS, compression=COMPRESSIONS[compression])
        self._writer.start(profile="ros2", library="libins")
        self._schemas: dict[str, int] = {}
        self._channels: list[int] = []

    @property
    def octets(self) -> int:
        """Written so far."""
        return self._file.tell()

    def topic(self, topic: Any) -> int:
        """A topic as it was found (_dds.RawTopic); the number of its messages."""
        if topic.type not in self._schemas:
            name, text = idl.definition(topic.type)
            self._schemas[topic.type] = self._writer.register_schema(name, "ros2msg", text.encode())
        metadata = {"offered_qos_profiles": _profile(topic)}
        if "typehash=" in topic.user:
            metadata["topic_type_hash"] = topic.user.partition("typehash=")[2].partition(";")[0]
        if topic.partition:
            metadata["libins_partition"] = topic.partition
        if topic.exclusive:
            metadata["libins_strength"] = str(topic.strength)
        name = ros_topic(topic.name, topic.type)
        self._channels.append(self._writer.register_channel(name, "cdr", self._schemas[topic.type], metadata))
        self.counts.append(0)
        return len(self.counts) - 1

    def add(self, number: int, log_ns: int, published_ns: int, octets: bytes) -> None:
        """A message of the topic with that number; log_ns must not go back."""
        self._writer.add_message(self._channels[number], log_ns, octets, published_ns, self.counts[number])
        self.counts[number] += 1
        self._waiting = True

    def flush(self) -> None:
        """To be called now and then: what has waited for FLUSH_S goes into the file."""
        if self._waiting and time.monotonic() - self._flushed >= FLUSH_S:
            self._writer.flush()
            self._waiting = False
        if not self._waiting:
            self._flushed = time.monotonic()

    def close(self) -> None:
        """It is whole."""
        self._writer.finish()
        self._file.close()
        self.part.replace(self.path)

    def drop(self) -> None:
        """Leave nothing, of a recording that never began."""
        self._file.close()
        self.part.unlink()
