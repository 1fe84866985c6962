"""How a driver passes doorways: angle, lateral offset, speed and corrections at each of them.

Barbret 2021, section 6.3, names the way in which an open door is approached as a measure of the
driving habits of people in wheelchairs.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from semnav_features.frames import (
    FloatArray,
    Point,
    Pose,
    distances_along,
    heading_between,
    middle_of,
    points_to_local,
    wrap_angle,
)

APPROACH_LENGTH, EXIT_LENGTH = 2.0, 1.0
"""Lengths of path before and behind a doorway that belong to a passage, metres."""

PASSED_DISTANCE = 0.3
"""Distance from the line of a doorway at which a robot is clearly on one side of it, metres."""

MIN_CORRECTION = math.radians(5.0)
"""Smallest change of heading against the last turn that is a correction, radians: odometry and
scan matching are noisy below."""

SPEED_SECONDS = 0.5
"""Time before and after the doorway over which the speed is taken, seconds."""


class PassableDoor(Protocol):
    """A door of a plan or of a map."""

    @property
    def name(self) -> str | None:
        """What to call it, if it has a name."""

    @property
    def start(self) -> Point:
        """One jamb, metres."""

    @property
    def end(self) -> Point:
        """The other jamb, metres."""


@dataclass(frozen=True)
class DoorPassage:
    """One passage of a robot's centre through a doorway.

    Attributes:
        door: name of the door; empty if it has none.
        seconds: time at which the centre was in the doorway.
        angle: heading less the direction square through the doorway, radians, positive to the left.
        offset: lateral distance of the centre from the middle of the doorway, metres, positive to
            the left.
        width: of the doorway, metres.
        speed: mean speed about the doorway, m/s; NaN if the times are not known.
        corrections: number of times that the turning changed its side on the last
            `APPROACH_LENGTH` metres before the doorway, each by `MIN_CORRECTION` or more.
        path: positions from the approach to the exit, shape (n, 2), in the frame of the doorway:
            origin in its middle, x square through it in the direction of travel, metres.
    """

    door: str
    seconds: float
    angle: float
    offset: float
    width: float
    speed: float
    corrections: int
    path: FloatArray = field(compare=False, repr=False)

    def row(self) -> dict[str, object]:
        """The passage as one flat object, without its path; NaN becomes None."""
        speed = None if math.isnan(self.speed) else self.speed
        names = ("door", "seconds", "angle", "offset", "width")
        told = {name: getattr(self, name) for name in names}
        return told | {"speed": speed, "corrections": self.corrections}


@dataclass(frozen=True)
class DrivingHabits:
    """Passages of one driver in numbers.

    Attributes:
        passages: how many.
        angle: median of the absolute angle, radians.
        angle_90: its 90th percentile, radians.
        offset: median of the absolute lateral offset, metres.
        offset_90: its 90th percentile, metres.
        speed: median speed, m/s; NaN if no times are known.
        corrections: mean number of corrections before a doorway.
    """

    passages: int
    angle: float
    angle_90: float
    offset: float
    offset_90: float
    speed: float
    corrections: float


def driving_habits(passages: Sequence[DoorPassage]) -> DrivingHabits:
    """The habits that passages show; NaN for every measure if there are none."""
    if not passages:
        return DrivingHabits(0, *[math.nan] * 6)
    angles, offsets = (np.abs([getattr(p, n) for p in passages]) for n in ("angle", "offset"))
    speeds = [p.speed for p in passages if not math.isnan(p.speed)]
    return DrivingHabits(
        len(passages),
        float(np.median(angles)),
        float(np.percentile(angles, 90)),
        float(np.median(offsets)),
        float(np.percentile(offsets, 90)),
        float(np.median(speeds)) if speeds else math.nan,
        float(np.mean([p.corrections for p in passages])),
    )


def door_passages(
    poses: FloatArray, seconds: FloatArray, doors: Iterable[PassableDoor]
) -> tuple[DoorPassage, ...]:
    """Every passage through a doorway, in the order of time.

    A robot passes where its centre crosses the line between the jambs and gets `PASSED_DISTANCE`
    beyond, or stops on that side. Who turns round in the doorway does not pass it.

    Args:
        poses: of the robot's centre, shape (n, 3), in the frame of the doors, metres and radians.
        seconds: time of each pose, shape (n,); NaN where it is not known.
        doors: of a plan or of a map.

    Raises:
        ValueError: there is not one time for each pose.
    """
    if len(poses) != len(seconds):
        raise ValueError(f"{len(seconds)} times for {len(poses)} poses; give one for each pose")
    if len(poses) < 2:
        return ()
    found = [
        _passage(poses, seconds, door, row, towards)
        for door in doors
        for row, towards in _crossings(poses[:, :2], door)
    ]
    return tuple(sorted(found, key=lambda passage: passage.seconds))


def _crossings(path: FloatArray, door: PassableDoor) -> Iterator[tuple[int, float]]:
    """Rows after which a path crosses a doorway for good, each with 1 if to the left of it, or -1.

    The left is that of the line from the door's start to its end.
    """
    start, along = np.array(door.start), np.subtract(door.end, door.start)
    width = float(np.hypot(*along))
    away = path - start
    left = (along[0] * away[:, 1] - along[1] * away[:, 0]) / width
    place = away @ along / width
    changes = (left[:-1] > 0.0) != (left[1:] > 0.0)
    share = np.divide(left[:-1], left[:-1] - left[1:], where=changes, out=np.zeros(len(changes)))
    at = place[:-1] + share * (place[1:] - place[:-1])
    rows = np.flatnonzero(changes & (at >= 0.0) & (at <= width))
    if not len(rows):
        return
    clear = np.flatnonzero(np.abs(left) >= PASSED_DISTANCE)
    for row in rows[np.append(np.diff(np.searchsorted(clear, rows, "right")) > 0, True)]:
        before, after = clear[clear <= row], clear[clear > row]
        came = left[before[-1]] if len(before) else left[0]
        went = left[after[0]] if len(after) else left[-1]
        if came * went < 0.0:
            yield int(row), math.copysign(1.0, went)


def _passage(
    poses: FloatArray, seconds: FloatArray, door: PassableDoor, row: int, towards: float
) -> DoorPassage:
    """The passage of a doorway between a row and the next one.

    Args:
        poses: of the robot.
        seconds: time of each.
        door: the doorway.
        row: the last one before it.
        towards: 1 if the robot comes to the left of the line from the door's start to its end.
    """
    through = heading_between(door.start, door.end) + towards * math.pi / 2
    doorway: Pose = (*middle_of(door.start, door.end), through)
    local = points_to_local(doorway, poses[:, :2])
    before, after = local[row], local[row + 1]
    share = float(before[0] / (before[0] - after[0])) if before[0] != after[0] else 0.0
    along = distances_along(local)
    here = along[row] + share * (along[row + 1] - along[row])
    first = int(np.searchsorted(along, here - APPROACH_LENGTH))
    last = int(np.searchsorted(along, here + EXIT_LENGTH, "right"))
    time = float(seconds[row] + share * (seconds[row + 1] - seconds[row]))
    return DoorPassage(
        door.name or "",
        time,
        wrap_angle(float(poses[row, 2]) - through),
        float(before[1] + share * (after[1] - before[1])),
        math.dist(door.start, door.end),
        _speed(along, seconds, time),
        count_reversals(np.unwrap(poses[first : row + 1, 2]), MIN_CORRECTION),
        local[first:last],
    )


def _speed(along: FloatArray, seconds: FloatArray, time: float) -> float:
    """Mean speed about a time, m/s; NaN if the times are not known."""
    near = np.flatnonzero(np.abs(seconds - time) <= SPEED_SECONDS)
    if len(near) < 2 or seconds[near[-1]] <= seconds[near[0]]:
        return math.nan
    return float((along[near[-1]] - along[near[0]]) / (seconds[near[-1]] - seconds[near[0]]))


def count_reversals(values: FloatArray, least: float) -> int:
    """Number of times that values turn back, each time by `least` or more from their extreme."""
    count, direction = 0, 0
    lowest = highest = float(values[0])  # since the last turning point
    for value in values.tolist():
        lowest, highest = min(lowest, value), max(highest, value)
        falls = direction >= 0 and highest - value >= least
        rises = direction <= 0 and value - lowest >= least
        if falls or rises:
            count += direction != 0
            direction = 1 if rises else -1
            lowest = highest = value
    return count
