"""Checks the times of a log for falls and standstills."""

from __future__ import annotations

from collections.abc import Iterator

from semnav_features.readers.log import LogRecord

DEEP_FALL = 1.0
"""Fall of the time beyond which there is a note, seconds; corrected clocks fall by less."""

MANY_FALLS = 0.01
"""Share of scans beyond which smaller falls give a note, too."""

STANDING_SCANS = 10
"""Number of successive scans with one and the same time from which on a note is made."""


class StampCheck:
    """Checks the times of a log; scans without a time, or with the time 0, are ignored.

    Args:
        unit: what `LogRecord.line` counts.
    """

    def __init__(self, unit: str) -> None:
        self._unit = unit
        self._last = 0.0
        self._scans = self._falls = 0
        self._deepest = 0.0
        self._first_fall = self._first_still = 0
        self._standing = self._longest = self._longest_from = 0

    def look(self, record: LogRecord) -> None:
        """Check the next time."""
        if not (now := record.stamp):
            return
        fall = self._last - now if self._scans else 0.0
        self._scans += 1
        if fall > 0.0:
            self._falls += 1
            self._first_fall = self._first_fall or record.line
            self._deepest = max(self._deepest, fall)
        self._look_at_standing(now == self._last, record.line)
        self._last = now

    def _look_at_standing(self, stands: bool, line: int) -> None:
        if not stands:
            self._standing, self._first_still = 0, line
        self._standing += 1
        if self._standing > self._longest:
            self._longest, self._longest_from = self._standing, self._first_still

    def notes(self) -> Iterator[str]:
        """The notes, one line each, with the begin of the error and advice."""
        if self._deepest > DEEP_FALL or self._falls > max(1, MANY_FALLS * self._scans):
            yield (
                f"{self._unit} {self._first_fall}: the time falls (the first of {self._falls} "
                f"falls in {self._scans} scans, by up to {self._deepest:.3g} s); sort the log by "
                "time, or take the scanner's clock"
            )
        if self._longest >= STANDING_SCANS:
            yield (
                f"{self._unit} {self._longest_from}: the time stands for {self._longest} scans; "
                "write it with all its digits, or leave it out"
            )
