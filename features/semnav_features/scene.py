"""A scene: the walls, doors, corners, corridors and arcs that a scan or a map shows.

The extractor and the floor plan give the same types, so perceived and true scenes can be
compared and the same grounding serves both.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from semnav_features.elements import (
    Arc,
    Corner,
    CornerKind,
    CorridorProbe,
    Door,
    Rejection,
    SceneLeaf,
    Wall,
)
from semnav_features.frames import FloatArray, Point, Pose, to_local, to_parent

__all__ = [
    "Arc",
    "Corner",
    "CornerKind",
    "CorridorProbe",
    "Door",
    "PlainWalls",
    "Rejection",
    "RememberedDoors",
    "Scene",
    "SceneLeaf",
    "StillScene",
    "Wall",
    "ends_of",
]

_Item = TypeVar("_Item", Wall, Door, Corner, CorridorProbe, Arc, Rejection)


_WallOrDoor = TypeVar("_WallOrDoor", bound=Wall | Door, covariant=True)


class _MadeFromEnds(Sequence[_WallOrDoor]):
    """Walls or doors that are made on first access; it equals the tuple of them."""

    ends: FloatArray

    def __len__(self) -> int:
        return len(self.ends)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and tuple(self) == tuple(other)

    def __hash__(self) -> int:
        return hash(tuple(self))

    def __repr__(self) -> str:
        return repr(tuple(self))


class PlainWalls(_MadeFromEnds[Wall]):
    """Walls of which only the ends are stored; a `Wall` is made on access.

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


class RememberedDoors(_MadeFromEnds[Door]):
    """Doors of a memory; a `Door` is made on first access, and kept.

    Args:
        ends: x and y of start and end, metres, shape (n, 4); not copied.
        beliefs: log-odds of being a door, and number of sightings, shape (n, 2).
    """

    def __init__(self, ends: FloatArray, beliefs: FloatArray) -> None:
        self.ends, self._beliefs = ends, beliefs
        self._made: list[Door | None] = [None] * len(ends)

    @overload
    def __getitem__(self, index: int) -> Door: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[Door, ...]: ...

    def __getitem__(self, index: int | slice) -> Door | tuple[Door, ...]:
        if isinstance(index, slice):
            return tuple(self)[index]
        if (door := self._made[index]) is None:
            x1, y1, x2, y2 = self.ends[index].tolist()
            odds, sightings = self._beliefs[index].tolist()
            confidence = 1.0 / (1.0 + math.exp(-odds))
            door = Door((x1, y1), (x2, y2), sightings=int(sightings), confidence=confidence)
            self._made[index] = door
        return door


@dataclass(frozen=True, slots=True)
class Scene:
    """Walls, doors, corners, corridors and arcs in one frame, metres.

    A scene from `extract` is in the frame of the scan; `placed` and `seen_from` change frames.
    `rejections` are the rejected candidates, if they were requested.
    """

    walls: Sequence[Wall] = ()
    doors: Sequence[Door] = ()
    corners: Sequence[Corner] = ()
    corridors: Sequence[CorridorProbe] = ()
    arcs: Sequence[Arc] = ()
    rejections: tuple[Rejection, ...] = ()

    def placed(self, frame: Pose) -> Scene:
        """The scene in the parent frame, given the pose of its own frame there."""
        return self._moved(lambda point: to_parent(frame, point))

    def seen_from(self, pose: Pose) -> Scene:
        """The scene in the frame of `pose`, a pose in the scene's own frame."""
        return self._moved(lambda point: to_local(pose, point))

    def _moved(self, move: Callable[[Point], Point]) -> Scene:
        return Scene(
            tuple([_moved(w, move, "start", "end", "centroid") for w in self.walls]),
            tuple([_moved(d, move, "start", "end") for d in self.doors]),
            tuple([_moved(c, move, "point") for c in self.corners]),
            tuple([_moved(c, move, "start", "end") for c in self.corridors]),
            tuple([_moved(a, move, "centre", "start", "end") for a in self.arcs]),
            tuple([_moved(r, move, "start", "end") for r in self.rejections]),
        )


@dataclass(frozen=True)
class StillScene(Scene):
    """A scene that never changes, such as that of a floor plan; frequent results are kept.

    Attributes:
        opening_slack: added to the least lengths of openings of corridors, metres: it shows
            whether an answer depends on these limits.
    """

    opening_slack: float = 0.0

    @cached_property
    def wall_ends(self) -> FloatArray:
        """`ends_of` the walls."""
        return ends_of(self.walls)

    @cached_property
    def door_ends(self) -> FloatArray:
        """`ends_of` the doors."""
        return ends_of(self.doors)

    @cached_property
    def named_doors(self) -> NDArray[np.bool_]:
        """The doors that have a name."""
        return which_are_named(self.doors)

    @cached_property
    def known_views(self) -> dict[Pose, Any]:
        """Corridors that were last found from a pose."""
        return {}

    @cached_property
    def known_doors(self) -> dict[Any, Any]:
        """The doors that were last counted along a corridor, by some rules."""
        return {}


def _moved(item: _Item, move: Callable[[Point], Point], *points: str) -> _Item:
    """The item with some of its points moved; a point that is None stays None."""
    places: dict[str, Any] = {
        name: move(point) for name in points if (point := getattr(item, name)) is not None
    }
    return replace(item, **places)


def ends_of(items: Iterable[Wall | Door]) -> FloatArray:
    """Coordinates x and y of start and end of walls or doors, shape (n, 4), metres."""
    if isinstance(items, _MadeFromEnds):
        return items.ends.copy()
    flat = [value for item in items for point in (item.start, item.end) for value in point]
    return np.array(flat, dtype=np.float64).reshape(-1, 4)


def known_ends(items: Iterable[Wall | Door]) -> FloatArray:
    """Like `ends_of`, for reading only: an array that the walls or doors may own, not a copy."""
    ends: FloatArray | None = getattr(items, "ends", None)
    return ends_of(items) if ends is None else ends


def which_are_named(doors: Sequence[Door]) -> NDArray[np.bool_]:
    """Mask of the doors with a name, shape (n,): those of a floor plan."""
    if type(doors) is RememberedDoors:
        return np.zeros(len(doors.ends), np.bool_)
    return np.array([door.name is not None for door in doors], dtype=np.bool_)
