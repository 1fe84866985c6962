"""The hallway around a pose: its axis, its sides, its openings and its end.

Commands speak of hallways, so this is where walls become places. The scene is probed by a ray
every `SPACING` metres to the left and to the right of the hallway's axis, as a person would look
along both sides; what the rays meet first is the hallway's side. Works on perceived (remembered)
and true scenes alike.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from semnav_env.features.frames import (
    FloatArray,
    Point,
    Pose,
    points_to_local,
    to_local,
    to_parent,
    wrap_angle,
)
from semnav_env.features.kernels.hallway import dominant_heading, leads_out, probe, stepped_back
from semnav_env.features.scene import Door, Scene, Wall

SPACING = 0.1
"""Distance between probes along the axis, metres."""

BEHIND, AHEAD = 2.0, 40.0
"""How far the sides are probed behind and ahead of the pose, metres."""

REACH = 6.0
"""Length of a probe to the side, metres."""

OPENING_WIDTH = 1.35
"""A gap wider than this is an opening, a narrower one a doorway, metres."""

OPENING_DEPTH = 1.5
"""An opening is at least this deep; less is a recess, metres."""

SIDE_STEP = 0.8
"""A side may step back this far and still be the same side, metres."""

BODY_WIDTH = 0.7
"""A hallway ends where no lane of this width goes on, metres."""

LANE = 0.1
"""Distance between the probes along the axis that look for the end, metres."""


@dataclass(frozen=True, slots=True)
class Opening:
    """Where a side of the hallway gives way to another one.

    Attributes:
        left: on the left side, else on the right.
        near: where it begins along the axis, metres.
        far: where it ends along the axis, metres.
        offset: how far the side lies from the axis there, metres, positive.
    """

    left: bool
    near: float
    far: float
    offset: float

    @property
    def centre(self) -> float:
        """Its middle along the axis, metres."""
        return (self.near + self.far) / 2


@dataclass(frozen=True, slots=True)
class Junction:
    """One or two facing openings, and whether the hallway goes on behind them.

    Attributes:
        left: the opening to the left, if any.
        right: the opening to the right, if any.
        ahead: whether the hallway goes on.
    """

    left: Opening | None
    right: Opening | None
    ahead: bool

    @property
    def openings(self) -> tuple[Opening, ...]:
        """The openings there are."""
        return tuple(side for side in (self.left, self.right) if side is not None)

    @property
    def centre(self) -> float:
        """Its middle along the axis, metres."""
        return sum(side.centre for side in self.openings) / len(self.openings)

    @property
    def is_corner(self) -> bool:
        """A bend: one way on, and not straight ahead."""
        return not self.ahead and len(self.openings) == 1


@dataclass(frozen=True, eq=False)
class Hallway:
    """A hallway as seen from a pose.

    Attributes:
        frame: the axis: a pose on its centre line beside the pose asked for, looking along it.
        left: distance from the axis to the left side at each probe, shape (n,), inf if none seen.
        right: the same to the right.
        end: where the hallway ends along the axis, metres; inf if that is not seen.
        junctions: in order along the axis, those behind the pose included.
    """

    frame: Pose
    left: FloatArray
    right: FloatArray
    end: float
    junctions: tuple[Junction, ...]

    def along(self, point: Point) -> float:
        """Where a point lies along the axis, metres."""
        return to_local(self.frame, point)[0]

    def place(self, along: float, offset: float = 0.0, turn: float = 0.0) -> Pose:
        """The pose at a place along the axis, `offset` to its left, turned from its direction."""
        x, y = to_parent(self.frame, (along, offset))
        return x, y, wrap_angle(self.frame[2] + turn)

    def unseen(self, left: bool, start: float, stop: float, longer_than: float = 0.6) -> float:
        """Where along [start, stop] the first stretch begins of whose side nothing is seen.

        Openings count as seen. Returns inf if there is none longer than `longer_than` metres.
        """
        side = self.left if left else self.right
        run = 0.0
        for i in range(max(0, _probe(start)), min(len(side), _probe(stop))):
            along = i * SPACING - BEHIND
            known = math.isfinite(side[i]) or self._opening_at(left, along)
            run = 0.0 if known else run + SPACING
            if run > longer_than:
                return along - run + SPACING
        return math.inf

    def _opening_at(self, left: bool, along: float) -> bool:
        sides = (j.left if left else j.right for j in self.junctions)
        return any(o is not None and o.near - 0.2 <= along <= o.far + 0.2 for o in sides)


def _probe(along: float) -> int:
    return round((along + BEHIND) / SPACING)


def hallway(scene: Scene, pose: Pose) -> Hallway:
    """The hallway that a robot at `pose` looks along, in the scene's frame.

    Args:
        scene: walls and doors; doors close their gaps here, for they are no openings.
        pose: where and which way, in the scene's frame; the axis is the dominant direction of
            the walls around within 45 degrees of the heading.
    """
    walls = _segments(scene.walls)
    solid = np.concatenate((walls, _segments(scene.doors)))
    frame = (*pose[:2], dominant_heading(walls, *pose))
    frame = _centred(frame, *_profiles(_in_frame(solid, frame)))
    local, local_walls = _in_frame(solid, frame), _in_frame(walls, frame)
    left, right = _profiles(local)
    end = _end(local, _median(left), _median(right))
    openings = [
        *_openings(left, local_walls, True, end),
        *_openings(right, local_walls * (1, -1, 1, -1), False, end),
    ]
    return Hallway(frame, left, right, end, _junctions(openings, end))


def _segments(items: Iterable[Wall | Door]) -> FloatArray:
    return np.array([(*i.start, *i.end) for i in items], dtype=np.float64).reshape(-1, 4)


def _in_frame(segments: FloatArray, frame: Pose) -> FloatArray:
    return points_to_local(frame, segments.reshape(-1, 2, 2)).reshape(-1, 4)


def _profiles(local: FloatArray) -> tuple[FloatArray, FloatArray]:
    left, right = probe(local, -BEHIND, SPACING, round((AHEAD + BEHIND) / SPACING))
    left[left > REACH] = math.inf
    right[right > REACH] = math.inf
    return left, right


def _median(side: FloatArray) -> float:
    """The usual distance of a side within a few metres; `REACH` where nothing is seen."""
    near = side[: _probe(8.0)]
    near = near[np.isfinite(near)]
    return float(np.median(near)) if len(near) else REACH


def _centred(frame: Pose, left: FloatArray, right: FloatArray) -> Pose:
    """The axis moved to the middle, where both sides are seen."""
    distances = _median(left), _median(right)
    shift = 0.0 if max(distances) >= REACH else (distances[0] - distances[1]) / 2
    return (*to_parent(frame, (0.0, shift)), frame[2])


def _end(local: FloatArray, left: float, right: float) -> float:
    """The farthest that any lane as wide as a body goes on, metres."""
    lanes = max(1, int((left + right) / LANE) - 1)
    swapped = np.ascontiguousarray(local[:, [1, 0, 3, 2]])
    ahead, _ = probe(swapped, LANE - right, LANE, lanes)
    width = min(lanes, round(BODY_WIDTH / LANE))
    return float(np.lib.stride_tricks.sliding_window_view(ahead, width).min(axis=1).max())


def _openings(side: FloatArray, walls: FloatArray, left: bool, end: float) -> list[Opening]:
    """The stretches where a side steps back, if a wall leads out of one of their edges."""
    found = []
    for first, last, offset in stepped_back(side, SIDE_STEP, _median(side)):
        near, far = first * SPACING - BEHIND, last * SPACING - BEHIND
        far = min(far, end)
        seen = leads_out(walls, far, offset) or leads_out(walls, near, offset)
        if far - near >= OPENING_WIDTH and seen and _is_deep(side[first:last], offset):
            found.append(Opening(left, near, far, offset))
    return found


def _is_deep(stretch: FloatArray, offset: float) -> bool:
    return bool(np.median(stretch) > offset + OPENING_DEPTH)


def _junctions(openings: list[Opening], end: float) -> tuple[Junction, ...]:
    """Facing openings belong to one junction."""
    lefts = [o for o in openings if o.left]
    rights = [o for o in openings if not o.left]
    junctions = []
    for left in lefts:
        facing = next((r for r in rights if min(r.far, left.far) > max(r.near, left.near)), None)
        if facing is not None:
            rights.remove(facing)
        junctions.append(Junction(left, facing, left.far < end - 0.5))
    junctions += [Junction(None, right, right.far < end - 0.5) for right in rights]
    return tuple(sorted(junctions, key=lambda junction: junction.centre))
