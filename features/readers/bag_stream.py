"""Bags read from front to back, without an index: unclosed, cut off, damaged, or unusual."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterator
from pathlib import Path

from semnav_env.features.readers.bag1_records import rosbag1_messages
from semnav_env.features.readers.channel import Channel, Message
from semnav_env.features.readers.log import DamageError, LogError
from semnav_env.features.readers.mcap_records import mcap_messages
from semnav_env.features.readers.sqlite_records import sqlite_messages

_FORMATS: dict[bytes, Callable[[Path], Iterator[Message]]] = {
    b"#ROSBAG V2": rosbag1_messages,
    b"\x89MCAP0": mcap_messages,
    b"SQLite format 3": sqlite_messages,
}


class StreamedBag:
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
