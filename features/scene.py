"""What a scan or a map says in words: walls, doors, corners and corridors.

The extractor and the floor plan give the same types, so perceived and true scenes can be
compared and the same grounding serves both.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from enum import IntEnum
from typing import overload

import numpy as np

from semnav_env.features.frames import FloatArray, Point, Pose, to_local, to_parent


class CornerKind(IntEnum):
    """The corner types of Barbret 2021, section 3.2.1."""

    OUTER = 0
    INNER = 1
    POTENTIAL = 2


@dataclass(frozen=True, slots=True)
class Wall:
    """A straight wall, directed so that its free side, where the scanner is, lies to its left.

    Attributes:
        start: first end, (x, y) in metres.
        end: last end.
        start_rupture: the beam before the start had no usable return.
        end_rupture: the beam after the end had no usable return.
        start_break: the range jumps before the start.
        end_break: the range jumps after the end.
        beams: how many beams support the wall; 0 for a wall of a floor plan.
        residual: root mean square distance of its points to the line, metres.
    """

    start: Point
    end: Point
    start_rupture: bool = False
    end_rupture: bool = False
    start_break: bool = False
    end_break: bool = False
    beams: int = 0
    residual: float = 0.0

    @property
    def length(self) -> float:
        """Metres."""
        return math.dist(self.start, self.end)

    @property
    def heading(self) -> float:
        """Direction from start to end, radians (Barbret (1.6))."""
        return math.atan2(self.end[1] - self.start[1], self.end[0] - self.start[0])


class PlainWalls(Sequence[Wall]):
    """Walls of which only the ends are known; a `Wall` is made when it is asked for.

    A memory and a floor plan hold hundreds of walls, and grounding needs only their ends.

    Args:
        ends: x and y of start and end, metres, shape (n, 4); not copied.
    """

    def __init__(self, ends: FloatArray) -> None:
        self.ends = ends

    @overload
    def __getitem__(self, index: int) -> Wall: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[Wall, ...]: ...

    def __getitem__(self, index: int | slice) -> Wall | tuple[Wall, ...]:
        if isinstance(index, slice):
            return tuple(PlainWalls(self.ends[index]))
        x1, y1, x2, y2 = self.ends[index].tolist()
        return Wall((x1, y1), (x2, y2))

    def __len__(self) -> int:
        return len(self.ends)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and tuple(self) == tuple(other)

    def __hash__(self) -> int:
        return hash(tuple(self))


@dataclass(frozen=True, slots=True)
class Door:
    """An open doorway: the gap from the end of one wall to the start of the next.

    Attributes:
        start: the jamb where a wall ends, (x, y) in metres.
        end: the jamb where the next wall starts; the scanner is on the left of start-end.
        name: the door's name in its floor plan; None for a perceived door.
        sightings: in how many scans it was seen; 1 in a single scan's scene.
    """

    start: Point
    end: Point
    name: str | None = None
    sightings: int = 1

    @property
    def midpoint(self) -> Point:
        """Middle of the opening, (x, y) in metres."""
        return (self.start[0] + self.end[0]) / 2, (self.start[1] + self.end[1]) / 2

    @property
    def width(self) -> float:
        """Distance between the jambs, metres."""
        return math.dist(self.start, self.end)


@dataclass(frozen=True, slots=True)
class Corner:
    """Where two walls meet, or where one may turn out of sight.

    Attributes:
        point: (x, y) in metres.
        kind: inner and outer as in Barbret (3.1); potential at a rupture or break.
    """

    point: Point
    kind: CornerKind


@dataclass(frozen=True, slots=True)
class Corridor:
    """An entrance to or a cross-section of a corridor: the probe from a corner to a wall.

    Attributes:
        start: the corner that was probed from, (x, y) in metres.
        end: where the probe met another wall.
    """

    start: Point
    end: Point

    @property
    def midpoint(self) -> Point:
        """Where a robot would pass, (x, y) in metres."""
        return (self.start[0] + self.end[0]) / 2, (self.start[1] + self.end[1]) / 2


@dataclass(frozen=True, slots=True)
class Scene:
    """Walls, doors, corners and corridors in one frame, metres.

    A scene from `extract` is in the frame of the scan; `placed` and `seen_from` change frames.
    """

    walls: Sequence[Wall] = ()
    doors: tuple[Door, ...] = ()
    corners: tuple[Corner, ...] = ()
    corridors: tuple[Corridor, ...] = ()

    def placed(self, frame: Pose) -> Scene:
        """The scene in the parent frame, given the pose of its own frame there."""
        return self._moved(lambda point: to_parent(frame, point))

    def seen_from(self, pose: Pose) -> Scene:
        """The scene in the frame of `pose`, a pose in the scene's own frame."""
        return self._moved(lambda point: to_local(pose, point))

    def _moved(self, move: Callable[[Point], Point]) -> Scene:
        return Scene(
            tuple(replace(w, start=move(w.start), end=move(w.end)) for w in self.walls),
            tuple(replace(d, start=move(d.start), end=move(d.end)) for d in self.doors),
            tuple(replace(c, point=move(c.point)) for c in self.corners),
            tuple(replace(c, start=move(c.start), end=move(c.end)) for c in self.corridors),
        )


def ends_of(items: Iterable[Wall | Door]) -> FloatArray:
    """Coordinates x and y of start and end of walls or doors, shape (n, 4), metres."""
    if isinstance(items, PlainWalls):
        return items.ends.copy()
    flat = [value for item in items for point in (item.start, item.end) for value in point]
    return np.array(flat, dtype=np.float64).reshape(-1, 4)
