"""ROS 1 bags from front to back (format: wiki.ros.org/Bags/Format/2.0).

A record is a header and data, each after its length in four bytes; a header is a row of
`name=value`, each after its length. Messages lie in chunks, after the connections they belong to.
"""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import IO

from semnav_env.features.readers.binary import decompressed, exactly
from semnav_env.features.readers.channel import Channel, Message

_MESSAGE, _BAG, _CHUNK, _CONNECTION = 2, 3, 5, 7


def rosbag1_messages(path: Path) -> Iterator[Message]:
    """The messages of a ROS 1 bag in the order of recording.

    Raises:
        EOFError: it ends too early, or was not closed.
        Exception: of other kinds, for damaged data.
    """
    channels: dict[int, Channel] = {}
    with open(path, "rb") as file:
        file.readline()
        closed = False
        for header, data in _records(file):
            kind = header[b"op"][0]
            if kind == _CHUNK:
                chunk = io.BytesIO(decompressed(header[b"compression"].decode(), data))
                yield from _chunk(chunk, channels)
            elif kind == _BAG:
                closed = any(header[b"index_pos"])
        if not closed:
            raise EOFError


def _chunk(chunk: IO[bytes], channels: dict[int, Channel]) -> Iterator[Message]:
    for header, data in _records(chunk):
        kind = header[b"op"][0]
        if kind == _CONNECTION:
            (number,) = struct.unpack("<I", header[b"conn"])
            type_name = _fields(data)[b"type"].decode()
            channels[number] = Channel.of(header[b"topic"].decode(), type_name, "ros1")
        elif kind == _MESSAGE:
            (number,) = struct.unpack("<I", header[b"conn"])
            seconds, nanoseconds = struct.unpack("<II", header[b"time"])
            yield channels[number], seconds * 10**9 + nanoseconds, data


def _records(file: IO[bytes]) -> Iterator[tuple[dict[bytes, bytes], bytes]]:
    while start := file.read(4):
        header = _fields(exactly(file, struct.unpack("<I", start)[0]))
        yield header, exactly(file, struct.unpack("<I", exactly(file, 4))[0])


def _fields(header: bytes) -> dict[bytes, bytes]:
    fields, place = {}, 0
    while place < len(header):
        (size,) = struct.unpack_from("<I", header, place)
        name, _, value = header[place + 4 : place + 4 + size].partition(b"=")
        fields[name] = value
        place += 4 + size
    return fields
