"""ROS bags as streams of raw messages: through rosbags, or front to back where that fails."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Protocol

from semnav_features.readers.channel import Channel, Message
from semnav_features.readers.chunks import bound_decompression
from semnav_features.readers.log import DamageError, LogError
from semnav_features.readers.salvage import SalvagedBag, check_tables


class Bag(Protocol):
    """An open bag.

    Attributes:
        counts: how many messages each channel has.
    """

    counts: Counter[Channel]

    def messages(self, channels: Collection[Channel]) -> Iterator[Message]:
        """Yield the messages of some channels, in the order of time.

        Raises:
            DamageError: the bag ends too early or is damaged.
        """
        ...

    def close(self) -> None:
        """Close the files."""


class IndexedBag:
    """A whole bag, read by rosbags with the bag's own index.

    Args:
        path: a ROS 1 bag, a folder of ROS 2, or a single file of one.

    Raises:
        Exception: of whatever kind, if rosbags cannot read it.
    """

    def __init__(self, path: Path) -> None:
        from rosbags import rosbag1, rosbag2

        ros1 = path.is_file() and _begins(path, b"#ROSBAG")
        self._reader = rosbag1.Reader(path) if ros1 else rosbag2.Reader(path)
        self._reader.open()
        self._connections = [
            (Channel.of(c.topic, c.msgtype, getattr(c.ext, "serialization_format", "ros1")), c)
            for c in self._reader.connections
        ]
        self.counts = Counter[Channel]()
        for channel, connection in self._connections:
            self.counts[channel] += connection.msgcount

    def messages(self, channels: Collection[Channel]) -> Iterator[Message]:
        """The messages of some channels; see `Bag`."""
        wanted = [connection for channel, connection in self._connections if channel in channels]
        by_id = {connection.id: channel for channel, connection in self._connections}
        messages = self._reader.messages(connections=wanted)
        while True:
            try:  # damaged bytes raise whatever the parser of the moment stumbles over
                connection, time, data = next(messages)
            except StopIteration:
                return
            except Exception:
                raise DamageError from None
            yield by_id[connection.id], time, bytes(data)

    def close(self) -> None:
        """Close the files."""
        self._reader.close()


def open_bag(path: Path) -> Bag:
    """Open a bag, by its index if it has a sound one, else by reading it front to back.

    Raises:
        ImportError: rosbags is not installed.
        LogError: nothing in it can be read.
    """
    try:
        import rosbags.rosbag1
        import rosbags.rosbag2  # noqa: F401
    except ImportError:
        raise ImportError(
            'ROS bags are read with rosbags, which is not installed: pip install "semnav-env[ros]"'
        ) from None
    bound_decompression()
    for file in [path] if path.is_file() else sorted(path.glob("*.db3")):
        check_tables(file)
    try:
        return IndexedBag(path)
    except LogError:  # beyond a budget
        raise
    except Exception:  # bags without an index, of other kinds of messages, or damaged in any way
        return SalvagedBag(path)


def _begins(path: Path, magic: bytes) -> bool:
    with open(path, "rb") as file:
        return file.read(len(magic)) == magic
