"""Text files, gzip-compressed or not, line by line."""

from __future__ import annotations

import gzip
import io
import os
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO, TypeAlias

from semnav_features.readers.log import DamageError, LogError, LogReader
from semnav_features.reading import check_file

_Text: TypeAlias = io.BufferedReader | gzip.GzipFile

_DAMAGED = (EOFError, gzip.BadGzipFile, zlib.error)
_LONGEST_LINE = 1 << 20
_LONGEST_PARTS = 64

MAX_LOG_BYTES = 1 << 40
"""Size of the largest log that is read, bytes; only a part of it is in memory at a time."""

MAX_EXPANSION = 100
"""Decompressed bytes for each byte of a compressed log beyond which it is no log: texts of numbers
expand five to twenty times."""

_ALWAYS_EXPANDED = 1 << 20
"""Number of bytes that are always decompressed."""


def most_expanded(packed: BinaryIO) -> int:
    """Largest number of decompressed bytes for the part of a compressed log read so far."""
    return _ALWAYS_EXPANDED + MAX_EXPANSION * packed.tell()


class TextFile:
    """An open text file.

    Attributes:
        path: where it is.
        head: its first characters, decompressed; enough to tell what it holds.

    Raises:
        DamageError: it is compressed and nothing can be read of it.
        OSError: it cannot be opened.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        check_file(path, MAX_LOG_BYTES, LogError)
        self._file = open(path, "rb")  # noqa: SIM115 - closed by its reader
        try:
            self._size = os.fstat(self._file.fileno()).st_size
            self._text = _decompressed(self._file)
            self.compressed = self._text is not self._file
            self.head = bytes(self._text.peek(1 << 13))
        except BaseException as error:
            self._file.close()
            if isinstance(error, _DAMAGED):
                raise DamageError from None
            raise

    @property
    def fraction(self) -> float | None:
        """Share of the log that has been read, 0 to 1; None if the size is unknown."""
        if not self._size or self._file.closed:
            return None
        return min(1.0, self._file.tell() / self._size)

    def lines(self) -> Iterator[tuple[int, bytes]]:
        """Numbers, from 1, and lines; "-" for each that is longer than a megabyte.

        Raises:
            DamageError: the compressed data end too early or are damaged.
        """
        try:
            size = 0
            for number, line in enumerate(_lines(self._text), start=1):
                size += len(line)
                if self.compressed and size > most_expanded(self._file):
                    raise LogError(f"{self.path}: expands more than {MAX_EXPANSION} times")
                yield number, line
        except _DAMAGED:
            raise DamageError from None

    def close(self) -> None:
        """Close the file."""
        self._file.close()


class TextLog(LogReader):
    """A log that is a text file."""

    def __init__(self, text: TextFile) -> None:
        super().__init__(text.path)
        self._text = text

    @property
    def fraction(self) -> float | None:
        """Share of the file that has been read, 0 to 1; None if its size is unknown."""
        return self._text.fraction

    def close(self) -> None:
        """Close the file."""
        self._text.close()


def _decompressed(file: io.BufferedReader) -> _Text:
    return gzip.GzipFile(fileobj=file) if file.peek(2)[:2] == b"\x1f\x8b" else file


def _lines(text: _Text) -> Iterator[bytes]:
    while line := text.readline(_LONGEST_LINE):
        whole = len(line) < _LONGEST_LINE
        for _ in range(_LONGEST_PARTS):
            if len(line) < _LONGEST_LINE or line.endswith(b"\n"):
                break
            line = text.readline(_LONGEST_LINE)
        else:
            raise EOFError
        yield line if whole else b"-"
