"""ROS 1 bags, ROS 2 bags and MCAP files: one record per sensor_msgs/LaserScan."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import takewhile
from pathlib import Path
from typing import ClassVar

from semnav_features.frames import Pose
from semnav_features.readers.bag import open_bag
from semnav_features.readers.channel import Channel
from semnav_features.readers.geometry import Geometry
from semnav_features.readers.log import BadRecordError, LogError, LogReader, LogRecord
from semnav_features.readers.ros_messages import ENCODINGS, LASER_SCAN, ODOMETRY, Decoder

_LISTED = 12


class RosLog(LogReader):
    """An open bag; see `ScanLog`.

    Records have no pose, for that would need the tree of transforms, which is not read: scans
    are in the lidar's frame, as mounted. Their odometry is the last nav_msgs/Odometry before
    them, of the topic whose name is nearest to the scan's.

    Args:
        path: a ROS 1 bag, a folder of ROS 2, a .db3 or an .mcap file.
        geometry: whose `range_max` counts where it is the smaller.
        topic: name of the scans' topic; None takes the only one.

    Raises:
        ImportError: rosbags is not installed.
        LogError: no such topic, or several to choose from; the message lists them.
        DamageError: nothing in it can be read.
        OSError: it cannot be opened.
    """

    unit: ClassVar[str] = "message"
    expected = f"messages of type {LASER_SCAN}"

    def __init__(self, path: Path, geometry: Geometry, topic: str | None) -> None:
        super().__init__(path)
        self._geometry = geometry
        self._bag = open_bag(path)
        try:
            self._decoder = Decoder()
            self._scans = self._chosen(topic)
            self._odometry = _nearest(self._scans, self._bag.counts)
        except BaseException:
            self._bag.close()
            raise
        self._read = Counter[Channel]()

    @property
    def fraction(self) -> float | None:
        """Share of the messages that have been read, 0 to 1; None without messages."""
        total = sum(self._bag.counts[channel] for channel in self._wanted)
        return min(1.0, self._read.total() / total) if total else None

    def records(self) -> Iterator[LogRecord]:
        """The records that are left."""
        pose: Pose | None = None
        for channel, time, data in self._bag.messages(self._wanted):
            self._read[channel] += 1
            number = self._read[channel]
            try:
                if channel == self._odometry:
                    pose = self._decoder.odometry(channel, data)
                else:
                    scan = self._decoder.scan(channel, time, data, self._geometry)
                    yield LogRecord(scan, None, pose, number)
            except BadRecordError as error:
                self.count_bad(f"{channel.topic}: {error}", number)

    def close(self) -> None:
        """Close the files."""
        self._bag.close()

    @property
    def _wanted(self) -> list[Channel]:
        return [self._scans] if self._odometry is None else [self._scans, self._odometry]

    def _chosen(self, topic: str | None) -> Channel:
        counts = self._bag.counts
        scans = Counter({c: n for c, n in counts.items() if _decodable(c, LASER_SCAN)})
        if not scans:
            raise LogError(
                f"{self.path} has no topic of {LASER_SCAN} in ROS's encodings; it has "
                + (_listed(counts, with_type=True) or "no messages")
            )
        if topic is None:
            heard = [channel for channel in scans if scans[channel]] or list(scans)
            if len(heard) > 1:
                raise LogError(f"{self.path} has several topics of scans; choose {_listed(scans)}")
            return heard[0]
        for channel in sorted(scans, key=scans.__getitem__, reverse=True):
            if channel.topic.strip("/") == topic.strip("/"):
                return channel
        raise LogError(f"{self.path} has no scans on topic {topic!r}; there are {_listed(scans)}")


def _decodable(channel: Channel, type_name: str) -> bool:
    return channel.type == type_name and channel.encoding in ENCODINGS


def _nearest(scans: Channel, counts: Counter[Channel]) -> Channel | None:
    """The channel of odometry that shares the most of the name, then the one with most messages."""

    def nearness(channel: Channel) -> tuple[int, int, str]:
        pairs = zip(scans.topic.split("/"), channel.topic.split("/"), strict=False)
        shared = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], pairs))
        return shared, counts[channel], channel.topic

    return max((c for c in counts if _decodable(c, ODOMETRY)), key=nearness, default=None)


def _listed(counts: Counter[Channel], with_type: bool = False) -> str:
    names = [
        f"{channel.topic} ({f'{channel.type}, ' if with_type else ''}{count} messages)"
        for channel, count in sorted(counts.items())
    ]
    more = [f"{len(names) - _LISTED} more"] if len(names) > _LISTED else []
    return ", ".join(names[:_LISTED] + more)
