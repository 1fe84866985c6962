"""Bags decompressed within a budget, by chunk or whole: two kilobytes may hold gigabytes."""

from __future__ import annotations

from bz2 import BZ2Decompressor
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache, partial
from types import SimpleNamespace
from typing import Any, BinaryIO

from semnav_features.decompression import decompressed
from semnav_features.readers.log import LogError
from semnav_features.readers.text import MAX_EXPANSION, most_expanded

MAX_CHUNK_BYTES = 64_000_000
"""Size of the largest chunk or message of a bag when decompressed, bytes: recorders make chunks of
up to some megabytes."""


@cache
def bound_decompression() -> None:
    """Let rosbags, which decompresses whatever a bag holds, refuse what is beyond the budget."""
    from lz4.frame import LZ4FrameDecompressor
    from rosbags.rosbag1 import reader as ros1
    from rosbags.rosbag2 import reader as ros2
    from rosbags.rosbag2 import storage_mcap as mcap

    reader: Any = ros2
    zstd = reader.zstd
    bounded = partial(partial, decompressed, most=MAX_CHUNK_BYTES)
    bz2, lz4, zst = (
        bounded(decompressor=kind)
        for kind in (BZ2Decompressor, LZ4FrameDecompressor, zstd.ZstdDecompressor)
    )
    ros1.decompressors.update({"bz2": bz2, "lz4": lz4})
    mcap.DECOMPRESSORS.update({"lz4": lambda data, _: lz4(data), "zstd": lambda data, _: zst(data)})
    reader.zstd = SimpleNamespace(open=partial(_bounded_file, zstd.open), decompress=zst)


@contextmanager
def _bounded_file(
    opened: Callable[..., Any], packed: BinaryIO, mode: str
) -> Iterator[SimpleNamespace]:
    """The content of a bag that is compressed as a whole; its `read` counts what it gives."""
    size = 0
    with opened(packed, mode) as content:

        def read(count: int) -> bytes:
            nonlocal size
            data: bytes = content.read(count)
            size += len(data)
            if size > most_expanded(packed):
                raise LogError(f"{packed.name}: expands more than {MAX_EXPANSION} times")
            return data

        yield SimpleNamespace(read=read)
