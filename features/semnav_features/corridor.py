"""The corridor around a pose: its axis, its sides, its openings and its end.

Commands name corridors, so this module turns walls into places. Rays to the left and to the right
of the corridor's axis probe the scene; the first thing that a ray meets is the corridor's side.
Perceived (remembered) and true scenes are treated alike.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray, Point, Pose, to_local, to_parent, wrap_angle
from semnav_features.kernels.corridor_rays import PROBE_SPACING, PROBED_BEHIND, first_gap
from semnav_features.kernels.corridor_survey import (
    PROBE_COUNT,
    axis_along,
    axis_heading,
    stands_in,
    write_survey,
)
from semnav_features.kernels.side_openings import MAX_OPENINGS, OPENING
from semnav_features.scene import Door, Scene, StillScene, known_ends, which_are_named

MIN_CONTINUATION = 1.2
"""Least length of a corridor behind a junction for it to continue there, metres."""

MAX_KNOWN_VIEWS = 256
"""Number of corridors that are kept for a scene that never changes: the same pose occurs again
while commands are tried and judged there."""


class SideOpening(NamedTuple):
    """An opening in a side of the corridor.

    Attributes:
        left: whether it is on the left side, else on the right.
        near: where it begins along the axis, metres.
        far: where it ends along the axis, metres.
        offset: distance of the side from the axis there, metres, positive.
    """

    left: bool
    near: float
    far: float
    offset: float

    @property
    def centre(self) -> float:
        """Its middle along the axis, metres."""
        return (self.near + self.far) / 2


class Junction(NamedTuple):
    """One or two facing openings, and whether the corridor continues behind them.

    Attributes:
        left: the opening to the left, if any.
        right: the opening to the right, if any.
        ahead: whether the corridor continues.
    """

    left: SideOpening | None
    right: SideOpening | None
    ahead: bool

    @property
    def openings(self) -> tuple[SideOpening, ...]:
        """The existing openings."""
        return tuple(side for side in (self.left, self.right) if side is not None)

    @property
    def centre(self) -> float:
        """Its middle along the axis, metres."""
        if self.left is not None and self.right is not None:
            return (self.left.centre + self.right.centre) / 2
        return self.openings[0].centre

    @property
    def far(self) -> float:
        """Where it ends along the axis, metres."""
        return max(side.far for side in self.openings)

    @property
    def is_corner(self) -> bool:
        """Whether it is a bend: the corridor continues in one direction, and not straight ahead."""
        return not self.ahead and len(self.openings) == 1


@dataclass(frozen=True, eq=False)
class Corridor:
    """A corridor as seen from a pose.

    Attributes:
        frame: the axis: a pose on its centre line beside the pose asked for, looking along it.
        left: distance from the axis to the left side at each probe, shape (n,); inf where it is
            not seen, has a gap or an opening, and beyond the corridor's ends.
        right: the same to the right.
        half_width: typical distance from the axis to the sides, metres.
        end: where the corridor ends along the axis, metres; inf if that is not seen.
        openings: of both sides, dtype `OPENING`, each side's in order along the axis.
    """

    frame: Pose
    left: FloatArray
    right: FloatArray
    half_width: float
    end: float
    openings: np.ndarray

    @cached_property
    def junctions(self) -> tuple[Junction, ...]:
        """The junctions in order along the axis, including those behind the pose."""
        return _junctions(_openings(self.openings), self.end)

    def along(self, point: Point) -> float:
        """Position of a point along the axis, metres."""
        return to_local(self.frame, point)[0]

    def place(self, along: float, offset: float = 0.0, heading_change: float = 0.0) -> Pose:
        """The pose at a place along the axis, `offset` metres to its left.

        Its heading is that of the axis plus `heading_change`, radians.
        """
        x, y = to_parent(self.frame, (along, offset))
        return x, y, wrap_angle(self.frame[2] + heading_change)

    def side_at(self, left: bool, along: float) -> float:
        """Distance from the axis to a side, metres; inf where there is none."""
        side, probe = self.left if left else self.right, _probe(along)
        return float(side[probe]) if 0 <= probe < len(side) else math.inf

    def unseen(self, left: bool, start: float, stop: float, longer_than: float = 0.6) -> float:
        """Position in [start, stop] at which the first part begins that may hide a door, metres.

        Such a part is longer than `longer_than` metres, and neither a side nor an opening is seen
        there. The result is infinite if there is none.
        """
        side = (self.left if left else self.right).copy()
        for junction in self.junctions:
            opening = junction.left if left else junction.right
            if opening is not None:
                side[max(0, _probe(opening.near - 0.2)) : _probe(opening.far + 0.2)] = 0.0
        gap = first_gap(side, _probe(start), _probe(stop), round(longer_than / PROBE_SPACING))
        return math.inf if gap < 0 else gap * PROBE_SPACING - PROBED_BEHIND


class CorridorAxis(NamedTuple):
    """The axis of a corridor, without its sides and openings; see `Corridor`."""

    frame: Pose
    half_width: float
    end: float


def _probe(along: float) -> int:
    return round((along + PROBED_BEHIND) / PROBE_SPACING)


def corridor_at(scene: Scene, pose: Pose) -> Corridor:
    """The corridor that a robot at `pose` faces along, in the scene's frame.

    Args:
        scene: walls and doors. A door closes its gap here, as it is no opening of the corridor;
            except a door in which the robot stands, looking through it, and a perceived door
            (without a name) across the corridor where that only narrows.
        pose: in the scene's frame. The axis is the direction within 45 degrees of the heading
            along which most of the wall in view runs.
    """
    if not isinstance(scene, StillScene):
        walls, doors = known_ends(scene.walls), known_ends(scene.doors)
        return corridor_along(walls, doors, which_are_named(scene.doors), pose)
    views = scene.known_views
    if pose not in views:
        if len(views) >= MAX_KNOWN_VIEWS:
            views.clear()
        views[pose] = corridor_along(
            scene.wall_ends, scene.door_ends, scene.named_doors, pose, scene.opening_slack
        )
    known: Corridor = views[pose]
    return known


def corridor_along(
    walls: FloatArray,
    doors: FloatArray,
    named: NDArray[np.bool_],
    pose: Pose,
    opening_slack: float = 0.0,
) -> Corridor:
    """Survey a corridor like `corridor_at`, from arrays.

    Args:
        walls: x and y of both ends, metres, shape (n, 4).
        doors: the same of the jambs, shape (m, 4).
        named: which doors are known to be doors, shape (m,).
        pose: in the same frame.
        opening_slack: added to the least lengths of openings, metres.
    """
    sides, openings = np.empty((2, PROBE_COUNT)), np.empty(MAX_OPENINGS, OPENING)
    x, y, heading = map(float, pose)
    told = walls, doors, named, (x, y, heading)
    frame, half_width, end, count = write_survey(*told, sides, openings, float(opening_slack))
    frame = frame[0], frame[1], wrap_angle(frame[2])
    return Corridor(frame, sides[0], sides[1], half_width, end, openings[:count])


def openings_at(scene: StillScene, pose: Pose) -> list[SideOpening]:
    """The openings of the corridor of `corridor_at`; nothing is cached."""
    return _openings(
        corridor_along(scene.wall_ends, scene.door_ends, scene.named_doors, pose).openings
    )


def axis_at(scene: StillScene, pose: Pose) -> CorridorAxis:
    """The axis of the corridor of `corridor_at`, in half the time."""
    solid, axis = axis_heading(scene.wall_ends, scene.door_ends, scene.named_doors, pose)
    (x, y, heading), _, end, left, right, _ = axis_along(solid, *pose[:2], axis)
    return CorridorAxis((x, y, wrap_angle(heading)), 0.5 * (left + right), end)


def doorway_at(scene: Scene, pose: Pose) -> Door | None:
    """The door in which a robot at `pose` stands and faces through; None if there is none."""
    for k, ends in enumerate(known_ends(scene.doors)):
        if stands_in(ends, *map(float, pose)):
            return scene.doors[k]
    return None


def _openings(rows: np.ndarray) -> list[SideOpening]:
    return [SideOpening._make(row) for row in rows.tolist()]


def _junctions(openings: list[SideOpening], end: float) -> tuple[Junction, ...]:
    """Join openings into junctions; facing openings belong to one junction."""
    last = end - MIN_CONTINUATION
    lefts = [o for o in openings if o.left]
    rights = [o for o in openings if not o.left]
    junctions = []
    for left in lefts:
        facing = next((r for r in rights if min(r.far, left.far) > max(r.near, left.near)), None)
        if facing is not None:
            rights.remove(facing)
        far = left.far if facing is None else max(left.far, facing.far)
        junctions.append(Junction(left, facing, far < last))
    junctions += [Junction(None, right, right.far < last) for right in rights]
    return tuple(sorted(junctions, key=lambda junction: junction.centre))
