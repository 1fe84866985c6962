"""Readers of recorded scans, so that the extractor runs on a robot's own logs."""

from semnav_env.features.readers.geometry import Geometry
from semnav_env.features.readers.log import LogError, LogRecord, ScanLog, TruncatedLogError
from semnav_env.features.readers.opening import open_log

__all__ = ["Geometry", "LogError", "LogRecord", "ScanLog", "TruncatedLogError", "open_log"]
