"""Readers of recorded scans, so that the extractor runs on a robot's own logs."""

from semnav_features.readers.geometry import Geometry
from semnav_features.readers.log import (
    LogError,
    LogReader,
    LogRecord,
    ScanLog,
    TruncatedLogError,
)
from semnav_features.readers.log_check import LogCheck
from semnav_features.readers.opening import open_log

__all__ = [
    "Geometry",
    "LogCheck",
    "LogError",
    "LogReader",
    "LogRecord",
    "ScanLog",
    "TruncatedLogError",
    "open_log",
]
