"""Readers of recorded scans, so that the extractor runs on a robot's own logs."""

from __future__ import annotations

import os

from semnav_env.features.readers.carmen import CarmenLog
from semnav_env.features.readers.carmen_lines import Geometry
from semnav_env.features.readers.log import LogError, LogRecord, ScanLog, TruncatedLogError

__all__ = [
    "CarmenLog",
    "Geometry",
    "LogError",
    "LogRecord",
    "ScanLog",
    "TruncatedLogError",
    "open_log",
]


def open_log(path: str | os.PathLike[str], geometry: Geometry | None = None) -> ScanLog:
    """Open a log of scans with the reader that its content asks for.

    Use it as a context manager and iterate over it once:

        with open_log("intel.log.gz") as log:
            for record in log:
                scene = extract(record.scan)

    Args:
        path: the file; CARMEN logs, as text or gzip-compressed.
        geometry: what the format leaves unsaid; by default that of a SICK LMS.

    Raises:
        LogError: the file is not a log that can be read.
        OSError: the file cannot be opened.
    """
    return CarmenLog(path, geometry)
