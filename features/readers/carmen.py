"""Logs of the CARMEN toolkit, as text or gzip-compressed: one record per front laser scan."""

from __future__ import annotations

import gzip
import io
import os
import re
import zlib
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import Self, TypeAlias

from semnav_env.features.frames import Pose
from semnav_env.features.readers.carmen_lines import (
    BadLineError,
    Geometry,
    parse_flaser,
    parse_odometry,
    parse_robotlaser,
)
from semnav_env.features.readers.log import LogError, LogRecord, TruncatedLogError

_Text: TypeAlias = io.BufferedReader | gzip.GzipFile

_DAMAGED = (EOFError, gzip.BadGzipFile, zlib.error)
_LONGEST_LINE = 1 << 20
_SCANS = {b"FLASER": parse_flaser, b"ROBOTLASER1": parse_robotlaser}
_MESSAGE = re.compile(rb"[A-Z][A-Z0-9_]*\Z")
_TELLTALE = re.compile(
    rb"^\s*(# CARMEN|# message|(PARAM|SYNC|ODOM|TRUEPOS|NEFF|[FR]LASER|(ROBOT|RAW)LASER\d)\s)",
    re.MULTILINE,
)


class CarmenLog:
    """An open CARMEN log; see `ScanLog`.

    FLASER and ROBOTLASER1 lines give records, ODOM lines the odometry of those that follow.
    Other messages are passed over silently, lines that cannot be read are counted in `bad`.

    Args:
        path: a text file, gzip-compressed or not.
        geometry: what the lines leave unsaid.

    Raises:
        LogError: empty, binary, or not a CARMEN log; while iterating, if there is no scan.
        TruncatedLogError: while iterating, after the last readable record, if the compressed
            data end too early or are damaged.
        OSError: the file cannot be opened.
    """

    def __init__(self, path: str | os.PathLike[str], geometry: Geometry | None = None) -> None:
        self.path = Path(path)
        self.scans = 0
        self.bad: Counter[str] = Counter()
        self.first_bad: dict[str, int] = {}
        self._geometry = geometry or Geometry()
        self._file = open(self.path, "rb")  # noqa: SIM115 - closed by __exit__ or at the end
        try:
            self._size = os.fstat(self._file.fileno()).st_size
            self._text = _decompressed(self._file)
            _check_head(self.path, self._text)
        except BaseException:
            self._file.close()
            raise

    @property
    def fraction(self) -> float | None:
        """How much of the file has been read, 0 to 1; None where its size is unknown."""
        if not self._size or self._file.closed:
            return None
        return min(1.0, self._file.tell() / self._size)

    def __iter__(self) -> Iterator[LogRecord]:
        """The records that are left, in the order of the log."""
        try:
            yield from self._records()
        except _DAMAGED:
            raise TruncatedLogError(
                f"{self.path} is truncated or damaged: its compressed data could be read up to "
                f"scan {self.scans}; copy or download the file again"
            ) from None
        if not self.scans:
            raise LogError(
                f"{self.path} holds no laser scan; expected FLASER or ROBOTLASER1 lines"
                + "".join(f"; {n} x {reason}" for reason, n in self.bad.most_common(3))
            )

    def __enter__(self) -> Self:
        """The log itself."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the file."""
        self._file.close()

    def _records(self) -> Iterator[LogRecord]:
        odometry: Pose | None = None
        for number, line in enumerate(_lines(self._text), start=1):
            fields = line.split()
            tag = fields[0] if fields else b"#"
            try:
                if parse := _SCANS.get(tag):
                    scan, pose = parse(fields, self._geometry)
                    self.scans += 1
                    yield LogRecord(scan, pose, odometry, number)
                elif tag == b"ODOM":
                    odometry = parse_odometry(fields)
                elif not tag.startswith(b"#") and not _MESSAGE.match(tag):
                    raise BadLineError("not a CARMEN message")
            except BadLineError as error:
                self._count_bad(tag, str(error), number)

    def _count_bad(self, tag: bytes, fault: str, number: int) -> None:
        named = tag == b"ODOM" or tag in _SCANS
        reason = f"{tag.decode()}: {fault}" if named else fault
        self.bad[reason] += 1
        self.first_bad.setdefault(reason, number)


def _decompressed(file: io.BufferedReader) -> _Text:
    return gzip.GzipFile(fileobj=file) if file.peek(2)[:2] == b"\x1f\x8b" else file


def _check_head(path: Path, text: _Text) -> None:
    expected = "expected a CARMEN log, text or gz, with FLASER or ROBOTLASER1 lines"
    try:
        head = text.peek(_LONGEST_LINE)
    except _DAMAGED:
        raise TruncatedLogError(
            f"{path} is truncated or damaged: nothing in its compressed data can be read; "
            "copy or download the file again"
        ) from None
    if not head:
        raise LogError(f"{path} is empty; {expected}")
    if b"\0" in head:
        raise LogError(f"{path} is a binary file; {expected}")
    if not _TELLTALE.search(head):
        first = head.strip().split(b"\n")[0][:40].decode("ascii", "replace")
        raise LogError(f"{path} is not a log of scans (it begins with {first!r}); {expected}")


def _lines(text: _Text) -> Iterator[bytes]:
    """The lines; "-", which is no message, for each that is longer than a megabyte."""
    while line := text.readline(_LONGEST_LINE):
        whole = len(line) < _LONGEST_LINE
        while len(line) == _LONGEST_LINE and not line.endswith(b"\n"):
            line = text.readline(_LONGEST_LINE)
        yield line if whole else b"-"
