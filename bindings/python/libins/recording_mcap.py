"""A recording in MCAP, read: what `ins record` or rosbag2 has written, as messages, as arrays, as tables.

    with Recording("drive.mcap") as recording:
        imu = recording.arrays("/imu/data")          # {"angular_velocity.x_rad_s": array, ...}
        recording.problem                            # None, or why it is not whole

Of a file that was cut off, what is whole is read. Frames and units are those of the messages; see docs/recording.md.
"""

import struct
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import IO, Any, Self

import numpy as np
import numpy.typing as npt
import zstandard
from mcap.exceptions import McapError
from mcap.reader import SeekingReader
from mcap.records import Channel, Message, Schema
from mcap.stream_reader import CRCValidationError, StreamReader

from libins import cdr
from libins.errors import UsageError

NS_PER_S = 10**9
TIMES = ("log_time_ns", "publish_time_ns")
"""Columns before those of the message: when it was taken, and when its publisher said it."""
BROKEN = (McapError, CRCValidationError, struct.error, zstandard.ZstdError, ValueError, KeyError, EOFError)
"""What mcap raises for octets that are no recording."""
Array = npt.NDArray[Any]


@dataclass(frozen=True)
class Taken:
    """A message."""

    topic: str
    log_ns: int
    published_ns: int
    octets: bytes


@dataclass(frozen=True)
class Topic:
    """What is known of one."""

    name: str
    type: str
    """package/msg/Name"""
    encoding: str
    """Of its definition."""
    definition: str
    metadata: dict[str, str]
    count: int


class Recording:
    """An open file."""

    def __init__(self, path: Path | str) -> None:
        """Raises UsageError for what is no recording at all."""
        self.path = Path(path)
        self.problem: str | None = None
        """Why the file is not whole."""
        self.topics: dict[str, Topic] = {}
        self.begin_ns = self.end_ns = 0
        """Of the log."""
        try:
            self._file: IO[bytes] = self.path.open("rb")
        except OSError as error:
            part = self.path.with_name(self.path.name + ".part")
            also = f"; {part} is there, of a recording that goes on or was killed" if part.exists() else ""
            raise UsageError(f"{path}: cannot be read: {error.strerror}{also}") from error
        self._summary = False
        try:
            self._open()
        except UsageError:
            self._file.close()
            raise

    def __enter__(self) -> Self:
        """It is open."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Close it."""
        self._file.close()

    @property
    def duration_s(self) -> float:
        """From the first message to the last."""
        return (self.end_ns - self.begin_ns) / NS_PER_S

    def _open(self) -> None:
        try:
            reader = SeekingReader(self._file)
        except BROKEN as error:
            raise UsageError(f"{self.path}: is no MCAP file: {error}") from error
        try:
            summary = reader.get_summary()
        except (*BROKEN, OSError):
            summary = None
        if summary is None or summary.statistics is None:
            self._scan()
            return
        self._summary = True
        statistics = summary.statistics
        self.begin_ns, self.end_ns = statistics.message_start_time, statistics.message_end_time
        for number, channel in summary.channels.items():
            count = statistics.channel_message_counts.get(number, 0)
            self._add(summary.schemas.get(channel.schema_id), channel, count)

    def _add(self, schema: Schema | None, channel: Channel, count: int) -> None:
        before = self.topics.get(channel.topic)
        self.topics[channel.topic] = Topic(
            channel.topic,
            schema.name if schema else "",
            schema.encoding if schema else "",
            schema.data.decode("utf-8", "replace") if schema else "",
            dict(channel.metadata),
            count + (before.count if before else 0),
        )

    def _scan(self) -> None:
        """Of a file without its end: go through all of it."""
        instants: list[int] = []
        schema_of: dict[str, tuple[Schema | None, Channel]] = {}
        counts: dict[str, int] = {}
        for schema, channel, message in self._whole():
            instants.append(message.log_time)
            schema_of[channel.topic] = (schema, channel)
            counts[channel.topic] = counts.get(channel.topic, 0) + 1
        for name, (schema, channel) in schema_of.items():
            self._add(schema, channel, counts[name])
        if instants:
            self.begin_ns, self.end_ns = min(instants), max(instants)

    def _whole(self) -> Iterator[tuple[Schema | None, Channel, Message]]:
        """What is whole, from the begin on; sets `problem`."""
        self._file.seek(0)
        schemas: dict[int, Schema] = {}
        channels: dict[int, Channel] = {}
        count = 0
        try:
            for record in StreamReader(self._file, validate_crcs=True).records:
                if isinstance(record, Schema):
                    schemas[record.id] = record
                elif isinstance(record, Channel):
                    channels[record.id] = record
                elif isinstance(record, Message):
                    channel = channels[record.channel_id]
                    count += 1
                    yield schemas.get(channel.schema_id), channel, record
            self.problem = "has no index"
        except BROKEN:
            size = self.path.stat().st_size
            self.problem = f"is cut off or damaged after {count} messages ({size} octets); its end was never written"

    def chosen(self, wanted: Collection[str]) -> list[str]:
        """These topics, or where none is named all that have messages. Raises UsageError for one that is not there."""
        for name in wanted:
            if name not in self.topics:
                raise UsageError(f"{self.path}: has no topic {name}; it has {', '.join(self.topics) or 'none'}")
        return list(wanted) or [name for name, topic in self.topics.items() if topic.count]

    def messages(
        self, topics: Collection[str] | None = None, from_s: float = 0.0, to_s: float | None = None
    ) -> Iterator[Taken]:
        """In the order of the log, between two instants after its begin; by the index, where there is one."""
        begin = self.begin_ns + round(from_s * NS_PER_S)
        end = self.end_ns + 1 if to_s is None else self.begin_ns + round(to_s * NS_PER_S)
        if not self._summary:
            for _, channel, message in self._whole():
                if begin <= message.log_time < end and (topics is None or channel.topic in topics):
                    yield Taken(channel.topic, message.log_time, message.publish_time, message.data)
            return
        self._file.seek(0)
        reader = SeekingReader(self._file, validate_crcs=True)
        wanted = None if topics is None else list(topics)
        try:
            for _, channel, message in reader.iter_messages(wanted, starting_at=begin, ending_before=end):
                yield Taken(channel.topic, message.log_time, message.publish_time, message.data)
        except BROKEN as error:
            raise UsageError(f"{self.path}: is damaged: {error}") from error

    def definition(self, topic: str) -> cdr.Definition:
        """How to read the octets of a topic. Raises UsageError."""
        known = self.topics[topic]
        if known.encoding != "ros2msg":
            raise UsageError(
                f"{self.path}: topic {topic}: its definition is {known.encoding or 'missing'}, not ros2msg; "
                "leave it out with --topic"
            )
        return cdr.Definition(known.type, known.definition)

    def arrays(self, topic: str, from_s: float = 0.0, to_s: float | None = None) -> dict[str, Array]:
        """Columns of a topic: log_time_ns, publish_time_ns, and each field; arrays of numbers have a row a message."""
        definition = self.definition(topic)
        taken = list(self.messages([topic], from_s, to_s))
        rows = [definition.read(message.octets) for message in taken]
        found: dict[str, Array] = {
            TIMES[0]: np.array([message.log_ns for message in taken], np.int64),
            TIMES[1]: np.array([message.published_ns for message in taken], np.int64),
        }
        for path, column in definition.columns.items():
            values = [row.get(path) for row in rows]
            head = column.heads()[0] if not column.labels else cdr.Column(column.name, column.unit).heads()[0]
            found[head] = _array(values)
        return found

    def table(
        self, topic: str, from_s: float = 0.0, to_s: float | None = None
    ) -> tuple[list[str], Iterator[list[Any]]]:
        """Heads and rows, a column for every number."""
        definition = self.definition(topic)
        taken = list(self.messages([topic], from_s, to_s))
        rows = [definition.read(message.octets) for message in taken]
        columns = definition.columns
        heads = [*TIMES, *(head for column in columns.values() for head in column.heads())]

        def lines() -> Iterator[list[Any]]:
            for message, row in zip(taken, rows, strict=True):
                line: list[Any] = [message.log_ns, message.published_ns]
                for path, column in columns.items():
                    value = row.get(path)
                    many = column.labels != ()
                    line += [""] * len(column.heads()) if value is None else list(value) if many else [value]
                yield line

        return heads, lines()


def _array(values: list[Any]) -> Array:
    """What a message lacks is NaN, or an empty text."""
    one = next(value for value in values if value is not None)
    nan = (np.nan,) * len(one) if isinstance(one, tuple) else np.nan
    filler: Any = "" if isinstance(one, str) else nan
    return np.array([filler if value is None else value for value in values])
