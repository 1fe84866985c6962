"""Chooses the reader of a log."""

from __future__ import annotations

import errno
import os
from pathlib import Path

from semnav_features.readers.breezyslam import BreezySlamLog, is_breezyslam
from semnav_features.readers.carmen import CarmenLog, is_carmen
from semnav_features.readers.csv_log import CsvLog, is_csv
from semnav_features.readers.geometry import Geometry
from semnav_features.readers.log import DamageError, LogError, ScanLog, TruncatedLogError
from semnav_features.readers.npz_log import NpzLog
from semnav_features.readers.ros import RosLog
from semnav_features.readers.text import TextFile

_BAGS = (b"#ROSBAG V", b"\x89MCAP0", b"SQLite format 3")
_COMPRESSED = (b"\x28\xb5\x2f\xfd", b"BZh", b"\xfd7zXZ", b"\x04\x22\x4d\x18")
_EXPECTED = (
    "expected a CARMEN log (FLASER or ROBOTLASER1 lines), a bag of ROS 1 or 2, MCAP, CSV, npz, or "
    "a log of BreezySLAM's; texts may be gz"
)


def open_log(
    path: str | os.PathLike[str], geometry: Geometry | None = None, topic: str | None = None
) -> ScanLog:
    """Open a log of scans with the reader for its content, or else for its name.

    Use it as a context manager and iterate over it once:

        with open_log("intel.log.gz") as log:
            for record in log:
                scene = extract(record.scan)

    Args:
        path: a CARMEN log, CSV or log of BreezySLAM's (text or gz), an npz archive, a ROS 1 bag,
            the folder or the .db3 or .mcap file of a ROS 2 bag.
        geometry: values that the format does not contain.
        topic: the scans' topic in a bag; None takes the only one.

    Raises:
        LogError: it is not a readable log; `TruncatedLogError` if nothing of it can be read.
        ImportError: it is a bag, and rosbags is not installed.
        OSError: it cannot be opened.
    """
    path, geometry = Path(path), geometry or Geometry()
    try:
        return _opened(path, geometry, topic)
    except DamageError:
        raise TruncatedLogError(
            f"{path} is truncated or damaged: nothing in it can be read; copy or download it again"
        ) from None


def _opened(path: Path, geometry: Geometry, topic: str | None) -> ScanLog:
    if path.is_dir():
        _check_folder(path)
        return RosLog(path, geometry, topic)
    text = TextFile(path)
    try:
        if text.head.startswith(_BAGS) and not text.compressed:
            text.close()
            return RosLog(path, geometry, topic)
        if topic is not None:
            raise LogError(f"{path} is not a bag and has no topics; leave out topic {topic!r}")
        if text.head.startswith(b"PK") and not text.compressed:
            text.close()
            return NpzLog(path, geometry)
        return _text_log(text, geometry)
    except BaseException:
        text.close()
        raise


def _text_log(text: TextFile, geometry: Geometry) -> ScanLog:
    _check(text)
    if is_carmen(text.head):
        return CarmenLog(text, geometry)
    suffix = Path(text.path.name.removesuffix(".gz")).suffix.lower()
    if is_breezyslam(text.head) or suffix == ".dat":
        return BreezySlamLog(text, geometry)
    if is_csv(text.head) or suffix == ".csv":
        return CsvLog(text, geometry)
    first = text.head.strip().split(b"\n")[0][:40].decode("ascii", "replace")
    raise LogError(f"{text.path} is not a log of scans (it begins with {first!r}); {_EXPECTED}")


def _check(text: TextFile) -> None:
    path, head = text.path, text.head
    if not head:
        raise LogError(f"{path} is empty; {_EXPECTED}")
    if head.startswith((*_BAGS, b"PK", *_COMPRESSED)):
        raise LogError(f"{path} is compressed as a whole; decompress it first")
    if head.startswith(b"\x93NUMPY"):
        raise LogError(
            f"{path} is a bare array; save it with its angles: "
            "np.savez(path, ranges=..., angle_min=..., angle_increment=...)"
        )
    if head.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise LogError(f"{path} is a text in UTF-16; save it in UTF-8")
    if b"\0" in head:
        raise LogError(f"{path} is a binary file; {_EXPECTED}")


def _check_folder(path: Path) -> None:
    if not any(next(path.glob(name), None) for name in ("metadata.yaml", "*.db3", "*.mcap")):
        fault = "a directory that is no ROS 2 bag: no metadata.yaml, .db3 or .mcap in it"
        raise IsADirectoryError(errno.EISDIR, fault, str(path))
