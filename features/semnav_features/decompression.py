"""Decompresses data and files within a budget, because two kilobytes may hold gigabytes."""

from __future__ import annotations

import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol, cast

from semnav_features.reading import read_bytes


class Decompressor(Protocol):
    """The interface of zlib, bz2, lz4 and zstd for data that come in parts."""

    eof: bool
    unused_data: bytes | None

    def decompress(self, data: bytes, max_length: int, /) -> bytes:
        """At most a number of bytes of the content of data."""
        ...


def gzip_decompressor() -> Decompressor:
    """A decompressor of gzip."""
    made: Any = zlib.decompressobj(wbits=16 + zlib.MAX_WBITS)
    return cast(Decompressor, made)


def decompressed(
    data: bytes, most: int, decompressor: Callable[[], Decompressor] = gzip_decompressor
) -> bytes:
    """The content of compressed data, with all of its parts.

    Raises:
        ValueError: it has more than `most` bytes.
        EOFError: the data end too early.
        Exception: that of the decompressor, if the data are damaged.
    """
    content: list[bytes] = []
    left = most
    while data:
        stream = decompressor()
        content.append(stream.decompress(data, left + 1))
        left -= len(content[-1])
        if left < 0:
            raise ValueError(f"more than {most:,} bytes when decompressed")
        if not stream.eof:
            raise EOFError
        data = (stream.unused_data or b"").lstrip(b"\0")
    return b"".join(content)


def read_lines(path: Path, most: int, error: type[ValueError] = ValueError) -> list[str]:
    """The lines of a file in UTF-8, which is compressed if its name ends in .gz.

    Args:
        path: of the file.
        most: size of the largest file that is read, bytes, also when decompressed.
        error: kind of the error.

    Raises:
        ValueError: of the kind `error`; names the file and what is wrong.
        OSError: there is no such file, or it may not be read.
    """
    raw = read_bytes(path, most, error)
    try:
        return (decompressed(raw, most) if path.suffix == ".gz" else raw).decode().splitlines()
    except (EOFError, zlib.error):
        raise error(f"{path}: is not gzip-compressed, or is cut off") from None
    except UnicodeDecodeError:
        raise error(f"{path}: is not text in UTF-8") from None
    except ValueError as fault:
        raise error(f"{path}: {fault}") from None
