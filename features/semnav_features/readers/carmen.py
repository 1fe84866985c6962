"""Logs of the CARMEN toolkit: one record per front laser scan."""

from __future__ import annotations

import re
from collections.abc import Iterator

from semnav_features.frames import Pose
from semnav_features.readers.carmen_lines import (
    parse_flaser,
    parse_odometry,
    parse_robotlaser,
)
from semnav_features.readers.geometry import Geometry
from semnav_features.readers.log import BadRecordError, LogRecord
from semnav_features.readers.text import TextFile, TextLog

_SCANS = {b"FLASER": parse_flaser, b"ROBOTLASER1": parse_robotlaser}
_MESSAGE = re.compile(rb"[A-Z][A-Z0-9_]*\Z")
_TELLTALE = re.compile(
    rb"^\s*(# CARMEN|# message|(PARAM|SYNC|ODOM|TRUEPOS|NEFF|[FR]LASER|(ROBOT|RAW)LASER\d)\s)",
    re.MULTILINE,
)


def is_carmen(head: bytes) -> bool:
    """Whether a text that begins so is a CARMEN log."""
    return _TELLTALE.search(head) is not None


class CarmenLog(TextLog):
    """An open CARMEN log; see `ScanLog`.

    FLASER and ROBOTLASER1 lines give records, ODOM lines the odometry of those that follow.
    Other messages are ignored, and lines that cannot be read are counted in `bad`.

    Args:
        text: the file.
        geometry: values that the lines do not contain.
    """

    expected = "FLASER or ROBOTLASER1 lines"

    def __init__(self, text: TextFile, geometry: Geometry) -> None:
        super().__init__(text)
        self._geometry = geometry

    def records(self) -> Iterator[LogRecord]:
        """The records that are left."""
        odometry: Pose | None = None
        for number, line in self._text.lines():
            fields = line.split()
            tag = fields[0] if fields else b"#"
            try:
                if parse := _SCANS.get(tag):
                    scan, pose = parse(fields, self._geometry)
                    yield LogRecord(scan, pose, odometry, number)
                elif tag == b"ODOM":
                    odometry = parse_odometry(fields)
                elif not tag.startswith(b"#") and not _MESSAGE.match(tag):
                    raise BadRecordError("not a CARMEN message")
            except BadRecordError as error:
                named = tag == b"ODOM" or tag in _SCANS
                self.count_bad(f"{tag.decode()}: {error}" if named else str(error), number)
