"""Bytes of binary logs: an exact number of them, or decompressed."""

from __future__ import annotations

import bz2
import sys
from typing import IO


def exactly(file: IO[bytes], size: int) -> bytes:
    """So many bytes of a file.

    Raises:
        EOFError: there are not so many left.
    """
    data = file.read(size)
    if len(data) != size:
        raise EOFError
    return data


def decompressed(compression: str, data: bytes) -> bytes:
    """What `data` were before they were compressed by a method that bags use.

    Raises:
        ValueError: there is no such method.
        Exception: of other kinds, for damaged data.
    """
    if compression in ("", "none"):
        return data
    if compression == "bz2":
        return bz2.decompress(data)
    if compression == "lz4":
        from lz4.frame import decompress  # type: ignore[import-untyped]

        return bytes(decompress(data))
    if compression == "zstd":
        return _from_zstd(data)
    raise ValueError(f"compression {compression!r}")


def _from_zstd(data: bytes) -> bytes:
    if sys.version_info >= (3, 14):
        from compression import zstd
    else:
        from backports import zstd
    return bytes(zstd.decompress(data))
