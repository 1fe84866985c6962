"""Checks whether the poses of a log are in metres and radians."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator

import numpy as np

from semnav_features.frames import Pose
from semnav_features.readers.log import LogRecord

FASTEST = 5.0
"""Speed that no indoor robot reaches, m/s."""

JUMP = 2.0
"""Longest motion from scan to scan whose speed is not checked, metres."""

JUMP_WITHOUT_TIME = 5.0
"""Longest motion from scan to scan in a log without times, metres; logs that were thinned out for
mapping have up to two."""

FROZEN_SCANS = 10
"""Number of scans with one and the same pose after which they are compared for motion."""

CHANGED_BY, CHANGED_BEAMS = 0.2, 0.4
"""Change of a range, metres, and share of the beams with such a change, beyond which the lidar has
moved: people who walk past a robot that stands hide fewer beams."""

_MOVED = 0.05
"""Least motion whose direction and speed count, metres; noise moves a robot that stands by less."""

_FEWEST_MOVES = 10
_FROM_SCANS = "find the poses from the scans (--poses match)"
_FULL_TURN = 2.0 * math.pi


class PoseCheck:
    """Checks the poses or the odometry of a log.

    Args:
        what: the checked values, in words.
        unit: what `LogRecord.line` counts.
    """

    def __init__(self, what: str, unit: str) -> None:
        self._what, self._unit = what, unit
        self._last: tuple[Pose, LogRecord] | None = None
        self._still: LogRecord | None = None
        self._still_scans = 0
        self._courses = Courses()
        self._moves = self._fast = 0
        self._jumps = 0
        self._first_jump = self._first_frozen = ""

    def look(self, pose: Pose, record: LogRecord) -> None:
        """Check the next pose."""
        self._courses.look(pose, record.line)
        if self._last is None or pose != self._last[0]:
            self._still, self._still_scans = record, 0
        self._look_at_still(record)
        if self._last is not None:
            self._look_at_step(self._last[0], pose, self._last[1], record)
        self._last = pose, record

    def notes(self) -> Iterator[str]:
        """The notes, one line each, with the begin of the error and advice."""
        if line := self._courses.in_degrees():
            yield (
                f"{self._unit} {line}: the heading of the {self._what} fits the way it moves only "
                "in degrees; give radians (divide by 57.2958)"
            )
        if self._fast > 0.5 * self._moves and self._moves >= _FEWEST_MOVES:
            yield (
                f"{self._first_jump}, and so do most; it must be in metres: divide centimetres by "
                "100, millimetres by 1000"
            )
        elif self._jumps:
            count = f" (the first of {self._jumps} jumps)" if self._jumps > 1 else ""
            yield f"{self._first_jump}{count}; cut the log there, or {_FROM_SCANS}"
        if self._first_frozen:
            yield self._first_frozen

    def _look_at_step(self, last: Pose, pose: Pose, before: LogRecord, record: LogRecord) -> None:
        step, seconds = math.dist(last[:2], pose[:2]), _seconds(before.stamp, record.stamp)
        if step < _MOVED:
            return
        self._courses.move(last, pose)
        self._moves += 1
        is_fast = step > FASTEST * seconds if seconds else step > JUMP_WITHOUT_TIME
        is_jump = is_fast and step > JUMP
        self._fast += is_fast
        self._jumps += is_jump
        if is_fast and (not self._first_jump or (is_jump and self._jumps == 1)):
            within = f" in {seconds:.3g} s" if seconds else ""
            self._first_jump = (
                f"{self._unit} {record.line}: the {self._what} jumps by {step:.4g} m{within}"
            )

    def _look_at_still(self, record: LogRecord) -> None:
        """Compare the scan with that at which the pose began to stand still."""
        self._still_scans += 1
        if self._first_frozen or self._still is None or self._still_scans % FROZEN_SCANS:
            return
        if _has_moved(self._still, record):
            self._first_frozen = (
                f"{self._unit} {self._still.line}: the {self._what} stands still while the scans "
                f"change, up to {self._unit} {record.line} and beyond; look whether it was "
                f"recorded, or {_FROM_SCANS}"
            )


class Courses:
    """Directions in which a robot moves, beside its headings, read as radians and as degrees.

    The angle between course and heading is nearly constant, or turned by half a turn where the
    robot backs up, so that the mean of exp(2i(course - heading)) is long in the right unit.
    """

    def __init__(self) -> None:
        self._moves = 0
        self._radians = self._degrees = 0j
        self._first_far = 0

    def look(self, pose: Pose, line: int) -> None:
        """Note the first heading of more than a turn."""
        if not self._first_far and abs(pose[2]) > _FULL_TURN:
            self._first_far = line

    def move(self, last: Pose, pose: Pose) -> None:
        """Take in a motion."""
        course = math.atan2(pose[1] - last[1], pose[0] - last[0])
        self._moves += 1
        self._radians += cmath.exp(2j * (course - pose[2]))
        self._degrees += cmath.exp(2j * (course - math.radians(pose[2])))

    def in_degrees(self) -> int:
        """Line of the first heading that shows that they are in degrees; 0 if they are not."""
        if self._moves < _FEWEST_MOVES:
            return 0
        radians, degrees = abs(self._radians) / self._moves, abs(self._degrees) / self._moves
        return self._first_far if degrees > 0.5 and degrees > radians + 0.2 else 0


def _seconds(before: float | None, now: float | None) -> float:
    """Time between two scans, seconds; 0 where it is not known."""
    return max(0.0, now - before) if before is not None and now is not None else 0.0


def _has_moved(before: LogRecord, now: LogRecord) -> bool:
    """Whether a large share of the beams, which returned in both scans, changed."""
    if len(before.scan.ranges) != len(now.scan.ranges):
        return False
    both = before.scan.valid & now.scan.valid
    changes = np.abs(before.scan.ranges[both] - now.scan.ranges[both])
    return bool((changes > CHANGED_BY).sum() > CHANGED_BEAMS * max(20, len(changes)))
