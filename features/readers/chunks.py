"""Chunks of bags, decompressed within a budget: two kilobytes may say that they are gigabytes."""

from __future__ import annotations

from bz2 import BZ2Decompressor
from functools import cache, partial
from types import SimpleNamespace
from typing import Any

from semnav_env.features.reading import decompressed

MAX_CHUNK_BYTES = 64_000_000
"""Size of the largest chunk or message of a bag when decompressed, bytes: recorders make chunks of
up to some megabytes."""


@cache
def bound_decompression() -> None:
    """Let rosbags, which decompresses whatever a bag holds, refuse chunks beyond the budget."""
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
    reader.zstd = SimpleNamespace(open=zstd.open, decompress=zst)
