"""MCAP files from front to back (format: mcap.dev/spec).

A record is a byte that says its kind, its length in eight bytes, and its content. Messages lie in
chunks or between them, after the schemas and channels that they belong to.
"""

from __future__ import annotations

import io
import struct
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import IO

from semnav_env.features.readers.binary import decompressed, exactly
from semnav_env.features.readers.channel import Channel, Message

_FOOTER, _SCHEMA, _CHANNEL, _MESSAGE, _CHUNK = 2, 3, 4, 5, 6


def mcap_messages(path: Path) -> Iterator[Message]:
    """The messages of an MCAP file in the order of recording.

    Raises:
        EOFError: it ends too early, or was not closed.
        Exception: of other kinds, for damaged data.
    """
    with open(path, "rb") as file:
        file.read(8)
        yield from _Sections().messages(file)
        if not file.read(1):
            raise EOFError


class _Sections:
    """What the records so far have declared."""

    def __init__(self) -> None:
        self._types = {0: ""}
        self._channels: dict[int, Channel] = {}

    def messages(self, file: IO[bytes]) -> Iterator[Message]:
        while start := file.read(9):
            kind, size = struct.unpack("<BQ", start)
            content = exactly(file, size)
            if kind == _MESSAGE:
                number, _, time, _ = struct.unpack_from("<HIQQ", content)
                yield self._channels[number], time, content[22:]
            elif kind == _CHUNK:
                yield from self.messages(io.BytesIO(_records_of(content)))
            elif kind == _FOOTER:
                return
            else:
                self._declare(kind, io.BytesIO(content))

    def _declare(self, kind: int, content: IO[bytes]) -> None:
        if kind == _SCHEMA:
            (number,) = struct.unpack("<H", exactly(content, 2))
            self._types[number] = _text(content)
        elif kind == _CHANNEL:
            number, schema = struct.unpack("<HH", exactly(content, 4))
            topic, encoding = _text(content), _text(content)
            self._channels[number] = Channel.of(topic, self._types[schema], encoding)


def _records_of(chunk: bytes) -> bytes:
    file = io.BytesIO(chunk)
    _, _, size, checksum = struct.unpack("<QQQI", exactly(file, 28))
    compression = _text(file)
    records = decompressed(compression, exactly(file, *struct.unpack("<Q", exactly(file, 8))))
    if len(records) != size or (checksum and zlib.crc32(records) != checksum):
        raise ValueError("checksum")
    return records


def _text(file: IO[bytes]) -> str:
    return exactly(file, *struct.unpack("<I", exactly(file, 4))).decode()
