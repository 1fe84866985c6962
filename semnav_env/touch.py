"""What a robot has run into without seeing it: glass, and what lies where no beam looks."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from semnav_env.features.frames import FloatArray, Point, Pose, compose, to_local, to_parent
from semnav_env.features.scene import Door, PlainWalls, Scene, ends_of
from semnav_env.grounding.crossing import first_crossed
from semnav_env.lidar.spec import LidarSpec

PIECE, GROWN = 0.2, 0.05
"""Each touch tells of so much of a pane, and something new if that is so much longer, metres."""

GAP = 0.45
"""Pieces that are nearer to one another are one: no robot gets between them, metres."""

LEVEL, PARALLEL = 0.15, 0.3
"""Pieces are on one line up to so many metres, and radians: odometry drifts."""

MOST_PIECES = 16
"""When so many pieces are known, a new one replaces the oldest."""

BEYOND, CLEAR, BEAMS = 0.03, 0.25, 3
"""What is touched is looked at so far inside it; it is not seen if that beam, and so many to each
side, end so far behind it, metres."""

IN_OPENING = 0.15
"""A piece that lies so far inside a door's opening shows that it is none, metres."""

Touch = tuple[float, float, float]
"""Where a robot touches something, x and y in metres, and the direction from there into it,
radians, robot frame."""


class Felt:
    """Pieces of invisible walls, in the odometry frame.

    A touch makes one where the lidar sees through it or does not look; what it sees is known.
    A piece is forgotten when the robot's centre gets through it, which shows that it was an error.

    Args:
        spec: the lidar.
        mount: its pose in the robot frame.
    """

    def __init__(self, spec: LidarSpec, mount: Pose) -> None:
        self._spec, self._mount = spec, mount
        self._pieces: list[FloatArray] = []

    def __len__(self) -> int:
        return len(self._pieces)

    @property
    def ends(self) -> FloatArray:
        """X and y of the ends of the pieces, metres, odometry frame, shape (n, 4)."""
        return np.array(self._pieces).reshape(-1, 4)

    def clear(self) -> None:
        """Forget everything."""
        self._pieces = []

    def note(self, touches: Iterable[Touch], ranges: FloatArray, odometry: Pose) -> bool:
        """Take in what was touched in one step; returns whether something new is known.

        Args:
            touches: of the robot.
            ranges: of the scan from the same place, metres.
            odometry: pose of the robot, odometry frame.
        """
        felt = [_piece(compose(odometry, t)) for t in touches if not self._is_seen(t, ranges)]
        fresh = [piece for piece in _united(felt, math.inf) if not self._covers(piece)]
        if fresh:
            self._pieces = _united([*self._pieces, *fresh], GAP)[-MOST_PIECES:]
        return bool(fresh)

    def pass_on(self, before: Pose, after: Pose) -> None:
        """Forget what the robot's centre goes through from one pose to the next, odometry frame."""
        while (k := first_crossed(self.ends, *before[:2], *after[:2])) >= 0:
            del self._pieces[k]

    def join(self, scene: Scene) -> Scene:
        """A scene of the odometry frame with these walls, and without the doors that they bar."""
        if not self._pieces:
            return scene
        walls = np.vstack((ends_of(scene.walls), self.ends))
        doors = [d for d in scene.doors if not any(_bars(piece, d) for piece in self._pieces)]
        return Scene(PlainWalls(walls), tuple(doors))

    def _is_seen(self, touch: Touch, ranges: FloatArray) -> bool:
        """Whether the beams that look there end there."""
        inside = to_parent(touch, (BEYOND, 0.0))
        x, y = to_local(self._mount, inside)
        turn = (math.atan2(y, x) - self._spec.angle_min) % math.tau
        beams = round(turn / self._spec.angle_increment) + np.arange(-BEAMS, BEAMS + 1)
        if len(ranges) * self._spec.angle_increment > math.tau - 1e-6:
            beams %= len(ranges)
        elif beams[0] < 0 or beams[-1] >= len(ranges):
            return False
        return float(ranges[beams].min()) < math.hypot(x, y) + CLEAR

    def _covers(self, piece: FloatArray) -> bool:
        """Whether a piece adds hardly anything to one that is known."""
        joined = ((other, _joined(other, piece, GAP)) for other in self._pieces)
        return any(
            whole is not None and _along(whole)[1] < _along(other)[1] + GROWN
            for other, whole in joined
        )


def _piece(touch: Pose) -> FloatArray:
    """The piece across a touch."""
    return np.array((*to_parent(touch, (0.0, -PIECE / 2)), *to_parent(touch, (0.0, PIECE / 2))))


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
    level = max(abs(offset), abs(last_offset)) < LEVEL
    parallel = abs(last_offset - offset) <= PARALLEL * (last - first)
    if not (level and parallel and first < length + gap and last > -gap):
        return None
    stretch = min(first, 0.0), max(last, length)
    return np.array([value for x in stretch for value in to_parent(frame, (x, 0.0))])


def _bars(piece: FloatArray, door: Door) -> bool:
    """Whether a piece lies in the opening of a door."""
    frame, width = _along(np.array((*door.start, *door.end)))
    (first, offset), (last, last_offset) = sorted(_seen_from(frame, piece))
    level = max(abs(offset), abs(last_offset)) < 2.0 * LEVEL
    return level and first < width - IN_OPENING and last > IN_OPENING


def _along(ends: FloatArray) -> tuple[Pose, float]:
    """The frame whose x runs along a line from its start, and the line's length."""
    x1, y1, x2, y2 = ends.tolist()
    return (x1, y1, math.atan2(y2 - y1, x2 - x1)), math.dist((x1, y1), (x2, y2))


def _seen_from(frame: Pose, ends: FloatArray) -> tuple[Point, Point]:
    x1, y1, x2, y2 = ends.tolist()
    return to_local(frame, (x1, y1)), to_local(frame, (x2, y2))
