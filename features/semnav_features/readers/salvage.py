"""Bags read from front to back, without an index: unclosed, cut off, damaged, or unusual.

The parts that records are made of are read by functions of rosbags.
"""

from __future__ import annotations

import io
import re
import sqlite3
import struct
from collections import Counter
from collections.abc import Callable, Collection, Iterator
from contextlib import closing
from pathlib import Path
from typing import BinaryIO

from semnav_features.readers.channel import Channel, Message
from semnav_features.readers.log import DamageError, LogError

MCAP_FOOTER, MCAP_SCHEMA, MCAP_CHANNEL, MCAP_MESSAGE, MCAP_CHUNK = 2, 3, 4, 5, 6
"""Kinds of records in MCAP (mcap.dev/spec)."""


class SalvagedBag:
    """A bag as far as it can be read from its front.

    Args:
        path: a file, or a folder of .db3 or .mcap files.

    Raises:
        LogError: there is no such file, or none that holds messages.
        OSError: one cannot be opened.
    """

    def __init__(self, path: Path) -> None:
        self._files = [(_format(file), file) for file in _storage_files(path)]
        self.counts = Counter[Channel]()
        try:
            for channel, _, _ in self._all():
                self.counts[channel] += 1
        except DamageError:
            if not self.counts:
                raise

    def messages(self, channels: Collection[Channel]) -> Iterator[Message]:
        """The messages of some channels; see `Bag`."""
        return (message for message in self._all() if message[0] in channels)

    def close(self) -> None:
        """Nothing stays open between messages."""

    def _all(self) -> Iterator[Message]:
        damaged = False
        for messages, file in self._files:
            try:  # damaged bytes raise whatever the parser of the moment stumbles over
                yield from messages(file)
            except Exception as error:
                if getattr(error, "errno", None):
                    raise
                damaged = True
        if damaged:
            raise DamageError


def _storage_files(path: Path) -> list[Path]:
    if not path.is_dir():
        return [path]
    files = [file for suffix in ("*.db3", "*.mcap") for file in path.glob(suffix)]
    if packed := next(path.glob("*.zst*"), None):
        raise LogError(
            f"{packed} cannot be read: it is damaged, or without its metadata.yaml; decompress it "
            "with zstd -d"
        )
    if not files:
        raise LogError(f"{path} is a directory without a bag; expected .db3 or .mcap files in it")
    return sorted(files, key=lambda file: (len(file.name), file.name))


def _format(path: Path) -> Callable[[Path], Iterator[Message]]:
    with open(path, "rb") as file:
        head = file.read(16)
    for magic, messages in _FORMATS.items():
        if head.startswith(magic):
            return messages
    raise LogError(f"{path} is neither a ROS 1 bag (version 2) nor .db3 or .mcap of ROS 2")


def _ros1_messages(path: Path) -> Iterator[Message]:
    """The messages of a ROS 1 bag.

    Raises:
        EOFError: it ends too early, or was not closed.
    """
    from rosbags.rosbag1.reader import Header, read_bytes, read_uint32

    with open(path, "rb") as file:
        file.readline()
        index = Header.read(file).get_uint64("index_pos")
        read_bytes(file, read_uint32(file))
        yield from _ros1_records(file, {})
    if not index:
        raise EOFError


def _ros1_records(file: BinaryIO, channels: dict[int, Channel]) -> Iterator[Message]:
    from rosbags.rosbag1 import reader as rosbag1

    kinds = rosbag1.RecordType
    while size := file.read(4):
        file.seek(-len(size), io.SEEK_CUR)
        header = rosbag1.Header.read(file)
        kind = header.get_uint8("op")
        if kind == kinds.CONNECTION:
            type_name = rosbag1.Header.read(file).get_string("type")
            channel = Channel.of(header.get_string("topic"), type_name, "ros1")
            channels[header.get_uint32("conn")] = channel
            continue
        data = rosbag1.read_bytes(file, rosbag1.read_uint32(file))
        if kind == kinds.MSGDATA:
            yield channels[header.get_uint32("conn")], header.get_time("time"), data
        elif kind == kinds.CHUNK:
            chunk = rosbag1.decompressors[header.get_string("compression")](data)
            yield from _ros1_records(io.BytesIO(chunk), channels)


def _mcap_messages(path: Path) -> Iterator[Message]:
    """The messages of an MCAP file, of whatever profile and other kinds of messages.

    Raises:
        EOFError: it ends too early, or was not closed.
    """
    with open(path, "rb") as file:
        file.read(8)
        yield from _mcap_records(file, {0: ""}, {})
        if not file.read(1):
            raise EOFError


def _mcap_records(
    file: BinaryIO, types: dict[int, str], channels: dict[int, Channel]
) -> Iterator[Message]:
    from rosbags.rosbag2 import storage_mcap as mcap

    while start := file.read(1):
        kind, record = start[0], io.BytesIO(mcap.read_sized(file))
        if kind == MCAP_FOOTER:
            return
        if kind == MCAP_SCHEMA:
            (number,) = struct.unpack("<H", record.read(2))
            types[number] = mcap.read_string(record)
        elif kind == MCAP_CHANNEL:
            number, schema = struct.unpack("<HH", record.read(4))
            topic, encoding = mcap.read_string(record), mcap.read_string(record)
            channels[number] = Channel.of(topic, types[schema], encoding)
        elif kind == MCAP_MESSAGE:
            number, _, time, _ = struct.unpack("<HIQQ", record.read(22))
            yield channels[number], time, record.read()
        elif kind == MCAP_CHUNK:
            _, _, size, checksum = struct.unpack("<QQQI", record.read(28))
            compression = mcap.read_string(record)
            packed = mcap.read_sized(record)
            chunk = io.BytesIO(mcap.decompress(packed, compression, size, checksum))
            yield from _mcap_records(chunk, types, channels)


def check_tables(path: Path) -> None:
    """Refuse a database whose topics or messages are computed, which may never end.

    Raises:
        LogError: names the file.
    """
    with open(path, "rb") as file:
        if not file.read(16).startswith(b"SQLite"):
            return
    try:
        with closing(_database(path)) as database:
            named = "SELECT type, sql FROM sqlite_master WHERE name IN ('topics', 'messages')"
            made = database.execute(named).fetchall()
    except sqlite3.Error:
        return  # the readers say what of it can be read
    for kind, statement in made:
        if kind != "table" or re.search(r"\b(VIRTUAL|GENERATED|AS)\b", statement, re.IGNORECASE):
            raise LogError(f"{path} computes its messages; a bag has tables of topics and messages")


def _database(path: Path) -> sqlite3.Connection:
    database = sqlite3.connect(f"{path.resolve().as_uri()}?immutable=1", uri=True)
    # Without it SQLite opens no file that is shorter than its first page says.
    database.execute("PRAGMA writable_schema=ON")
    return database


def _sqlite_messages(path: Path) -> Iterator[Message]:
    """The messages of ROS 2's SQLite storage in the order of recording.

    Raises:
        sqlite3.DatabaseError: it ends too early or is damaged.
        EOFError: it is shorter than it should be, where no message lies.
    """
    with closing(_database(path)) as database:
        topics = database.execute("SELECT id, name, type, serialization_format FROM topics")
        channels = {number: Channel.of(*names) for number, *names in topics}
        rows = database.execute("SELECT topic_id, timestamp, data FROM messages ORDER BY id")
        for number, time, data in rows:
            yield channels[number], time, data
        (whole,) = database.execute("PRAGMA page_count").fetchone()
        (size,) = database.execute("PRAGMA page_size").fetchone()
        if path.stat().st_size < whole * size:
            raise EOFError


_FORMATS: dict[bytes, Callable[[Path], Iterator[Message]]] = {
    b"#ROSBAG V2": _ros1_messages,
    b"\x89MCAP0": _mcap_messages,
    b"SQLite format 3": _sqlite_messages,
}
