"""Walls that a robot has bumped into without seeing them: glass, and what no beam looks at."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from semnav_env.features.frames import (
    Contact,
    FloatArray,
    Point,
    Pose,
    compose,
    to_local,
    to_parent,
)
from semnav_env.features.lidar_spec import LidarSpec
from semnav_env.features.scene import Door, PlainWalls, Scene, ends_of
from semnav_env.grounding.crossing import first_crossed

MOST_PIECES = 16
"""When so many pieces are known, a new one replaces the oldest."""


@dataclass(frozen=True)
class BumpLimits:
    """What a contact tells.

    Attributes:
        piece_length: length of wall that one contact tells of, metres.
        least_growth: a contact is new if it makes a known piece longer by this, metres.
        piece_gap: pieces nearer to one another are one, metres: no robot gets between them.
        line_offset: largest distance of two pieces from one line, metres: odometry drifts.
        line_slope: largest slope between two pieces on one line, as a tangent.
        look_depth: the place to look for is this far inside what was touched, metres.
        seen_depth: it is seen if a beam ends at most this far behind that place, metres.
        seen_beams: beams to each side that are asked as well.
        opening_overlap: a piece this far inside the opening of a door shows that it is no door,
            metres.
    """

    piece_length: float = 0.2
    least_growth: float = 0.05
    piece_gap: float = 0.45
    line_offset: float = 0.15
    line_slope: float = 0.3
    look_depth: float = 0.03
    seen_depth: float = 0.25
    seen_beams: int = 3
    opening_overlap: float = 0.15


LIMITS = BumpLimits()
_LOOK_DEPTH, _SEEN_DEPTH, _SEEN_BEAMS = LIMITS.look_depth, LIMITS.seen_depth, LIMITS.seen_beams


class BumpMap:
    """Pieces of walls that were bumped into, in the odometry frame.

    A contact makes a piece where the lidar sees through it or does not look. A piece is forgotten
    when the robot's centre passes through it, which shows that it was an error.

    Args:
        spec: the lidar.
        mount: its pose in the robot frame.
    """

    def __init__(self, spec: LidarSpec, mount: Pose) -> None:
        self._spec, self._mount = spec, mount
        self._pieces: list[FloatArray] = []
        self._ends, self._used = np.zeros((MOST_PIECES, 4)), np.zeros(1, np.int64)

    def __len__(self) -> int:
        return len(self._pieces)

    @property
    def ends(self) -> FloatArray:
        """X and y of the ends of the pieces, metres, odometry frame, shape (n, 4)."""
        return self._ends[: len(self._pieces)].copy()

    @property
    def arrays(self) -> tuple[FloatArray, NDArray[np.int64]]:
        """Room for the ends of `MOST_PIECES`, shape (n, 4), and how many there are, shape (1,)."""
        return self._ends, self._used

    def clear(self) -> None:
        """Forget everything."""
        self._know([])

    def copy(self) -> BumpMap:
        """What is known now, unchanged by later contacts."""
        copy = BumpMap(self._spec, self._mount)
        copy._know(self._pieces)
        return copy

    def note(self, contacts: Iterable[Contact], ranges: FloatArray, pose: Pose) -> bool:
        """Take in the contacts of one step; returns whether something new is known.

        Args:
            contacts: of the robot, robot frame.
            ranges: of the scan from the same place, metres.
            pose: of the robot, odometry frame.
        """
        unseen = [_piece(compose(pose, c)) for c in contacts if not self._is_seen(c, ranges)]
        fresh = [piece for piece in _united(unseen, math.inf) if not self._covers(piece)]
        if fresh:
            self._know(_united([*self._pieces, *fresh], LIMITS.piece_gap)[-MOST_PIECES:])
        return bool(fresh)

    def pass_on(self, before: Pose, after: Pose) -> None:
        """Forget what the robot's centre goes through from one pose to the next, odometry frame."""
        while (k := first_crossed(self.ends, *before[:2], *after[:2])) >= 0:
            self._know([*self._pieces[:k], *self._pieces[k + 1 :]])

    def join(self, scene: Scene) -> Scene:
        """A scene of the odometry frame with these walls, and without the doors that they bar."""
        if not self._pieces:
            return scene
        walls = np.vstack((ends_of(scene.walls), self.ends))
        doors = [d for d in scene.doors if not any(_bars(piece, d) for piece in self._pieces)]
        return Scene(PlainWalls(walls), tuple(doors))

    def _know(self, pieces: list[FloatArray]) -> None:
        self._pieces, self._used[0] = pieces, len(pieces)
        for k, piece in enumerate(pieces):
            self._ends[k] = piece

    def _is_seen(self, contact: Contact, ranges: FloatArray) -> bool:
        """Whether the beams that look there end there."""
        spec = self._spec
        return bool(_is_seen(contact, ranges, spec.angle_min, spec.angle_increment, self._mount))

    def _covers(self, piece: FloatArray) -> bool:
        """Whether a piece adds hardly anything to one that is known."""
        joined = ((other, _joined(other, piece, LIMITS.piece_gap)) for other in self._pieces)
        return any(
            whole is not None and _along(whole)[1] < _along(other)[1] + LIMITS.least_growth
            for other, whole in joined
        )


@njit(cache=True, error_model="numpy")
def _is_seen(
    contact: Contact, ranges: FloatArray, angle_min: float, increment: float, mount: Pose
) -> bool:
    """Whether the beams that look at a contact, robot frame, end there; NaN ends nowhere."""
    x, y = to_local(mount, to_parent(contact, (_LOOK_DEPTH, 0.0)))
    bearing = (math.atan2(y, x) - angle_min) % math.tau
    beam, beams = int(np.rint(bearing / increment)), len(ranges)
    around = beams * increment > math.tau - 1e-6
    if not around and (beam - _SEEN_BEAMS < 0 or beam + _SEEN_BEAMS >= beams):
        return False
    nearest = math.inf
    for k in range(beam - _SEEN_BEAMS, beam + _SEEN_BEAMS + 1):
        measured = ranges[k % beams]
        if math.isnan(measured):
            return False
        nearest = min(nearest, measured)
    return nearest < math.hypot(x, y) + _SEEN_DEPTH


def _piece(contact: Pose) -> FloatArray:
    """The piece of wall across a contact."""
    half = LIMITS.piece_length / 2
    return np.array((*to_parent(contact, (0.0, -half)), *to_parent(contact, (0.0, half))))


def _united(pieces: Iterable[FloatArray], gap: float) -> list[FloatArray]:
    """Pieces with those made one that are on one line and no farther apart than a gap, metres."""
    united: list[FloatArray] = []
    for piece in pieces:
        apart = []
        for other in united:
            whole = _joined(other, piece, gap)
            if whole is None:
                apart.append(other)
            else:
                piece = whole
        united = [*apart, piece]
    return united


def _joined(one: FloatArray, other: FloatArray, gap: float) -> FloatArray | None:
    """Two pieces as one, along the first; None if they are not on one line and near."""
    frame, length = _along(one)
    (first, offset), (last, last_offset) = sorted(_seen_from(frame, other))
    level = max(abs(offset), abs(last_offset)) < LIMITS.line_offset
    parallel = abs(last_offset - offset) <= LIMITS.line_slope * (last - first)
    if not (level and parallel and first < length + gap and last > -gap):
        return None
    stretch = min(first, 0.0), max(last, length)
    return np.array([value for x in stretch for value in to_parent(frame, (x, 0.0))])


def _bars(piece: FloatArray, door: Door) -> bool:
    """Whether a piece lies in the opening of a door."""
    frame, width = _along(np.array((*door.start, *door.end)))
    (first, offset), (last, last_offset) = sorted(_seen_from(frame, piece))
    level = max(abs(offset), abs(last_offset)) < 2.0 * LIMITS.line_offset
    inside = LIMITS.opening_overlap
    return level and first < width - inside and last > inside


def _along(ends: FloatArray) -> tuple[Pose, float]:
    """The frame whose x runs along a line from its start, and the line's length."""
    x1, y1, x2, y2 = ends.tolist()
    return (x1, y1, math.atan2(y2 - y1, x2 - x1)), math.dist((x1, y1), (x2, y2))


def _seen_from(frame: Pose, ends: FloatArray) -> tuple[Point, Point]:
    x1, y1, x2, y2 = ends.tolist()
    return to_local(frame, (x1, y1)), to_local(frame, (x2, y2))
